#include <correct/correct_newton.hpp>
#include <correct/correct_trees.hpp>

namespace liecheck::properties::correct {

const RegisteredTree<NewtonTree> registered_newton{"correct:newton", "recursion in the axes of each body"};

}  // namespace liecheck::properties::correct
