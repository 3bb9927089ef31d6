#include <generators/tree_shrinks.hpp>
#include <invariants/tree_law.hpp>
#include <invariants/witness.hpp>
#include <set>
#include <subjects/urdf_options.hpp>

namespace liecheck::properties {

namespace {

using oracles::JointKind;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

/// Whether all eigenvalues of the second moment tr(I) / 2 - I exceed `least` tr(I). I is xx xy yy xz yz zz.
bool thicker(const double* I, long double trace, long double least) {
  if (trace == 0) return least < 0;
  const auto second = [&](int k, bool diagonal) {
    return (diagonal ? 0.5L - least : 0.0L) - static_cast<long double>(I[k]) / trace;
  };
  const long double xy = second(1, false), xz = second(3, false), yz = second(4, false);
  long double A[3][3] = {{second(0, true), xy, xz}, {xy, second(2, true), yz}, {xz, yz, second(5, true)}};
  // Elimination with the largest pivot. In a determinant the two small eigenvalues of a needle are lost.
  bool left[3] = {true, true, true};
  for (int step = 0; step < 3; ++step) {
    int p = -1;
    for (int i = 0; i < 3; ++i)
      if (left[i] && (p < 0 || A[i][i] > A[p][p])) p = i;
    if (!(A[p][p] > 0)) return false;
    left[p] = false;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (left[i] && left[j]) A[i][j] -= A[i][p] * A[p][j] / A[p][p];
  }
  return trace > 0;
}
/// Calls f(first, size) for each range of numbers that belong to a robot's state.
template <class F>
void for_each_state(TreeLayout at, F f) {
  f(at.frame(), 15);
  for (int i = 0; i < at.slots; ++i) f(at.slot(i) + TreeSlot::q_p, TreeSlot::size - TreeSlot::q_p);
}
std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

std::set<std::string>& tree_laws() {
  static std::set<std::string> all;
  return all;
}

}  // namespace

bool is_tree_law(const std::string& property) {
  return tree_laws().contains(property);
}
void add_tree_law(const std::string& property) {
  tree_laws().insert(property);
}

RobotNumbers robot_numbers(const Robot& robot, bool coupled) {
  const Model<double> m = loadUrdfText(robot.urdf, urdf_options(robot.fixed, coupled), robot.name).model;
  RobotNumbers r;
  r.at = {m.njoints - 1};
  r.numbers.assign(r.at.size(), 0);
  const auto put = [&](int to, const auto& v) {
    tree_detail::put(&r.numbers[static_cast<std::size_t>(to)], v);
  };
  const auto one = [&](int to, double x) { r.numbers[static_cast<std::size_t>(to)] = x; };
  put(r.at.gravity(), m.gravity);
  one(r.at.frame() + 4, 1), one(r.at.wrench(), -1);
  for (int i = 0; i < r.at.slots; ++i) {
    const auto j = static_cast<std::size_t>(i) + 1;
    const int slot = r.at.slot(i);
    const Inertia<double>& I = m.inertias[j];
    one(r.at.parent(i), m.parents[j] - 1), one(r.at.primary(i), -1);
    one(r.at.mass(i), I.mass()), put(slot + TreeSlot::c, I.lever());
    const Mat<double, 3>& I_C = I.inertia();
    put(slot + TreeSlot::I,
        (Vec<double, 6>() << I_C(0, 0), I_C(1, 0), I_C(1, 1), I_C(2, 0), I_C(2, 1), I_C(2, 2)).finished());
    const Eigen::Quaterniond Q(m.jointPlacements[j].rotation());
    put(slot + TreeSlot::Q, Q.normalized().coeffs()),
        put(slot + TreeSlot::p, m.jointPlacements[j].translation());
    put(slot + TreeSlot::axis, Vec<double, 3>(Vec<double, 3>::UnitX()));
    one(slot + TreeSlot::q_Q + 3, 1), one(slot + TreeSlot::q_circle, 1);
    if (m.nvs[j] > 0) one(slot + TreeSlot::armature, m.armature[m.idx_vs[j]]);
    JointKind kind{};
    const auto turning = [&](JointKind k, const liecheck::Axis<double>& axis) {
      kind = k;
      put(slot + TreeSlot::axis, axis.to_vector());
    };
    const Overloaded visitor{[&](const Revolute<double>& x) { turning(JointKind::revolute, x.axis); },
                             [&](const Continuous<double>& x) { turning(JointKind::continuous, x.axis); },
                             [&](const Prismatic<double>& x) { turning(JointKind::prismatic, x.axis); },
                             [&](const Helical<double>& x) {
                               turning(JointKind::helical, x.axis);
                               one(slot + TreeSlot::pitch, x.pitch);
                             },
                             [&](const Spherical<double>&) { kind = JointKind::spherical; },
                             [&](const Planar<double>&) { kind = JointKind::planar; },
                             [&](const Translation<double>&) { kind = JointKind::translation; },
                             [&](const FreeFlyer<double>&) { kind = JointKind::free_flyer; },
                             [](const Universe<double>&) {},
                             [](const Mimic<double>&) {}};
    if (const auto* mimic = std::get_if<Mimic<double>>(&m.joints[j])) {
      std::visit(visitor, mimic->moved);
      one(r.at.primary(i), mimic->primary - 1);
      one(slot + TreeSlot::multiplier, mimic->multiplier), one(slot + TreeSlot::offset, mimic->offset);
    } else {
      std::visit(visitor, m.joints[j]);
    }
    one(r.at.kind(i), static_cast<int>(kind));
  }
  return r;
}

bool AnyTreeLaw::has(const Subject& subject, const Operation& operation) const {
  if (!subject.operations.tree) return false;
  const auto zero = oracles::zero_vector<3, double>();
  oracles::JointOf<double> joint;
  joint.Q = {{0, 0, 0, 1}}, joint.p = zero, joint.axis = {{0, 0, 1}};
  joint.pitch = joint.multiplier = joint.offset = joint.armature = 0;
  joint.body = {1, zero, oracles::identity<3, double>()};
  Tree<double> tree;
  tree.joints = {joint}, tree.gravity = zero, tree.frame_Q = joint.Q, tree.frame_p = zero;
  tree.index();
  if (!rebuilds_tree()) tree.urdf = urdf_;
  return subject.operations.tree(tree).has(operation);
}

std::unique_ptr<const TreeCase<double>> AnyTreeLaw::users_tree() const {
  return robot_ ? std::make_unique<const TreeCase<double>>(at_, fixed_, fixed_) : nullptr;
}

std::vector<Field> AnyTreeLaw::fields() const {
  std::vector<Field> all;
  const auto add = [&](const std::string& name, Kind kind, int size, const char* unit, Reach reach) {
    all.push_back({name, kind, size, unit, reach});
  };
  constexpr Reach any = Reach::any;
  const bool tree = !robot_;
  if (tree) {
    const Reach shape = has_floating_base() ? any : Reach::limited;
    add("parents", Kind::parents, at_.slots, "1", shape);
    add("kinds", Kind::joints, 2 * at_.slots, "1", shape);
    for (std::uint32_t k = 0; k < oracles::joint_kinds; ++k)
      if (!taken_.has(static_cast<JointKind>(k))) all.back().without |= 1u << k;
    using enum JointKind;
    if (!taken_.mimics() || !(taken_.has(revolute) || taken_.has(prismatic) || taken_.has(helical)))
      all.back().without |= 1u << oracles::joint_kinds;
    add("masses", Kind::masses, at_.slots, "kg", Reach::limited);
    add("gravity", Kind::vector, 3, "m/s^2", any);
  }
  add("frame_joint", Kind::choice, 1, "1", any);
  add("frame_Q", Kind::quaternion, 4, "1", Reach::limited);
  add("frame_p", Kind::vector, 3, "m", Reach::limited);
  add("wrench_joint", Kind::choice, 1, "1", any);
  add("force", Kind::vector, 3, "N", Reach::limited);
  add("moment", Kind::vector, 3, "N m", Reach::limited);
  for (int i = 0; i < at_.slots; ++i) {
    const auto named = [&](const char* what) { return what + std::to_string(i); };
    if (tree) {
      add(named("Q"), Kind::quaternion, 4, "1", any);
      add(named("p"), Kind::vector, 3, "m", any);
      add(named("axis"), Kind::vector, 3, "1", any);
      add(named("pitch_multiplier_offset"), Kind::vector, 3, "m/rad, 1, rad or m", any);
      add(named("armature"), Kind::vector, 1, "kg, kg m^2", any);
      add(named("c"), Kind::vector, 3, "m", any);
      add(named("I_C"), Kind::inertia, 6, "kg m^2", any);
    }
    add(named("q_p"), Kind::vector, 3, "m, rad", any);
    add(named("q_Q"), Kind::quaternion, 4, "1", any);
    add(named("q_circle"), Kind::opaque, 2, "1", any);
    for (const char* what : {"v", "a", "d"})
      for (const char* part : {"_u", "_w"}) add(named(what) + part, Kind::vector, 3, "m, rad, s", any);
  }
  return all;
}

std::vector<std::vector<double>> AnyTreeLaw::simpler(const std::vector<double>& input) const {
  std::vector<std::vector<double>> all;
  if (robot_) return all;
  scalar().with([&]<class S>() {
    for (const std::vector<S>& x : shrinks::simpler_trees(oracles::numbers_in<S>(input)))
      all.push_back(oracles::as_doubles(x));
  });
  return all;
}

bool AnyTreeLaw::takes(std::size_t numbers) const {
  if (robot_) return Property::takes(numbers);
  const TreeLayout at = TreeLayout::of_size(numbers);
  return at.slots <= most_joints && at.size() == numbers;
}

std::string AnyTreeLaw::program(const Output& output, const std::vector<double>& input) const {
  const std::vector<double> full = full_of(input);
  const TreeCase<double> c(layout_of(full), full, full);
  return tree_program(c, output.record->call, std::string(scalar().name));
}

void AnyTreeLaw::prepare(const Robot& robot) {
  urdf_ = nullptr;
  if (robot.path.empty()) return;
  robot_ = true;
  if (robot.mimics) with_mimics_ = robot;
  read(robot, false);
}
void AnyTreeLaw::read(const Robot& robot, bool coupled) {
  urdf_ = urdf_model(robot.urdf, robot.fixed, coupled);
  const RobotNumbers r = robot_numbers(robot, coupled);
  at_ = r.at;
  fixed_.clear();
  for (double x : r.numbers) fixed_.push_back(scalar().rounded(x));
}

std::string AnyTreeLaw::draw_for(const Subject& subject) {
  if (subject.takes.mimics && with_mimics_.mimics) read(with_mimics_, true);
  if (robot_) return "";
  taken_ = subject.takes.joints;
  return taken_.everything() ? "" : taken_.text();
}
bool AnyTreeLaw::exists(const Output&) const {
  return robot_ || (taken_.moves() && (!has_floating_base() || taken_.has(JointKind::free_flyer)));
}

template <class S>
std::vector<S> AnyTreeLaw::state_of(const std::vector<S>& full) const {
  std::vector<S> x;
  for_each_state(
      at_, [&](int first, int n) { x.insert(x.end(), full.begin() + first, full.begin() + first + n); });
  return x;
}
std::vector<double> AnyTreeLaw::full_of(const std::vector<double>& input) const {
  if (!robot_) return input;
  std::vector<double> full = fixed_;
  auto from = input.begin();
  for_each_state(at_, [&](int first, int n) {
    std::copy_n(from, n, full.begin() + first);
    from += n;
  });
  return full;
}

template <class S>
std::vector<S> AnyTreeLaw::draw(Source& source) const {
  if (!robot_) return random_tree<S>(source, has_floating_base(), taken_);
  std::vector<S> x = oracles::numbers_in<S>(fixed_);
  const StateReach far(source);
  for (int i = 0; i < at_.slots; ++i)
    random_joint_state(source, static_cast<oracles::JointKind>(static_cast<int>(fixed_[index(at_.kind(i))])),
                       fixed_[index(at_.primary(i))] >= 0, far, x.data() + at_.slot(i));
  random_frame(source, at_.slots, x.data() + at_.frame());
  random_wrench(source, at_.slots, x.data() + at_.wrench());
  return state_of(x);
}
template std::vector<float> AnyTreeLaw::draw(Source&) const;
template std::vector<double> AnyTreeLaw::draw(Source&) const;

bool AnyTreeLaw::valid(const std::vector<double>& input) const {
  if (!oracles::all_finite(input)) return false;
  if (!takes(input.size())) return false;
  const std::vector<double> x = full_of(input);
  const TreeLayout at = layout_of(x);
  using oracles::JointKind;
  using Slot = TreeSlot;
  const auto whole = [&](int i, int low, int high) {
    return x[index(i)] >= low && x[index(i)] <= high && x[index(i)] == static_cast<int>(x[index(i)]);
  };
  const auto unit = [&](int first, int n) {
    oracles::Quaternion<> u{{Real(0), Real(0), Real(0), Real(0)}};
    for (int k = 0; k < n; ++k) u[k] = oracles::exact<Real>(x[index(first + k)]);
    return oracles::norm_defect(scalar(), u) <= 8;
  };
  int joints = 0, roots = 0;
  for (int i = 0; i < at.slots; ++i) {
    if (!whole(at.parent(i), absent_joint, i - 1)) return false;
    const int slot = at.slot(i);
    if (!unit(slot + Slot::Q, 4) || !unit(slot + Slot::q_Q, 4) || !unit(slot + Slot::q_circle, 2))
      return false;
    if (x[index(at.parent(i))] == absent_joint) continue;
    if (joints++ < i) return false;
    roots += x[index(at.parent(i))] == -1;
    if (!whole(at.kind(i), 0, 7) || !whole(at.primary(i), -1, i - 1)) return false;
    const auto kind = [&](int k) { return static_cast<JointKind>(static_cast<int>(x[index(at.kind(k))])); };
    if (const int primary = static_cast<int>(x[index(at.primary(i))]); primary >= 0) {
      const bool simple =
          kind(i) == JointKind::revolute || kind(i) == JointKind::prismatic || kind(i) == JointKind::helical;
      if (!simple || velocity_size(kind(primary)) != 1 || x[index(at.primary(primary))] >= 0) return false;
    }
    if (robot_) continue;
    const double mass = x[index(at.mass(i))], armature = x[index(slot + Slot::armature)];
    if (!(mass > 0) || !(armature >= 0) || !unit(slot + Slot::axis, 3)) return false;
    // The second moment tr(I) / 2 - I must be positive semidefinite. Without an armature the body must also
    // be thick enough to give its joint an inertia.
    const double* I = x.data() + slot + Slot::I;
    const long double trace =
        static_cast<long double>(I[0]) + static_cast<long double>(I[2]) + static_cast<long double>(I[5]);
    if (!thicker(I, trace, -32 * static_cast<long double>(scalar().epsilon))) return false;
    if (armature == 0 && (!thicker(I, trace, 1e-5L) || trace < 1e-4L * static_cast<long double>(mass)))
      return false;
  }
  if (joints == 0 || !whole(at.frame(), 0, joints - 1) || !whole(at.wrench(), -1, joints - 1)) return false;
  if (has_floating_base() && !robot_ &&
      (roots > 1 || x[index(at.kind(0))] != static_cast<int>(JointKind::free_flyer)))
    return false;
  return unit(at.frame() + 1, 4);
}

template <class T>
CaseAt<T>::CaseAt(TreeLayout at, const std::vector<double>& full)
    : layout(at),
      structure(full),
      numbers(exact_list<T>(full)),
      stored(layout, full, full),
      exact(layout, full, numbers),
      q(eigen(stored.q)),
      v(eigen(stored.v)),
      a(eigen(stored.a)),
      d(eigen(stored.d)),
      F(eigen(stored.wrench)),
      F_joint(stored.wrench.empty() ? -1 : stored.wrench[0].joint) {}
template <class T>
CaseAt<T>::~CaseAt() = default;

template <class T>
oracles::TreeSizes<double> CaseAt<T>::sizes(const std::vector<double>& v, const std::vector<double>& a,
                                            bool pushed) const {
  return {stored.tree, stored.q, v, a, pushed ? stored.wrench : std::vector<oracles::WrenchOf<double>>()};
}
template <class T>
void CaseAt<T>::note(const Output& output, const std::vector<T>& computed, const std::vector<T>& exact) {
  Witness* const w = Witness::current();
  if (!w || !w->notes(output.operation, output.block)) return;
  if constexpr (std::is_same_v<T, oracles::Real>)
    w->all.push_back({computed, exact, output.operation, output.block});
  else if (const auto x = rough_list(computed), y = rough_list(exact); w->every)
    w->all.push_back({{x.begin(), x.end()}, {y.begin(), y.end()}, output.operation, output.block});
}
template <class T>
bool CaseAt<T>::resolved(bool direction) const {
  if constexpr (oracles::BallNumber<T>)
    return true;
  else
    return oracles::confirmed(exact.tree, exact.q, exact.v, exact.a, direction ? exact.d : std::vector<T>());
}
template <class T>
void CaseAt<T>::record(Recorder& r, const Output& output, const VecX<double>& computed,
                       const std::vector<T>& exact_value, const std::vector<double>& w, double terms,
                       bool confirmed) const {
  if (!oracles::all_finite(computed)) {
    if constexpr (!oracles::BallNumber<T>) note(output, exact_list<T>(computed), exact_value);
    return r.outcome(output, 0, Outcome::not_finite);
  }
  record(r, output, exact_list<T>(computed), exact_value, w, terms, confirmed);
}
template <class T>
void CaseAt<T>::record(Recorder& r, const Output& output, const std::vector<T>& computed,
                       const std::vector<T>& exact_value, const std::vector<double>& w, double terms,
                       bool confirmed) const {
  note(output, computed, exact_value);
  if (!confirmed) return r.outcome(output, 0, Outcome::unresolved);
  const T size = oracles::larger(weighted_norm(exact_value, w), T(r.scalar().least_denominator()));
  double kappa = terms / approximate(size);
  const auto known = [&] { return kappa; };
  if constexpr (oracles::BallNumber<T>) {
    const double eps = r.scalar().epsilon;
    const double most = size.head() + size.r;
    if (terms / most * eps >
        2) {  // ill-posed, whatever the error; kappa may be larger, because y may be zero
      kappa = terms / most;
      const std::vector<double> x = rough_list(computed), y = rough_list(exact_value);
      std::vector<double> difference;
      std::transform(x.begin(), x.end(), y.begin(), std::back_inserter(difference), std::minus<>());
      return r.record(output, 0, weighted_norm(difference, w) / most / eps, {known, kappa});
    }
  }
  r.record(output, 0, weighted_error(r.scalar(), computed, exact_value, w, size), {known, kappa});
}

template struct CaseAt<oracles::Real>;
template struct CaseAt<oracles::DoubleDoubleBall>;
template struct CaseAt<oracles::RealBall>;
template decltype(mass_roots<oracles::Real>) mass_roots<oracles::Real>;
template decltype(mass_roots<oracles::DoubleDoubleBall>) mass_roots<oracles::DoubleDoubleBall>;
template decltype(mass_roots<oracles::RealBall>) mass_roots<oracles::RealBall>;
template decltype(weighted_norm<oracles::Real>) weighted_norm<oracles::Real>;
template decltype(weighted_norm<oracles::DoubleDoubleBall>) weighted_norm<oracles::DoubleDoubleBall>;
template decltype(weighted_norm<oracles::RealBall>) weighted_norm<oracles::RealBall>;
template decltype(rough_list<oracles::Real>) rough_list<oracles::Real>;
template decltype(rough_list<oracles::DoubleDoubleBall>) rough_list<oracles::DoubleDoubleBall>;
template decltype(rough_list<oracles::RealBall>) rough_list<oracles::RealBall>;
template decltype(inverse_size<oracles::Real>) inverse_size<oracles::Real>;
template decltype(inverse_size<oracles::DoubleDoubleBall>) inverse_size<oracles::DoubleDoubleBall>;
template decltype(inverse_size<oracles::RealBall>) inverse_size<oracles::RealBall>;

}  // namespace liecheck::properties
