// Subject "textbook" in float and double: subjects/textbook.hpp. It is the positive control: every campaign over all
// subjects must find its large errors near the cutoff. The variants textbook:1e-1 ... textbook:1e-12 have the cutoff
// in their name and run only if they are named.

#include <fmt/format.h>
#include <subjects/own_programs.hpp>
#include <subjects/textbook_subject.hpp>

#include <utility>
#include <vector>

namespace liecheck::properties {
namespace {

const Registered<float> in_float(TextbookSubject<float>::make<8, false>());
const Registered<double> in_double(TextbookSubject<double>::make<8, false>());

template <class S, int... i>
std::vector<Registered<S>> variants(std::integer_sequence<int, i...>) {
  return {Registered<S>(TextbookSubject<S>::template make<i + 1, true>())...};
}
const auto variants_in_float = variants<float>(std::make_integer_sequence<int, 12>());
const auto variants_in_double = variants<double>(std::make_integer_sequence<int, 12>());

/// The programs of the textbook with this cutoff.
OwnPrograms programs(const std::string& cutoff) {
  OwnPrograms all{"-I lib -I properties",
                  "#include <subjects/textbook_subject.hpp>\nusing namespace liecheck::properties;\n",
                  "const TextbookSubject<S> book{{{}, " + cutoff + "}};\n",
                  {}};
  const auto add = [&](const Operation& o, const char* arguments) {
    const std::string value = fmt::format("book.{}({})", o.name, arguments);
    const bool pose = o.results[0]->parts.size() == 2 && o.results[0]->parts[0].size == 9;
    all.statements.emplace_back(
        &o, pose ? "const Pose<S> T = " + value + ";\nstd::cout << T.R << '\\n' << T.p << '\\n';" : value);
  };
  add(op::exp3_quaternion, "phi");
  add(op::exp3_matrix, "phi");
  add(op::left_jacobian3, "phi");
  add(op::right_jacobian3, "phi");
  add(op::left_jacobian3_inverse, "phi");
  add(op::right_jacobian3_inverse, "phi");
  add(op::log3_quaternion, "Q");
  add(op::log3_matrix, "R");
  add(op::exp6, "xi");
  add(op::log6, "{R, p}");
  add(op::left_jacobian6, "xi");
  add(op::right_jacobian6, "xi");
  add(op::left_jacobian6_inverse, "xi");
  add(op::right_jacobian6_inverse, "xi");
  add(op::integrate, "q0, delta");
  add(op::d_integrate_arg0, "q0, delta");
  add(op::d_integrate_arg1, "q0, delta");
  add(op::difference, "q0, q1");
  add(op::d_difference_arg0, "q0, q1");
  add(op::d_difference_arg1, "q0, q1");
  add(op::compose, "{R, p}, {R_Y, p_Y}");
  add(op::inverse, "{R, p}");
  add(op::act_point, "{R, p}, p_Y");
  add(op::rotate_point, "Q, p");
  add(op::quaternion_from_matrix, "R");
  add(op::axis_angle_from_quaternion, "Q");
  add(op::angle_between, "a, b");
  return all;
}

const std::vector<RegisteredPrograms> registered_programs = [] {
  std::vector<RegisteredPrograms> all{{"textbook", programs("1e-8")}};
  for (int e = 1; e <= 12; ++e)
    all.emplace_back(fmt::format("textbook:1e-{}", e), programs(fmt::format("1e-{}", e)));
  return all;
}();

}  // namespace
}  // namespace liecheck::properties
