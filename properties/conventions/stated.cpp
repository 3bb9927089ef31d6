#include <conventions/stated.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <conventions/choices.hpp>
#include <conventions/table.hpp>
#include <conventions/values.hpp>
#include <numeric>
#include <stdexcept>

namespace liecheck::properties::conventions {
namespace {

/// Throws std::invalid_argument unless the convention is known and can be converted exactly.
void check(const std::string& name, const std::string& value) {
  if (const Choice* const c = choice_named(name)) {
    if (std::ranges::count(c->values, value) > 0) return;
    throw std::invalid_argument(fmt::format("\"{}\": \"{}\" is no choice: it is one of \"{}\"", name, value,
                                            fmt::join(c->values, "\", \"")));
  }
  std::string names;
  for (const Convention& c : conventions()) {
    const Statement& s = c.statement;
    if (s.name.empty()) continue;
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", s.name);
    if (s.name != name) continue;
    if (value != s.value && value != s.of_liecheck)
      throw std::invalid_argument(fmt::format("\"{}\": \"{}\" is no convention: it is \"{}\" or \"{}\"", name,
                                              value, s.of_liecheck, s.value));
    if (value == s.value && !c.exact)
      throw std::invalid_argument(fmt::format(
          "\"{}\": \"{}\" cannot be converted without rounding: in the adapter, {}", name, value, c.advice));
    return;
  }
  for (const Choice& c : choices()) names += fmt::format(", \"{}\"", c.name);
  throw std::invalid_argument(fmt::format("\"{}\" is no convention: known are {}", name, names));
}

}  // namespace

Rearranged rearranged(const Operation& operation, const Statements& stated) {
  Numbers arguments(arguments_of(operation)), result(size_of(*operation.results[0]));
  std::iota(arguments.begin(), arguments.end(), 1);
  std::iota(result.begin(), result.end(), 1);
  for (const auto& [name, value] : stated) check(name, value);
  for (const Convention& c : conventions()) {
    const auto at = stated.find(std::string(c.statement.name));
    if (at == stated.end() || at->second != c.statement.value) continue;
    for_each_argument(operation, arguments,
                      [&](const Layout& l, std::span<double> x) { c.decode(kind_of(l), x); });
    c.decode(kind_of(*operation.results[0]), result);
  }
  return {{arguments.begin(), arguments.end()}, {result.begin(), result.end()}};
}

}  // namespace liecheck::properties::conventions
