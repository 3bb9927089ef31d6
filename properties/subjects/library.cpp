// liecheck's own library in float128, and in the scalars that are timed alone.

#include <subjects/library.hpp>
#include <subjects/own.hpp>

namespace liecheck::properties {
namespace {

const Registered<float128> in_float128(Own<float128>::with_robots());

}  // namespace

template <class S>
Operations<S> library_operations() {
  return Own<S>::make().operations;
}
template Operations<float128> library_operations();
template Operations<Digits50> library_operations();
template Operations<Digits100> library_operations();
#ifdef LIECHECK_QD
template Operations<dd_real> library_operations();
#endif

const char* library_version() {
  return LIECHECK_VERSION;
}

}  // namespace liecheck::properties
