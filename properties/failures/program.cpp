#include <failures/program.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/series.hpp>
#include <invariants/property.hpp>
#include <regex>
#include <set>

namespace liecheck::properties {

namespace {

std::string declaration(const Field& f, std::vector<std::string> x) {
  if (f.kind == Kind::inertia) {  // from xx xy yy xz yz zz to rows
    x = {x[0], x[1], x[3], x[1], x[2], x[4], x[3], x[4], x[5]};
  }
  const std::string list = fmt::format("{}", fmt::join(x, ", "));
  if (x.size() == 1) return fmt::format("  const S {} = {};  // {}\n", f.name, list, f.unit);
  if (f.size == 3 || f.size == 4)
    return fmt::format("  const Vector{}<S> {}({});  // {}\n", x.size(), f.name, list, f.unit);
  const bool matrix =
      f.kind == Kind::rotation_matrix || f.kind == Kind::near_rotation || f.kind == Kind::inertia;
  const std::string type = matrix ? "Matrix3<S> " + f.name
                           : f.kind == Kind::covariance
                               ? "Matrix6<S> " + f.name
                               : fmt::format("Eigen::Matrix<S, {}, 1> {}", f.size, f.name);
  return fmt::format("  {};  // {}\n  {} << {};\n", type, f.unit, f.name, list);
}

/// Declares the variable that holds an argument of several parts; "" for an argument of one part.
std::string variable_of(const Layout& argument) {
  if (argument.type.empty()) return "";
  std::vector<std::string_view> parts;
  for (const Part& part : argument.parts) parts.push_back(part.name);
  return argument.type.starts_with("Vector")
             ? fmt::format("  {0} {1};\n  {1} << {2};\n", argument.type, argument.name,
                           fmt::join(parts, ", "))
             : fmt::format("  const {} {}{{{}}};\n", argument.type, argument.name, fmt::join(parts, ", "));
}

/// The law's fields. Fields of a robot's joints (q0_7, q0_0_p, ...) are joined to vectors (q0, q1, delta).
std::vector<Field> whole_vectors(const Series& series) {
  if (!series.on_robot) return series.fields;
  std::vector<Field> all;
  for (const Field& f : series.fields) {
    const std::string name = f.name.substr(0, f.name.find('_'));
    if (all.empty() || all.back().name != name)
      all.push_back({name, Kind::opaque, 0, name == "delta" ? "m, rad" : "m, 1, rad"});
    all.back().size += f.size;
  }
  return all;
}

bool is_liecheck(const Series& series) {
  return series.subject == "liecheck" || series.subject == "liecheck:fast" ||
         series.subject == "liecheck:tight";
}

/// liecheck's call; of a subject liecheck:fast or liecheck:tight, in its precision.
std::string call_of(const Series& series, const Operation& operation) {
  const std::string call(operation.call.expression);
  if (!is_liecheck(series) || series.subject == "liecheck") return call;
  const std::string precision = "Precision::" + series.subject.substr(std::string("liecheck:").size());
  static const std::regex function("\\b([a-z]\\w*)<S>\\("), act("(SO3<S>\\(Q\\)[.]act)\\(");
  return std::regex_replace(std::regex_replace(call, function, "$1<S, " + precision + ">("), act,
                            "$1<" + precision + ">(");
}

/// The law's own program, or "" if it has none.
std::string law_program(const Series& series, const Output& output, const std::vector<std::string>& numbers) {
  std::vector<double> x;
  for (const std::string& text : numbers) x.push_back(parse_float(text, series.format()));
  return series.tested_law().program(output, x);
}

}  // namespace

std::string program_of(const Series& series, const Output& output, const std::vector<std::string>& numbers) {
  const auto note = [&] {
    return is_liecheck(series)
               ? std::string()
               : fmt::format(
                     "  // liecheck's function in the place of {0}'s, which has no program of its own: the "
                     "replay line calls {0}'s.\n",
                     series.subject);
  };
  if (std::string own = law_program(series, output, numbers); !own.empty()) {
    const std::string main = "int main() {\n";
    return own.insert(own.find(main) + main.size(), note());
  }
  const Operation& operation = *output.record;
  const bool robot = series.on_robot;
  std::string text = fmt::format(
      "// c++ -std=gnu++20 -I lib $(pkg-config --cflags eigen3) case.cpp{}\n"
      "#include <iostream>\n#include <liecheck/{}>\nusing namespace liecheck;\nint main() {{\n  using S = "
      "{};\n",
      robot ? " -lliecheck_lib -lexpat" : "", operation.call.header, series.scalar);
  if (robot)
    text += fmt::format("  const auto model = buildModelFromUrdf(\"ROBOT.urdf\", RootJoint::{}).cast<S>();\n",
                        series.robot_fixed ? "Fixed" : "FreeFlyer");
  const char* suffix = series.format().is_float() ? "f" : "";
  std::set<std::string_view> needed;
  std::string variables;
  for (const Layout* argument : operation.arguments) {
    for (const Part& part : argument->parts) needed.insert(part.name);
    variables += variable_of(*argument);
  }
  // A law on two adjacent angles has the fields `direction` and `theta` (both angles) in place of phi.
  const bool adjacent = std::any_of(series.fields.begin(), series.fields.end(),
                                    [](const Field& f) { return f.name == "theta" && f.size == 2; });
  std::size_t from = 0;
  for (const Field& f : whole_vectors(series)) {
    std::vector<std::string> x;
    for (int i = 0; i < f.size; ++i) x.push_back(numbers.at(from++) + suffix);
    if (adjacent || needed.count(f.name)) text += declaration(f, x);
  }
  if (!adjacent)
    return text + variables + note() + "  std::cout.precision(36);\n" +
           fmt::format("  std::cout << {} << '\\n';\n}}\n", call_of(series, operation));
  return text + note() + "  std::cout.precision(36);\n  for (int k = 0; k < 2; ++k) {\n" +
         "    const Vector3<S> phi = theta[k] * direction;\n" + variables +
         fmt::format("    std::cout << {} << '\\n';\n  }}\n}}\n", call_of(series, operation));
}

}  // namespace liecheck::properties
