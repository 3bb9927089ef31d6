#include <oracles/scalar_coefficients.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace liecheck::oracles {
namespace {

using Long = long double;
static_assert(std::numeric_limits<Long>::digits >= 64);
using Quad = __float128;
using Terms = std::vector<Quad>;

constexpr int term_count = 30;  // 10^30 / 60! < 2^-170
constexpr Long domain = 10;     // pi^2 < 10

/// The coefficients (-scale)^j weight(j).
template <class Weight>
Terms alternating(Quad scale, Weight weight) {
  Terms all;
  Quad power = 1;
  for (int j = 0; j < term_count; ++j, power *= -scale) all.push_back(power * weight(j));
  return all;
}
Quad reciprocal_factorial(int n) {
  Quad r = 1;
  for (int i = 2; i <= n; ++i) r /= i;
  return r;
}
Terms product(const Terms& a, const Terms& b) {
  Terms c(term_count, Quad(0));
  for (int i = 0; i < term_count; ++i)
    for (int j = 0; i + j < term_count; ++j) c[i + j] += a[i] * b[j];
  return c;
}
Terms derivative(const Terms& a) {
  Terms d(term_count, Quad(0));
  for (int j = 1; j < term_count; ++j) d[j - 1] = a[j] * j;
  return d;
}
Terms combined(Quad p, const Terms& a, Quad q, const Terms& b) {
  Terms c(term_count);
  for (int j = 0; j < term_count; ++j) c[j] = p * a[j] + q * b[j];
  return c;
}

/// A third-order Taylor polynomial about a point, and a bound of its error.
struct Cubic {
  std::array<Long, 4> t;
  Long error;  ///< of truncation and rounding, on the interval
  Long least(Long w) const { return std::fabs(t[0]) - sum(w) + std::fabs(t[0]) - error; }
  Long sum(Long w) const {
    return std::fabs(t[0]) + w * (std::fabs(t[1]) + w * (std::fabs(t[2]) + w * std::fabs(t[3])));
  }
};

/// A power series on [0, 10].
class Series {
 public:
  explicit Series(const Terms& terms) {
    Long power = 1, wide = 1;
    for (int j = 0; j < term_count; ++j, wide *= domain + 1) {
      a_[j] = static_cast<Long>(terms[j]);
      size_ += std::fabs(a_[j]) * wide;
      if (j < 4) continue;
      fourth_ += static_cast<Long>(j * (j - 1) * (j - 2) * (j - 3) / 24) * std::fabs(a_[j]) * power;
      power *= domain;
    }
  }
  /// The Taylor coefficients about m, t[n] = sum_j C(j, n) a_j m^(j - n). For |x - m| <= w <= 1, the
  /// roundings of a_j and of Horner's scheme change the cubic by at most 64 * 2^-64 sum_j |a_j| (m + w)^j.
  Cubic about(Long m, Long w) const {
    Cubic c{{0, 0, 0, 0}, 0};
    for (int j = term_count; j-- > 0;) {  // Horner's scheme for the value and the derivatives / n!
      for (int n = 3; n > 0; --n) c.t[n] = c.t[n] * m + c.t[n - 1];
      c.t[0] = c.t[0] * m + a_[j];
    }
    c.error = fourth_ * w * w * w * w + 0x1p-58L * size_;
    return c;
  }

 private:
  std::array<Long, term_count> a_;
  Long size_ = 0, fourth_ = 0;
};

struct Quotient {
  Series a, b;
};

std::vector<Quotient> quotients() {
  const auto stumpff = [](int k) {
    return alternating(1, [k](int j) { return reciprocal_factorial(2 * j + k); });
  };
  const Quad quarter = Quad(1) / 4;
  const Terms one = alternating(0, [](int) { return Quad(1); });
  const Terms N = alternating(
      quarter, [](int j) { return reciprocal_factorial(2 * j + 2) - reciprocal_factorial(2 * j + 3); });
  const Terms D = alternating(quarter, [](int j) { return reciprocal_factorial(2 * j + 1); });
  const Terms cosine = alternating(quarter, [](int j) { return reciprocal_factorial(2 * j); });
  const auto over = [](const Terms& a, const Terms& b) { return Quotient{Series(a), Series(b)}; };
  std::vector<Quotient> all;
  for (int k = 0; k <= 5; ++k) all.push_back(over(stumpff(k), one));
  all.push_back(over(combined(1, stumpff(3), -2, stumpff(4)), one));
  all.push_back(over(combined(1, stumpff(4), -3, stumpff(5)), one));
  all.push_back(over(N, combined(4, D, 0, D)));
  all.push_back(over(combined(1, product(derivative(N), D), -1, product(N, derivative(D))),
                     combined(2, product(D, D), 0, D)));
  all.push_back(over(combined(quarter * 2, D, 0, D), one));
  all.push_back(over(cosine, one));
  return all;
}

/// The Taylor cubic of G (scalar_coefficients.hpp) about m, with a bound of its error for |t - m| <= w.
Cubic arctangent(Long m, Long w) {
  const Long end = m + w;
  if (end < 0x1p-20L)  // 1 - t/3 + t^2/5 - t^3/7, expanded about m; truncation error < t^4 / 9
    return {{1 - m * (1 / 3.0L - m * (1 / 5.0L - m / 7)), -1 / 3.0L + m * (2 / 5.0L - m * 3 / 7),
             1 / 5.0L - m * 3 / 7, -1 / 7.0L},
            end * end * end * end / 9 + 0x1p-61L};
  const Long s = std::sqrt(m), q = 2 * w / m;
  Cubic c{{std::atan(s) / s, 0, 0, 0}, 0};
  Long h = 1 / (1 + m);
  for (int n = 0; n < 3; ++n, h /= -(1 + m))
    c.t[n + 1] = (h - static_cast<Long>(2 * n + 1) * c.t[n]) / (static_cast<Long>(2 * (n + 1)) * m);
  // glibc's atanl has an error of one ulp. At small m the recursion for t[n] loses digits, but t[n] is
  // multiplied by (t - m)^n, and |t - m| <= w < m / 4.
  c.error = q >= 0.5L ? std::numeric_limits<Long>::infinity()
                      : c.t[0] * (1.4143L * q * q * q * q / (1 - q) + 0x1p-58L);
  return c;
}

}  // namespace

double LocalExpansion::condition(double half_width, bool absolute) const {
  const double w = half_width;
  const double slope = std::fabs(p[1]) + w * (2 * std::fabs(p[2]) + w * 3 * std::fabs(p[3]));
  const double least = std::fabs(p[0]) - w * slope;
  return (centre + w) * slope / (absolute ? 1 : least);
}

LocalExpansion expand(Coefficient which, double low, double high) {
  static const std::vector<Quotient> table = quotients();
  const double centre = (low + high) / 2;
  const Long m = centre, w = static_cast<Long>(high) - m;
  Cubic a, b{{1, 0, 0, 0}, 0};
  if (which == Coefficient::angle_over_sine || which == Coefficient::alpha) {
    a = arctangent(m, w);
    if (which == Coefficient::angle_over_sine) b.t[0] = 0.5L;
  } else {
    const Quotient& f = table.at(static_cast<std::size_t>(which));
    a = f.a.about(m, w);
    b = f.b.about(m, w);
  }
  // The terms with 2^-49 bound at most sixteen roundings in double: of the coefficients p, of Horner's
  // scheme, and of f p(u) - 1, which the caller computes.
  LocalExpansion e{centre, 0, {}};
  if (is_absolute(which)) {  // then B = 1
    for (int n = 0; n < 4; ++n) e.p[n] = static_cast<double>(a.t[n]);
    e.bound = static_cast<double>((a.error + 0x1p-49L * a.sum(w)) * (1 + 0x1p-40L));
    return e;
  }
  Cubic r{{0, 0, 0, 0}, 0};
  for (int n = 0; n < 4; ++n) {
    r.t[n] = b.t[n];
    for (int i = 0; i < n; ++i) r.t[n] -= r.t[i] * a.t[n - i];
    r.t[n] /= a.t[0];
    e.p[n] = static_cast<double>(r.t[n]);
  }
  // |r A - B| has the terms of degree 4 to 6, the errors of A and B, and the roundings of the division.
  const Long size = r.sum(w);
  Long residual = size * (a.error + 0x1p-60L * a.sum(w)) + b.error, power = w * w * w * w;
  for (int n = 4; n <= 6; ++n, power *= w) {
    Long order = 0;
    for (int i = n - 3; i <= 3; ++i) order += r.t[i] * a.t[n - i];
    residual += std::fabs(order) * power;
  }
  const Long least = b.least(w);
  e.bound =
      least > 0
          ? static_cast<double>((residual / least + 0x1p-49L * size / std::fabs(r.t[0])) * (1 + 0x1p-40L))
          : std::numeric_limits<double>::infinity();
  return e;
}

}  // namespace liecheck::oracles
