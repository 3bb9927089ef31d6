#include <oracles/tree_definitions.hpp>

namespace liecheck::oracles {

LIECHECK_TREE(DoubleBall)
LIECHECK_TREE(DoubleDoubleBall)
template std::vector<double> solve(const std::vector<double>&, std::vector<double>);

}  // namespace liecheck::oracles
