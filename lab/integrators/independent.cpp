#include <integrators/independent.hpp>

#include <integrators/independent_values.hpp>
#include <map>

namespace liecheck::properties {

const std::vector<Unconfirmed>& unconfirmed_parts() {
  static const std::vector<Unconfirmed> all = {
      {"contact", "cylinders",
       "the smooth lowest point of a rim is a model of its own, which a second formulation would only "
       "repeat"},
      {"contact", "heights and meshes",
       "the nearest of many triangles changes without an event, so that neither formulation is exact"}};
  return all;
}

/// Throws std::invalid_argument with the entry of unconfirmed_parts().
void refuse(const std::string& effect, const std::string& part) {
  for (const Unconfirmed& u : unconfirmed_parts())
    if (u.effect == effect && u.part == part)
      throw std::invalid_argument(effect + " of " + part + " is not confirmed: " + u.why);
  throw std::logic_error("unconfirmed_parts() lacks " + effect + " of " + part);
}

namespace {

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

template <class T>
std::vector<T> joined(std::vector<T> a, const std::vector<T>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The pairs of solids of different bodies that no joint connects; a free-flyer connects nothing. If one of them
/// is a box, it is the second.
template <class T>
std::vector<std::pair<laws::Solid<T>, laws::Solid<T>>> pairs_of(const std::vector<laws::Solid<T>>& solids,
                                                                const Robot& robot) {
  const auto carries = [&robot](int parent, int child) {
    return robot.nvs[std::size_t(child)] != 6 && robot.parents[std::size_t(child)] == parent;
  };
  std::vector<std::pair<laws::Solid<T>, laws::Solid<T>>> pairs;
  for (std::size_t i = 0; i < solids.size(); ++i)
    for (std::size_t j = i + 1; j < solids.size(); ++j) {
      const int a = solids[i].at.link, b = solids[j].at.link;
      if (a == b || (b > 0 && carries(a, b)) || (a > 0 && carries(b, a))) continue;
      pairs.emplace_back(solids[solids[i].box ? j : i], solids[solids[i].box ? i : j]);
    }
  return pairs;
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
                                              p.is("axes", "world"), from(p), until(p), p.curve("rows")},
                              joined<T>(interval(p), p.curve("rows").times)});
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
         tree.laws.push_back(
             {laws::Drag<T>{p.place(), p.number("linear"), p.number("quadratic"), p.number("angular_linear"),
                            p.number("angular_quadratic"), p.vector("current")}});
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
         if (around.mesh) refuse("contact", "heights and meshes");
         laws::Contact<T> contact{{}, p.vector(around.normal), T(around.height), p.touch()};
         for (const Place<T>& place : p.places()) contact.balls.push_back({place, p.number("radius")});
         for (const auto& solid : p.solids())
           if (solid.at.link != 0) contact.add(solid);
         tree.laws.push_back({contact});
       }},
      {"collisions",
       [](P p, Tree tree) {
         tree.laws.push_back({laws::Collisions<T>{pairs_of<T>(p.solids(), p.scene().robot), p.touch()}});
       }},
      {"added_mass",
       [](P p, Tree tree) {
         const std::size_t joint = p.joint("joint"), k = std::size_t(p.scene().robot.idx_vs[joint]);
         const Column3<T> m = p.vector("masses"), j = p.vector("inertias");
         for (std::size_t i = 0; i < 3; ++i)
           tree.armature[k + i] += m[int(i)], tree.armature[k + 3 + i] += j[int(i)];
         tree.laws.push_back({laws::AddedMass<T>{int(joint), m, j}});
       }},
      {"closed_loops",
       [](P p, Tree tree) {
         const auto places = p.places();
         for (std::size_t i = 0; i + 1 < places.size(); i += 2)
           tree.loops.push_back({places[i], places[i + 1], p.is("type", "weld"), p.number("rate")});
       }},
      {"constant",
       [](P p, Tree tree) {
         tree.laws.push_back({laws::ConstantForce<T>{p.coordinates(), p.number("force")}});
       }},
      {"pd",
       [](P p, Tree tree) {
         tree.laws.push_back(
             {laws::PdControl<T>{p.positions(), p.pursuit(), p.of_positions(p.scene().robot.effortLimit)},
              p.curve("rows").times});
       }},
      {"table",
       [](P p, Tree tree) {
         const auto force = p.column("forces");
         tree.laws.push_back({laws::ForceTable<T>{p.coordinates(), force}, force.times});
       }},
      {"motor", [](P p, Tree tree) {
         const T N = p.number("ratio");
         const auto at = p.number("stiffness") > 0 ? p.positions() : p.coordinates();
         for (const std::size_t k : at) tree.armature[k] += N * N * p.number("rotor_inertia");
         const auto force = p.has("forces") ? p.curve("forces") : p.constant({p.number("force")});
         tree.laws.push_back(
             {laws::Motor<T>{at, p.pursuit(), force, N * p.limit("stall_torque"),
                             p.limit("no_load_speed") / N, p.number("efficiency"), p.number("slip")},
              joined<T>(p.curve("rows").times, force.times)});
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
