#include <correct/correct_lagrange.hpp>
#include <correct/correct_trees.hpp>

namespace liecheck::properties::correct {
namespace {

const RegisteredTree<DenseTree, float> in_float;

}  // namespace
}  // namespace liecheck::properties::correct
