#include <Eigen/Core>
#undef __FMA__  // the formulas without it, so that all sets of instructions give the same bits
#include <liecheck/batch/kernels.hpp>

namespace liecheck::batch::detail {
constinit const Kernels avx2 = kernelsOf<32>();
}
