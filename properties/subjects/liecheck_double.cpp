// liecheck's own library in double. liecheck:fast and liecheck:tight run only if they are named.

#include <subjects/liecheck_robots.hpp>
#include <subjects/liecheck_trees.hpp>

namespace liecheck::properties {
namespace {

const Registered<double> standard(liecheck_with_robots<double>(&liecheck_tree<double>));
const Registered<double> fast(LiecheckOperations<double, Precision::fast>::make());
const Registered<double> tight(LiecheckOperations<double, Precision::tight>::make());

}  // namespace
}  // namespace liecheck::properties
