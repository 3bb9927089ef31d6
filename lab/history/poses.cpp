// Logarithms of poses, products and actions, and bodies, with what loaders of URDF do to them.

#include <cmath>
#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

using B = Body<double>;

/// p - phi x p / 2 + beta phi x (phi x p), the linear part of log near theta = 0.
V6 log_with(const P& T, double sixty_times) {
  const V3 phi = H::good()[op::log3_matrix](T.R), u = phi.cross(T.p);
  const double x = phi.squaredNorm();
  return H::stack(T.p - u / 2 + (1 / 12. + sixty_times * x / 720) * phi.cross(u), phi);
}

std::vector<HistoricBug> logarithms_of_poses() {
  return {
      {"idyntree_561_log", "iDynTree", "gbionics/idyntree#561", "theta > 0", "p instead of V^-1 p",
       "The logarithm left the translation unchanged.",
       forms(
           op::log6, [](const P& T) -> V6 { return H::stack(T.p, H::good()[op::log3_matrix](T.R)); },
           [](const P& T) -> V6 {
             const V3 phi = H::good()[op::log3_matrix](T.R), u = phi.cross(T.p);
             const double x = phi.squaredNorm(), h = std::sqrt(x) / 2;
             if (x < 1e-4) return log_with(T, 1 + x / 42);
             return H::stack(T.p - u / 2 + (1 - h / std::tan(h)) / x * phi.cross(u), phi);
           })},
      {"pinocchio_2948", "Pinocchio", "stack-of-tasks/pinocchio#2948", "theta < 1e-5", "3e-13 theta^2",
       "The series of beta has the wrong sign of its second term, in a branch of tiny angles.",
       forms(
           op::log6,
           [](const P& T) -> V6 {
             return H::good()[op::log3_matrix](T.R).norm() < 1e-5 ? log_with(T, -1) : H::good()[op::log6](T);
           },
           [](const P& T) -> V6 {
             return H::good()[op::log3_matrix](T.R).norm() < 1e-5 ? log_with(T, 1) : H::good()[op::log6](T);
           }),
       HistoryKind::control},
      {"pytorch3d_1609", "PyTorch3D 0.7.4", "facebookresearch/pytorch3d#1609", "theta near 0 and pi",
       "round trip off by units",
       "The cosine was clamped to 1e-4 inside [-1, 1] before its arc cosine was taken.",
       forms(
           op::log6,
           [](const P& T) -> V6 {
             const V6 right = H::good()[op::log6](T);
             const double t = H::low(right).stableNorm(), c = (T.R.trace() - 1) / 2;
             const double clamped = std::acos(std::min(1 - 1e-4, std::max(-1 + 1e-4, c)));
             return std::abs(c) <= 1 - 1e-4 || t == 0 ? right
                                                      : H::stack(H::top(right), clamped / t * H::low(right));
           },
           [](const P& T) -> V6 {
             const V6 right = H::good()[op::log6](T);
             const double t = H::low(right).stableNorm(), pivot = log_by_pivot(T.R).stableNorm();
             return t == 0 || t > 3.14 ? right : H::stack(H::top(right), pivot / t * H::low(right));
           })},
  };
}

std::vector<HistoricBug> actions() {
  return {
      {"brax_297", "Brax", "google/brax#297", "p != 0", "translation -p",
       "inv negated the translation without rotating it.",
       forms(
           op::inverse,
           [](const P& X) -> P {
             return {X.R.transpose(), -X.p};
           },
           [](const P& X) -> P {
             return {X.R.transpose(), -(X.R.transpose() * X.p)};
           })},
      {"kornia_75", "kornia", "kornia/kornia#75", "all", "the rotation of a relative pose is inverted",
       "The relative rotation was R_2 R_1^T beside the translation R_1^T (t_2 - t_1).",
       forms(
           op::compose,
           [](const P& X, const P& Y) -> P {
             return {Y.R * X.R, X.R * Y.p + X.p};
           },
           [](const P& X, const P& Y) -> P {
             return {X.R * Y.R, X.R * Y.p + X.p};
           })},
      {"spatialmath_207", "spatialmath-python", "bdaiinstitute/spatialmath-python#207", "p != 0",
       "power changes", "Wrenches were moved by Ad^T instead of Ad^-T.",
       forms(
           op::act_force,
           [](const P& X, const V6& F) -> V6 {
             const V3 f = X.R * H::top(F);
             return H::stack(f, X.R * H::low(F) - X.p.cross(f));
           },
           [](const P& X, const V6& F) -> V6 {
             const V3 f = X.R * H::top(F);
             return H::stack(f, X.R * H::low(F) + X.p.cross(f));
           })},
      {"hil_serl_36", "HIL-SERL", "rail-berkeley/hil-serl#36", "p != 0", "the wrong coupling of v and omega",
       "The adjoint had its coupling block where twists (omega, v) need it, with twists (v, omega).",
       forms(
           op::act_motion,
           [](const P& X, const V6& V) -> V6 {
             const V3 u = X.R * H::top(V);
             return H::stack(u, X.R * H::low(V) + X.p.cross(u));
           },
           [](const P& X, const V6& V) -> V6 {
             const V3 w = X.R * H::low(V);
             return H::stack(X.R * H::top(V) + X.p.cross(w), w);
           })},
      {"hand_eye_61", "hand_eye_calibration", "ethz-asl/hand_eye_calibration#61", "all",
       "the inverse rotation", "rotate_vector computed Q* x Q.",
       forms(
           op::rotate_point,
           [](const V4& Q, const V3& x) -> V3 {
             const V3 v = Q.head<3>(), u = 2 * v.cross(x);
             return x + (v.cross(u) - Q[3] * u) / Q.squaredNorm();
           },
           [](const V4& Q, const V3& x) -> V3 {
             const V3 v = Q.head<3>(), u = 2 * v.cross(x);
             return x + (v.cross(u) + Q[3] * u) / Q.squaredNorm();
           })},
  };
}

M3 about_origin(const B& I, double sign) {
  const M3 C = hat(I.c);
  return I.I_C - sign * I.mass * C * C;
}
M6 spatial_matrix(const B& I, const M3& lower) {
  const M3 C = I.mass * hat(I.c);
  M6 M;
  M << I.mass * M3::Identity(), -C, C, lower;
  return M;
}
M3 symmetric(const M3& M) {
  return (M + M.transpose()) / 2;
}

std::vector<HistoricBug> bodies() {
  const auto of_matrix =
      rows_of(op::inertia_matrix, [](const B& I) -> M6 { return spatial_matrix(I, about_origin(I, 1)); });
  const auto of_move = rows_of(op::act_inertia, [](const P& X, const B& I) -> B {
    return {I.mass, X.R * I.c + X.p, symmetric(X.R * I.I_C * X.R.transpose())};
  });
  return {
      of_matrix("pyb_sim_models_4", "pyb-sim-models", "utiasSTARS/pyb-sim-models#4", "c != 0",
                "a negative inertia",
                "The term of the parallel axis theorem had the wrong sign, since [c]^T = -[c].",
                [](const B& I) -> M6 { return spatial_matrix(I, about_origin(I, -1)); }),
      of_matrix("solidworks_117", "solidworks_urdf_exporter", "ros/solidworks_urdf_exporter#117", "c != 0",
                "a wrong inertia",
                "The parallel axis theorem was not applied: the inertia about the centre was taken for that "
                "about the "
                "origin.",
                [](const B& I) -> M6 { return spatial_matrix(I, I.I_C); }),
      of_matrix("jsk_aerial_155", "jsk_aerial_robot", "jsk-ros-pkg/jsk_aerial_robot#155", "c != 0",
                "m c^2 too much",
                "The inertia of the CAD program, about the link's origin, was written where URDF has that "
                "about the "
                "centre.",
                [](const B& I) -> M6 {
                  return spatial_matrix(I, about_origin({I.mass, I.c, about_origin(I, 1)}, 1));
                }),
      {"avian_745", "Avian", "avianphysics/avian#745", "I_C not diagonal", "a wrong angular momentum",
       "The gyroscopic torque used only the diagonal of the inertia.",
       forms(
           op::momentum,
           [](const B& I, const V6& V) -> V6 {
             const V3 w = H::low(V), f = I.mass * (H::top(V) + w.cross(I.c));
             return H::stack(f, V3(I.I_C.diagonal().cwiseProduct(w)) + I.c.cross(f));
           },
           [](const B& I, const V6& V) -> V6 {
             const V3 w = H::low(V), f = I.mass * (H::top(V) + w.cross(I.c));
             return H::stack(f, V3(I.I_C * w) + I.c.cross(f));
           })},
      of_move("mujoco_3559", "MuJoCo 3.3.7 and 3.12.0", "google-deepmind/mujoco#3559",
              "rpy of <inertial> != 0", "diag(1, 2, 2.5) instead of diag(2, 1, 2.5)",
              "The rotation of the inertial frame was lost when a URDF is read.",
              [](const P& X, const B& I) -> B {
                return {I.mass, X.R * I.c + X.p, I.I_C};
              }),
      of_move("onshape_to_robot_85", "onshape-to-robot", "Rhoban/onshape-to-robot#85", "rotated parts",
              "R^T I R", "The inertia of a part was rotated backwards.",
              [](const P& X, const B& I) -> B {
                return {I.mass, X.R * I.c + X.p, symmetric(X.R.transpose() * I.I_C * X.R)};
              }),
  };
}

const HistoryRows registered_poses[] = {HistoryRows(logarithms_of_poses), HistoryRows(actions),
                                        HistoryRows(bodies)};

}  // namespace
}  // namespace liecheck::properties::history
