#include <console_bridge/console.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
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

Joint<double> moving(const urdf::Joint& joint) {
  const Vector3<double> axis(joint.axis.x, joint.axis.y, joint.axis.z);
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return Revolute<double>(axis);
    case urdf::Joint::CONTINUOUS:
      return Continuous<double>(axis);
    case urdf::Joint::PRISMATIC:
      return Prismatic<double>(axis);
    case urdf::Joint::FLOATING:
      return FreeFlyer<double>();
    default:
      throw std::logic_error("the validator let a joint type pass that has no model");
  }
}

/// The children of a link whose BODY frame is link_frame, depth first.
void addChildren(Model<double>& model, const urdf::Link& link, int link_frame) {
  std::vector<urdf::JointSharedPtr> children = link.child_joints;
  std::sort(children.begin(), children.end(), [](const auto& a, const auto& b) { return a->name < b->name; });
  std::vector<urdf::LinkSharedPtr> links = link.child_links;
  for (const urdf::JointSharedPtr& joint : children) {
    const urdf::Link& child = **std::find_if(
        links.begin(), links.end(), [&](const auto& l) { return l->name == joint->child_link_name; });
    const Frame<double> parent = model.frames[std::size_t(link_frame)];
    const SE3<double> X_PJ = parent.placement * pose(joint->parent_to_joint_origin_transform);
    int body_frame = 0;
    if (joint->type == urdf::Joint::FIXED) {
      const int frame =
          model.addFrame({joint->name, parent.parentJoint, link_frame, X_PJ, FrameType::FIXED_JOINT});
      body_frame = model.addBodyFrame(child.name, parent.parentJoint, X_PJ, frame);
      model.appendBodyToJoint(parent.parentJoint, inertia(child), X_PJ);
    } else {
      const int index = model.addJoint(parent.parentJoint, moving(*joint), X_PJ, joint->name);
      const int frame = model.addJointFrame(index, link_frame);
      body_frame = model.addBodyFrame(child.name, index, SE3<double>::Identity(), frame);
      model.appendBodyToJoint(index, inertia(child));
    }
    addChildren(model, child, body_frame);
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

UrdfError::UrdfError(const std::string& file, int line, const std::string& what, const std::string& value)
    : std::runtime_error(oneLine(file + ":" + (line > 0 ? std::to_string(line) + ": " : " ") + what + " (" +
                                 shortened(value) + ")")),
      file_(file),
      line_(line) {}

Model<double> buildModelFromUrdfText(const std::string& text, RootJoint root,
                                     const std::string& source_name) {
  const int robot_line = urdf_detail::validateUrdfText(text, source_name, root);
  urdf::ModelInterfaceSharedPtr robot;
  {
    const QuietLog log;
    robot = urdf::parseURDF(text);
    if (!robot || !robot->getRoot())
      throw UrdfError(source_name, robot_line, "urdfdom refuses it", log.errors());
  }
  const urdf::Link& link = *robot->getRoot();
  Model<double> model;
  model.name = robot->getName();
  int joint = 0, joint_frame = 0;
  if (root == RootJoint::FreeFlyer) {
    joint = model.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "root_joint");
    joint_frame = model.addJointFrame(joint);
  }
  const int body_frame = model.addBodyFrame(link.name, joint, SE3<double>::Identity(), joint_frame);
  model.appendBodyToJoint(joint, inertia(link));
  addChildren(model, link, body_frame);
  return model;
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

Model<double> buildModelFromUrdf(const std::string& path, RootJoint root) {
  return buildModelFromUrdfText(readUrdf(path), root, path);
}

}  // namespace liecheck
