#include <correct/correct_newton.hpp>
#include <correct/correct_trees.hpp>

namespace liecheck::properties::correct {
namespace {

const RegisteredTree<NewtonTree, float> in_float;
const RegisteredTree<NewtonTree, double> in_double;

}  // namespace
}  // namespace liecheck::properties::correct
