// liecheck's own library in float128, and in the scalars that are timed alone.

#include <subjects/wide_scalars.hpp>
#include <subjects/liecheck_operations.hpp>

namespace liecheck::properties {
namespace {

const Registered<float128> in_float128(LiecheckOperations<float128>::with_robots());

}  // namespace

template <class S>
Operations<S> wide_scalar_operations() {
  return LiecheckOperations<S>::make().operations;
}
template Operations<float128> wide_scalar_operations();
template Operations<Digits50> wide_scalar_operations();
template Operations<Digits100> wide_scalar_operations();
#ifdef LIECHECK_QD
template Operations<dd_real> wide_scalar_operations();
#endif

const char* liecheck_version() {
  return LIECHECK_VERSION;
}

}  // namespace liecheck::properties
