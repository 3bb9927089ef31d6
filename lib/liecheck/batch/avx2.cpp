#include <Eigen/Core>
#undef __FMA__
#undef __FP_FAST_FMA
#undef __ARM_FEATURE_FMA  // the formulas without it, so that all sets of instructions give the same bits
#include <liecheck/batch/kernels.hpp>

namespace liecheck::batch::detail {
constinit const Kernels avx2 = kernelsOf<32>();
}
