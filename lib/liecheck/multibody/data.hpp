#pragma once
// Data holds the results and the workspace of the algorithms for one robot, so that they allocate nothing.
// Each thread needs its own Data; the Model can be shared. Every algorithm states which fields it updates.
// data_field.hpp defines when a field is stale.
//
// Fields are read as data.tau() or data.oMi[i]. Names and meanings are Pinocchio's. An algorithm returns
// the value of its field if that has a fixed size, otherwise a reference to it: copy the result if you need it
// after the next call that updates the field. No two algorithms return one field with different meanings.
//
// A copy of a Data holds the same results, fresh or stale, and is independent of the original from then on.
// std::move copies too, so that both remain valid.

#include <liecheck/multibody/composite_inertia.hpp>
#include <liecheck/multibody/data_field.hpp>
#include <liecheck/multibody/joint_place.hpp>
#include <liecheck/multibody/model.hpp>
#include <span>

namespace liecheck {

template <class S>
using Matrix6X = Eigen::Matrix<S, 6, Eigen::Dynamic>;
template <class S>
using Matrix3X = Eigen::Matrix<S, 3, Eigen::Dynamic>;

/// External forces [njoints; N, N m] on every joint's body, in the joint's axes at its origin. May be empty.
template <class S>
using External = std::type_identity_t<std::span<const Force<S>>>;

/// The nv x nv matrices that a Data allocates; their size grows with the square of nv.
enum class Dense {
  None,
  Mass,        ///< M, Minv: crba, computeMinverse, and aba of a model with mimics
  Derivatives  ///< the matrices of Mass, and dtau_dq, dtau_dv, ddq_dq, ddq_dv
};

/// The columns of motion subspaces with their rates, and the motions of the bodies, in world axes about the origin of the
/// root of each branch (algorithms/derivatives.hpp). Without gravity.
template <class S>
struct MotionRates {
  Eigen::Matrix<S, 24, Eigen::Dynamic> columns;
  std::vector<Motion<S>> velocity, acceleration;
  std::vector<Vector3<S>> from_root;  ///< [m] of the joints' origins, from the root of the branch
};

template <Scalar S>
class Data {
  Clock clock_;
  template <class T>
  using Each = std::vector<T>;
  static constexpr const char *fk = "forwardKinematics(model, data, q)",
                              *fk_v = "forwardKinematics(model, data, q, v)",
                              *fk_a = "forwardKinematics(model, data, q, v, a)",
                              *rnea_derivatives = "computeRNEADerivatives(model, data, q, v, a)",
                              *aba_derivatives = "computeABADerivatives(model, data, q, v, tau)";

 public:
  explicit Data(const Model<S>& model, Dense dense = Dense::None);
  Data(const Data& other) : Data() { *this = other; }
  Data& operator=(const Data& other) = default;

  Field<Each<SE3<S>>> liMi{clock_, "liMi", fk};                                  ///< [njoints] X_parent,joint
  Field<Each<SE3<S>>> oMi{clock_, "oMi", fk};                                    ///< [njoints] X_world,joint
  Field<Each<SE3<S>>> oMf{clock_, "oMf", "updateFramePlacements(model, data)"};  ///< [nframes] X_world,frame
  /// [njoints] velocity [m/s, rad/s] and spatial acceleration without gravity [m/s^2, rad/s^2] of joint i in
  /// its axes, at its origin.
  Field<Each<Motion<S>>> v{clock_, "v", fk_v}, a{clock_, "a", fk_a};
  /// [njoints] force of the parent on joint i, in i's axes, at its origin [N, N m].
  Field<Each<Force<S>>> f{clock_, "f", "rnea(model, data, q, v, a)", Constants::Gravity};
  /// [nv; N, N m] tau: generalised forces of rnea; nle: h(q, v), tau at a = 0; g: tau at v = a = 0;
  /// tau_static: g - sum J^T fext.
  Field<VectorX<S>> tau{clock_, "tau", "rnea(model, data, q, v, a)", Constants::GravityAndArmature};
  Field<VectorX<S>> nle{clock_, "nle", "nonLinearEffects(model, data, q, v)", Constants::Gravity};
  Field<VectorX<S>> g{clock_, "g", "computeGeneralizedGravity(model, data, q)", Constants::Gravity};
  Field<VectorX<S>> tau_static{clock_, "tau_static", "computeStaticTorque(model, data, q, fext)",
                               Constants::Gravity};
  /// [nv; m/s^2, rad/s^2] acceleration of aba.
  Field<VectorX<S>> ddq{clock_, "ddq", "aba(model, data, q, v, tau)", Constants::GravityAndArmature};
  /// [6 x nv] the Jacobian columns of all joints in WORLD, and their time derivatives.
  Field<Matrix6X<S>> J{clock_, "J", "computeJointJacobians(model, data, q)"};
  Field<Matrix6X<S>> dJ{clock_, "dJ", "computeJointJacobiansTimeVariation(model, data, q, v)"};
  /// [nv x nv] joint-space inertia and its inverse, both triangles.
  Field<MatrixX<S>> M{clock_, "M", "crba(model, data, q)", Constants::Armature};
  Field<MatrixX<S>> Minv{clock_, "Minv", "computeMinverse(model, data, q)", Constants::Armature};
  /// [nv x nv]: C v = h - g.
  Field<MatrixX<S>> C{clock_, "C", "computeCoriolisMatrix(model, data, q, v)"};
  /// For the derivatives of frames' motions (algorithms/kinematics_derivatives.hpp).
  Field<MotionRates<S>> motion_rates{clock_, "motion_rates",
                                     "computeForwardKinematicsDerivatives(model, data, q, v, a)"};
  /// [nv x nv] derivatives with respect to tangent increments of q (_dq) and to v (_dv).
  Field<MatrixX<S>> dtau_dq{clock_, "dtau_dq", rnea_derivatives, Constants::Gravity},
      dtau_dv{clock_, "dtau_dv", rnea_derivatives},
      ddq_dq{clock_, "ddq_dq", aba_derivatives, Constants::GravityAndArmature},
      ddq_dv{clock_, "ddq_dv", aba_derivatives, Constants::Armature};
  /// [J].
  Field<S> kinetic_energy{clock_, "kinetic_energy", "computeKineticEnergy(model, data, q, v)",
                          Constants::Armature};
  Field<S> potential_energy{clock_, "potential_energy", "computePotentialEnergy(model, data, q)",
                            Constants::Gravity};
  /// Centre of mass, in the world [m, m/s, m/s^2].
  Field<Vector3<S>> com{clock_, "com", "centerOfMass(model, data, q)", Constants::None, Vector3<S>::Zero()};
  Field<Vector3<S>> vcom{clock_, "vcom", "centerOfMass(model, data, q, v)", Constants::None,
                         Vector3<S>::Zero()};
  Field<Vector3<S>> acom{clock_, "acom", "centerOfMass(model, data, q, v, a)", Constants::None,
                         Vector3<S>::Zero()};
  /// [3 x nv] vcom = Jcom v.
  Field<Matrix3X<S>> Jcom{clock_, "Jcom", "jacobianCenterOfMass(model, data, q)"};
  /// [6 x nv] hg = Ag v.
  Field<Matrix6X<S>> Ag{clock_, "Ag", "computeCentroidalMap(model, data, q)"};
  /// Momentum about the centre of mass in the world's axes [N s, N m s], and its rate [N, N m].
  Field<Force<S>> hg{clock_, "hg", "computeCentroidalMomentum(model, data, q, v)", Constants::None,
                     Force<S>::Zero()};
  Field<Force<S>> dhg{clock_, "dhg", "computeCentroidalMomentumTimeVariation(model, data, q, v, a)",
                      Constants::None, Force<S>::Zero()};

  /// Workspace of the algorithms. "In world axes" means in the world's axes with the joint's origin as
  /// reference point, so that no digits are lost far from the world's origin.
  struct Work {
    Each<Motion<S>> gravitated;  ///< acceleration minus gravity
    Each<Vector3<S>> r;          ///< vector from the parent's origin, in world axes (derivatives.hpp: from O)
    Each<Motion<S>> velocity, bias;     ///< in world axes
    Each<Force<S>> force;               ///< in world axes
    Each<CompositeInertia<S>> inertia;  ///< composite inertias of subtrees, in world axes
    Each<JoinedMass<S>> joined;         ///< cached mass ratios for adding subtree i to its parent
    Each<MovingInertia<S>> moving;      ///< inertias and momenta of subtrees about one point, in world axes
    Each<Matrix6<S>> articulated, D_factor;
    Each<InertiaBound<S>> carried;               ///< of subtrees, for the rounding errors of `articulated`
    Matrix6X<S> S_columns, dS, U;                ///< [6 x ncolumns]
    Eigen::Matrix<S, 24, Eigen::Dynamic> rates;  ///< [24 x ncolumns] s, w, y and z of derivatives.hpp
    VectorX<S> u;                                ///< [ncolumns]
    /// Coordinate k of v has depth[k] coordinates before it on its path from the universe. They and then k
    /// are the numbers of `path` from row[k] on, a multiple of four. last[k] is the last coordinate whose
    /// path contains k. Mimics couple branches: with mimics all coordinates are on one path.
    Each<int> depth, row, path, last;
    VectorX<S> factor, factor_inverse;  ///< L of M = L^T L, and L^-1; the numbers of row k belong to `path`
    MatrixX<S> square, inverse;  ///< L^-1 and M^-1, with rows and columns of zeros up to a multiple of four
    Each<int> terms;             ///< [nv] the columns that contribute to a block of a product
  };
  Work work;

  /// Throws std::invalid_argument unless this Data was made from this model in its current form.
  void check(const Model<S>& model) const {
    if (model.revision != revision_)
      throw std::invalid_argument(
          "this Data was made from another model, or before a joint, a frame or a body was added to this "
          "model");
  }
  /// Throws std::logic_error if this Data has not allocated the matrices.
  void require(Dense dense, const char* call) const {
    if (int(dense_) < int(dense))
      throw std::logic_error(std::string(call) + " needs nv x nv matrices: make Data(model, Dense::" +
                             (dense == Dense::Mass ? "Mass)" : "Derivatives)"));
  }
  /// For algorithms: sets the current state q, (q, v) or (q, v, a) and the constants of the model, and checks
  /// the model and the sizes.
  void begin(const Model<S>& model, In<S> q) {
    check(model);
    note(model.gravity, gravity_, clock_.gravity);
    update(model.armature, armature_, model.nv, "armature", "nv", clock_.armature);
    update(q, q_, model.nq, "q", "nq", clock_.q);
  }
  void begin(const Model<S>& model, In<S> q, In<S> velocity) {
    begin(model, q);
    update(velocity, v_, model.nv, "v", "nv", clock_.v);
  }
  void begin(const Model<S>& model, In<S> q, In<S> velocity, In<S> acceleration) {
    begin(model, q, velocity);
    update(acceleration, a_, model.nv, "a", "nv", clock_.a);
  }

 private:
  Data() = default;  // for the copy constructor
  void allocateFactors(const Model<S>& model);

  void update(In<S> x, VectorX<S>& last, int size, const char* what, const char* dimension, long& stamp) {
    multibody_detail::checkSize(x.size(), size, what, dimension);
    note(x, last, stamp);
  }
  template <class Vector>
  void note(const Vector& x, Vector& last, long& stamp) {
    if (stamp != 0 && x == last) return;
    last = x;
    stamp = ++changes_;
  }

  int revision_ = 0;
  Dense dense_ = Dense::None;
  VectorX<S> q_, v_, a_, armature_;
  Vector3<S> gravity_;
  long changes_ = 0;
};

template <Scalar S>
Data<S>::Data(const Model<S>& model, Dense dense)
    : revision_(model.revision),
      dense_(dense),
      q_(model.nq),
      v_(model.nv),
      a_(model.nv),
      armature_(model.nv) {
  const std::size_t n = model.joints.size();
  liMi.scratch().assign(n, SE3<S>::Identity()), oMi.scratch().assign(n, SE3<S>::Identity());
  oMf.scratch().resize(model.frames.size());
  v.scratch().assign(n, Motion<S>::Zero()), a.scratch().assign(n, Motion<S>::Zero());
  f.scratch().assign(n, Force<S>::Zero());
  for (Field<VectorX<S>>* x : {&tau, &nle, &g, &tau_static, &ddq}) x->scratch().resize(model.nv);
  for (Field<Matrix6X<S>>* m : {&J, &dJ, &Ag}) m->scratch().resize(6, model.nv);
  Jcom.scratch().resize(3, model.nv);
  work.gravitated.assign(n, Motion<S>::Zero());
  work.r.assign(n, Vector3<S>::Zero());
  work.velocity.assign(n, Motion<S>::Zero()), work.bias.assign(n, Motion<S>::Zero());
  work.force.assign(n, Force<S>::Zero());
  work.inertia.resize(n), work.joined.resize(n);
  work.articulated.resize(n), work.D_factor.resize(n), work.carried.resize(n);
  for (Matrix6X<S>* m : {&work.S_columns, &work.dS, &work.U}) m->resize(6, model.ncolumns);
  work.u.resize(model.ncolumns);
  if (dense == Dense::None) return;
  M.scratch().setZero(model.nv, model.nv);  // entries between branches are never written
  Minv.scratch().resize(model.nv, model.nv);
  allocateFactors(model);
  if (dense == Dense::Mass) return;
  for (Field<MatrixX<S>>* m : {&dtau_dq, &dtau_dv, &ddq_dq, &ddq_dv, &C})
    m->scratch().setZero(model.nv, model.nv);  // entries between branches of dtau are never written
  work.inverse = work.square;
  work.moving.resize(n), work.rates.resize(24, model.ncolumns);
}

template <Scalar S>
void Data<S>::allocateFactors(const Model<S>& model) {
  const int n = model.nv, rounded = (n + 3) / 4 * 4;
  auto& path = work.path;
  for (Each<int>* x : {&work.depth, &work.row, &work.last, &work.terms}) x->resize(std::size_t(n));
  Each<int> tip(model.joints.size(), -1);  // the last coordinate on the path of each joint
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    tip[i] = tip[std::size_t(model.parents[i])];
    for (int k = model.idx_vs[i]; k < model.idx_vs[i] + model.nvs[i]; ++k) {
      const int before = model.has_mimics ? k - 1 : tip[i];
      const int depth = before < 0 ? 0 : work.depth[std::size_t(before)] + 1;
      work.depth[std::size_t(k)] = depth, work.row[std::size_t(k)] = int(path.size());
      for (int t = 0; t < depth; ++t) path.push_back(path[std::size_t(work.row[std::size_t(before)] + t)]);
      for (int t = depth; t < (depth + 4) / 4 * 4; ++t) path.push_back(k);
      for (std::size_t t = std::size_t(work.row[std::size_t(k)]); t < path.size(); ++t)
        work.last[std::size_t(path[t])] = k;
      tip[i] = k;
    }
  }
  work.factor.setZero(Eigen::Index(path.size())), work.factor_inverse.setZero(Eigen::Index(path.size()));
  work.square.setZero(rounded, rounded);
}

extern template class Data<float>;
extern template class Data<double>;

}  // namespace liecheck
