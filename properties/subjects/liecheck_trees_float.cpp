#include <subjects/liecheck_robots.hpp>
#include <subjects/liecheck_tree.hpp>

namespace liecheck::properties {

template Model<float> liecheck_model(const Tree<float>&);
template RobotOperations<float> liecheck_robot(const std::string&, bool);
template TreeOperations<float> liecheck_tree(const Tree<float>&);

}  // namespace liecheck::properties
