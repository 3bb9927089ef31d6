#include <console_bridge/console.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <liecheck/multibody/inertia_validity.hpp>
#include <liecheck/urdf/urdf.hpp>
#include <liecheck/urdf/urdf_text.hpp>
#include <memory>
#include <mutex>

namespace liecheck {

namespace {

/// While it lives, what urdfdom logs is kept here instead of going to stderr. The handler is the process's,
/// so one parse runs at a time.
class QuietLog : private console_bridge::OutputHandler {
 public:
  QuietLog() : lock_(mutex()) { console_bridge::useOutputHandler(this); }
  ~QuietLog() override { console_bridge::restorePreviousOutputHandler(); }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;
  /// The errors, the first one first.
  const std::string& errors() const { return errors_; }

 private:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) errors_ += (errors_.empty() ? "" : "; ") + text;
  }
  static std::mutex& mutex() {
    static std::mutex m;
    return m;
  }
  std::lock_guard<std::mutex> lock_;
  std::string errors_;
};

SE3<double> pose(const urdf::Pose& X) {
  Vector4<double> Q;
  X.rotation.getQuaternion(Q[0], Q[1], Q[2], Q[3]);
  return {SO3<double>(Q), Vector3<double>(X.position.x, X.position.y, X.position.z)};
}

Inertia<double> inertia(const urdf::Link& link) {
  if (!link.inertial) return Inertia<double>::Zero();
  const urdf::Inertial& i = *link.inertial;
  Matrix3<double> I_C;
  I_C << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
  return pose(i.origin).act(Inertia<double>(i.mass, Vector3<double>::Zero(), I_C));
}

Mimic<double>::Moved oneDof(const urdf::Joint& joint, const Axis<double>& axis) {
  if (joint.type == urdf::Joint::PRISMATIC) return Prismatic<double>(axis);
  return Revolute<double>(axis);
}

/// The joint of the model; a mimic's primary must be in the model already.
Joint<double> moving(const urdf::Joint& joint, const Model<double>& model, bool tied) {
  const Vector3<double> axis(joint.axis.x, joint.axis.y, joint.axis.z);
  if (tied)
    return Mimic<double>(oneDof(joint, Axis<double>(axis)), model.getJointId(joint.mimic->joint_name),
                         joint.mimic->multiplier, joint.mimic->offset);
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return Revolute<double>(axis);
    case urdf::Joint::CONTINUOUS:
      return Continuous<double>(axis);
    case urdf::Joint::PRISMATIC:
      return Prismatic<double>(axis);
    case urdf::Joint::PLANAR:
      return Planar<double>();
    case urdf::Joint::FLOATING:
      return FreeFlyer<double>();
    default:
      throw std::logic_error("the validator let a joint type pass that has no model");
  }
}

/// The limits and the friction of a joint with one degree of freedom.
void setLimits(Model<double>& model, const urdf::Joint& joint, int index) {
  if (model.nvs[std::size_t(index)] != 1) return;
  const int v = model.idx_vs[std::size_t(index)], q = model.idx_qs[std::size_t(index)];
  if (joint.limits)
    model.effortLimit[v] = joint.limits->effort, model.velocityLimit[v] = joint.limits->velocity;
  if (joint.limits && model.nqs[std::size_t(index)] == 1)
    model.lowerPositionLimit[q] = joint.limits->lower, model.upperPositionLimit[q] = joint.limits->upper;
  if (joint.dynamics)
    model.damping[v] = joint.dynamics->damping, model.friction[v] = joint.dynamics->friction;
}

/// Adds the links below one whose BODY frame is in the model.
class Tree {
 public:
  Tree(Model<double>& model, const UrdfOptions& options, urdf_detail::ValidUrdf& valid,
       const std::string& source)
      : model_(model), options_(options), valid_(valid), source_(source) {}

  /// Depth first, the children of a link in alphabetical order of joint names; without recursion.
  void add(const urdf::LinkConstSharedPtr& root, int body_frame) {
    std::vector<std::pair<Step, int>> todo;  // and the BODY frame of the joint's parent
    const auto push = [&](const urdf::LinkConstSharedPtr& link, int frame) {
      std::unordered_map<std::string, urdf::LinkConstSharedPtr> links;
      for (const auto& child : link->child_links) links.emplace(child->name, child);
      std::vector<Step> steps;
      for (const auto& joint : link->child_joints) steps.push_back({joint, links.at(joint->child_link_name)});
      std::sort(steps.begin(), steps.end(),
                [](const Step& a, const Step& b) { return a.joint->name > b.joint->name; });
      for (const Step& step : steps) todo.emplace_back(step, frame);
    };
    push(root, body_frame);
    while (!todo.empty()) {
      const auto [step, frame] = todo.back();
      todo.pop_back();
      push(step.link, connect(*step.joint, *step.link, frame));
    }
  }

 private:
  struct Step {
    urdf::JointConstSharedPtr joint;
    urdf::LinkConstSharedPtr link;
  };

  /// The joint and the link behind it; returns the link's BODY frame.
  int connect(const urdf::Joint& joint, const urdf::Link& link, int parent_frame) {
    const Frame<double> parent = model_.frames[std::size_t(parent_frame)];
    const SE3<double> X_PJ = parent.placement * pose(joint.parent_to_joint_origin_transform);
    if (joint.type == urdf::Joint::FIXED) {
      const int frame = model_.addFixedJoint(joint.name, parent.parentJoint, X_PJ, parent_frame);
      model_.appendBodyToJoint(parent.parentJoint, inertia(link), X_PJ);
      return model_.addBodyFrame(link.name, parent.parentJoint, X_PJ, frame);
    }
    const bool mimics =
        joint.mimic && joint.type != urdf::Joint::FLOATING && joint.type != urdf::Joint::PLANAR;
    if (mimics) checkPrimary(joint);
    const bool tied = mimics && options_.mimic == MimicJoints::Tied;
    const int index = model_.addJoint(parent.parentJoint, moving(joint, model_, tied), X_PJ, joint.name);
    setLimits(model_, joint, index);
    const int frame = model_.addJointFrame(index, parent_frame);
    model_.appendBodyToJoint(index, inertia(link));
    return model_.addBodyFrame(link.name, index, SE3<double>::Identity(), frame);
  }
  void checkPrimary(const urdf::Joint& joint) const {
    const std::string& primary = joint.mimic->joint_name;
    const int line = valid_.joint_line.at(joint.name), index = model_.getJointId(primary);
    const std::string what = "joint '" + joint.name + "' mimics ";
    if (joint.name == primary) throw UrdfError(source_, line, what + "itself", primary);
    if (model_.existFrame(primary, FrameType::FIXED_JOINT))
      throw UrdfError(source_, line, what + "a joint that does not move", primary);
    if (index == model_.njoints)
      throw UrdfError(source_, line, what + "a joint that comes later, depth first and by the alphabet",
                      primary);
    if (std::holds_alternative<Mimic<double>>(model_.joints[std::size_t(index)]))
      throw UrdfError(source_, line, what + "a joint that is a mimic itself", primary);
    if (model_.nvs[std::size_t(index)] != 1)
      throw UrdfError(source_, line, what + "a joint that has not one coordinate", primary);
  }

  Model<double>& model_;
  const UrdfOptions& options_;
  urdf_detail::ValidUrdf& valid_;
  const std::string& source_;
};

/// Bodies as the joints carry them: without mass, a warning; not physical, an error at the link that makes it so.
void judgeBodies(const Model<double>& model, const UrdfOptions& options, urdf_detail::ValidUrdf& valid,
                 const std::string& source) {
  const auto warn = [&](int line, const std::string& what, const std::string& value) {
    if (options.strict) throw UrdfError(source, line, what, value);
    valid.warnings.push_back(urdf_detail::complaint(source, line, what, value));
  };
  for (const auto& [link, line, what, value] : valid.faults) {
    const int joint = model.frames[std::size_t(model.getFrameId(link, FrameType::BODY))].parentJoint;
    if (!whyUnphysical(model.inertias[std::size_t(joint)], urdf_detail::printed_inertia_slack).empty())
      throw UrdfError(source, line, what, value);
    warn(line, what + "; what it is fixed to makes up for it", value);
  }
  for (int i = 1; i < model.njoints; ++i) {
    if (model.inertias[std::size_t(i)].mass() > 0) continue;
    const auto line = valid.joint_line.find(model.names[std::size_t(i)]);
    warn(line == valid.joint_line.end() ? valid.robot_line : line->second,
         "the link of a moving joint, and what is fixed to it, has no mass", model.names[std::size_t(i)]);
  }
}

std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  return text;
}
std::string shortened(const std::string& value) {
  if (value.size() <= 80) return value;
  std::size_t end = 77;
  while (end > 74 && (static_cast<unsigned char>(value[end]) & 0xC0) == 0x80) --end;  // whole characters
  return value.substr(0, end) + "...";
}

}  // namespace

std::string urdf_detail::complaint(const std::string& file, int line, const std::string& what,
                                   const std::string& value) {
  return oneLine(file + ":" + (line > 0 ? std::to_string(line) + ": " : " ") + what + " (" +
                 shortened(value) + ")");
}

UrdfError::UrdfError(const std::string& file, int line, const std::string& what, const std::string& value)
    : std::runtime_error(urdf_detail::complaint(file, line, what, value)), file_(file), line_(line) {}

UrdfRobot loadUrdfText(const std::string& text, const UrdfOptions& options, const std::string& source_name) {
  urdf_detail::ValidUrdf valid = urdf_detail::validateUrdfText(text, source_name, options);
  urdf::ModelInterfaceSharedPtr robot;
  {
    const QuietLog log;
    robot = urdf::parseURDF(valid.skeleton);
    if (!robot || !robot->getRoot())
      throw UrdfError(source_name, valid.robot_line, "urdfdom refuses it", log.errors());
  }
  // Links own their children: a long chain, destroyed from its root, would end the stack.
  const auto dissolve = [](urdf::ModelInterface* tree) {
    for (auto& [name, link] : tree->links_) link->child_links.clear();
  };
  const std::unique_ptr<urdf::ModelInterface, decltype(dissolve)> dissolved(robot.get(), dissolve);

  const urdf::LinkConstSharedPtr link = robot->getRoot();
  Model<double> model;
  model.name = robot->getName();
  int joint = 0, joint_frame = 0;
  if (options.root_joint || options.root == RootJoint::FreeFlyer) {
    joint = model.addJoint(0, options.root_joint.value_or(FreeFlyer<double>()), SE3<double>::Identity(),
                           "root_joint");
    joint_frame = model.addJointFrame(joint);
  }
  const int body_frame = model.addBodyFrame(link->name, joint, SE3<double>::Identity(), joint_frame);
  model.appendBodyToJoint(joint, inertia(*link));
  Tree(model, options, valid, source_name).add(link, body_frame);
  judgeBodies(model, options, valid, source_name);
  return {std::move(model), std::move(valid.warnings)};
}

Model<double> buildModelFromUrdfText(const std::string& text, RootJoint root,
                                     const std::string& source_name) {
  return loadUrdfText(text, {.root = root}, source_name).model;
}

std::string readUrdf(const std::string& path) {
  const auto refuse = [&](const char* what, const std::string& value) {
    throw UrdfError(path, 0, what, value);
  };
  // Without O_NONBLOCK a FIFO that nobody writes to would be waited for.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) refuse("cannot be opened", std::strerror(errno));
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(::fdopen(descriptor, "rb"), std::fclose);
  struct stat status {};
  if (!file || ::fstat(descriptor, &status) != 0) refuse("cannot be read", std::strerror(errno));
  const bool pipe = S_ISFIFO(status.st_mode);
  if (S_ISDIR(status.st_mode)) refuse("cannot be read", "a directory");
  if (!pipe && !S_ISREG(status.st_mode)) refuse("cannot be read", "neither a regular file nor a pipe");
  ::fcntl(descriptor, F_SETFL, O_RDONLY);
  std::string text(std::size_t(1) << 16, 0);
  std::size_t size = 0;
  while (const std::size_t n = std::fread(&text[size], 1, text.size() - size, file.get())) {
    size += n;
    if (size > max_urdf_bytes) refuse("longer than a URDF may be", std::to_string(max_urdf_bytes) + " bytes");
    if (size == text.size()) text.resize(2 * size);
  }
  if (std::ferror(file.get())) refuse("cannot be read", std::strerror(errno));
  if (pipe && size == 0) refuse("cannot be read", "a pipe, and nobody writes to it");
  text.resize(size);
  return text;
}

UrdfRobot loadUrdf(const std::string& path, const UrdfOptions& options) {
  return loadUrdfText(readUrdf(path), options, path);
}
Model<double> buildModelFromUrdf(const std::string& path, RootJoint root) {
  return loadUrdf(path, {.root = root}).model;
}

}  // namespace liecheck
