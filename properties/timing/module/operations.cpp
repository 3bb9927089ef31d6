// A module of timing/kernels.hpp: the library in double, compiled with the flags that LIECHECK_KERNELS names.

#include <subjects/liecheck_operations.hpp>
#include <timing/kernels.hpp>

extern "C" __attribute__((visibility("default"))) const liecheck::properties::Kernels* liecheck_kernels() {
  using namespace liecheck::properties;
  static const TypedOperations<double> operations = LiecheckOperations<double>::make().operations;
  static const Kernels kernels{LIECHECK_KERNELS, kernels_layout(), &operations};
  return &kernels;
}
