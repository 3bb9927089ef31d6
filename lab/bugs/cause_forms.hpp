#pragma once
// Faulty forms of operations in double, each with the cause that a finding should name.

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <string>
#include <subjects/subject.hpp>
#include <vector>

namespace liecheck::properties {

using V3 = Vec<double, 3>;
using V4 = Vec<double, 4>;
using M3 = Mat<double, 3>;

/// A class of causes: what a guess says that names it, and what one says that names its kind.
struct Cause {
  const char *name, *right, *near;
};
inline constexpr Cause cutoff{"series lacks a term", "series below it lacks a term|formulas grow",
                              "cutoff|threshold"},
    coefficient{"wrong coefficient of a series", "has a wrong one", "cutoff|threshold"},
    cancels{"closed form cancels", "closed form cancels|formula cancels|1 - cos\\(theta\\) cancels",
            "cutoff|cancel"},
    acos_one{"acos near 1", "acos near 1|acos of a number|asin or acos|asin of a number", "acos|cancels"},
    sin_pi{"sin near pi", "sin near pi|1 \\+ cos", "near pi"},
    trace{"1 + trace", "sin near pi|1 \\+ cos|trace", "near pi"},
    sign_of_w{"w < 0 only", "w < 0|sign of w", "w"},
    interpolated{"linear interpolation", "linear interpolation", "threshold"},
    opposite_vectors{"threshold near pi", "threshold at pi|threshold between pi|1 \\+ cos",
                     "near pi|opposite"},
    at_lock{"threshold at gimbal lock", "a threshold: less|another formula at gimbal lock", "asin"},
    zero{"0 where it is not", "result is 0|result is that of theta = 0", "threshold|cutoff"},
    single{"float inside double", "too few digits|rounded to float", "constant"},
    transposed{"transposed, or the inverse",
               "transposed|inverse|passive|column|opposite sign|order of frames|sign, or|"
               "conjugate|A in B|reversed|left|other side|change its sign",
               "wrong term"},
    swapped{"swapped or wrong component", "wrong term, factor or sign|in place of -R|right but for",
            "convention"},
    other_formula{"another formula", "longer way|relative pose in place|on one half of the circle",
                  "wrong term"},
    overflow{"theta^2 underflows or overflows", "underflows|overflows|0/0", "NaN"},
    nothing{"no nameable cause", "^$", "a wrong term"};

struct Form {
  std::string name;
  Cause cause;
  double threshold;
  std::function<void(Operations&)> plant;
};

inline const Operations& right() {
  static const Operations all = [] {
    for (const Subject* s : subjects(oracles::scalar_of<double>))
      if (s->name == "liecheck") return s->operations;
    return Operations();
  }();
  return all;
}
inline M3 hat(const V3& v) {
  M3 K;
  K << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return K;
}
inline V3 vee(const M3& M) {
  return {M(2, 1), M(0, 2), M(1, 0)};
}
inline V4 quaternion(const V3& v, double w) {
  return {v[0], v[1], v[2], w};
}
inline V3 vector(const V4& Q) {
  return Q.head<3>();
}

class CauseForms {
 public:
  std::vector<Form> all;

  /// A function that replaces that of liecheck where `where(arguments)`.
  template <class O, class Where, class F>
  void add(const std::string& name, const Cause& cause, double threshold, const O& operation, Where where,
           F faulty) {
    all.push_back(
        {fmt::format("{}_{}{}", name, operation.name, threshold > 0 ? fmt::format("_{:.0e}", threshold) : ""),
         cause, threshold, [&operation, where, faulty](Operations& o) {
           o[operation] = [&operation, where, faulty](const auto&... x) {
             auto result = right()[operation](x...);
             if (where(x...)) result = faulty(result, x...);
             return result;
           };
         }});
  }
};

inline double theta_of(const V3& phi) {
  return phi.norm();
}
inline double theta_of(const V4& Q) {
  return 2 * std::atan2(Q.head<3>().norm(), std::fabs(Q[3]));
}
inline double theta_of(const M3& R) {
  return std::atan2(vee(R - R.transpose()).norm(), R.trace() - 1);
}
inline constexpr auto always = [](const auto&...) { return true; };
inline auto below(double x) {
  return [x](const auto& argument) { return theta_of(argument) < x; };
}

/// CauseForms as public libraries have them: cutoffs, thresholds and closed forms.
void add_styles(CauseForms& f);

}  // namespace liecheck::properties
