// liecheck's own library in float128, for campaigns and for `liecheck cost`.

#include <subjects/liecheck_robots.hpp>
#include <subjects/wide_scalars.hpp>

namespace liecheck::properties {
namespace {

const Registered<float128> in_float128(liecheck_with_robots<float128>());

}  // namespace

template <>
Operations<float128> wide_scalar_operations() {
  return LiecheckOperations<float128>::make().operations;
}

}  // namespace liecheck::properties
