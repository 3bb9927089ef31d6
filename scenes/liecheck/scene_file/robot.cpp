#include <liecheck/scene_file/robot.hpp>

#include <algorithm>
#include <liecheck/scene/bodies.hpp>
#include <liecheck/scene/starts.hpp>
#include <liecheck/scene_file/shapes.hpp>
#include <liecheck/urdf/urdf.hpp>

namespace liecheck::scene_file_detail {
namespace {

using scene::Key;
using scene::Kind;
using V3 = Vector3<double>;

const std::vector<Key>& rootKeys() {
  static const std::vector<Key> keys = {
      {"root", Kind::Choice, "free_flyer|fixed|spherical|planar|translation|revolute|continuous|prismatic",
       "free_flyer", "the joint between the world and the robot"},
      {"axis", Kind::Direction, "1", "[0, 0, 1]", "of a revolute, continuous or prismatic root"}};
  return keys;
}

/// The root's joint; none if it is fixed. Refuses `axis` unless the joint has an axis.
std::optional<Joint<double>> readRootJoint(const Text& text, const YAML::Node& robot, int line,
                                           const scene::Parameters& p) {
  const std::string& kind = p.word("root");
  if (kind == "revolute" || kind == "continuous" || kind == "prismatic")
    return text.at(line, [&]() -> Joint<double> {
      const auto& a = p.numbers("axis");
      const Axis<double> axis(V3(a[0], a[1], a[2]));
      if (kind == "revolute") return Revolute<double>(axis);
      if (kind == "continuous") return Continuous<double>(axis);
      return Prismatic<double>(axis);
    });
  if (robot["axis"].IsDefined())
    text.refuse(robot["axis"],
                "robot.axis needs a revolute, continuous or prismatic root, not '" + kind + "'");
  if (kind == "free_flyer") return FreeFlyer<double>();
  if (kind == "spherical") return Spherical<double>();
  if (kind == "planar") return Planar<double>();
  if (kind == "translation") return Translation<double>();
  return std::nullopt;
}

void fromUrdf(const Text& text, const YAML::Node& robot, scene::Scene& scene,
              std::vector<std::string>& warnings) {
  const auto p = text.parameters(robot, Text::lineOf(robot), "robot", rootKeys(), nullptr, {"urdf"});
  const int line = Text::lineOf(robot["urdf"]);
  const std::string file = text.path(robot["urdf"], "robot.urdf");
  const UrdfOptions options{.root_joint = readRootJoint(text, robot, line, p), .mimic = MimicJoints::Tied};
  try {
    const std::string urdf = readUrdf(file);
    UrdfRobot loaded = loadUrdfText(urdf, options, file);
    warnings.insert(warnings.end(), loaded.warnings.begin(), loaded.warnings.end());
    scene.around.shapes = shapesOfUrdf(urdf, loaded.model);
    scene.model = std::move(loaded.model);
  } catch (const UrdfError& e) {
    text.refuse(line, std::string("robot.urdf: ") + e.what());
  } catch (const std::invalid_argument& e) {
    text.refuse(line, std::string("robot.urdf: ") + e.what());
  }
}

/// A built-in body and its values.
struct BuiltIn {
  std::string kind;
  scene::Parameters p;
  Inertia<double> inertia;
};
/// Reads the body of a map, with `more` keys; those in `others` are not read.
BuiltIn readBody(const Text& text, const YAML::Node& node, const std::string& what,
                 const std::vector<Key>& more, std::vector<std::string> others) {
  const std::string kind = text.word(node["body"], what + ".body");
  const scene::BodyEntry& body =
      text.entry(node["body"], kind, scene::bodyEntries(), "no built-in body is named '" + kind + "'");
  std::vector<Key> keys = body.info.keys;
  keys.insert(keys.end(), more.begin(), more.end());
  others.emplace_back("body");
  const auto p = text.parameters(node, Text::lineOf(node), what, keys, nullptr, others);
  return {kind, p, text.at(Text::lineOf(node), [&] { return scene::inertiaOf(body, p); })};
}
/// Adds the body on a joint of the world; returns the joint's index.
int addBody(const BuiltIn& body, const Joint<double>& joint, const std::string& joint_name,
            const std::string& body_name, scene::Scene& scene) {
  Model<double>& model = scene.model;
  const int index = model.addJoint(0, joint, SE3<double>::Identity(), joint_name);
  model.addJointFrame(index);
  for (scene::Shape& shape : shapeOfBody(body.kind, body.p, body_name, model.addBodyFrame(body_name, index)))
    scene.around.shapes.push_back(std::move(shape));
  model.appendBodyToJoint(index, body.inertia);
  return index;
}
void fromBody(const Text& text, const YAML::Node& robot, scene::Scene& scene) {
  const BuiltIn body = readBody(text, robot, "robot", rootKeys(), {});
  const int line = Text::lineOf(robot);
  const auto joint = readRootJoint(text, robot, line, body.p);
  if (!joint) text.refuse(line, "a body on a fixed root cannot move: take another root");
  scene.model.name = body.kind;
  addBody(body, *joint, "root_joint", "body", scene);
}

constexpr double most_bodies = 10000;

/// Adds the free bodies of a list, and sets their start. Body NAME moves with the joint NAME_joint; copies
/// are NAME_1, NAME_2, ..., the first along x.
void fromBodies(const Text& text, const YAML::Node& robot, scene::Scene& scene) {
  static const std::vector<Key> keys = {
      {"position", Kind::Vector, "m", "[0, 0, 0]", "at the start, of the first copy"},
      {"attitude", Kind::Vector, "rad", "[0, 0, 0]", "rotation vector at the start"},
      {"velocity", Kind::Vector, "m/s", "[0, 0, 0]", "at the start, in the body's axes"},
      {"angular_velocity", Kind::Vector, "rad/s", "[0, 0, 0]", "at the start, in the body's axes"},
      {"copies", Kind::Vector, "1", "[1, 1, 1]", "along x, y and z"},
      {"spacing", Kind::Vector, "m", "[0, 0, 0]", "of copies along x, y and z"}};
  text.checkKeys(robot, "robot", {"bodies"});
  const YAML::Node bodies = robot["bodies"];
  if (!bodies.IsSequence() || bodies.size() == 0)
    text.refuse(bodies, "robot.bodies is a list: [{name: a, body: ball, radius: 0.1, position: [0, 0, 1]}]");
  std::vector<double> q, v;
  for (const auto& node : bodies) {
    if (!node.IsMap() || !node["body"].IsDefined() || !node["name"].IsDefined())
      text.refuse(node, "a body of robot.bodies needs 'name' and 'body'");
    const BuiltIn body = readBody(text, node, "a body", keys, {"name"});
    const std::string name = text.word(node["name"], "a body's name");
    const auto vector = [&](const char* key) {
      const auto& x = body.p.numbers(key);
      return V3(x[0], x[1], x[2]);
    };
    const V3 copies = vector("copies"), spacing = vector("spacing"), position = vector("position");
    for (const double n : copies)
      if (!(n >= 1 && n == std::floor(n)))
        text.refuse(node, "copies are three whole numbers of at least 1, such as [3, 3, 2]");
    if (!(copies.prod() + double(scene.model.njoints) <= most_bodies))
      text.refuse(node, "robot.bodies has more than " + std::to_string(int(most_bodies)) + " bodies");
    const Vector4<double> Q = quaternion::exp3<double>(vector("attitude")).normalized().to_vector();
    for (int k = 0; k < int(copies.prod()); ++k) {
      const int nx = int(copies[0]), ny = int(copies[1]);
      const V3 p = position + V3(k % nx * spacing[0], k / nx % ny * spacing[1], k / nx / ny * spacing[2]);
      const std::string own = copies.prod() == 1 ? name : name + "_" + std::to_string(k + 1);
      if (scene.model.existFrame(own)) text.refuse(node, "a body or joint is named '" + own + "' already");
      text.at(Text::lineOf(node),
              [&] { return addBody(body, FreeFlyer<double>(), own + "_joint", own, scene); });
      q.insert(q.end(), p.begin(), p.end()), q.insert(q.end(), Q.begin(), Q.end());
      for (const char* key : {"velocity", "angular_velocity"})
        v.insert(v.end(), body.p.numbers(key).begin(), body.p.numbers(key).end());
    }
  }
  scene.model.name = "bodies";
  scene.q = Eigen::Map<const VectorX<double>>(q.data(), Eigen::Index(q.size()));
  scene.v = Eigen::Map<const VectorX<double>>(v.data(), Eigen::Index(v.size()));
}

/// Adds the frames that the scene defines, fixed to frames of the robot.
void addFrames(const Text& text, const YAML::Node& frames, Model<double>& model) {
  if (!frames.IsDefined() || frames.IsNull()) return;
  if (!frames.IsSequence()) text.refuse(frames, "frames is a list of {name, on, position, attitude}");
  static const std::vector<Key> keys = {
      {"on", Kind::Frame, "", nullptr, "a frame of the robot"},
      {"position", Kind::Vector, "m", "[0, 0, 0]", "in that frame"},
      {"attitude", Kind::Vector, "rad", "[0, 0, 0]", "rotation vector, in that frame"}};
  for (const auto& node : frames) {
    const int line = Text::lineOf(node);
    const auto p = text.parameters(node, line, "a frame", keys, &model, {"name"});
    if (!node.IsMap() || !node["name"].IsDefined()) text.refuse(line, "a frame needs 'name'");
    const int on = model.requireFrameId(p.word("on"));
    const Frame<double> base = model.frames[std::size_t(on)];
    const auto &x = p.numbers("position"), &phi = p.numbers("attitude");
    const SE3<double> X(exp3<double>(V3(phi[0], phi[1], phi[2])), V3(x[0], x[1], x[2]));
    const std::string name = text.word(node["name"], "a frame's name");
    if (model.existFrame(name))
      text.refuse(node["name"], "the robot has a frame '" + name + "' already: take another name");
    text.at(line, [&] {
      return model.addFrame({name, base.parentJoint, on, base.placement * X, FrameType::OP_FRAME});
    });
  }
}

/// Reads the position or velocity of each joint that is named: one number, or a list of numbers.
void readJoints(const Text& text, const YAML::Node& initial, scene::Scene& scene, const std::string& key,
                bool velocity) {
  const YAML::Node joints = initial[key];
  const std::string what = "initial." + key;
  if (!joints.IsDefined() || joints.IsNull()) return;
  if (!joints.IsMap()) text.refuse(joints, what + " is a map of joints and numbers");
  text.checkKeys(joints, what, scene.model.names);
  for (const auto& entry : joints) {
    const std::string name = entry.first.Scalar();
    const std::size_t i = std::size_t(scene.model.requireJointId(name));
    const Model<double>& m = scene.model;
    const bool angle = !velocity && m.nqs[i] == 2;
    const int count = velocity ? m.nvs[i] : angle ? 1 : m.nqs[i];
    if (const auto* mimic = std::get_if<Mimic<double>>(&m.joints[i]))
      text.refuse(entry.first, "joint '" + name + "' has no coordinates because it mimics '" +
                                   m.names[std::size_t(mimic->primary)] + "': give that joint's");
    if (i == 0 || count == 0) text.refuse(entry.first, "joint '" + name + "' has no coordinates");
    const char* unit = velocity ? "rad/s|m/s" : "rad|m";
    const auto x = count == 1 && entry.second.IsScalar()
                       ? std::vector{text.number(entry.second, what + "." + name, unit)}
                       : text.numbers(entry.second, what + "." + name, unit, count);
    if (angle) {
      scene.q.segment<2>(m.idx_qs[i]) << std::cos(x[0]), std::sin(x[0]);
    } else {
      auto& target = velocity ? scene.v : scene.q;
      for (int k = 0; k < count; ++k) target[(velocity ? m.idx_vs[i] : m.idx_qs[i]) + k] = x[std::size_t(k)];
    }
  }
}

/// Position, attitude and velocities of the root, joint 1.
void readRoot(const Text& text, const YAML::Node& initial, scene::Scene& scene) {
  const Model<double>& m = scene.model;
  const bool flyer = m.njoints > 1 && std::holds_alternative<FreeFlyer<double>>(m.joints[1]),
             ball = m.njoints > 1 && std::holds_alternative<Spherical<double>>(m.joints[1]);
  const auto vector = [&](const std::string& key, const char* unit, bool turns) -> std::optional<V3> {
    const YAML::Node node = initial[key];
    if (!node.IsDefined()) return {};
    if (std::count(m.parents.begin() + 1, m.parents.end(), 0) > 1)
      text.refuse(node, "initial." + key + " needs a robot with one root: give each of robot.bodies its own");
    if (!flyer && !(turns && ball))
      text.refuse(node, "initial." + key + " needs a robot whose root is free_flyer" +
                            (turns ? " or spherical" : "") + ": name joints instead");
    const auto x = text.numbers(node, "initial." + key, unit, 3);
    return V3(x[0], x[1], x[2]);
  };
  const int at = flyer ? 3 : 0;
  if (const auto p = vector("position", "m", false)) scene.q.head<3>() = *p;
  if (const auto v = vector("velocity", "m/s", false)) scene.v.head<3>() = *v;
  if (const auto omega = vector("angular_velocity", "rad/s", true)) scene.v.segment<3>(at) = *omega;
  if (const auto phi = vector("attitude", "rad", true))
    scene.q.segment<4>(at) = quaternion::exp3<double>(*phi).normalized().to_vector();
  if (const YAML::Node node = initial["quaternion"]; node.IsDefined()) {
    if (!(flyer || ball))
      text.refuse(node, "initial.quaternion needs a robot whose root is free_flyer or spherical");
    if (initial["attitude"].IsDefined())
      text.refuse(node, "initial has an attitude and a quaternion: keep one");
    const auto x = text.numbers(node, "initial.quaternion", "1", 4);
    const Vector4<double> Q(x[0], x[1], x[2], x[3]);
    if (Q.isZero(0)) text.refuse(node, "initial.quaternion is zero, which is not a rotation");
    scene.q.segment<4>(at) = SO3<double>(Q).normalized().to_vector();
  }
}

}  // namespace

void readRobot(const Text& text, const YAML::Node& root, scene::Scene& scene,
               std::vector<std::string>& warnings) {
  const YAML::Node robot = root["robot"];
  if (!robot.IsDefined())
    text.refuse(0, "the scene needs 'robot': {body: box, size: [1, 1, 1]} or {urdf: FILE}");
  if (!robot.IsMap()) text.refuse(robot, "robot is a map: {body: box, size: [1, 1, 1]} or {urdf: FILE}");
  if (int(robot["urdf"].IsDefined()) + int(robot["body"].IsDefined()) + int(robot["bodies"].IsDefined()) != 1)
    text.refuse(robot, "robot needs one of 'urdf', 'body' and 'bodies'");
  if (robot["urdf"].IsDefined())
    fromUrdf(text, robot, scene, warnings);
  else if (robot["body"].IsDefined())
    fromBody(text, robot, scene);
  else
    fromBodies(text, robot, scene);
  if (scene.model.nv == 0) text.refuse(robot, "the robot has no joint that moves");
  addFrames(text, root["frames"], scene.model);
  readShapes(text, root["shapes"], scene);
  if (scene.q.size() > 0) return;
  scene.q = neutral(scene.model);
  scene.v = VectorX<double>::Zero(scene.model.nv);
}

void readStart(const Text& text, const YAML::Node& initial, scene::Scene& scene) {
  if (!initial.IsDefined() || initial.IsNull()) return;
  if (!initial.IsMap())
    text.refuse(initial,
                "initial is a map: {start: dzhanibekov, rate: 1 rad/s} or {angular_velocity: [0, 0, 1]}");
  static const std::vector<std::string> own = {"position",         "attitude", "quaternion",       "velocity",
                                               "angular_velocity", "joints",   "joint_velocities", "start"};
  if (!initial["start"].IsDefined()) text.checkKeys(initial, "initial", own);
  readRoot(text, initial, scene);
  readJoints(text, initial, scene, "joints", false);
  readJoints(text, initial, scene, "joint_velocities", true);
  if (const YAML::Node start = initial["start"]; start.IsDefined()) {
    const std::string name = text.word(start, "initial.start");
    const scene::StartEntry& entry =
        text.entry(start, name, scene::startEntries(), "no start is named '" + name + "'");
    const auto p =
        text.parameters(initial, Text::lineOf(start), "initial", entry.info.keys, &scene.model, own);
    const VectorX<double> q = scene.q, v = scene.v, q_neutral = neutral(scene.model);
    text.at(Text::lineOf(start), [&] { entry.set(p, scene.model, scene.q, scene.v); });
    // What initial gives and the start leaves at rest holds: a group of numbers belongs to one of them.
    const auto join = [&](auto now, auto given, auto rest, const std::string& what) {
      if (given == rest || now == given) return;
      if (!(now == rest))
        text.refuse(start, "start '" + name + "' sets " + what + ", and initial gives it, too: keep one");
      now = given;
    };
    const VectorX<double> still = VectorX<double>::Zero(scene.model.nv);
    for (std::size_t i = 1; i < scene.model.joints.size(); ++i) {
      const int at_q = scene.model.idx_qs[i], at_v = scene.model.idx_vs[i];
      const bool flyer = std::holds_alternative<FreeFlyer<double>>(scene.model.joints[i]);
      const auto groups = [&](int from, int all, auto each) {
        if (flyer) each(from, 3, true);
        each(flyer ? from + 3 : from, flyer ? all - 3 : all, false);
      };
      groups(at_q, scene.model.nqs[i], [&](int from, int n, bool linear) {
        join(scene.q.segment(from, n), q.segment(from, n), q_neutral.segment(from, n),
             linear  ? "the position"
             : flyer ? "the attitude"
                     : "the position of joint '" + scene.model.names[i] + "'");
      });
      groups(at_v, scene.model.nvs[i], [&](int from, int n, bool linear) {
        join(scene.v.segment(from, n), v.segment(from, n), still.segment(from, n),
             linear  ? "the velocity"
             : flyer ? "the angular velocity"
                     : "the velocity of joint '" + scene.model.names[i] + "'");
      });
    }
  }
  text.at(Text::lineOf(initial), [&] { scene.q = normalized(scene.model, scene.q); });
  if (!scene.v.allFinite()) text.refuse(initial, "the initial velocity is not finite");
}

}  // namespace liecheck::scene_file_detail
