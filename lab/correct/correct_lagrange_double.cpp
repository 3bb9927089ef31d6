#include <correct/correct_lagrange.hpp>
#include <correct/correct_trees.hpp>

namespace liecheck::properties::correct {
namespace {

const RegisteredTree<DenseTree, double> in_double;

}  // namespace
}  // namespace liecheck::properties::correct
