#include <liecheck/batch/kernels.hpp>

namespace liecheck::batch::detail {
constinit const Kernels avx512 = kernelsOf<64>();
}
