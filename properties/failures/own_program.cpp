// The program of a failure in the terms of the library that failed.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <campaign/series.hpp>
#include <conventions/values.hpp>
#include <failures/program.hpp>
#include <failures/result.hpp>
#include <span>
#include <sstream>
#include <subjects/own_programs.hpp>

namespace liecheck::properties {

namespace {

/// Declares consecutive numbers as a matrix of 3 rows if they are 9, else as a vector, or as a number.
std::string declared(std::string_view name, std::span<const std::string> numbers, std::string_view unit) {
  const std::string list = fmt::format("{}", fmt::join(numbers, ", "));
  const std::string comment = unit.empty() || unit == "1" ? "" : fmt::format("  // {}", unit);
  if (numbers.size() == 1) return fmt::format("  const S {} = {};{}\n", name, list, comment);
  const std::string type =
      numbers.size() == 9 ? "Eigen::Matrix<S, 3, 3>" : fmt::format("Eigen::Matrix<S, {}, 1>", numbers.size());
  return fmt::format("  {} {};{}\n  {} << {};\n", type, name, comment, name, list);
}

/// Declares an argument: by its parts if one of them is a matrix, else as one vector.
std::string declared(const Layout& argument, std::span<const std::string> numbers) {
  const bool by_parts = std::ranges::any_of(argument.parts, [](const Part& p) { return p.size == 9; });
  std::string text;
  std::vector<std::string_view> units;
  for (const Part& part : argument.parts) {
    units.push_back(part.unit);
    if (by_parts) {
      text += declared(part.name, numbers.first(static_cast<std::size_t>(part.size)), part.unit);
      numbers = numbers.subspan(static_cast<std::size_t>(part.size));
    }
  }
  return by_parts ? text : declared(argument.name, numbers, fmt::format("{}", fmt::join(units, ", ")));
}

}  // namespace

std::string own_program(const Series& series, const NotedCall& call) {
  const OwnPrograms* const own = own_programs(series.subject);
  if (!own) return "";
  const auto found =
      std::ranges::find(own->statements, call.operation, [](const auto& s) { return s.first; });
  if (found == own->statements.end()) return "";
  std::vector<std::string> numbers;
  for (const double x : call.arguments)
    numbers.push_back(hexadecimal_float(x) + (series.format().is_float() ? "f" : ""));
  std::string text = fmt::format(
      "// c++ -std=c++20 $(pkg-config --cflags eigen3) case.cpp{}{}\n{}#include <Eigen/Core>\n"
      "#include <iostream>\nint main() {{\n  using S = {};\n",
      own->compile.empty() ? "" : " ", own->compile, own->includes, series.scalar);
  std::span<const std::string> left(numbers);
  for (const Layout* l : call.operation->arguments) {
    text += declared(*l, left.first(conventions::size_of(*l)));
    left = left.subspan(conventions::size_of(*l));
  }
  text += "  std::cout.precision(17);\n";
  const bool expression = found->second.find(';') == std::string::npos;
  std::istringstream statements(
      own->begin + (expression ? "std::cout << " + found->second + " << '\\n';" : found->second));
  for (std::string line; std::getline(statements, line);) text += "  " + line + "\n";
  return text + "}\n";
}

std::string own_program(const Series& series, const Output& output, const NotedCase& noted) {
  const NotedCall* const call = worst_call(output, noted);
  return call ? own_program(series, *call) : "";
}

}  // namespace liecheck::properties
