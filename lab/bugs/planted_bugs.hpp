#pragma once
// A known bug consists of liecheck's operations, some of which are replaced by a faulty function. Class Bugs
// has helpers for these functions. The bugs are in rotation_bugs.cpp, configuration_bugs.cpp,
// spatial_algebra_bugs.cpp and tree_bugs.cpp, the look-alikes in look_alikes.cpp.

#include <Eigen/Geometry>
#include <functional>
#include <subjects/tree.hpp>

namespace liecheck::properties {

template <class S>
struct Bugs : Types<S> {
  using O = TypedOperations<S>;
  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::V6, typename Types<S>::V7,
      typename Types<S>::M3, typename Types<S>::M6;
  using M76 = Mat<S, 7, 6>;
  using B = Body<S>;
  using P = Pose<S>;
  using X = VecX<S>;
  using M = MatX<S>;
  using T = Tree<S>;
  using TO = TreeOperations<S>;

  struct Entry {
    const char *name, *fault, *origin;
    std::function<void(O&)> plant;

    Entry(const char* name, const char* fault, const char* origin, std::function<void(O&)> plant)
        : name(name), fault(fault), origin(origin), plant(std::move(plant)) {}
    /// Replaces the function of one operation.
    template <class Operation>
    Entry(const char* name, const char* fault, const char* origin, const Operation& operation,
          typename Operation::template Function<S> faulty)
        : Entry(name, fault, origin, [&operation, faulty](O& o) { o[operation] = faulty; }) {}
  };
  using Entries = std::vector<Entry>;

  static Entries exp_of_rotations();
  static Entries log_of_rotations();
  static Entries exp_and_log_of_poses();
  static Entries jacobians();
  static Entries integration();
  static Entries differences();
  static Entries configuration_derivatives();
  static Entries robots();
  static Entries points_motions_and_forces();
  static Entries inertias();
  static Entries dynamics_of_trees();
  static Entries frames_of_trees();
  static Entries relative_rotations();
  static Entries euler_angles();
  static Entries rates_and_planar_poses();
  static Entries representations();
  static Entries transforms_and_means();
  static Entries navigation();
  static Entries derivatives_of_trees();
  static Entries look_alikes_of_rotations();
  static Entries look_alikes_of_poses_and_bodies();

  /// The correct operations, which the replacements call. known_bugs() sets them.
  static O& good() {
    static O operations;
    return operations;
  }

  /// Plants a function that changes the correct result by change(result, arguments...).
  template <const auto& operation, class Change>
  static std::function<void(O&)> changed(Change) {
    return [](O& o) { plant<operation, Change>(o[operation]); };
  }
  template <const auto& operation, class Change, class R, class... A>
  static void plant(R (*&slot)(A...)) {
    slot = [](A... a) -> R {
      R result = good()[operation](a...);
      Change()(result, a...);
      return result;
    };
  }

  static V3 top(const V6& v) { return v.template head<3>(); }
  static V3 low(const V6& v) { return v.template tail<3>(); }
  static V6 stack(const V3& a, const V3& b) {
    V6 v;
    v << a, b;
    return v;
  }
  static V4 multiply(const V4& a, const V4& b) {
    V4 q;
    q << a[3] * b.template head<3>() + b[3] * a.template head<3>() +
             V3(a.template head<3>()).cross(V3(b.template head<3>())),
        a[3] * b[3] - a.template head<3>().dot(b.template head<3>());
    return q;
  }
  static V4 conjugate(const V4& q) { return {-q[0], -q[1], -q[2], q[3]}; }
  static V4 rotation_of(const V7& q) { return q.template tail<4>(); }
  static V7 moved(const V7& q, const V3& p, const V4& Q) {
    V7 r;
    r << q.template head<3>() + p, Q;
    return r;
  }
  /// The matrix [[J, C], [0, J]].
  static M6 blocks(const M3& J, const M3& C) {
    M6 m = M6::Zero();
    m.template topLeftCorner<3, 3>() = m.template bottomRightCorner<3, 3>() = J;
    m.template topRightCorner<3, 3>() = C;
    return m;
  }
  static P pose_exp(const V6& xi, M3 V) { return {good()[op::exp3_matrix](low(xi)), V * top(xi)}; }
  static S angle(const V3& phi) { return phi.norm(); }
  static V3 narrow(const Vec<long double, 3>& v) { return v.template cast<S>(); }
};

}  // namespace liecheck::properties
