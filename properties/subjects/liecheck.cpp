// liecheck's own library in float and double; liecheck:fast and liecheck:tight run where they are named.

#include <subjects/own.hpp>

namespace liecheck::properties {
namespace {

const Registered<float> in_float(Own<float>::with_robots());
const Registered<double> in_double(Own<double>::with_robots());
const Registered<float> fast_in_float(Own<float, Precision::fast>::make());
const Registered<double> fast_in_double(Own<double, Precision::fast>::make());
const Registered<float> tight_in_float(Own<float, Precision::tight>::make());
const Registered<double> tight_in_double(Own<double, Precision::tight>::make());

}  // namespace
}  // namespace liecheck::properties
