#include <fmt/format.h>
#include <fmt/ranges.h>
#include <adapters/adapter.hpp>
#include <adapters/subjects.hpp>
#include <campaign/series.hpp>
#include <conventions/stated.hpp>
#include <conventions/values.hpp>
#include <failures/program.hpp>
#include <failures/result.hpp>
#include <span>

namespace liecheck::properties {

namespace {

/// The argument's numbers in decimals that read back as the same numbers, and in hexadecimal.
struct Argument {
  std::string name, decimal, hexadecimal;
};

std::vector<Argument> arguments_in(const NotedCall& call, const adapters::Description& d,
                                   const Scalar& scalar) {
  std::vector<double> numbers = call.arguments;
  if (!d.conventions.empty()) {  // as the adapter receives them
    std::vector<double> own(numbers.size());
    conventions::encode(conventions::rearranged(*call.operation, d.conventions).arguments, numbers.data(),
                        own.data());
    numbers = own;
  }
  std::vector<Argument> all;
  std::span<const double> left(numbers);
  for (const Layout* l : call.operation->arguments) {
    std::vector<std::string> decimal, hexadecimal;
    for (const double x : left.first(conventions::size_of(*l)))
      decimal.push_back(decimal_float(x, scalar)), hexadecimal.push_back(hexadecimal_float(x));
    left = left.subspan(conventions::size_of(*l));
    all.push_back({std::string(l->name), fmt::format("{}", fmt::join(decimal, ", ")),
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

std::string adapter_program(const Series& series, const Output& output, const NotedCase& noted) try {
  if (std::string own = program_of_template(series, output, noted); !own.empty()) return own;
  const adapters::Description* const d = adapters::description_of(series.adapter);
  const NotedCall* const call = worst_call(output, noted);
  if (!d || !call) return "";
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
