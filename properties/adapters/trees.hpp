#pragma once
// Trees of bodies and robots that an adapter is asked about. A model is one line of JSON; docs/adapters.md has its
// members. A call has the arguments of its operation as consecutive numbers; joint and reference are numbers,
// too. A frame (joint, Q, p) follows the arguments of each operation on a frame.

#include <adapters/adapter.hpp>
#include <functional>
#include <subjects/tree.hpp>
#include <vector>

namespace liecheck::properties::adapters {

/// The names of the kinds of joints in the order of oracles::JointKind, then "mimic" and "armature".
const std::vector<std::string>& joint_names();

/// Every operation on trees and robots.
const std::vector<const Operation*>& model_operations();
/// One of them, or null.
const Operation* model_operation(std::string_view name);

/// Where to send calls of a model, and how.
using Route = std::function<Adapter&()>;

/// A model that an adapter is asked about, in the scalar S.
template <class S>
class Model {
 public:
  /// The URDF of the tree, if it has one and the adapter takes it; otherwise the list of its joints.
  Model(const Tree<S>& tree, const Description& adapter, Route route);
  Model(const UrdfModel& robot, Route route);

  /// How many numbers the operation takes and gives.
  OperationSizes sizes(const Operation& operation) const;
  /// Throws CallFailed if the call has no result, or std::domain_error if it is refused.
  std::vector<S> call(const Operation& operation, std::vector<S> arguments) const;
  const std::string& text() const { return text_; }
  const std::vector<S>& frame() const { return frame_; }
  int nq() const { return nq_; }
  int nv() const { return nv_; }

 private:
  std::string text_;
  int nq_, nv_;
  std::vector<S> frame_;
  std::string unsupported_;  ///< a joint that the adapter does not take, or ""
  Route route_;
};

/// Appends the number or numbers of an argument.
template <class S, class T>
void append(std::vector<S>& to, const T& x) {
  if constexpr (requires { x.size(); })
    to.insert(to.end(), x.data(), x.data() + x.size());
  else
    to.push_back(static_cast<S>(static_cast<int>(x)));
}

/// The operations that the adapter offers on a tree; none if it takes no such model.
template <class S>
TreeOperations<S> tree_operations(const Tree<S>& tree, const Description& adapter, const Route& route);

/// The operations on the configurations of a robot. May be called if offers_robots().
template <class S>
RobotOperations<S> robot_operations(const std::string& urdf, bool fixed, const Route& route);

/// Whether the adapter offers every operation on the configurations of a robot, and takes URDFs.
bool offers_robots(const Description& adapter, const std::string& scalar);
/// Whether the adapter offers an operation on trees.
bool offers_trees(const Description& adapter, const std::string& scalar);

}  // namespace liecheck::properties::adapters
