#pragma once
// The base class of laws on trees of bodies. A case is a random tree with a state or, if the user gives a
// robot, a state of that robot.

#include <invariants/tree_case.hpp>
#include <invariants/tree_laws.hpp>
#include <invariants/tree_norms.hpp>
#include <invariants/tree_program.hpp>
#include <invariants/witness.hpp>
#include <numeric>
#include <stdexcept>

namespace liecheck::properties {

/// All numbers of a robot at its neutral configuration, and their layout.
struct RobotNumbers {
  TreeLayout at{0};
  std::vector<double> numbers;
};
/// Reads the robot's URDF, in which mimics are `coupled` or independent joints. Throws what the URDF reader throws.
RobotNumbers robot_numbers(const Robot& robot, bool coupled = false);

/// The exact values of the numbers in a container.
template <class T, class V>
std::vector<T> exact_list(const V& x) {
  std::vector<T> y;
  y.reserve(static_cast<std::size_t>(x.size()));
  for (const auto& v : x) y.push_back(oracles::exact<T>(v));
  return y;
}
template <class T>
std::vector<double> rough_list(const std::vector<T>& x) {
  std::vector<double> y;
  y.reserve(x.size());
  for (const T& v : x) y.push_back(approximate(v));
  return y;
}
/// J x with the exact numbers of J.
template <class T>
std::vector<T> exact_product(const MatX<double>& J, const std::vector<T>& x) {
  std::vector<T> sum(static_cast<std::size_t>(J.rows()), T(0));
  for (int i = 0; i < J.rows(); ++i)
    for (int k = 0; k < J.cols(); ++k)
      sum[static_cast<std::size_t>(i)] += oracles::exact<T>(J(i, k)) * x[static_cast<std::size_t>(k)];
  return sum;
}
/// At least ||A^-1|| of A = M_kl / sqrt(M_kk M_ll), from the factor of M and the roots sqrt(M_kk).
template <class T>
double inverse_size(const std::vector<T>& factor, const std::vector<double>& roots) {
  const std::vector<double> rough = rough_list(factor);
  double size = 0;
  for (std::size_t k = 0; k < roots.size(); ++k) {
    std::vector<double> e(roots.size(), 0);
    e[k] = roots[k];
    size += weighted_norm(oracles::solve(rough, std::move(e)), roots);
  }
  return size;
}
/// Whether M is singular, or may be after rounding in the scalar. Then an operation that solves with M may refuse the
/// case. `factor` is that of M, empty if M has none; `size` is ||A||.
template <class T>
bool nearly_singular(const oracles::Scalar& scalar, const std::vector<T>& factor,
                     const std::vector<double>& roots, double size) {
  return factor.empty() || !(64 * size * inverse_size(factor, roots) * scalar.epsilon < 1);
}
/// Calls f, which records the outputs of an operation that solves with M. If the operation throws
/// std::domain_error and M is nearly singular, records that the case is ill-posed.
template <class F, class IsSingular>
void solved(Recorder& r, const Few<Output, 2>& outputs, const IsSingular& nearly_singular, const F& f) {
  try {
    f();
  } catch (const std::domain_error&) {
    if (!nearly_singular()) throw;
    for (const Output& o : outputs) r.outcome(o, 0, Outcome::ill_posed);
  }
}
/// The entries of a matrix, row by row.
template <int R, int C>
VecX<double> flat(const Eigen::Matrix<double, R, C>& M) {
  return M.transpose().reshaped();
}

/// The case that `of` receives: the stored numbers, and the same numbers in T.
template <class T>
struct CaseAt {
  CaseAt(TreeLayout at, const std::vector<double>& full);
  ~CaseAt();

  TreeLayout layout;
  const std::vector<double>& structure;
  std::vector<T> numbers;
  TreeCase<double> stored;  ///< also for the sizes of terms
  TreeCase<T> exact;
  VecX<double> q, v, a, d;
  Vec<double, 6> F;
  int F_joint;

  std::size_t nv() const { return exact.v.size(); }
  /// The oracle at (q, v, a), with derivatives if a direction (dq, dv, da) is given.
  template <class... Direction>
  oracles::TreeDynamics<T> dynamics(const std::vector<T>& v, const std::vector<T>& a,
                                    const Direction&... direction) const {
    return {exact.tree, poses(), v, a, direction...};
  }
  const std::shared_ptr<const oracles::TreePoses<T>>& poses() const {
    if (!poses_) poses_ = std::make_shared<oracles::TreePoses<T>>(exact.tree, exact.q);
    return poses_;
  }
  /// The sizes of the terms that may cancel in a result. If `pushed`, they include those of the wrench.
  oracles::TreeSizes<double> sizes(const std::vector<double>& v, const std::vector<double>& a,
                                   bool pushed = false) const;
  /// Whether finite differences of poses confirm the oracle. In ball arithmetic, always true (not checked).
  bool resolved(bool direction = false) const;
  /// Records the error of a vector, in the norm with weights w, and kappa = terms / ||exact||.
  void record(Recorder& r, const Output& output, const VecX<double>& computed,
              const std::vector<T>& exact_value, const std::vector<double>& w, double terms,
              bool confirmed) const;
  void record(Recorder& r, const Output& output, const std::vector<T>& computed,
              const std::vector<T>& exact_value, const std::vector<double>& w, double terms,
              bool confirmed) const;
  /// Tells what is compared to the thread's witness, if it has one for the output. record() does so.
  static void note(const Output& output, const std::vector<T>& computed, const std::vector<T>& exact);

 private:
  mutable std::shared_ptr<const oracles::TreePoses<T>> poses_;
};

/// What all laws on trees of bodies share.
class AnyTreeLaw : public Property {
 public:
  /// Balls of double lose too many digits in these sums.
  using Tiers = std::tuple<oracles::DoubleDoubleBall, oracles::RealBall>;
  static std::size_t first_tier(const oracles::Scalar&, bool) { return 0; }
  static constexpr bool floating = false;  ///< a law may set this to true
  /// Whether the tree has one root, a free-flyer.
  virtual bool has_floating_base() const = 0;
  static constexpr bool rebuilds = false;  ///< a law may set this to true
  /// Whether the law builds other trees than that of its case, which no URDF describes.
  virtual bool rebuilds_tree() const = 0;
  std::vector<Field> fields() const override;
  std::vector<std::vector<double>> simpler(const std::vector<double>& input) const override;
  /// A random tree of more than tree_slots joints has more numbers than the fields name.
  bool takes(std::size_t numbers) const override;
  std::string program(const Output& output, const std::vector<double>& input) const override;
  /// True only if the user gave a robot. The built-in robot is too simple for these laws.
  bool needs_robot() const override { return robot_; }
  bool gives_urdf() const override { return robot_ && !rebuilds_tree(); }
  void prepare(const Robot& robot) override;
  std::string draw_for(const Subject& subject) override;
  template <class S>
  std::vector<S> draw(Source& source) const;
  bool valid(const std::vector<double>& input) const override;

 protected:
  TreeLayout layout_of(const std::vector<double>& full) const {
    return robot_ ? at_ : TreeLayout::of_size(full.size());
  }
  /// Whether the subject offers the operation on a tree of one joint or, if the user gave a robot, on a URDF.
  /// Before prepare: whether it does on either.
  bool has(const Subject& subject, const Operation& operation) const override;
  /// Whether there are trees of the joints that the subject takes.
  bool exists(const Output&) const override;
  /// The tree of the user's robot, at its neutral configuration; null without one.
  std::unique_ptr<const TreeCase<double>> users_tree() const;
  /// All numbers of a case. If the user gave a robot, the input holds only its state.
  std::vector<double> full_of(const std::vector<double>& input) const;

  std::shared_ptr<const UrdfModel> urdf_ = std::make_shared<UrdfModel>();  ///< null without a robot

 private:
  template <class S>
  std::vector<S> state_of(const std::vector<S>& full) const;
  void read(const Robot& robot, bool coupled);

  bool robot_ = false;
  Robot with_mimics_;        ///< the user's robot, if it has mimics
  oracles::JointSet taken_;  ///< of random trees
  TreeLayout at_{tree_slots};
  std::vector<double> fixed_;
};

/// A law P on trees of bodies. P has the function
///   template <class Real> void of(const Operations&, const CaseAt<Real>&, Recorder&) const
/// and, if its trees need a floating base, a constant `floating` that is true; if it builds other trees,
/// `rebuilds`.
template <class P>
class TreeLaw : public Law<P, AnyTreeLaw> {
 public:
  bool has_floating_base() const override { return P::floating; }
  bool rebuilds_tree() const override { return P::rebuilds; }
  template <class T>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& recorder) const {
    const std::vector<double> full = this->full_of(input);
    CaseAt<T> c(this->layout_of(full), full);
    // Balls that could not decide have noted it before.
    if (Witness* const w = Witness::current(); w && w->every) w->all.clear();
    if (!P::rebuilds) c.stored.urdf = this->urdf_;
    static_cast<const P*>(this)->template of<T>(subject.operations, std::as_const(c), recorder);
  }
};

// tree_law.cpp instantiates these.
extern template std::vector<float> AnyTreeLaw::draw(Source&) const;
extern template std::vector<double> AnyTreeLaw::draw(Source&) const;
extern template struct CaseAt<oracles::Real>;
extern template struct CaseAt<oracles::DoubleDoubleBall>;
extern template struct CaseAt<oracles::RealBall>;
extern template decltype(mass_roots<oracles::Real>) mass_roots<oracles::Real>;
extern template decltype(mass_roots<oracles::DoubleDoubleBall>) mass_roots<oracles::DoubleDoubleBall>;
extern template decltype(mass_roots<oracles::RealBall>) mass_roots<oracles::RealBall>;
extern template decltype(weighted_norm<oracles::Real>) weighted_norm<oracles::Real>;
extern template decltype(weighted_norm<oracles::DoubleDoubleBall>) weighted_norm<oracles::DoubleDoubleBall>;
extern template decltype(weighted_norm<oracles::RealBall>) weighted_norm<oracles::RealBall>;
extern template decltype(rough_list<oracles::Real>) rough_list<oracles::Real>;
extern template decltype(rough_list<oracles::DoubleDoubleBall>) rough_list<oracles::DoubleDoubleBall>;
extern template decltype(rough_list<oracles::RealBall>) rough_list<oracles::RealBall>;
extern template decltype(inverse_size<oracles::Real>) inverse_size<oracles::Real>;
extern template decltype(inverse_size<oracles::DoubleDoubleBall>) inverse_size<oracles::DoubleDoubleBall>;
extern template decltype(inverse_size<oracles::RealBall>) inverse_size<oracles::RealBall>;

/// Registers a law on trees of bodies.
template <class P>
struct RegisteredTreeLaw : RegisteredProperty<P> {
  RegisteredTreeLaw() { add_tree_law(P::stated.name); }
};

}  // namespace liecheck::properties
