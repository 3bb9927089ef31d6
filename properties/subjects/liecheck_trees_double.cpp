#include <subjects/liecheck_robots.hpp>
#include <subjects/liecheck_tree.hpp>

namespace liecheck::properties {

template Model<double> liecheck_model(const Tree<double>&);
template RobotOperations<double> liecheck_robot(const std::string&, bool);
template TreeOperations<double> liecheck_tree(const Tree<double>&);

}  // namespace liecheck::properties
