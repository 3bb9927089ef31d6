#include <correct/correct_lagrange.hpp>
#include <correct/correct_trees.hpp>

namespace liecheck::properties::correct {

const RegisteredTree<DenseTree> registered_lagrange{"correct:lagrange", "dense Jacobians in body axes"};

}  // namespace liecheck::properties::correct
