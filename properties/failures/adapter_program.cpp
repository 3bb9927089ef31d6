#include <fmt/format.h>
#include <fmt/ranges.h>
#include <adapters/adapter.hpp>
#include <adapters/subjects.hpp>
#include <adapters/trees.hpp>
#include <campaign/series.hpp>
#include <cmath>
#include <conventions/stated.hpp>
#include <conventions/values.hpp>
#include <failures/drawn_tree.hpp>
#include <failures/program.hpp>
#include <failures/result.hpp>
#include <invariants/tree_case.hpp>
#include <invariants/tree_laws.hpp>
#include <operations/quaternion_poses.hpp>
#include <span>

namespace liecheck::properties {

namespace {

/// A decimal that reads back as the same number also in a program, where -0 would be an integer.
std::string literal(double x, const Scalar& scalar) {
  return x == 0 && std::signbit(x) ? "-0.0" : decimal_float(x, scalar);
}

/// The argument's numbers in decimals that read back as the same numbers, and in hexadecimal.
struct Argument {
  std::string name, decimal, hexadecimal;
};

std::vector<Argument> arguments_in(const NotedCall& call, const adapters::Description& d,
                                   const Scalar& scalar) {
  const std::vector<double> numbers =
      conventions::given(*call.operation, d.conventions, call.arguments, scalar.is_float());
  std::vector<Argument> all;
  std::span<const double> left(numbers);
  for (const Layout* own : call.operation->arguments) {
    const Layout l = conventions::has_quaternion_poses(d.conventions) ? with_quaternion(*own) : *own;
    std::vector<std::string> decimal, hexadecimal;
    for (const double x : left.first(conventions::size_of(l)))
      decimal.push_back(literal(x, scalar)), hexadecimal.push_back(hexadecimal_float(x));
    left = left.subspan(conventions::size_of(l));
    all.push_back({std::string(l.name), fmt::format("{}", fmt::join(decimal, ", ")),
                   fmt::format("{}", fmt::join(hexadecimal, ", "))});
  }
  return all;
}

/// The template with the numbers of each argument in the place of its name in braces, and the scalar's name in that of
/// {scalar}.
std::string filled(std::string text, std::vector<Argument> arguments, const std::string& scalar) {
  arguments.push_back({"scalar", scalar, ""});
  for (const Argument& a : arguments) {
    const std::string place = "{" + a.name + "}";
    for (auto at = text.find(place); at != text.npos; at = text.find(place, at + a.decimal.size()))
      text.replace(at, place.size(), a.decimal);
  }
  return text.ends_with('\n') ? text : text + "\n";
}

}  // namespace

std::string program_of_template(const Series& series, const Output& output, const NotedCase& noted) try {
  const adapters::Description* const d = adapters::description_of(series.adapter);
  const NotedCall* const call = worst_call(output, noted);
  if (!d || !call) return "";
  const auto source = d->source.find(std::string(call->operation->name));
  if (source == d->source.end()) return "";
  return fmt::format("  as {}'s own program:\n\n{}\n", series.subject,
                     filled(source->second, arguments_in(*call, *d, series.format()), series.scalar));
} catch (const std::logic_error&) {  // an argument whose size the model of a robot determines
  return "";
}

namespace {

/// The call of an operation on a tree, with the model as an adapter that takes lists of joints is given it.
std::string tree_call(const Series& series, const NotedCall& call, const adapters::Description& d,
                      const CaseId& id) {
  if (!is_tree_law(series.property) || series.on_robot) return "";
  const std::vector<double> x = series.numbers(id);
  TreeCase<double> c(TreeLayout::of_size(x.size()), x, x);
  if (is_weightless(series)) c.tree.gravity = oracles::zero_vector<3, double>();
  const adapters::Model model(described(c), d, series.format(), {});
  std::string text =
      fmt::format("  as the adapter is called: {} in {}{}\n    model {}\n", call.operation->name,
                  series.scalar, call.seen.empty() ? "" : ", seen in " + call.seen, model.text());
  std::span<const double> left(call.arguments);
  for (const Layout* l : call.operation->arguments)
    for (const Part& part : l->parts) {
      std::vector<std::string> numbers;
      for (const double y : left.first(size_of(part, model.size())))
        numbers.push_back(decimal_float(y, series.format()));
      left = left.subspan(numbers.size());
      text += fmt::format("    {} = {}\n", part.name, fmt::join(numbers, ", "));
    }
  if (adapters::of_frame(*call.operation))
    text += fmt::format("    frame = {}\n", fmt::join(model.frame(), ", "));
  return text;
}

}  // namespace

std::string adapter_program(const Series& series, const Output& output, const NotedCase& noted,
                            const CaseId& id) try {
  if (std::string own = program_of_template(series, output, noted); !own.empty()) return own;
  const adapters::Description* const d = adapters::description_of(series.adapter);
  const NotedCall* call = worst_call(output, noted);
  if (!d || !call) return "";
  for (const NotedCall& one : noted.calls)  // the one in the reference whose numbers are shown
    if (one.operation == output.record && !noted.compared.seen.empty() && one.seen == noted.compared.seen)
      call = &one;
  if (adapters::model_operation(call->operation->name)) return tree_call(series, *call, *d, id);
  const auto arguments = arguments_in(*call, *d, series.format());
  std::string text =
      fmt::format("  as the adapter is called: {} in {}\n", call->operation->name, series.scalar);
  for (const Argument& a : arguments)
    text += fmt::format("    {:<10}{}\n    {:<10}{}\n", a.name, a.decimal, "", a.hexadecimal);
  return text;
} catch (const std::logic_error&) {  // an argument whose size the model of a robot determines
  return "";
}

}  // namespace liecheck::properties
