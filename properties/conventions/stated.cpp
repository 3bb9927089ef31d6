#include <conventions/stated.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <conventions/choices.hpp>
#include <conventions/table.hpp>
#include <conventions/values.hpp>
#include <numeric>
#include <operations/quaternion_poses.hpp>
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
  if (name == pose_form) {
    if (value == "matrix" || value == "quaternion") return;
    throw std::invalid_argument(
        fmt::format(R"("{}": "{}" is no convention: it is "matrix" or "quaternion")", name, value));
  }
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
  names += fmt::format(", \"{}\"", pose_form);
  for (const Choice& c : choices()) names += fmt::format(", \"{}\"", c.name);
  throw std::invalid_argument(fmt::format("\"{}\" is no convention: known are {}", name, names));
}

}  // namespace

Rearranged rearranged(const Operation& operation, const Statements& stated) {
  const auto layout = [in_quaternions = has_quaternion_poses(stated)](const Layout& l) {
    return in_quaternions ? with_quaternion(l) : l;
  };
  std::vector<Layout> of_arguments;
  std::size_t n = 0;
  for (const Layout* l : operation.arguments) n += size_of(of_arguments.emplace_back(layout(*l)));
  const Layout of_result = layout(*operation.results[0]);
  Numbers arguments(n), result(size_of(of_result));
  std::iota(arguments.begin(), arguments.end(), 1);
  std::iota(result.begin(), result.end(), 1);
  for (const auto& [name, value] : stated) check(name, value);
  for (const Convention& c : conventions()) {
    const auto at = stated.find(std::string(c.statement.name));
    if (at == stated.end() || at->second != c.statement.value) continue;
    std::span<double> left(arguments);
    for (const Layout& l : of_arguments) {
      c.decode(kind_of(l), left.first(size_of(l)));
      left = left.subspan(size_of(l));
    }
    c.decode(kind_of(of_result), result);
  }
  return {{arguments.begin(), arguments.end()}, {result.begin(), result.end()}};
}

bool has_quaternion_poses(const Statements& stated) {
  const auto at = stated.find(pose_form);
  return at != stated.end() && at->second == "quaternion";
}

std::vector<double> given(const Operation& operation, const Statements& stated,
                          const std::vector<double>& arguments, bool is_float) {
  const std::vector<double> numbers =
      has_quaternion_poses(stated) ? poses_as_quaternions(operation, arguments, is_float) : arguments;
  std::vector<double> own(numbers.size());
  encode(rearranged(operation, stated).arguments, numbers.data(), own.data());
  return own;
}

}  // namespace liecheck::properties::conventions
