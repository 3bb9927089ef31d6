#include <correct/correct_kane.hpp>
#include <correct/correct_trees.hpp>

namespace liecheck::properties::correct {
namespace {

const RegisteredTree<KaneTree, float> in_float;

}  // namespace
}  // namespace liecheck::properties::correct
