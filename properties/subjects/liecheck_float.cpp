// liecheck's own library in float. liecheck:fast and liecheck:tight run only if they are named.

#include <subjects/liecheck_robots.hpp>
#include <subjects/liecheck_trees.hpp>

namespace liecheck::properties {
namespace {

const Registered<float> standard(liecheck_with_robots<float>(&liecheck_tree<float>));
const Registered<float> fast(LiecheckOperations<float, Precision::fast>::make());
const Registered<float> tight(LiecheckOperations<float, Precision::tight>::make());

}  // namespace
}  // namespace liecheck::properties
