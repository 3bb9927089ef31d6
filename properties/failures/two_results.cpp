#include <failures/two_results.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <conventions/values.hpp>
#include <failures/calls.hpp>
#include <support/same_numbers.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

/// The name of a number of a result, whose size the model of a robot may determine.
std::string name_of_number(const Layout& layout, std::size_t i) {
  for (const Part& part : layout.parts) {
    if (part.size < 0) return fmt::format("{}[{}]", part.name, i);
    if (i < static_cast<std::size_t>(part.size)) return conventions::number_name(part, i);
    i -= static_cast<std::size_t>(part.size);
  }
  return "the result";
}

std::string difference(const Series& series, const NotedCall& a, const NotedCall& b) {
  if (a.operation != b.operation || a.arguments != b.arguments || a.seen != b.seen) return "";
  if (a.thrown.empty() != b.thrown.empty())
    return fmt::format("the call is refused ({}), and then not", printable(a.thrown + b.thrown));
  if (a.result.size() != b.result.size()) return "";
  std::size_t most = 0;
  double apart = 0;
  for (std::size_t i = 0; i < a.result.size(); ++i) {
    const double x = a.result[i], y = b.result[i];
    if (x == y || (std::isnan(x) && std::isnan(y))) continue;
    const double between = std::isfinite(x - y) ? std::fabs(x - y) : HUGE_VAL;
    if (between > apart) apart = between, most = i;
  }
  if (apart == 0) return "";
  return fmt::format(
      "{} is {}, and {} when the same call is made again", name_of_number(*a.operation->results[0], most),
      decimal_float(a.result[most], series.format()), decimal_float(b.result[most], series.format()));
}

}  // namespace

std::string two_results_text(const Series& series, const CaseId& id, std::size_t output) {
  constexpr std::uint64_t any_seed = 42, others = 12;
  const NotedCase first = noted(series, id, output);
  for (std::uint64_t i = 0; i < others; ++i) {
    const NotedCase again = noted(series, id, output);
    for (std::size_t k = 0; k < std::min(first.calls.size(), again.calls.size()); ++k)
      if (std::string text = difference(series, first.calls[k], again.calls[k]); !text.empty()) return text;
    noted(series, series.id(any_seed, i), output);  // other calls between
  }
  return "";
}

}  // namespace liecheck::properties
