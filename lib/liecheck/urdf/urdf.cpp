#include <liecheck/spatial/inertia.hpp>
#include <liecheck/text/text_file.hpp>
#include <liecheck/urdf/description.hpp>
#include <liecheck/urdf/urdf.hpp>
#include <type_traits>

namespace liecheck {

namespace {

using urdf_detail::Description, urdf_detail::JointDescription, urdf_detail::JointType, urdf_detail::Messages;

Mimic<double>::Moved oneDof(const JointDescription& joint) {
  if (joint.type == JointType::Prismatic) return Prismatic<double>(joint.axis);
  return Revolute<double>(joint.axis);
}

/// The joint of the model. The primary of a tied mimic must already be in the model.
Joint<double> modelJoint(const JointDescription& joint, const Model<double>& model, bool tied) {
  if (tied)
    return Mimic<double>(oneDof(joint), model.getJointId(joint.mimic->primary), joint.mimic->multiplier,
                         joint.mimic->offset);
  if (joint.type == JointType::Revolute) return Revolute<double>(joint.axis);
  if (joint.type == JointType::Continuous) return Continuous<double>(joint.axis);
  if (joint.type == JointType::Prismatic) return Prismatic<double>(joint.axis);
  if (joint.type == JointType::Planar) return Planar<double>();
  if (joint.type == JointType::Floating) return FreeFlyer<double>();
  throw std::logic_error("a fixed joint is not a joint of the model");
}

/// Sets the limits, damping and friction of a joint with one degree of freedom. Crossed and negative limits,
/// which public URDFs use for "unlimited", are ignored.
void setLimits(Model<double>& model, const JointDescription& joint, int index) {
  if (model.nvs[std::size_t(index)] != 1) return;
  const int v = model.idx_vs[std::size_t(index)], q = model.idx_qs[std::size_t(index)];
  if (joint.limit && joint.limit->effort >= 0) model.effortLimit[v] = joint.limit->effort;
  if (joint.limit && joint.limit->velocity >= 0) model.velocityLimit[v] = joint.limit->velocity;
  if (joint.limit && model.nqs[std::size_t(index)] == 1 && joint.limit->lower <= joint.limit->upper)
    model.lowerPositionLimit[q] = joint.limit->lower, model.upperPositionLimit[q] = joint.limit->upper;
  if (joint.dynamics)
    model.damping[v] = joint.dynamics->damping, model.friction[v] = joint.dynamics->friction;
}

class ModelBuilder {
 public:
  ModelBuilder(const Description& robot, const UrdfOptions& options, Messages& messages)
      : robot_(robot), options_(options), messages_(messages) {}

  Model<double> build() {
    model_.name = robot_.name.empty() ? urdf_detail::unnamed_robot : robot_.name;
    int joint = 0, joint_frame = 0;
    if (options_.root_joint || options_.root == RootJoint::FreeFlyer) {
      joint = model_.addJoint(0, options_.root_joint.value_or(FreeFlyer<double>()), SE3<double>::Identity(),
                              "root_joint");
      joint_frame = model_.addJointFrame(joint);
    }
    const int body_frame = model_.addBodyFrame(robot_.root, joint, SE3<double>::Identity(), joint_frame);
    const auto& root = robot_.links.at(robot_.root);
    at(root.line, robot_.root, [&] { return model_.appendBodyToJoint(joint, root.inertia); });
    addTree(body_frame);
    checkBodies();
    checkMoving();
    return std::move(model_);
  }

 private:
  /// Returns f(); what the model refuses is an error in this line.
  template <class F>
  std::invoke_result_t<F> at(int line, const std::string& value, const F& f) const {
    try {
      return f();
    } catch (const std::invalid_argument& e) {
      messages_.refuse(line, e.what(), value);
    }
  }

  struct Place {
    std::string joint;
    int parent_frame;  ///< the BODY frame of its parent link
  };

  /// Adds the joints below the root link, depth first, and in alphabetical order for each link. A tied mimic
  /// waits until the subtree of its primary has been added.
  void addTree(int root_frame) {
    std::vector<Place> todo;
    std::map<std::string, std::vector<Place>> waiting;  // by the name of the primary
    const auto push = [&](const std::string& link, int frame) {
      const auto& below = robot_.joints_below.at(link);
      for (auto joint = below.rbegin(); joint != below.rend(); ++joint) todo.push_back({*joint, frame});
    };
    push(robot_.root, root_frame);
    while (!todo.empty()) {
      const Place place = std::move(todo.back());
      todo.pop_back();
      const JointDescription& joint = robot_.joints.at(place.joint);
      if (isTied(joint) && !model_.existJointName(joint.mimic->primary)) {
        waiting[joint.mimic->primary].push_back(place);
        continue;
      }
      const int frame =
          at(joint.line, place.joint, [&] { return connect(place.joint, joint, place.parent_frame); });
      if (const auto mimics = waiting.extract(place.joint))
        todo.insert(todo.end(), mimics.mapped().rbegin(), mimics.mapped().rend());
      push(joint.child, frame);
    }
    for (const auto& [primary, mimics] : waiting)
      messages_.refuse(
          robot_.joints.at(mimics[0].joint).line,
          "joint '" + mimics[0].joint + "' mimics a joint that it carries, directly or through another mimic",
          primary);
  }

  bool isTied(const JointDescription& joint) const {
    return joint.mimic && options_.mimic == MimicJoints::Tied;
  }

  /// Adds the joint and its child link; returns the link's BODY frame.
  int connect(const std::string& name, const JointDescription& joint, int parent_frame) {
    const Frame<double> parent = model_.frames[std::size_t(parent_frame)];
    const SE3<double> X_PJ = parent.placement * joint.X_PJ;
    const Inertia<double>& inertia = robot_.links.at(joint.child).inertia;
    if (joint.type == JointType::Fixed) {
      const int frame = model_.addFixedJoint(name, parent.parentJoint, X_PJ, parent_frame);
      model_.appendBodyToJoint(parent.parentJoint, inertia, X_PJ);
      return model_.addBodyFrame(joint.child, parent.parentJoint, X_PJ, frame);
    }
    const int index =
        model_.addJoint(parent.parentJoint, modelJoint(joint, model_, isTied(joint)), X_PJ, name);
    setLimits(model_, joint, index);
    const int frame = model_.addJointFrame(index, parent_frame);
    model_.appendBodyToJoint(index, inertia);
    return model_.addBodyFrame(joint.child, index, SE3<double>::Identity(), frame);
  }

  /// Warns of links whose inertia no body can have, with what follows for the links fixed to one joint together.
  /// A moment that is too large for the others leaves the equations of motion well-posed; with a negative one
  /// the kinetic energy can be negative.
  void checkBodies() {
    for (const auto& [link, line, what, value] : robot_.unphysical_links) {
      const int joint = model_.frames[std::size_t(model_.getFrameId(link, FrameType::BODY))].parentJoint;
      const Inertia<double>& sum = model_.inertias[std::size_t(joint)];
      if (urdf_detail::whyUnphysicalLink(sum).empty())
        messages_.warn(line, what + "; the sum with the links fixed to it is valid", value);
      else if (joint == 0)
        messages_.warn(line, what + "; the link does not move", value);
      else if (urdf_detail::smallestMoment(sum) < -urdf_detail::printed_inertia_slack)
        messages_.warn(line, what + ", and the kinetic energy can be negative", value);
      else
        messages_.warn(line, what, value);
    }
  }

  /// Warns of joints without mass, and of those with S^T I S = 0 in one of their directions, where I is the
  /// inertia of all bodies that the joint moves at the neutral configuration.
  void checkMoving() {
    std::vector<Inertia<double>> moved = model_.inertias;
    for (int i = model_.njoints - 1; i > 0; --i) {
      const std::size_t k = std::size_t(i), parent = std::size_t(model_.parents[k]);
      moved[parent] = moved[parent] + model_.jointPlacements[k].act(moved[k]);
    }
    for (std::size_t i = 1; i < moved.size(); ++i) {
      const auto joint = robot_.joints.find(model_.names[i]);
      const int line = joint == robot_.joints.end() ? robot_.line : joint->second.line;
      const auto weight = [&](const auto& model_joint) {
        const Eigen::Matrix<double, 6, Eigen::Dynamic> S = model_joint.subspace();
        const MatrixX<double> D = S.transpose() * moved[i].matrix() * S;
        return D.diagonal().minCoeff();
      };
      if (model_.inertias[i].mass() == 0)
        messages_.warn(line, "the link of a moving joint and the links fixed to it have no mass",
                       model_.names[i]);
      else if (model_.nvs[i] > 0 && std::visit(weight, model_.joints[i]) <= 0)
        messages_.warn(line, "no inertia resists this joint at the neutral configuration", model_.names[i]);
    }
  }

  const Description& robot_;
  const UrdfOptions& options_;
  Messages& messages_;
  Model<double> model_;
};

}  // namespace

UrdfRobot loadUrdfText(const std::string& text, const UrdfOptions& options, const std::string& source_name) {
  Messages messages(source_name, options.strict);
  if (text.size() > max_urdf_bytes)
    messages.refuse(0, "larger than the limit for a URDF", std::to_string(max_urdf_bytes) + " bytes");
  const Description robot = urdf_detail::describe(text, options, messages);
  Model<double> model = ModelBuilder(robot, options, messages).build();
  return {std::move(model), std::move(messages.warnings)};
}

Model<double> buildModelFromUrdfText(const std::string& text, RootJoint root,
                                     const std::string& source_name) {
  return loadUrdfText(text, {.root = root}, source_name).model;
}

std::string readUrdf(const std::string& path) {
  try {
    return readTextFile(path, max_urdf_bytes);
  } catch (const FileError& e) {
    throw UrdfError(path, 0, e.problem, e.value);
  }
}

UrdfRobot loadUrdf(const std::string& path, const UrdfOptions& options) {
  return loadUrdfText(readUrdf(path), options, path);
}
Model<double> buildModelFromUrdf(const std::string& path, RootJoint root) {
  return loadUrdf(path, {.root = root}).model;
}

}  // namespace liecheck
