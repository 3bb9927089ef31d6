// liecheck's own library in float and double.

#include <subjects/own.hpp>

namespace liecheck::properties {
namespace {

const Registered<float> in_float(Own<float>::with_robots());
const Registered<double> in_double(Own<double>::with_robots());

}  // namespace
}  // namespace liecheck::properties
