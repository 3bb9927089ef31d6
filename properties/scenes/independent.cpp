#include <scenes/independent.hpp>

#include <map>
#include <oracles/motions/force_laws.hpp>

namespace liecheck::properties {
namespace {

using namespace oracles;
using Robot = Model<double>;

JointKind kind_of(const Robot& robot, std::size_t i) {
  const Joint<double>& j = robot.joints[i];
  if (std::holds_alternative<FreeFlyer<double>>(j)) return JointKind::free_flyer;
  if (std::holds_alternative<Revolute<double>>(j)) return JointKind::revolute;
  if (std::holds_alternative<Continuous<double>>(j)) return JointKind::continuous;
  if (std::holds_alternative<Prismatic<double>>(j)) return JointKind::prismatic;
  if (std::holds_alternative<Helical<double>>(j)) return JointKind::helical;
  if (std::holds_alternative<Spherical<double>>(j)) return JointKind::spherical;
  if (std::holds_alternative<Planar<double>>(j)) return JointKind::planar;
  if (std::holds_alternative<Translation<double>>(j)) return JointKind::translation;
  throw std::invalid_argument("joint '" + robot.names[i] + "' is a mimic, which maximal coordinates lack");
}

template <class T>
MaximalLink<T> link_of(const Robot& robot, std::size_t i) {
  MaximalLink<T> l;
  l.kind = kind_of(robot, i), l.parent = robot.parents[i];
  l.R = robot.jointPlacements[i].rotation().cast<T>(), l.p = robot.jointPlacements[i].translation().cast<T>();
  std::visit(
      [&l](const auto& joint) {
        if constexpr (requires { joint.axis; }) l.axis = joint.axis.to_vector().template cast<T>();
        if constexpr (requires { joint.pitch; }) l.pitch = T(joint.pitch);
      },
      robot.joints[i]);
  l.mass = T(robot.inertias[i].mass()), l.lever = robot.inertias[i].lever().cast<T>();
  l.inertia = robot.inertias[i].inertia().cast<T>();
  return l;
}

/// The numbers of a request as T.
template <class T>
class Values {
 public:
  Values(const scene::Parameters& p, const Benchmark& scene) : p_(p), scene_(scene) {}
  T number(const char* key) const { return T(p_.number(key)); }
  T number(const char* key, double otherwise) const { return T(p_.number(key, otherwise)); }
  Column3<T> vector(const char* key) const { return vector(p_.numbers(key)); }
  static Column3<T> vector(const auto& x) { return {T(x[0]), T(x[1]), T(x[2])}; }
  std::vector<T> numbers(const char* key) const {
    return std::vector<T>(p_.numbers(key).begin(), p_.numbers(key).end());
  }
  bool is(const char* key, const char* word) const { return p_.word(key) == word; }
  Place<T> place() const { return place(p_.word("frame")); }
  std::vector<Place<T>> places() const {
    std::vector<Place<T>> all;
    for (const std::string& name : p_.names("frames")) all.push_back(place(name));
    return all;
  }
  /// The indices in v of the joints named; "all" is every joint except free-flyers.
  std::vector<std::size_t> coordinates() const { return select(false); }
  /// Those that have a scalar position.
  std::vector<std::size_t> positions() const { return select(true); }
  /// The number `key` for each coordinate, or the robot's own if it is missing.
  std::vector<T> each(const char* key, const Eigen::VectorXd& of_robot) const {
    std::vector<T> all;
    for (const std::size_t k : coordinates())
      all.push_back(p_.has(key) ? T(p_.number(key)) : T(of_robot[Eigen::Index(k)]));
    return all;
  }
  /// A robot's numbers by q or v of the coordinates with a scalar position.
  std::vector<T> of_positions(const Eigen::VectorXd& of_robot) const {
    const Robot& robot = scene_.robot;
    std::vector<T> all;
    for (const std::size_t k : positions()) {
      const std::size_t joint = std::size_t(robot.column_to_joint[k]);
      const int shift = of_robot.size() == robot.nv ? 0 : robot.idx_qs[joint] - robot.idx_vs[joint];
      all.push_back(T(of_robot[Eigen::Index(k) + shift]));
    }
    return all;
  }
  const Benchmark& scene() const { return scene_; }

 private:
  Place<T> place(const std::string& name) const {
    const auto& f = scene_.robot.frames[std::size_t(scene_.robot.requireFrameId(name))];
    return {f.parentJoint, nearest_rotation<T>(f.placement.rotation().cast<T>()),
            f.placement.translation().cast<T>()};
  }
  std::vector<std::size_t> select(bool with_position) const {
    const Robot& robot = scene_.robot;
    const auto& names = p_.names("joints");
    std::vector<std::size_t> all;
    for (std::size_t i = 1; i < robot.joints.size(); ++i) {
      const bool named = std::find(names.begin(), names.end(), robot.names[i]) != names.end();
      const bool meant = names[0] == "all" ? kind_of(robot, i) != JointKind::free_flyer : named;
      if (!meant || (with_position && robot.nqs[i] != robot.nvs[i])) continue;
      for (int k = 0; k < robot.nvs[i]; ++k) all.push_back(std::size_t(robot.idx_vs[i] + k));
    }
    return all;
  }
  const scene::Parameters& p_;
  const Benchmark& scene_;
};

template <class T>
T from(const Values<T>& p) {
  return p.number("from", -std::numeric_limits<double>::infinity());
}
template <class T>
T until(const Values<T>& p) {
  return p.number("until", std::numeric_limits<double>::infinity());
}
/// The finite times at which a force begins and ends.
template <class T>
std::vector<T> interval(const Values<T>& p) {
  std::vector<T> times;
  for (const T& t : {from(p), until(p)})
    if (t - t == 0) times.push_back(t);
  return times;
}

template <class T>
using Maker = std::function<void(const Values<T>&, MaximalTree<T>&)>;

// Longer than 80 lines: a table with an entry for each effect.
template <class T>
const std::map<std::string, Maker<T>>& makers() {
  using P = const Values<T>&;
  using Tree = MaximalTree<T>&;
  static const std::map<std::string, Maker<T>> all = {
      {"gravity",
       [](P p, Tree tree) {
         std::vector<T> masses;
         for (const auto& link : tree.links()) masses.push_back(link.mass);
         tree.laws.push_back({laws::Gravity<T>{p.vector("acceleration"), masses}});
       }},
      {"wrench",
       [](P p, Tree tree) {
         tree.laws.push_back({laws::Wrench<T>{p.place(), p.vector("force"), p.vector("moment"),
                                              p.is("axes", "world"), from(p), until(p)},
                              interval(p)});
       }},
      {"joint_damping",
       [](P p, Tree tree) {
         tree.laws.push_back(
             {laws::JointDamping<T>{p.coordinates(), p.each("coefficient", p.scene().robot.damping)}});
       }},
      {"joint_friction",
       [](P p, Tree tree) {
         tree.laws.push_back({laws::JointFriction<T>{
             p.coordinates(), p.each("force", p.scene().robot.friction), p.number("slip")}});
       }},
      {"joint_spring",
       [](P p, Tree tree) {
         tree.laws.push_back({laws::JointSpring<T>{p.positions(), p.number("stiffness"), p.number("rest")}});
       }},
      {"joint_limits",
       [](P p, Tree tree) {
         const Robot& robot = p.scene().robot;
         tree.laws.push_back({laws::JointLimits<T>{p.positions(), p.of_positions(robot.lowerPositionLimit),
                                                   p.of_positions(robot.upperPositionLimit),
                                                   p.number("stiffness"), p.number("dissipation")}});
       }},
      {"armature",
       [](P p, Tree tree) {
         for (const std::size_t k : p.coordinates()) tree.armature[k] += p.number("inertia");
       }},
      {"drag",
       [](P p, Tree tree) {
         tree.laws.push_back({laws::Drag<T>{p.place(), p.number("linear"), p.number("quadratic"),
                                            p.number("angular_linear"), p.number("angular_quadratic")}});
       }},
      {"buoyancy",
       [](P p, Tree tree) {
         tree.laws.push_back({laws::Buoyancy<T>{p.place(), p.number("volume"), p.number("density"),
                                                p.vector("acceleration")}});
       }},
      {"thruster",
       [](P p, Tree tree) {
         tree.laws.push_back({laws::Thruster<T>{p.place(), p.number("thrust"), p.number("moment_ratio"),
                                                p.vector("direction"), from(p), until(p)},
                              interval(p)});
       }},
      {"contact",
       [](P p, Tree tree) {
         const auto& around = p.scene().around;
         tree.laws.push_back({laws::Contact<T>{
             p.places(), p.vector(around.normal), T(around.height), p.number("radius"), p.number("stiffness"),
             p.number("dissipation"), p.number("friction"), p.number("slip"), p.number("rolling"),
             p.number("torsion"), p.number("angular_slip")}});
       }},
      {"constant",
       [](P p, Tree tree) {
         tree.laws.push_back({laws::ConstantForce<T>{p.coordinates(), p.number("force")}});
       }},
      {"pd",
       [](P p, Tree tree) {
         std::vector<T> targets = p.numbers("target");
         if (targets.size() == 1) targets.assign(p.positions().size(), T(targets[0]));
         tree.laws.push_back({laws::PdControl<T>{p.positions(), p.number("stiffness"), p.number("damping"),
                                                 targets, p.of_positions(p.scene().robot.effortLimit)}});
       }},
      {"table", [](P p, Tree tree) {
         tree.laws.push_back({laws::ForceTable<T>{p.coordinates(), p.numbers("times"), p.numbers("forces")},
                              p.numbers("times")});
       }}};
  return all;
}

}  // namespace

std::vector<std::string> independent_laws() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers<long double>()) names.push_back(name);
  return names;
}

template <class T>
MaximalTree<T> independent_tree(const Benchmark& scene) {
  std::vector<MaximalLink<T>> links(1);
  for (std::size_t i = 1; i < scene.robot.joints.size(); ++i) links.push_back(link_of<T>(scene.robot, i));
  MaximalTree<T> tree(std::move(links));
  for (const scene::Request& r : scene.requests) {
    const auto maker = makers<T>().find(r.name);
    if (maker == makers<T>().end())
      throw std::invalid_argument("the effect '" + r.name + "' has no law in scenes/independent.cpp");
    maker->second(Values<T>(r.parameters, scene), tree);
  }
  return tree;
}

template <class T>
std::vector<Moment> moments_of(MaximalTree<T> tree, const Benchmark& scene, long parts, const T& tolerance,
                               const std::atomic<bool>* stop) {
  std::vector<T> q(scene.q0.begin(), scene.q0.end()), v(scene.v0.begin(), scene.v0.end());
  MaximalMotion<T> motion(std::move(tree), q, v, tolerance, stop);
  std::vector<Moment> all;
  for (long k = 0; k <= parts; ++k) {
    motion.to(T(scene.duration) * T(k) / T(parts));
    motion.coordinates(q, v);
    Moment m;
    for (const T& x : q) m.q.push_back(exact<Real>(x));
    for (const T& x : v) m.v.push_back(exact<Real>(x));
    all.push_back(m);
  }
  return all;
}

template MaximalTree<long double> independent_tree(const Benchmark&);
template MaximalTree<float128> independent_tree(const Benchmark&);
template std::vector<Moment> moments_of(MaximalTree<long double>, const Benchmark&, long, const long double&,
                                        const std::atomic<bool>*);
template std::vector<Moment> moments_of(MaximalTree<float128>, const Benchmark&, long, const float128&,
                                        const std::atomic<bool>*);

}  // namespace liecheck::properties
