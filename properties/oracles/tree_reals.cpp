#include <oracles/tree_definitions.hpp>

namespace liecheck::oracles {

LIECHECK_TREE(Real)
LIECHECK_TREE(Real100)
LIECHECK_TREE(RealBall)

}  // namespace liecheck::oracles
