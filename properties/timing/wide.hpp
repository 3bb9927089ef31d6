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
#include <timing/cost.hpp>
#include <timing/operations.hpp>

namespace liecheck::properties {

template <class T>
class WideScore {
  using Wide = oracles::Real100;
  using List = std::vector<Wide>;

 public:
  /// eps: of T.
  WideScore(const Operations<T>& operations, double eps) : o_(operations), eps_(eps) {}

  /// x: the numbers of the operation's law, doubles that T holds exactly.
  void add(const std::string& operation, const std::vector<double>& x) {
    std::vector<T> t(x.begin(), x.end());
    for_each_cost_operation<T>([&](const char* name, const char*, auto member, auto arguments) {
      if (operation == name) compare(operation, std::apply(o_.*member, arguments(t)), x);
    });
  }
  std::vector<BlockErrors> blocks;

 private:
  template <int N>
  static oracles::Vec<N, Wide> numbers(const std::vector<double>& x, std::size_t first) {
    oracles::Vec<N, Wide> v;
    for (int i = 0; i < N; ++i) v[i] = Wide(x[first + static_cast<std::size_t>(i)]);
    return v;
  }
  static oracles::PoseOf<Wide> pose(const std::vector<double>& x, std::size_t first) {
    return {{numbers<9>(x, first).x}, numbers<3>(x, first + 9)};
  }
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
  /// J_l(xi), J_r(xi) = J_l(-xi), or their inverses, with that sign.
  static oracles::JacobianBlocks<Wide> jacobian(const oracles::Vec6<Wide>& xi, bool left, bool inverse) {
    const auto at = left ? xi : Wide(-1) * xi;
    return inverse ? oracles::closed_left_jacobian_inverse(at) : oracles::closed_left_jacobian(at);
  }

  template <int N>
  void compare(const std::string& op, const Vec<T, N>& y, const std::vector<double>& x) {
    const List computed = list(y);
    const auto none = oracles::Vec3<Wide>{{Wide(0), Wide(0), Wide(0)}};
    if (op == "exp3_quaternion") {
      rotation(computed, oracles::closed_exp(oracles::stack(none, numbers<3>(x, 3))).Q);
    } else if (op == "log3_quaternion") {
      relative("rotation vector", computed,
               list(oracles::tail3(oracles::closed_log(numbers<4>(x, 0), none))));
    } else if (op == "log3_matrix") {
      const auto Q = oracles::nearest_quaternion(pose(x, 4).R).Q;
      relative("rotation vector", computed, list(oracles::tail3(oracles::closed_log(Q, none))));
    } else if (op == "log6") {
      log(computed, oracles::closed_log(oracles::nearest_quaternion(pose(x, 4).R).Q, pose(x, 4).p));
    } else if (op == "integrate") {
      const auto q0 = numbers<7>(x, 0);
      const auto exact = oracles::closed_integrate(q0, numbers<6>(x, 14));
      const List p0 = slice(list(q0), 0, 3), p = list(exact.p);
      rotation(slice(computed, 3, 4), exact.Q);
      relative("translation", slice(computed, 0, 3), p, std::max(norm(p0), norm(minus(p, p0))));
    } else if (op == "difference") {
      const auto q0 = numbers<7>(x, 0), q1 = numbers<7>(x, 7);
      log(computed, oracles::closed_difference(q0, q1),
          norm(minus(slice(list(q1), 0, 3), slice(list(q0), 0, 3))));
    } else if (op == "act_point") {
      const auto X = pose(x, 0);
      relative("point", computed, list(X.R * numbers<3>(x, 21) + X.p));
    } else if (op == "rotate_point") {
      relative("point", computed, list(oracles::rotate(numbers<4>(x, 30), numbers<3>(x, 9))));
    } else if (op == "act_motion") {
      const List exact = list(oracles::formulas::act_motion(pose(x, 0), numbers<6>(x, 12)));
      relative("linear", slice(computed, 0, 3), slice(exact, 0, 3));
      relative("angular", slice(computed, 3, 3), slice(exact, 3, 3));
    }
  }
  void compare(const std::string& op, const Mat<T, 3>& y, const std::vector<double>& x) {
    const auto xi = oracles::stack(oracles::Vec3<Wide>{{Wide(0), Wide(0), Wide(0)}}, numbers<3>(x, 3));
    if (op == "exp3_matrix") return rotation_of_matrix(list(y), oracles::closed_exp(xi).Q);
    relative("jacobian", list(y), list(jacobian(xi, has(op, "left"), has(op, "inverse")).J));
  }
  void compare(const std::string& op, const Pose<T>& y, const std::vector<double>& x) {
    if (op == "exp6") {
      const auto exact = oracles::closed_exp(numbers<6>(x, 0));
      rotation_of_matrix(list(y.R), exact.Q);
      relative("translation", list(y.p), list(exact.p));
    } else if (op == "compose") {
      const auto X = pose(x, 0), Y = pose(x, 12);
      relative("matrix", list(y.R), list(X.R * Y.R));
      relative("translation", list(y.p), list(X.R * Y.p + X.p), std::max(norm(list(X.p)), norm(list(Y.p))));
    } else {
      const auto X = pose(x, 0), Rt = oracles::PoseOf<Wide>{oracles::transpose(X.R), X.p};
      relative("matrix", list(y.R), list(Rt.R));
      relative("translation", list(y.p), list(Wide(-1) * (Rt.R * X.p)));
    }
  }
  void compare(const std::string& op, const Mat<T, 6>& y, const std::vector<double>& x) {
    if (op == "d_integrate_arg0") {
      const auto inverse = oracles::closed_exp(Wide(-1) * numbers<6>(x, 14));
      const auto R = oracles::rotation_matrix(inverse.Q);
      return jacobian6(y, R, oracles::hat(inverse.p) * R);
    }
    if (op.rfind("d_difference", 0) == 0) {
      const auto delta = oracles::closed_difference(numbers<7>(x, 0), numbers<7>(x, 7));
      const bool first = has(op, "arg0");
      const auto exact = jacobian(delta, first, true);
      const Wide sign(first ? -1 : 1);
      return jacobian6(y, sign * exact.J, sign * exact.C);
    }
    const auto exact = op == "d_integrate_arg1"
                           ? jacobian(numbers<6>(x, 14), false, false)
                           : jacobian(numbers<6>(x, 0), has(op, "left"), has(op, "inverse"));
    jacobian6(y, exact.J, exact.C);
  }
  static bool has(const std::string& text, const char* part) { return text.find(part) != text.npos; }

  const Operations<T>& o_;
  double eps_;
};

}  // namespace liecheck::properties
