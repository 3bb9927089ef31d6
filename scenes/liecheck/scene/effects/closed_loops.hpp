#pragma once
// Closed loops: pairs of frames whose origins coincide (point), or which coincide (weld). The forces of the constraints
// follow from the other forces, so that this effect is the last of a scene.
//
//   r = (p_A - p_B, log(R_A R_B^T)),   r_ddot = a_A - a_B of the motion without the constraints + K lambda
//   K = J M^-1 J^T,   K lambda = -2 alpha r_dot - alpha^2 r - r_ddot without the constraints,   tau += J^T lambda
//
// in the world's axes, with Baumgarte's stabilisation (1972): a gap r decays as exp(-alpha t), and the method of the
// scene, of order p, leaves one of O(h^p), which the observer loop_gaps measures. Columns of M^-1 J^T come from the
// articulated-body algorithm. Redundant constraints, as in a planar linkage, get no force: K is factorised with pivots, and
// pivots below its rounding errors are left out.

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/scene/effects/coordinates.hpp>
#include <optional>

namespace liecheck::scene {

inline const PartInfo closed_loops_info{
    "closed_loops",
    "tau += J^T lambda,  r_ddot = -2 alpha r_dot - alpha^2 r,  r = p_A - p_B, and the rotation of a weld",
    "conserves, but for the work of the stabilisation",
    "the articulated-body algorithm 1 + m times, for m constraints",
    {{"frames", Kind::Frames, "", nullptr, "A1, B1, A2, B2, ...: the pairs that coincide"},
     {"type", Kind::Choice, "point|weld", "point", "whether the origins coincide or the frames"},
     {"rate", Kind::Positive, "1/s", "20", "alpha, at which a gap closes; well below 1/step"}}};

/// The gap of a pair of frames and its rates, in the world's axes: rows 0 to 2 of the origins, 3 to 5 of the axes.
template <Scalar S>
struct Gap {
  Vector6<S> r, rate;
  Gap(const Now<S>& now, const Spot<S>& a, const Spot<S>& b) {
    const SE3<S> A = a.pose(now), B = b.pose(now);
    const Matrix3<S> R = A.rotation() * B.rotation().transpose();
    r << A.translation() - B.translation(), log3<S>(R);
    rate << velocity(now, a, A) - velocity(now, b, B);
  }

 private:
  static Vector6<S> velocity(const Now<S>& now, const Spot<S>& spot, const SE3<S>& X) {
    const Motion<S> V = spot.velocity(now);
    Vector6<S> v;
    v << X.rotation() * V.linear(), X.rotation() * V.angular();
    return v;
  }
};

/// The pairs of frames of the parameters. Throws std::invalid_argument if their number is odd.
template <Scalar S>
std::vector<std::pair<Spot<S>, Spot<S>>> pairsOf(const Parameters& p, const Model<S>& model) {
  const auto& frames = p.names("frames");
  if (frames.size() % 2 != 0)
    throw std::invalid_argument("closed_loops.frames is a list of pairs: one frame is left over");
  std::vector<std::pair<Spot<S>, Spot<S>>> pairs;
  for (std::size_t i = 0; i < frames.size(); i += 2)
    pairs.emplace_back(Spot<S>(model, frames[i]), Spot<S>(model, frames[i + 1]));
  return pairs;
}

template <Scalar S>
class ClosedLoops final : public Effect<S> {
 public:
  ClosedLoops(const Parameters& p, const Model<S>& model, const Surroundings&)
      : pairs_(pairsOf(p, model)), rows_(p.word("type") == "weld" ? 6 : 3), alpha_(S(p.number("rate"))) {}
  Acts acts() const override { return Acts::OnBodies; }
  Kinematics needs() const override { return Kinematics::Velocities; }
  bool conservative() const override { return true; }
  bool follows() const override { return true; }
  void prepare(Model<S>& model) const override {
    if (!work_) work_.emplace(model, rows_ * int(pairs_.size()));
  }
  void add(const Now<S>& now, const Load<S>& load) const override {
    Work& w = *work_;
    for (int k = 0; k < w.q.size(); ++k) w.q[k] = now.q[std::size_t(k)];
    for (int k = 0; k < w.v.size(); ++k) w.v[k] = now.v[std::size_t(k)], w.tau[k] = load.tau[std::size_t(k)];
    std::copy_n(load.f.begin(), w.f.size(), w.f.begin());
    toJointAxes(now, w.f);
    w.a = aba(w.model, w.data, w.q, w.v, w.tau, External<S>(w.f));
    accelerations(w.model, w.data, w.v, w.target);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Gap<S> gap(now, pairs_[i].first, pairs_[i].second);
      for (int k = 0; k < rows_; ++k)
        w.target[rows_ * int(i) + k] =
            -w.target[rows_ * int(i) + k] - alpha_ * (S(2) * gap.rate[k] + alpha_ * gap.r[k]);
    }
    w.tau.setZero();
    for (int column = 0; column < w.K.cols(); ++column) {
      std::ranges::fill(w.f, Force<S>::Zero());
      push(now, w.f, column, S(1));
      toJointAxes(now, w.f);
      w.a = aba(w.weightless, w.light, w.q, w.rest, w.tau, External<S>(w.f));
      accelerations(w.weightless, w.light, w.rest, w.column);
      w.K.col(column) = w.column;
    }
    solve(w);
    for (int row = 0; row < w.K.cols(); ++row) push(now, load.f, row, w.target[row]);
  }

 private:
  struct Work {
    Model<S> model, weightless;
    Data<S> data, light;
    VectorX<S> q, v, tau, a, rest, target, column;
    MatrixX<S> K;
    std::vector<Force<S>> f;
    Work(const Model<S>& of, int rows)
        : model(of), weightless(of), data(of, dense(of)), light(of, dense(of)) {
      weightless.gravity.setZero();
      q = VectorX<S>::Zero(of.nq), target = column = VectorX<S>::Zero(rows), K = MatrixX<S>::Zero(rows, rows);
      v = tau = a = rest = VectorX<S>::Zero(of.nv);
      f.assign(std::size_t(of.njoints), Force<S>::Zero());
    }
    static Dense dense(const Model<S>& of) { return of.has_mimics ? Dense::Mass : Dense::None; }
  };
  /// The accelerations of all gaps at (q, v, a of work_).
  void accelerations(const Model<S>& model, Data<S>& data, const VectorX<S>& v, VectorX<S>& gaps) const {
    forwardKinematics(model, data, work_->q, v, work_->a);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Vector6<S> a = acceleration(data, pairs_[i].first) - acceleration(data, pairs_[i].second);
      gaps.segment(rows_ * int(i), rows_) = a.head(rows_);
    }
  }
  static Vector6<S> acceleration(const Data<S>& data, const Spot<S>& spot) {
    const Matrix3<S> R = (data.oMi()[spot.joint] * spot.X_JF).rotation();
    const Motion<S> V = spot.X_JF.actInv(data.v()[spot.joint]), A = spot.X_JF.actInv(data.a()[spot.joint]);
    Vector6<S> a;
    a << R * (A.linear() + cross<S>(V.angular(), V.linear())), R * A.angular();
    return a;
  }
  /// Adds the forces of constraint `row` with the multiplier lambda.
  template <class Forces>
  void push(const Now<S>& now, Forces& f, int row, const S& lambda) const {
    const auto& [a, b] = pairs_[std::size_t(row / rows_)];
    const int k = row % rows_;
    const Vector3<S> e = lambda * Vector3<S>::Unit(k % 3), zero = Vector3<S>::Zero();
    const Load<S> load{{}, f};
    a.addWorld(now, load, k < 3 ? e : zero, k < 3 ? zero : e);
    b.addWorld(now, load, k < 3 ? Vector3<S>(-e) : zero, k < 3 ? zero : Vector3<S>(-e));
  }
  /// target := K^-1 target by Gauss and Jordan with diagonal pivots; 0 where no pivot is above the rounding errors.
  static void solve(Work& w) {
    const int n = int(w.K.cols());
    const S least = S(1024) * eps<S>() * w.K.diagonal().cwiseAbs().maxCoeff();
    w.column.setZero();  // 1 for the rows that have been a pivot
    for (int step = 0; step < n; ++step) {
      int p = -1;
      for (int i = 0; i < n; ++i)
        if (w.column[i] == S(0) && w.K(i, i) > least && (p < 0 || w.K(i, i) > w.K(p, p))) p = i;
      if (p < 0) break;
      w.column[p] = S(1);
      const S pivot = w.K(p, p);
      for (int j = 0; j < n; ++j) w.K(p, j) = w.K(p, j) / pivot;
      w.target[p] = w.target[p] / pivot;
      for (int i = 0; i < n; ++i) {
        const S factor = w.K(i, p);
        if (i == p || factor == S(0)) continue;
        for (int j = 0; j < n; ++j) w.K(i, j) -= factor * w.K(p, j);
        w.target[i] -= factor * w.target[p];
      }
    }
    for (int i = 0; i < n; ++i)
      if (w.column[i] == S(0)) w.target[i] = S(0);
  }

  std::vector<std::pair<Spot<S>, Spot<S>>> pairs_;
  int rows_;
  S alpha_;
  mutable std::optional<Work> work_;
};

}  // namespace liecheck::scene
