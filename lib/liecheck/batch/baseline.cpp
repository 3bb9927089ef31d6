#include <liecheck/batch/kernels.hpp>

namespace liecheck::batch::detail {
constinit const Kernels baseline = kernelsOf<register_bytes>();
}
