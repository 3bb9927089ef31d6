// Subjects "series:1" ... "series:12" in float and double: the textbook's formulas whose coefficients are Taylor's series
// with this number of terms, at every angle. `cost --curve` shows what each term costs and where it ends. They run only if
// they are named.
//
//     c_k(x) = sum_j (-x)^j/(2j + k)!,  x = theta^2: sines and their remainders (the Stumpff functions)
//     d(x) = (1 - theta/2 cot(theta/2))/x = (c_1(x/4) - c_0(x/4))/(x c_1(x/4)), by division of the power series
//     asin(s)/s = sum_j (2j)!/(4^j j!^2 (2j + 1)) s^(2j)
//
// Source: the coefficients of Sola, Deray and Atchuthan 2018 (arXiv 1812.01537), eq. 132-146, as power series.

#include <fmt/format.h>
#include <array>
#include <subjects/textbook.hpp>
#include <utility>
#include <vector>

namespace liecheck::properties {
namespace {

/// The first n numbers of a power series, from the lowest power.
template <std::size_t n>
using Terms = std::array<double, n>;

/// c_k(scale x).
template <std::size_t n>
constexpr Terms<n> stumpff(int k, double scale = 1) {
  Terms<n> c{};
  double term = 1;
  for (int i = 2; i <= k; ++i) term /= i;
  for (std::size_t j = 0; j < n; ++j) {
    c[j] = term;
    const double next = 2 * static_cast<double>(j) + k + 1;
    term *= -scale / (next * (next + 1));
  }
  return c;
}
template <std::size_t n>
constexpr Terms<n> inverse_jacobian() {
  const Terms<n + 1> c0 = stumpff<n + 1>(0, 0.25), c1 = stumpff<n + 1>(1, 0.25);
  Terms<n> d{};
  for (std::size_t j = 0; j < n; ++j) {
    d[j] = c1[j + 1] - c0[j + 1];
    for (std::size_t i = 1; i <= j; ++i) d[j] -= c1[i] * d[j - i];
  }
  return d;
}
template <std::size_t n>
constexpr Terms<n> inverse_sine() {
  Terms<n> a{};
  double term = 1;
  for (std::size_t j = 0; j < n; ++j) {
    const double i = static_cast<double>(j);
    a[j] = term / (2 * i + 1);
    term *= (2 * i + 1) / (2 * i + 2);
  }
  return a;
}

template <class S, std::size_t n>
struct Series : Types<S> {
  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::V6, typename Types<S>::M3,
      typename Types<S>::M6;

  /// The sum of the terms at x, by Horner's scheme.
  static S sum(const Terms<n>& terms, const S& x) {
    S value = static_cast<S>(terms[n - 1]);
    for (std::size_t j = n - 1; j-- > 0;) value = value * x + static_cast<S>(terms[j]);
    return value;
  }
  template <int k>
  static S c(const S& x) {
    static constexpr Terms<n> terms = stumpff<n>(k);
    return sum(terms, x);
  }

  static V4 exp3_quaternion(const V3& phi) {
    const S h = phi.squaredNorm() / S(4);
    V4 q;
    q << c<1>(h) / S(2) * phi, c<0>(h);
    return q;
  }
  static M3 exp3_matrix(const V3& phi) {
    const M3 P = hat(phi);
    const S x = phi.squaredNorm();
    return M3::Identity() + c<1>(x) * P + c<2>(x) * P * P;
  }
  static V3 log3_quaternion(const V4& Q) {
    static constexpr Terms<n> terms = inverse_sine<n>();
    const V3 v = Q[3] < S(0) ? V3(-Q.template head<3>()) : V3(Q.template head<3>());
    return S(2) * sum(terms, v.squaredNorm()) * v;
  }
  static M3 left_jacobian3(const V3& phi) {
    const M3 P = hat(phi);
    const S x = phi.squaredNorm();
    return M3::Identity() + c<2>(x) * P + c<3>(x) * P * P;
  }
  static M3 left_jacobian3_inverse(const V3& phi) {
    static constexpr Terms<n> terms = inverse_jacobian<n>();
    const M3 P = hat(phi);
    return M3::Identity() - P / S(2) + sum(terms, phi.squaredNorm()) * P * P;
  }
  static Pose<S> exp6(const V6& xi) {
    const V3 phi = xi.template tail<3>();
    return {exp3_matrix(phi), left_jacobian3(phi) * xi.template head<3>()};
  }
  /// Barfoot and Furgale 2014, eq. 102: its coefficients are c_3, c_4 and 3 c_5 - c_4.
  static M6 left_jacobian6(const V6& xi) {
    const V3 rho = xi.template head<3>(), phi = xi.template tail<3>();
    const M3 r = hat(rho), p = hat(phi);
    const S x = phi.squaredNorm(), b = c<4>(x), d = S(3) * c<5>(x) - b;
    M6 J = M6::Zero();
    J.template topLeftCorner<3, 3>() = J.template bottomRightCorner<3, 3>() = left_jacobian3(phi);
    J.template topRightCorner<3, 3>() = r / S(2) + c<3>(x) * (p * r + r * p + p * r * p) +
                                        b * (p * p * r + r * p * p - S(3) * p * r * p) -
                                        d / S(2) * (p * r * p * p + p * p * r * p);
    return J;
  }

  static TypedSubject<S> subject() {
    TypedSubject<S> s{fmt::format("series:{}", n), n == 1 ? "1 term" : fmt::format("{} terms", n), {}};
    auto& o = s.operations;
    o[op::exp3_quaternion] = exp3_quaternion;
    o[op::exp3_matrix] = exp3_matrix;
    o[op::log3_quaternion] = log3_quaternion;
    o[op::left_jacobian3] = left_jacobian3;
    o[op::left_jacobian3_inverse] = left_jacobian3_inverse;
    o[op::exp6] = exp6;
    o[op::left_jacobian6] = left_jacobian6;
    return s;
  }
};

template <class S, std::size_t... i>
std::vector<Registered<S>> of_each_length(std::index_sequence<i...>) {
  return {Registered<S>(Series<S, i + 1>::subject())...};
}
const auto in_float = of_each_length<float>(std::make_index_sequence<12>());
const auto in_double = of_each_length<double>(std::make_index_sequence<12>());

}  // namespace
}  // namespace liecheck::properties
