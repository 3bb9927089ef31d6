#pragma once
// The error of an operation in a scalar of any width, by block, against the oracles' closed forms at 100 digits (334
// bits, held to 1e-98 of the exact value by tests/properties/enclosure_test.cpp): for scalars that the laws' own
// oracles, at 50 digits, cannot judge. Blocks and denominators are those of the laws, but a rotation matrix is
// measured by |R - R_exact| / sqrt 2, which is its angle and its defect from orthogonality together. The error of a
// scalar of 100 digits is how far two formulas of that width are apart.

#include <algorithm>
#include <oracles/closed_forms.hpp>
#include <oracles/error.hpp>
#include <oracles/log.hpp>
#include <oracles/spatial_formulas.hpp>
#include <timing/arguments.hpp>
#include <timing/cost.hpp>

namespace liecheck::properties {

template <class T>
class WideScore {
  using Wide = oracles::Real100;
  using List = std::vector<Wide>;

 public:
  /// eps: of T.
  WideScore(const Operations<T>& operations, double eps) : o_(operations), eps_(eps) {}

  /// Calls the operation on arguments that are doubles, which T holds exactly, and adds its errors.
  template <class Operation, class... A>
  void add(const Operation& operation, const A&... arguments) {
    compare(operation, o_[operation](arguments...), exact(arguments)...);
  }
  /// The same for inputs of a law.
  template <class Operation>
  void add_all(const Operation& operation, const Property<double>& law,
               const std::vector<std::vector<double>>& inputs) {
    const std::vector<Field> fields = law.fields();
    const FieldPositions positions(fields);
    for (const auto& x : inputs)
      std::apply([&](const auto&... argument) { add(operation, argument...); },
                 arguments_of(operation, positions, std::vector<T>(x.begin(), x.end())));
  }
  std::vector<BlockErrors> blocks;

 private:
  template <int N>
  static oracles::Vec<N, Wide> exact(const Vec<T, N>& v) {
    oracles::Vec<N, Wide> x;
    for (int i = 0; i < N; ++i) x[i] = wide(v[i]);
    return x;
  }
  static oracles::Mat3<Wide> exact(const Mat<T, 3>& m) {
    oracles::Mat3<Wide> x;
    for (int i = 0; i < 9; ++i) x(i / 3, i % 3) = wide(m(i / 3, i % 3));
    return x;
  }
  static oracles::PoseOf<Wide> exact(const Pose<T>& X) { return {exact(X.R), exact(X.p)}; }
  static oracles::BodyOf<Wide> exact(const Body<T>& I) { return {wide(I.mass), exact(I.c), exact(I.I_C)}; }
  template <int R, int C>
  static List list(const oracles::Mat<R, C, Wide>& m) {
    return {m.x.begin(), m.x.end()};
  }
  template <int N>
  static List list(const oracles::Vec<N, Wide>& v) {
    return {v.x.begin(), v.x.end()};
  }
  /// Row by row.
  template <class M>
  static List list(const Eigen::MatrixBase<M>& m) {
    List l;
    for (int i = 0; i < m.rows(); ++i)
      for (int j = 0; j < m.cols(); ++j) l.push_back(wide(T(m(i, j))));
    return l;
  }
  static Wide wide(const T& x) {
    if constexpr (requires { x._hi(); })  // QD's
      return Wide(x._hi()) + Wide(x._lo());
    else
      return oracles::exact<Wide>(x);
  }
  static Wide norm(const List& v) {
    Wide sum(0);
    for (const Wide& c : v) sum += c * c;
    return sqrt(sum);
  }
  static List minus(List a, const List& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
    return a;
  }
  static List slice(const List& v, std::size_t first, std::size_t n) {
    return List(v.begin() + static_cast<std::ptrdiff_t>(first),
                v.begin() + static_cast<std::ptrdiff_t>(first + n));
  }

  BlockErrors& block(const char* name) {
    const auto found =
        std::find_if(blocks.begin(), blocks.end(), [&](const BlockErrors& b) { return b.block == name; });
    return found != blocks.end() ? *found : blocks.emplace_back(BlockErrors{name, {}});
  }
  void add_distance(const char* name, const Wide& distance) {
    const auto error = static_cast<double>(Wide(distance / Wide(eps_)));
    if (std::isfinite(error))
      block(name).errors.push_back(error);
    else
      ++block(name).not_finite;
  }
  void relative(const char* name, const List& computed, const List& exact, const Wide& scale = Wide(0)) {
    const Wide size = std::max(norm(exact), scale), distance = norm(minus(computed, exact));
    add_distance(name, size > 0 ? Wide(distance / size) : distance);
  }
  void rotation(const List& Q, const oracles::Quaternion<Wide>& exact) {
    List unit = Q, other;
    const Wide n = norm(Q);
    for (Wide& c : unit) c /= n;
    for (const Wide& c : unit) other.push_back(-c);
    const List e = list(exact);
    add_distance("rotation", 2 * std::min(norm(minus(unit, e)), norm(minus(other, e))));
  }
  void rotation_of_matrix(const List& R, const oracles::Quaternion<Wide>& exact) {
    add_distance("rotation", norm(minus(R, list(oracles::rotation_matrix(exact)))) / sqrt(Wide(2)));
  }
  void log(const List& xi, const oracles::Vec6<Wide>& exact, const Wide& scale = Wide(0)) {
    relative("rotation vector", slice(xi, 3, 3), list(oracles::tail3(exact)));
    relative("linear", slice(xi, 0, 3), list(oracles::head3(exact)), scale);
  }
  template <class M>
  void jacobian6(const M& J, const oracles::Mat3<Wide>& diagonal, const oracles::Mat3<Wide>& coupling) {
    const auto part = [&](int i, int j) { return list(Mat<T, 3>(J.template block<3, 3>(3 * i, 3 * j))); };
    const Wide size = norm(list(diagonal));
    add_distance(
        "jacobian",
        std::max(norm(minus(part(0, 0), list(diagonal))), norm(minus(part(1, 1), list(diagonal)))) / size);
    relative("coupling", part(0, 1), list(coupling));
  }
  template <class M>
  void jacobian6(const M& J, const oracles::JacobianBlocks<Wide>& exact) {
    jacobian6(J, exact.J, exact.C);
  }
  /// J_l(xi), J_r(xi) = J_l(-xi), or their inverses, with that sign.
  static oracles::JacobianBlocks<Wide> jacobian(const oracles::Vec6<Wide>& xi, bool left, bool inverse) {
    const auto at = left ? xi : Wide(-1) * xi;
    return inverse ? oracles::closed_left_jacobian_inverse(at) : oracles::closed_left_jacobian(at);
  }

  using V3 = oracles::Vec3<Wide>;
  using V4 = oracles::Quaternion<Wide>;
  using V6 = oracles::Vec6<Wide>;
  using V7 = oracles::Vec7<Wide>;
  using M3 = oracles::Mat3<Wide>;
  using X = oracles::PoseOf<Wide>;
  using I = oracles::BodyOf<Wide>;
  template <const auto& operation>
  using As = const std::remove_cvref_t<decltype(operation)>&;
  static V3 zero() { return {{Wide(0), Wide(0), Wide(0)}}; }

  // exp and log
  void compare(As<op::exp3_quaternion>, const Vec<T, 4>& Q, const V3& phi) {
    rotation(list(Q), oracles::closed_exp(oracles::stack(zero(), phi)).Q);
  }
  void compare(As<op::exp3_matrix>, const Mat<T, 3>& R, const V3& phi) {
    rotation_of_matrix(list(R), oracles::closed_exp(oracles::stack(zero(), phi)).Q);
  }
  void compare(As<op::exp6>, const Pose<T>& Y, const V6& xi) {
    const auto exact = oracles::closed_exp(xi);
    rotation_of_matrix(list(Y.R), exact.Q);
    relative("translation", list(Y.p), list(exact.p));
  }
  void compare(As<op::log3_quaternion>, const Vec<T, 3>& phi, const V4& Q) {
    relative("rotation vector", list(phi), list(oracles::tail3(oracles::closed_log(Q, zero()))));
  }
  void compare(As<op::log3_matrix>, const Vec<T, 3>& phi, const M3& R) {
    const auto Q = oracles::nearest_quaternion(R).Q;
    relative("rotation vector", list(phi), list(oracles::tail3(oracles::closed_log(Q, zero()))));
  }
  void compare(As<op::log6>, const Vec<T, 6>& xi, const X& pose) {
    log(list(xi), oracles::closed_log(oracles::nearest_quaternion(pose.R).Q, pose.p));
  }

  // configurations
  void compare(As<op::integrate>, const Vec<T, 7>& q, const V7& q0, const V6& delta) {
    const auto exact = oracles::closed_integrate(q0, delta);
    const List computed = list(q), p0 = slice(list(q0), 0, 3), p = list(exact.p);
    rotation(slice(computed, 3, 4), exact.Q);
    relative("translation", slice(computed, 0, 3), p, std::max(norm(p0), norm(minus(p, p0))));
  }
  void compare(As<op::difference>, const Vec<T, 6>& delta, const V7& q0, const V7& q1) {
    log(list(delta), oracles::closed_difference(q0, q1),
        norm(minus(slice(list(q1), 0, 3), slice(list(q0), 0, 3))));
  }
  void compare(As<op::d_integrate_arg0>, const Mat<T, 6>& J, const V7&, const V6& delta) {
    const auto inverse = oracles::closed_exp(Wide(-1) * delta);
    const auto R = oracles::rotation_matrix(inverse.Q);
    jacobian6(J, R, oracles::hat(inverse.p) * R);
  }
  void compare(As<op::d_integrate_arg1>, const Mat<T, 6>& J, const V7&, const V6& delta) {
    jacobian6(J, jacobian(delta, false, false));
  }
  void compare(As<op::d_difference_arg0>, const Mat<T, 6>& J, const V7& q0, const V7& q1) {
    const auto exact = jacobian(oracles::closed_difference(q0, q1), true, true);
    jacobian6(J, Wide(-1) * exact.J, Wide(-1) * exact.C);
  }
  void compare(As<op::d_difference_arg1>, const Mat<T, 6>& J, const V7& q0, const V7& q1) {
    jacobian6(J, jacobian(oracles::closed_difference(q0, q1), false, true));
  }
  void compare(As<op::integrate_coefficient_jacobian>, const Mat<T, 7, 6>& J, const V7& q) {
    const V4 Q{{q[3], q[4], q[5], q[6]}};
    relative("translation matrix", list(Mat<T, 3>(J.template topLeftCorner<3, 3>())),
             list(oracles::rotation_matrix(Wide(1) / oracles::norm(Q) * Q)));
    List half;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j)
        half.push_back((i == 3   ? -q[3 + j]
                        : i == j ? q[6]
                                 : ((j - i + 3) % 3 == 1 ? -1 : 1) * q[6 - i - j]) /
                       2);
    relative("quaternion matrix", list(Mat<T, 4, 3>(J.template bottomRightCorner<4, 3>())), half);
  }

  // Jacobians of exp
  template <class J3>
  void three(const J3& J, const V3& phi, bool left, bool inverse) {
    relative("jacobian", list(J), list(jacobian(oracles::stack(zero(), phi), left, inverse).J));
  }
  void compare(As<op::left_jacobian3>, const Mat<T, 3>& J, const V3& phi) { three(J, phi, true, false); }
  void compare(As<op::right_jacobian3>, const Mat<T, 3>& J, const V3& phi) { three(J, phi, false, false); }
  void compare(As<op::left_jacobian3_inverse>, const Mat<T, 3>& J, const V3& phi) {
    three(J, phi, true, true);
  }
  void compare(As<op::right_jacobian3_inverse>, const Mat<T, 3>& J, const V3& phi) {
    three(J, phi, false, true);
  }
  void compare(As<op::left_jacobian6>, const Mat<T, 6>& J, const V6& xi) {
    jacobian6(J, jacobian(xi, true, false));
  }
  void compare(As<op::right_jacobian6>, const Mat<T, 6>& J, const V6& xi) {
    jacobian6(J, jacobian(xi, false, false));
  }
  void compare(As<op::left_jacobian6_inverse>, const Mat<T, 6>& J, const V6& xi) {
    jacobian6(J, jacobian(xi, true, true));
  }
  void compare(As<op::right_jacobian6_inverse>, const Mat<T, 6>& J, const V6& xi) {
    jacobian6(J, jacobian(xi, false, true));
  }

  // poses, motions and forces
  void compare(As<op::compose>, const Pose<T>& Z, const X& x, const X& y) {
    relative("matrix", list(Z.R), list(x.R * y.R));
    relative("translation", list(Z.p), list(x.R * y.p + x.p), std::max(norm(list(x.p)), norm(list(y.p))));
  }
  void compare(As<op::inverse>, const Pose<T>& Z, const X& x) {
    const M3 Rt = oracles::transpose(x.R);
    relative("matrix", list(Z.R), list(Rt));
    relative("translation", list(Z.p), list(Wide(-1) * (Rt * x.p)));
  }
  void compare(As<op::act_point>, const Vec<T, 3>& x_A, const X& x, const V3& p) {
    relative("point", list(x_A), list(x.R * p + x.p));
  }
  void compare(As<op::rotate_point>, const Vec<T, 3>& x_A, const V4& Q, const V3& p) {
    relative("point", list(x_A), list(oracles::rotate(Q, p)));
  }
  void six(const Vec<T, 6>& computed, const V6& exact) {
    const List all = list(computed), right = list(exact);
    relative("linear", slice(all, 0, 3), slice(right, 0, 3));
    relative("angular", slice(all, 3, 3), slice(right, 3, 3));
  }
  void compare(As<op::act_motion>, const Vec<T, 6>& y, const X& x, const V6& V) {
    six(y, oracles::formulas::act_motion(x, V));
  }
  void compare(As<op::act_inverse_motion>, const Vec<T, 6>& y, const X& x, const V6& V) {
    six(y, oracles::formulas::act_inverse_motion(x, V));
  }
  void compare(As<op::act_force>, const Vec<T, 6>& y, const X& x, const V6& F) {
    six(y, oracles::formulas::act_force(x, F));
  }
  void compare(As<op::act_inverse_force>, const Vec<T, 6>& y, const X& x, const V6& F) {
    six(y, oracles::formulas::act_inverse_force(x, F));
  }
  void compare(As<op::cross_motion>, const Vec<T, 6>& y, const V6& V, const V6& W) {
    six(y, oracles::formulas::cross_motion(V, W));
  }
  void compare(As<op::cross_force>, const Vec<T, 6>& y, const V6& V, const V6& F) {
    six(y, oracles::formulas::cross_force(V, F));
  }

  // inertias
  void body(const Body<T>& y, const Wide& mass, const V3& c, const M3& I_C) {
    relative("mass", {wide(y.mass)}, {mass});
    relative("lever", list(y.c), list(c));
    relative("inertia", list(y.I_C), list(I_C));
  }
  void compare(As<op::act_inertia>, const Body<T>& y, const X& x, const I& b) {
    body(y, b.mass, x.R * b.c + x.p, x.R * b.I_C * oracles::transpose(x.R));
  }
  void compare(As<op::act_inverse_inertia>, const Body<T>& y, const X& x, const I& b) {
    const M3 Rt = oracles::transpose(x.R);
    body(y, b.mass, Rt * (b.c - x.p), Rt * b.I_C * x.R);
  }
  void compare(As<op::momentum>, const Vec<T, 6>& h, const I& b, const V6& V) {
    six(h, oracles::formulas::momentum(b, V));
  }
  void compare(As<op::kinetic_energy>, const T& energy, const I& b, const V6& V) {
    relative("energy", {wide(energy)}, {oracles::formulas::kinetic_energy(b, V)});
  }
  void compare(As<op::inertia_matrix>, const Mat<T, 6>& M, const I& b) {
    const M3 lever = oracles::hat(b.c);
    M3 mass;
    for (int i = 0; i < 9; ++i) mass(i / 3, i % 3) = i % 4 == 0 ? b.mass : Wide(0);
    const M3 exact[2][2] = {{mass, Wide(-1) * (b.mass * lever)},
                            {b.mass * lever, b.I_C + Wide(-1) * (b.mass * (lever * lever))}};
    Wide worst(0);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const List right = list(exact[i][j]);
        const Wide distance = norm(minus(list(Mat<T, 3>(M.template block<3, 3>(3 * i, 3 * j))), right));
        worst = std::max(worst, distance > 0 ? Wide(distance / norm(right)) : distance);
      }
    add_distance("matrix", worst);
  }

  const Operations<T>& o_;
  double eps_;
};

}  // namespace liecheck::properties
