#include <subjects/eigen_geometry.hpp>

namespace liecheck::properties {
namespace {

const Registered<float> in_float(EigenGeometry<float>::make());

}  // namespace
}  // namespace liecheck::properties
