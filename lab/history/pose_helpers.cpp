// Adjoint matrices, covariances, screws, means, and what lies between poses and directions.

#include <cmath>
#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

M6 adjoint_of(const P& X) {
  return H::blocks(X.R, hat<double>(X.p) * X.R);
}
M6 transported(const M6& Ad, const M6& Sigma) {
  M6 S = Ad * Sigma * Ad.transpose();
  return (S + M6(S.transpose())) / 2;
}
M6 only_turned(const M3& R) {
  return H::blocks(R, M3::Zero());
}

std::vector<HistoricBug> adjoints() {
  const auto covariance = rows_of(op::transport_covariance, [](const P& X, const M6& Sigma) -> M6 {
    return transported(adjoint_of(X), Sigma);
  });
  return {
      {"eeros_68", "EEROS", "eeros-project/eeros-framework#68", "p != 0", "a wrong upper right block",
       "The rows of R were taken in place of its columns.",
       forms(
           op::adjoint, [](const P& X) -> M6 { return H::blocks(X.R, hat<double>(X.p) * X.R.transpose()); },
           adjoint_of)},
      {"manif_114", "manif before 2019-09", "artivis/manif#114", "u != 0", "not the bracket",
       "The block of the linear velocity stood where it belongs in the order of angular first.",
       forms(
           op::small_adjoint,
           [](const V6& V) -> M6 {
             return H::blocks(hat<double>(H::low(V)), hat<double>(H::top(V))).transpose();
           },
           [](const V6& V) -> M6 { return H::blocks(hat<double>(H::low(V)), hat<double>(H::top(V))); })},
      covariance("mavros_1998", "MAVROS", "mavlink/mavros#1998", "all", "not symmetric",
                 "The covariance was rotated on one side only.",
                 [](const P& X, const M6& Sigma) -> M6 { return Sigma * only_turned(X.R); }),
      covariance("geometry2_431", "tf2_geometry_msgs", "ros2/geometry2#431", "all", "the input",
                 "The covariance was copied without being rotated.",
                 [](const P&, const M6& Sigma) -> M6 { return Sigma; }),
      covariance("nv_liom_6", "nv_liom", "dhchung/nv_liom#6", "all", "another frame",
                 "The rotation was multiplied transposed.",
                 [](const P& X, const M6& Sigma) -> M6 {
                   return transported(H::blocks(X.R.transpose(), X.R.transpose() * hat<double>(X.p)), Sigma);
                 }),
      covariance("colmap_3155", "COLMAP", "colmap/colmap#3155", "all", "that of the inverse",
                 "The adjoint stood in place of its inverse.",
                 [](const P& X, const M6& Sigma) -> M6 {
                   return transported(H::blocks(X.R.transpose(), -X.R.transpose() * hat<double>(X.p)), Sigma);
                 }),
  };
}

V7 screw(const V6& V) {
  const V3 u = H::top(V), w = H::low(V);
  const double n = w.norm();
  return (V7() << w / n, u.dot(w) / n / n, w.cross(u) / n / n).finished();
}
std::vector<HistoricBug> screws() {
  const auto row = rows_of(op::screw_parameters, screw);
  return {
      row("spatialmath_61", "spatialmath-python", "bdaiinstitute/spatialmath-python#61", "|omega| != 1",
          "a wrong pitch", "The pitch was omega . u, without a division by |omega|^2.",
          [](const V6& V) -> V7 {
            V7 s = screw(V);
            s[3] = H::top(V).dot(H::low(V));
            return s;
          }),
      row("rvc3_2", "RVC3-MATLAB", "petercorke/RVC3-MATLAB#2", "all", "axis and moment exchanged",
          "The two vectors of the line were exchanged.",
          [](const V6& V) -> V7 {
            V7 s = screw(V);
            if (!H::top(V).isZero(0)) s.head<3>() = H::top(V).normalized();
            return s;
          }),
  };
}

V4 mean_of(const V4& a, const V4& b, const V4& c, const V3& w) {
  Eigen::Matrix4d M = w[0] * a * a.transpose() + w[1] * b * b.transpose() + w[2] * c * c.transpose();
  for (int i = 0; i < 60; ++i) M = (M * M / (M * M).trace()).eval();
  int k = 0;
  M.diagonal().maxCoeff(&k);
  return M.col(k).normalized();
}
std::vector<HistoricBug> means() {
  const auto row = rows_of(op::mean_rotation, mean_of);
  return {
      row("opencv_contrib_2553", "OpenCV contrib", "opencv/opencv_contrib#2553", "all", "not of length 1",
          "The weighted sum was divided by the sum of the weights and not normalised.",
          [](const V4& a, const V4& b, const V4& c, const V3& w) -> V4 {
            const auto near = [&](const V4& q) -> V4 { return q.dot(a) < 0 ? V4(-q) : q; };
            return (w[0] * a + w[1] * near(b) + w[2] * near(c)) / w.sum();
          }),
      row("mne_4895", "MNE-Python", "mne-tools/mne-python#4895", "Q and -Q", "cancelled",
          "Quaternions were summed whatever their signs.",
          [](const V4& a, const V4& b, const V4& c, const V3& w) -> V4 {
            return (w[0] * a + w[1] * b + w[2] * c).normalized();
          }),
      row("nalgebra_1430", "nalgebra", "dimforge/nalgebra#1430", "all", "permuted numbers",
          "The eigenvector x y z w was read as w x y z.",
          [](const V4& a, const V4& b, const V4& c, const V3& w) -> V4 {
            const V4 e = mean_of(a, b, c, w);
            return {e[1], e[2], e[3], e[0]};
          }),
  };
}

V3 between(const V3& a, const V3& b, const double& t) {
  const double theta = 2 * std::atan2((a - b).norm(), (a + b).norm());
  const V3 d = a.dot(b) > 0 ? V3(b - a) : V3(b + a);
  V3 n = d - a.dot(d) * a;
  if (!(n.norm() > 0)) return (1 - t) * a + t * b;
  n.normalize();
  n = (n - a.dot(n) * a).normalized();
  return std::cos(t * theta) * a + std::sin(t * theta) * n;
}
double kahan(const V3& a, const V3& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}

std::vector<HistoricBug> between_directions() {
  const auto slerp = rows_of(op::slerp_directions, between);
  const auto angle = rows_of(op::angle_between, kahan);
  return {
      slerp("gl_matrix_500", "gl-matrix", "toji/gl-matrix#500", "parallel vectors", "NaN",
            "The weights were divided by the sine of the angle, which is 0.",
            [](const V3& a, const V3& b, const double& t) -> V3 {
              const double theta = std::acos(std::clamp(a.dot(b), -1., 1.)), s = std::sin(theta);
              return std::sin((1 - t) * theta) / s * a + std::sin(t * theta) / s * b;
            }),
      slerp("glm_1423", "GLM", "g-truc/glm#1423", "parallel vectors", "NaN",
            "The acos of a dot product above 1 was not guarded.",
            [](const V3& a, const V3& b, const double& t) -> V3 {
              const double theta = std::acos(a.dot(b)), s = std::sin(theta);
              return std::sin((1 - t) * theta) / s * a + std::sin(t * theta) / s * b;
            }),
      slerp("godot_27825", "Godot 3.1", "godotengine/godot#27825", "all", "a vector off the arc",
            "The axis a x b was not normalised.",
            [](const V3& a, const V3& b, const double& t) -> V3 {
              const V3 c = a.cross(b);
              const double at = t * kahan(a, b);
              return std::cos(at) * a + std::sin(at) * c.cross(a);
            }),
      angle("gl_matrix_230", "gl-matrix", "toji/gl-matrix#230", "opposite vectors", "NaN",
            "The cosine was cut off above 1 and not below -1.",
            [](const V3& a, const V3& b) -> double {
              const double c = a.dot(b);
              return c > 1 ? 0 : std::acos(c);
            }),
      angle("glm_145", "GLM", "g-truc/glm#145", "parallel vectors", "NaN",
            "The acos of a dot product above 1.",
            [](const V3& a, const V3& b) -> double { return std::acos(a.dot(b)); }),
      angle("godot_8111", "Godot 3.0", "godotengine/godot#8111", "parallel vectors", "NaN",
            "The cosine was divided by the root of a product of squares, and not cut off.",
            [](const V3& a, const V3& b) -> double {
              return std::acos(a.dot(b) / std::sqrt(a.squaredNorm() * b.squaredNorm()));
            }),
      angle("mathnet_13", "Math.NET Spatial", "mathnet/mathnet-spatial#13", "a vector and itself", "NaN",
            "The dot product of two normalised vectors exceeds 1 by rounding.",
            [](const V3& a, const V3& b) -> double { return std::acos(a.normalized().dot(b.normalized())); }),
      angle("pytransform3d_47", "pytransform3d", "dfki-ric/pytransform3d#47", "parallel vectors",
            "half of the digits lost", "The cosine was cut off, and its acos is flat at 1.",
            [](const V3& a, const V3& b) -> double {
              return std::acos(std::clamp(a.dot(b) / (a.norm() * b.norm()), -1., 1.));
            }),
  };
}

const HistoryRows adjoint_rows(adjoints), screw_rows(screws), mean_rows(means),
    direction_rows(between_directions);

}  // namespace
}  // namespace liecheck::properties::history
