#include <correct/correct_kane.hpp>
#include <correct/correct_trees.hpp>

namespace liecheck::properties::correct {

const RegisteredTree<KaneTree> registered_kane{"correct:kane", "centres of mass in world axes"};

}  // namespace liecheck::properties::correct
