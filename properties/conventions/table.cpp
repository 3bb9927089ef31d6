#include <conventions/table.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <numbers>

namespace liecheck::properties::conventions {
namespace {

using Value = std::span<double>;
template <int R, int C>
using Rows = Eigen::Map<Eigen::Matrix<double, R, C, Eigen::RowMajor>>;

void exchange_halves(Value v) {
  std::rotate(v.begin(), v.begin() + std::ssize(v) / 2, v.end());
}
template <int R>
void exchange_columns(Value v) {
  Rows<R, 6> M(v.data());
  M = (Eigen::Matrix<double, R, 6>() << M.template rightCols<3>(), M.template leftCols<3>()).finished();
}
void negate(Value v) {
  for (double& x : v) x = -x;
}
template <int R, int C>
void from_columns(Value v) {
  const Eigen::Matrix<double, R, C> M = Eigen::Map<Eigen::Matrix<double, R, C>>(v.data());
  Rows<R, C>(v.data()) = M;
}

void column_by_column(Kind k, Value v) {
  if (k == Kind::rotation_matrix || k == Kind::jacobian3 || k == Kind::pose) from_columns<3, 3>(v);
  if (k == Kind::jacobian6 || k == Kind::inertia_matrix || k == Kind::covariance) from_columns<6, 6>(v);
  if (k == Kind::jacobian76) from_columns<7, 6>(v);
  if (k == Kind::jacobian9) from_columns<9, 9>(v);
  if (k == Kind::extended_pose) from_columns<3, 3>(v);
}
/// The three vectors of a tangent of SE_2(3), or the blocks of its Jacobian, so that number i of `order` comes from the i-th.
void in_order(Kind k, Value v, std::array<int, 3> order) {
  if (k != Kind::extended_tangent && k != Kind::jacobian9) return;
  const std::vector<double> own(v.begin(), v.end());
  const auto place = [&](std::size_t i) { return 3 * static_cast<std::size_t>(order[i / 3]) + i % 3; };
  for (std::size_t i = 0; i < 9; ++i) {
    if (k == Kind::extended_tangent)
      v[place(i)] = own[i];
    else
      for (std::size_t j = 0; j < 9; ++j) v[9 * place(i) + place(j)] = own[9 * i + j];
  }
}
void rotation_velocity_position(Kind k, Value v) {
  in_order(k, v, {2, 1, 0});
}
void position_rotation_velocity(Kind k, Value v) {
  in_order(k, v, {0, 2, 1});
}
void quaternion_first(Kind k, Value v) {
  if (k == Kind::configuration) std::rotate(v.begin(), v.begin() + 4, v.end());
  if (k == Kind::jacobian76) std::rotate(v.begin(), v.begin() + 24, v.end());
}
/// Calls change(numbers of a quaternion, or rows of its derivative).
template <class Change>
void in_quaternions(Kind k, Value v, Change change) {
  if (k == Kind::quaternion) change(v, 1);
  if (k == Kind::configuration) change(v.subspan(3), 1);
  if (k == Kind::jacobian76) change(v.subspan(18), 6);
}
void w_first(Kind k, Value v) {
  in_quaternions(k, v, [](Value Q, int each) { std::rotate(Q.begin(), Q.begin() + each, Q.end()); });
}
void conjugated(Kind k, Value v) {
  in_quaternions(k, v, [](Value Q, int each) { negate(Q.first(static_cast<std::size_t>(3 * each))); });
}
void twist_angular_first(Kind k, Value v) {
  if (k == Kind::tangent || k == Kind::twist) exchange_halves(v);
  if (k == Kind::inertia_matrix) exchange_columns<6>(v);
}
void wrench_moment_first(Kind k, Value v) {
  if (k == Kind::wrench || k == Kind::inertia_matrix) exchange_halves(v);
}
void jacobian_angular_first(Kind k, Value v) {
  if (k == Kind::jacobian6 || k == Kind::covariance) exchange_halves(v), exchange_columns<6>(v);
  if (k == Kind::jacobian76) exchange_columns<7>(v);
}
void matrix_passive(Kind k, Value v) {
  if (k == Kind::rotation_matrix) from_columns<3, 3>(v);
}
void pose_passive(Kind k, Value v) {
  if (k != Kind::pose) return;
  from_columns<3, 3>(v);
  Eigen::Map<Eigen::Vector3d> p(v.data() + 9);
  p = (-(Rows<3, 3>(v.data()) * p)).eval();
}
void degrees(Kind k, Value v) {
  const std::size_t angles = k == Kind::angle || k == Kind::planar_tangent || k == Kind::axis_angle ? 1
                             : k == Kind::rotation_vector || k == Kind::tangent || k == Kind::euler_angles
                                 ? 3
                                 : 0;
  for (double& x : v.last(angles)) x *= std::numbers::pi / 180;
}
void about_the_origin(Kind k, Value v) {
  if (k != Kind::body) return;
  const Eigen::Map<const Eigen::Vector3d> c(v.data() + 1);
  Rows<3, 3>(v.data() + 4) -= v[0] * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
}
void opposite(Kind k, Value v) {
  if (k == Kind::rotation_vector || k == Kind::tangent || k == Kind::parameters) negate(v);
  if (k == Kind::axis_angle) negate(v.first(3));
}

}  // namespace

const std::vector<Convention>& conventions() {
  static const std::vector<Convention> all = [] {
    const auto exact = [](const char* meaning, std::string_view advice, auto decode, Statement statement) {
      return Convention{meaning, advice, decode, nullptr, "", statement, true};
    };
    const auto rounds = [](const char* meaning, std::string_view advice, auto decode, Statement statement) {
      return Convention{meaning, advice, decode, nullptr, "", statement, false};
    };
    std::vector<Convention> list{
        exact("matrices are stored column by column", "store them row by row", column_by_column,
              {"matrix", "columns", "rows"}),
        exact("configurations are (Q, p)", "give p before Q", quaternion_first,
              {"configuration", "Q first", "p first"}),
        exact("quaternions are stored w x y z", "store them x y z w", w_first,
              {"quaternion", "wxyz", "xyzw"}),
        exact("twists are angular first", "exchange their halves: the linear part comes first",
              twist_angular_first, {"twist", "angular first", "linear first"}),
        exact("wrenches are moment first", "exchange their halves: the force comes before the moment",
              wrench_moment_first, {"wrench", "moment first", "force first"}),
        exact("Jacobians are angular first",
              "exchange the halves of their rows and columns: linear comes first", jacobian_angular_first,
              {"jacobian", "angular first", "linear first"}),
        exact("tangents of SE_2(3) are (phi, nu, rho)", "give position, velocity and rotation in this order",
              rotation_velocity_position,
              {"extended tangent", "rotation velocity position", "position velocity rotation"}),
        exact("tangents of SE_2(3) are (rho, phi, nu)", "give position, velocity and rotation in this order",
              position_rotation_velocity,
              {"extended tangent", "position rotation velocity", "position velocity rotation"}),
        rounds("angles are in degrees", "convert them to radians", degrees, {"angle", "degrees", "radians"}),
        rounds("inertias are about the origin of the body", "give I_C, about the centre of mass",
               about_the_origin, {"inertia", "origin", "centre of mass"}),
        exact("quaternions are those of the inverse rotations (passive)",
              "conjugate them: Q turns coordinates of B into coordinates of A", conjugated,
              {"quaternion sense", "passive", "active"}),
        exact("rotation matrices are those of the inverse rotations (passive)",
              "transpose them: R turns coordinates of B into coordinates of A", matrix_passive,
              {"rotation matrix", "passive", "active"}),
        rounds("poses are those of A in B (passive)",
               "invert them: X turns coordinates of B into coordinates of A", pose_passive,
               {"pose", "passive", "active"})};
    for (const Convention& c : function_conventions()) list.push_back(c);
    list.push_back({"rotation vectors and tangents have the opposite sign", "change their sign", opposite});
    for (std::size_t c = 0, n = list.size(); c < n; ++c)
      for (const Side side : {Side::arguments, Side::result})
        if (list[c].decode) {
          const char* const where =
              side == Side::result ? ", but only as results" : ", but only as arguments";
          list.push_back({list[c].meaning + where, list[c].advice, list[c].decode});
          list.back().side = side;
        }
    return list;
  }();
  return all;
}

}  // namespace liecheck::properties::conventions
