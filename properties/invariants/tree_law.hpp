#pragma once
// The base class of laws on trees of bodies. A case is a random tree with a state or, if the user gives a
// robot, a state of that robot.

#include <generators/tree_shrinks.hpp>
#include <invariants/tree_case.hpp>
#include <invariants/tree_laws.hpp>
#include <invariants/tree_norms.hpp>
#include <invariants/tree_program.hpp>
#include <numeric>

namespace liecheck::properties {

/// All numbers of a robot at its neutral configuration, and their layout.
struct RobotNumbers {
  TreeLayout at{0};
  std::vector<double> numbers;
};
/// Reads the robot's URDF. Throws what the URDF reader throws.
RobotNumbers robot_numbers(const Robot& robot);

namespace tree_law_detail {
/// Whether all eigenvalues of the second moment tr(I) / 2 - I exceed `least` tr(I). I is xx xy yy xz yz zz.
template <class S>
bool thicker(const S* I, long double trace, long double least) {
  if (trace == 0) return least < 0;
  const auto second = [&](int k, bool diagonal) {
    return (diagonal ? 0.5L - least : 0.0L) - static_cast<long double>(I[k]) / trace;
  };
  const long double xx = second(0, true), xy = second(1, false), yy = second(2, true), xz = second(3, false),
                    yz = second(4, false), zz = second(5, true);
  return trace > 0 && xx > 0 && xx * yy - xy * xy > 0 &&
         xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz) > 0;
}
}  // namespace tree_law_detail

/// A law P on trees of bodies. P<S> has a constant `floating` and the function
///   template <class Real> void of(const Operations<S>&, const CaseAt<Real>&, Recorder&) const.
template <template <class> class P, class S>
class TreeLaw : public Property<S> {
 public:
  std::vector<Field> fields() const override {
    std::vector<Field> all;
    const auto add = [&](const std::string& name, Kind kind, int size, const char* unit, Reach reach) {
      all.push_back({name, kind, size, unit, reach});
    };
    constexpr Reach any = Reach::any;
    const bool tree = !robot_;
    if (tree) {
      const Reach shape = P<S>::floating ? any : Reach::limited;
      add("parents", Kind::parents, at_.slots, "1", shape);
      add("kinds", Kind::joints, 2 * at_.slots, "1", shape);
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
  std::vector<std::vector<S>> simpler(const std::vector<S>& input) const override {
    return robot_ ? std::vector<std::vector<S>>() : shrinks::simpler_trees(input);
  }
  std::string program(const Output& output, const std::vector<S>& input) const override {
    const std::vector<S> full = full_of(input);
    const TreeCase<double> c(at_, full, std::vector<double>(full.begin(), full.end()));
    return tree_program(c, output.record->call, std::is_same_v<S, float> ? "float" : "double");
  }
  bool offered(const Subject<S>& s) const override { return s.operations.tree != nullptr; }
  /// True only if the user gave a robot. The built-in robot is too simple for these laws.
  bool needs_robot() const override { return robot_; }
  void prepare(const Robot& robot) override {
    if (robot.path.empty()) return;
    const RobotNumbers r = robot_numbers(robot);
    robot_ = true;
    at_ = r.at;
    fixed_.clear();
    for (double x : r.numbers) fixed_.push_back(S(x));
  }
  std::vector<S> generate(Source& source) const override {
    if (!robot_) return random_tree<S>(source, static_cast<const P<S>*>(this)->floating);
    std::vector<S> x = fixed_;
    for (int i = 0; i < at_.slots; ++i)
      random_joint_state(source,
                         static_cast<oracles::JointKind>(static_cast<int>(fixed_[index(at_.kinds() + i)])),
                         fixed_[index(at_.primaries() + i)] >= S(0), x.data() + at_.slot(i));
    random_frame(source, at_.slots, x.data() + at_.frame());
    random_wrench(source, at_.slots, x.data() + at_.wrench());
    return state_of(x);
  }
  bool valid(const std::vector<S>& input) const override;

  void measure(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder) const override {
    in<oracles::Real>(subject, input, recorder);
  }
  bool measure_fast(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder,
                    std::size_t tier) const override {
    using Tiers = typename oracles::BallTiers<S>::type;
    if constexpr (std::tuple_size_v<Tiers> == 0) {
      return false;
    } else {  // balls of double lose too many digits in these sums
      if (tier > 0) return false;
      in<std::tuple_element_t<std::tuple_size_v<Tiers> - 1, Tiers>>(subject, input, recorder);
      return true;
    }
  }

 protected:
  /// The case that `of` receives: the stored numbers, the same numbers in T and in double.
  template <class T>
  struct CaseAt {
    CaseAt(const TreeLaw& law, const std::vector<S>& full)
        : layout(law.at_),
          structure(full),
          numbers(exact_numbers<T>(full)),
          stored(layout, full, full),
          exact(layout, full, numbers),
          rough(layout, full, std::vector<double>(full.begin(), full.end())),
          q(eigen(stored.q)),
          v(eigen(stored.v)),
          a(eigen(stored.a)),
          d(eigen(stored.d)),
          F(eigen(stored.wrench)),
          F_joint(stored.wrench.empty() ? -1 : stored.wrench[0].joint) {}

    TreeLayout layout;
    const std::vector<S>& structure;
    std::vector<T> numbers;
    TreeCase<S> stored;
    TreeCase<T> exact;
    TreeCase<double> rough;  ///< for the sizes of terms
    VecX<S> q, v, a, d;
    Vec<S, 6> F;
    int F_joint;

    std::size_t nv() const { return exact.v.size(); }
    /// The oracle at (q, v, a), with derivatives if a direction (dq, dv, da) is given.
    template <class... Direction>
    oracles::TreeDynamics<T> dynamics(const std::vector<T>& v, const std::vector<T>& a,
                                      const Direction&... direction) const {
      return {exact.tree, exact.q, v, a, direction...};
    }
    /// The sizes of the terms that may cancel in a result; with `pushed` also those of the wrench.
    oracles::TreeSizes<double> sizes(const std::vector<double>& v, const std::vector<double>& a,
                                     bool pushed = false) const {
      return {rough.tree, rough.q, v, a, pushed ? rough.wrench : std::vector<oracles::WrenchOf<double>>()};
    }
    /// Whether finite differences of poses confirm the oracle. Ball arithmetic does not check this.
    bool resolved(bool direction = false) const {
      if constexpr (oracles::BallNumber<T>)
        return true;
      else
        return oracles::confirmed(exact.tree, exact.q, exact.v, exact.a,
                                  direction ? exact.d : std::vector<T>());
    }
    /// Records the error of a vector, in the norm with weights w, and kappa = terms / ||exact||.
    void record(Recorder& r, const Output& output, const VecX<S>& computed, const std::vector<T>& exact_value,
                const std::vector<double>& w, double terms, bool confirmed) const {
      if (!oracles::all_finite(computed)) return r.outcome(output, 0, Outcome::not_finite);
      record(r, output, exact_list<T>(computed), exact_value, w, terms, confirmed);
    }
    void record(Recorder& r, const Output& output, const std::vector<T>& computed,
                const std::vector<T>& exact_value, const std::vector<double>& w, double terms,
                bool confirmed) const {
      if (!confirmed) return r.outcome(output, 0, Outcome::unresolved);
      const T size = oracles::larger(weighted_norm(exact_value, w), oracles::least_denominator<S, T>());
      const double kappa = terms / approximate(size);
      r.record(output, 0, weighted_error<S>(computed, exact_value, w, size), [&] { return kappa; });
    }
  };
  template <class T>
  static std::vector<T> exact_numbers(const std::vector<S>& x) {
    std::vector<T> y;
    for (const S& v : x) y.push_back(oracles::exact<T>(v));
    return y;
  }
  template <class T>
  static std::vector<T> exact_list(const VecX<S>& x) {
    std::vector<T> y;
    for (int i = 0; i < x.size(); ++i) y.push_back(oracles::exact<T>(x[i]));
    return y;
  }
  template <class T>
  static std::vector<double> rough_list(const std::vector<T>& x) {
    std::vector<double> y;
    for (const T& v : x) y.push_back(approximate(v));
    return y;
  }
  /// The entries of a matrix, row by row.
  static VecX<S> flat(const MatX<S>& M) { return M.transpose().reshaped(); }

 private:
  template <class T>
  void in(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder) const {
    const std::vector<S> full = full_of(input);
    const CaseAt<T> c(*this, full);
    static_cast<const P<S>*>(this)->template of<T>(subject.operations, c, recorder);
  }
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  /// Calls f(first, size) for each range of numbers that belong to a robot's state.
  template <class F>
  void for_each_state(F f) const {
    f(at_.frame(), 15);
    for (int i = 0; i < at_.slots; ++i) f(at_.slot(i) + TreeSlot::q_p, TreeSlot::size - TreeSlot::q_p);
  }
  std::vector<S> state_of(const std::vector<S>& full) const {
    std::vector<S> x;
    for_each_state(
        [&](int first, int n) { x.insert(x.end(), full.begin() + first, full.begin() + first + n); });
    return x;
  }
  std::vector<S> full_of(const std::vector<S>& input) const {
    if (!robot_) return input;
    std::vector<S> full = fixed_;
    auto from = input.begin();
    for_each_state([&](int first, int n) {
      std::copy_n(from, n, full.begin() + first);
      from += n;
    });
    return full;
  }

  bool robot_ = false;
  TreeLayout at_{tree_slots};
  std::vector<S> fixed_;
};

template <template <class> class P, class S>
bool TreeLaw<P, S>::valid(const std::vector<S>& input) const {
  if (!Property<S>::valid(input)) return false;
  const std::vector<S> x = full_of(input);
  using oracles::JointKind;
  using Slot = TreeSlot;
  const auto whole = [&](int i, int low, int high) {
    return x[index(i)] >= S(low) && x[index(i)] <= S(high) && x[index(i)] == S(static_cast<int>(x[index(i)]));
  };
  const auto unit = [&](int first, int n) {
    oracles::Quaternion<> u{{Real(0), Real(0), Real(0), Real(0)}};
    for (int k = 0; k < n; ++k) u[k] = oracles::exact<Real>(x[index(first + k)]);
    return oracles::norm_defect<S>(u) <= 8;
  };
  int joints = 0, roots = 0;
  for (int i = 0; i < at_.slots; ++i) {
    if (!whole(at_.parents() + i, absent_joint, i - 1)) return false;
    const int slot = at_.slot(i);
    if (!unit(slot + Slot::Q, 4) || !unit(slot + Slot::q_Q, 4) || !unit(slot + Slot::q_circle, 2))
      return false;
    if (x[index(at_.parents() + i)] == S(absent_joint)) continue;
    if (joints++ < i) return false;
    roots += x[index(at_.parents() + i)] == S(-1);
    if (!whole(at_.kinds() + i, 0, 7) || !whole(at_.primaries() + i, -1, i - 1)) return false;
    const auto kind = [&](int k) {
      return static_cast<JointKind>(static_cast<int>(x[index(at_.kinds() + k)]));
    };
    if (const int primary = static_cast<int>(x[index(at_.primaries() + i)]); primary >= 0) {
      const bool simple =
          kind(i) == JointKind::revolute || kind(i) == JointKind::prismatic || kind(i) == JointKind::helical;
      if (!simple || velocity_size(kind(primary)) != 1 || x[index(at_.primaries() + primary)] >= S(0))
        return false;
    }
    if (robot_) continue;
    const S mass = x[index(at_.masses() + i)], armature = x[index(slot + Slot::armature)];
    if (!(mass > S(0)) || !(armature >= S(0)) || !unit(slot + Slot::axis, 3)) return false;
    // The second moment tr(I) / 2 - I must be positive semidefinite. Without an armature the body must also
    // be thick enough to give its joint an inertia.
    const S* I = x.data() + slot + Slot::I;
    const long double trace =
        static_cast<long double>(I[0]) + static_cast<long double>(I[2]) + static_cast<long double>(I[5]);
    if (!tree_law_detail::thicker(I, trace,
                                  -32 * static_cast<long double>(std::numeric_limits<S>::epsilon())))
      return false;
    if (armature == S(0) &&
        (!tree_law_detail::thicker(I, trace, 1e-5L) || trace < 1e-4L * static_cast<long double>(mass)))
      return false;
  }
  if (joints == 0 || !whole(at_.frame(), 0, joints - 1) || !whole(at_.wrench(), -1, joints - 1)) return false;
  if (static_cast<const P<S>*>(this)->floating && !robot_ &&
      (roots > 1 || x[index(at_.kinds())] != S(static_cast<int>(JointKind::free_flyer))))
    return false;
  return unit(at_.frame() + 1, 4);
}

/// Registers a law on trees of bodies.
template <template <class> class P>
struct RegisteredTreeLaw : RegisteredProperty<P> {
  RegisteredTreeLaw() { add_tree_law(P<double>().name()); }
};

}  // namespace liecheck::properties
