#pragma once
// Trees of bodies and robots that an adapter is asked about. A model is one line of JSON; docs/adapters.md has its
// members. A call has the arguments of its operation as consecutive numbers; joint and reference are numbers,
// too. A frame (joint, Q, p) follows the arguments of each operation on a frame.

#include <adapters/adapter.hpp>
#include <functional>
#include <operations/numbers.hpp>
#include <set>
#include <subjects/subject.hpp>
#include <subjects/tree.hpp>
#include <vector>

namespace liecheck::properties::adapters {

/// Those of oracles::joint_names.
const std::vector<std::string>& joint_names();

/// Every operation on trees and robots.
const std::vector<const Operation*>& model_operations();
/// One of them, or null.
const Operation* model_operation(std::string_view name);
/// Whether the operation takes a frame.
bool of_frame(const Operation& operation);

/// Where to send calls of a model, and how.
using Route = std::function<Adapter&()>;

/// A model that an adapter is asked about. Its numbers are rounded to the scalar.
class Model {
 public:
  /// The URDF of the tree, if it has one and the adapter takes it; otherwise the list of its joints.
  Model(const Tree<double>& tree, const Description& adapter, const Scalar& scalar, Route route);
  Model(const UrdfModel& robot, const Scalar& scalar, Route route);

  /// How many numbers the operation takes and gives.
  OperationSizes sizes(const Operation& operation) const;
  /// Numbers in the scalar, without those of the frame. Throws CallFailed if the call has no result, or std::domain_error if
  /// it is refused.
  void call(const Operation& operation, const void* arguments, void* results) const;
  const std::string& text() const { return text_; }
  ModelSize size() const { return size_; }
  /// What follows the arguments of an operation on a frame.
  const std::vector<double>& frame() const { return frame_; }

 private:
  /// Throws CallFailed if the adapter does not see frames in the reference.
  void check_reference(const Operation& operation, const void* arguments) const;

  std::string text_;
  ModelSize size_;
  const Scalar& scalar_;
  std::vector<double> frame_;
  std::string unsupported_;           ///< a joint that the adapter does not take, or ""
  std::set<std::string> references_;  ///< in which it sees frames
  Route route_;
};

/// Fills the operations that the adapter offers on a tree; none if it takes no such model.
void fill_tree(TreeOperations<double>& o, const Tree<double>& tree, const Description& adapter,
               const Scalar& scalar, const Route& route);
/// Fills the operations on the configurations of a robot. May be called if offers_robots().
void fill_robot(RobotOperations<double>& o, const UrdfModel& robot, const Scalar& scalar, const Route& route);

/// Whether the adapter offers every operation on the configurations of a robot, and takes URDFs.
bool offers_robots(const Description& adapter, const std::string& scalar);

}  // namespace liecheck::properties::adapters
