// Not a library: the forms that the findings of the league propose, in float and double.

#include <liecheck_adapter.hpp>
#include <map>

#include "numbers.hpp"
#include "repaired_forms.hpp"
#include "repaired_text.hpp"

namespace {

/// The program of a form: its text, and a call that prints its result.
std::string program(const std::string& name, int results, const std::string& place) {
  const std::string text = repaired_text, heading = "\n// " + name + "\n";
  const auto from = text.find(heading) + heading.size();
  return "#include <algorithm>\n#include <cmath>\n#include <cstdio>\n#include <limits>\n\n" +
         text.substr(from, text.find("\n\n", from) - from) + "\n\nint main() {\n  {scalar} x[] = {{" + place +
         "}}, y[" + std::to_string(results) + "];\n  " + name +
         "(x, y);\n  for (double out : y) std::printf(\"%.17g \", out);\n}";
}

struct Repaired {
  static constexpr const char *name = "repaired_cpp", *version = "1";

  template <class S>
  static void exp3_quaternion(In<S, 3> phi, Out<S, 4> Q) {
    ::exp3_quaternion(&phi[0], &Q[0]);
  }
  template <class S>
  static void exp3_matrix(In<S, 3> phi, Out<S, 9> R) {
    ::exp3_matrix(&phi[0], &R[0]);
  }
  template <class S>
  static void log3_quaternion(In<S, 4> Q, Out<S, 3> phi) {
    ::log3_quaternion(&Q[0], &phi[0]);
  }
  template <class S>
  static void log3_matrix(In<S, 9> R, Out<S, 3> phi) {
    ::log3_matrix(&R[0], &phi[0]);
  }
  template <class S>
  static void normalize(In<S, 4> Q, Out<S, 4> y) {
    ::normalize(&Q[0], &y[0]);
  }
  template <class S>
  static void log3_any_norm(In<S, 4> Q, Out<S, 3> phi) {
    ::log3_any_norm(&Q[0], &phi[0]);
  }
  template <class S>
  static void matrix_from_quaternion_any_norm(In<S, 4> Q, Out<S, 9> R) {
    ::matrix_from_quaternion_any_norm(&Q[0], &R[0]);
  }

  template <class S>
  static void relative_angle(In<S, 8> x, Out<S, 1> y) {
    ::relative_angle(&x[0], &y[0]);
  }
  template <class S>
  static void slerp(In<S, 9> x, Out<S, 4> y) {
    ::slerp(&x[0], &y[0]);
  }
  template <class S>
  static void rotation_between(In<S, 6> x, Out<S, 4> y) {
    ::rotation_between(&x[0], &y[0]);
  }

  static const char* source(std::string_view operation) {
    static const std::map<std::string, std::string, std::less<>> all = {
        {"exp3_quaternion", program("exp3_quaternion", 4, "phi")},
        {"exp3_matrix", program("exp3_matrix", 9, "phi")},
        {"log3_quaternion", program("log3_quaternion", 3, "Q")},
        {"log3_matrix", program("log3_matrix", 3, "R")},
        {"normalize", program("normalize", 4, "Q")},
        {"log3_any_norm", program("log3_any_norm", 3, "Q")},
        {"matrix_from_quaternion_any_norm", program("matrix_from_quaternion_any_norm", 9, "Q")},
        {"relative_angle", program("relative_angle", 1, "Q0}, {Q1")},
        {"slerp", program("slerp", 4, "Q0}, {Q1}, {t")},
        {"rotation_between", program("rotation_between", 4, "a}, {b")}};
    const auto at = all.find(operation);
    return at == all.end() ? nullptr : at->second.c_str();
  }
};

}  // namespace

LIECHECK_ADAPTER(Repaired, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, normalize,
                 log3_any_norm, matrix_from_quaternion_any_norm, relative_angle, slerp, rotation_between)
