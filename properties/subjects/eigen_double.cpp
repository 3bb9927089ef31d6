#include <subjects/eigen_geometry.hpp>

namespace liecheck::properties {
namespace {

const Registered<double> in_double(EigenGeometry<double>::make());

}  // namespace
}  // namespace liecheck::properties
