#include <correct/correct_kane.hpp>
#include <correct/correct_trees.hpp>

namespace liecheck::properties::correct {
namespace {

const RegisteredTree<KaneTree, double> in_double;

}  // namespace
}  // namespace liecheck::properties::correct
