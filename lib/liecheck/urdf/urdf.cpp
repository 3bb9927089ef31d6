#include <liecheck/spatial/inertia.hpp>
#include <liecheck/text/text_file.hpp>
#include <liecheck/urdf/description.hpp>
#include <liecheck/urdf/urdf.hpp>

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

/// Sets the limits, damping and friction of a joint with one degree of freedom.
void setLimits(Model<double>& model, const JointDescription& joint, int index) {
  if (model.nvs[std::size_t(index)] != 1) return;
  const int v = model.idx_vs[std::size_t(index)], q = model.idx_qs[std::size_t(index)];
  if (joint.limit) model.effortLimit[v] = joint.limit->effort, model.velocityLimit[v] = joint.limit->velocity;
  if (joint.limit && model.nqs[std::size_t(index)] == 1)
    model.lowerPositionLimit[q] = joint.limit->lower, model.upperPositionLimit[q] = joint.limit->upper;
  if (joint.dynamics)
    model.damping[v] = joint.dynamics->damping, model.friction[v] = joint.dynamics->friction;
}

class ModelBuilder {
 public:
  ModelBuilder(const Description& robot, const UrdfOptions& options, Messages& messages)
      : robot_(robot), options_(options), messages_(messages) {}

  Model<double> build() {
    model_.name = robot_.name;
    int joint = 0, joint_frame = 0;
    if (options_.root_joint || options_.root == RootJoint::FreeFlyer) {
      joint = model_.addJoint(0, options_.root_joint.value_or(FreeFlyer<double>()), SE3<double>::Identity(),
                              "root_joint");
      joint_frame = model_.addJointFrame(joint);
    }
    const int body_frame = model_.addBodyFrame(robot_.root, joint, SE3<double>::Identity(), joint_frame);
    model_.appendBodyToJoint(joint, robot_.links.at(robot_.root).inertia);
    addTree(body_frame);
    checkBodies();
    return std::move(model_);
  }

 private:
  /// Adds the joints below the root link, depth first, and in alphabetical order for each link.
  void addTree(int root_frame) {
    std::vector<std::pair<std::string, int>> todo;  // a joint, and the BODY frame of its parent link
    const auto push = [&](const std::string& link, int frame) {
      const auto& below = robot_.joints_below.at(link);
      for (auto joint = below.rbegin(); joint != below.rend(); ++joint) todo.emplace_back(*joint, frame);
    };
    push(robot_.root, root_frame);
    while (!todo.empty()) {
      const auto [name, frame] = todo.back();
      todo.pop_back();
      const JointDescription& joint = robot_.joints.at(name);
      push(joint.child, connect(name, joint, frame));
    }
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
    if (joint.mimic) checkPrimary(name, joint);
    const bool tied = joint.mimic && options_.mimic == MimicJoints::Tied;
    const int index = model_.addJoint(parent.parentJoint, modelJoint(joint, model_, tied), X_PJ, name);
    setLimits(model_, joint, index);
    const int frame = model_.addJointFrame(index, parent_frame);
    model_.appendBodyToJoint(index, inertia);
    return model_.addBodyFrame(joint.child, index, SE3<double>::Identity(), frame);
  }

  void checkPrimary(const std::string& name, const JointDescription& joint) const {
    const std::string& primary = joint.mimic->primary;
    const int index = model_.getJointId(primary);
    const auto refuse = [&](const char* what) {
      messages_.refuse(joint.line, "joint '" + name + "' mimics " + what, primary);
    };
    if (name == primary) refuse("itself");
    if (model_.existFrame(primary, FrameType::FIXED_JOINT)) refuse("a joint that does not move");
    if (index == model_.njoints) refuse("a joint that comes later (depth first, in alphabetical order)");
    if (std::holds_alternative<Mimic<double>>(model_.joints[std::size_t(index)]))
      refuse("a joint that is a mimic itself");
    if (model_.nvs[std::size_t(index)] != 1)
      refuse("a joint that does not have exactly one degree of freedom");
  }

  /// Checks the total inertia of the links fixed to each joint. If no body can have it, the error names the
  /// link at fault. A joint without mass causes a warning.
  void checkBodies() {
    for (const auto& [link, line, what, value] : robot_.unphysical_links) {
      const int joint = model_.frames[std::size_t(model_.getFrameId(link, FrameType::BODY))].parentJoint;
      if (!whyUnphysical(model_.inertias[std::size_t(joint)], urdf_detail::printed_inertia_slack).empty())
        messages_.refuse(line, what, value);
      messages_.warn(line, what + "; the sum with the links fixed to it is valid", value);
    }
    for (int i = 1; i < model_.njoints; ++i) {
      if (model_.inertias[std::size_t(i)].mass() > 0) continue;
      const std::string& name = model_.names[std::size_t(i)];
      const auto joint = robot_.joints.find(name);
      messages_.warn(joint == robot_.joints.end() ? robot_.line : joint->second.line,
                     "the link of a moving joint and the links fixed to it have no mass", name);
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
    std::string text = readTextFile(path, max_urdf_bytes);
    if (text.size() > max_urdf_bytes)
      throw FileError("larger than the limit for a URDF", std::to_string(max_urdf_bytes) + " bytes");
    return text;
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
