#include <liecheck/batch/kernels.hpp>

namespace liecheck::batch::detail {
constinit const Kernels avx2 = kernelsOf<32>();
}
