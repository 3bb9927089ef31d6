#include <failures/substitutions.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <conventions/values.hpp>
#include <failures/relations.hpp>
#include <failures/turned_parts.hpp>
#include <invariants/tree_laws.hpp>
#include <iterator>
#include <numbers>
#include <optional>
#include <oracles/orientations.hpp>
#include <span>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

std::vector<PartPlace> places_of_arguments(const Operation& operation) {
  return places_of({operation.arguments.begin(), operation.arguments.size()});
}

}  // namespace

std::vector<JudgedCall> judged_calls(const Series& series, std::size_t output) {
  std::vector<JudgedCall> all;
  if (series.on_robot || is_tree_law(series.property)) return all;
  std::size_t wrong = 0;
  for (std::uint64_t from = 0; from < (wrong > 0 ? 1000 : 300); from += 20)
    for (NotedCall& call : sampled_calls(series, output, from, from + 20)) {
      if (stop_requested) return {};
      const Operation& operation = *call.operation;
      Numbers right;
      for (const oracles::Real& x : expected_of(call)) right.push_back(static_cast<double>(x));
      if (right.size() != call.result.size()) continue;
      if (operation.name.starts_with("euler_from") &&
          !are_unique(right, oracles::Order(static_cast<int>(call.arguments[0]))))
        continue;
      call.result = in_blocks(operation, call.result);
      all.push_back({std::move(call), in_blocks(operation, right)});
      if (Wrong(operation, {all.back()}, 1e-6).count() == 0) continue;
      const bool fails = case_fails(series, all.back().call.index, operation);
      if (fails && ++wrong == enough_calls) return all;
      if (!fails) all.pop_back();
    }
  return all;
}

std::string float_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  const std::vector<PartPlace> places = places_of_arguments(operation);
  Wrong wrong(operation, calls, 1e-10);
  wrong.of_all = false;  // some may be wrong for another reason
  if (wrong.count() < 4) return "";
  const auto rounded = [](Numbers x) {
    for (double& v : x) v = oracles::rounded_to_float(v) != 0 ? oracles::rounded_to_float(v) : v;
    return x;
  };
  if (wrong.given_by([&](const JudgedCall& c) { return rounded(c.right); }))
    return fmt::format("where it fails, {} is rounded to float", wrong.subject());
  if (wrong.has_floats())
    return fmt::format("where it fails, {} has numbers of a float: it is calculated in float",
                       wrong.subject());
  const auto given_by_rounded = [&](std::size_t from, std::size_t n) {
    return wrong.given_by([&](const JudgedCall& c) {
      Numbers x = c.call.arguments;
      const Span part = Span(x).subspan(from, n);
      std::ranges::copy(rounded(Numbers(part.begin(), part.end())), part.begin());
      return in_blocks(operation, exact(operation.name.data(), x));
    });
  };
  for (const PartPlace& at : places)
    for (std::size_t i = 0; i <= at.size && (i == 0 || at.size <= 4); ++i)  // all numbers, and then each
      if (i == 0 ? given_by_rounded(at.from, at.size) : given_by_rounded(at.from + i - 1, 1))
        return fmt::format("where it fails, {} is what {} rounded to float would give", wrong.subject(),
                           i == 0 ? name_of(at, places) : number_of(at, i - 1, places));
  return "";
}

namespace {
/// The one change that gives the wrong results, in words; or "".
std::string change_of(const Operation& operation, const std::vector<PartPlace>& places, const Wrong& wrong) {
  for (const PartPlace& at : places)
    for (const PartPlace& part : wrong.results())
      if (at.size == part.size && at.size > 1 && wrong.given_by([&](const JudgedCall& c) {
            Numbers x = c.right;
            std::ranges::copy(at.in(c.call.arguments), part.in(x).begin());
            return x;
          }))
        return fmt::format("where it fails, {} is {}, unchanged", wrong.subject(), name_of(at, places));
  for (const PartPlace& part : wrong.results())
    for (std::size_t i = 0; i < part.size && part.size <= 4; ++i)
      for (const PartPlace& at : places)
        for (std::size_t k = 0; k < at.size && at.size <= 4; ++k)
          if (wrong.given_by([&](const JudgedCall& c) {
                Numbers x = c.right;
                part.in(x)[i] = at.in(c.call.arguments)[k];
                return x;
              }))
            return fmt::format("where it fails, {} is right but for {}, which is {}", wrong.subject(),
                               number_of(part, i, wrong.results()),
                               number_of(at, k, places) + " of the arguments");
  std::vector<PartChange> changes;
  for (const PartPlace& p : wrong.results()) add_changes(p, wrong.results(), true, changes);
  add_exchanges(wrong.results(), changes);
  for (const PartChange& change : changes)
    if (wrong.given_by([&](const JudgedCall& c) {
          Numbers x = c.right;
          change.apply(x);
          return x;
        }))
      return fmt::format("where it fails, {} is {}", wrong.subject(), change.text);
  changes.clear();
  for (const PartPlace& p : places) add_changes(p, places, false, changes);
  add_exchanges(places, changes);
  for (const PartChange& change : changes)
    if (wrong.given_by([&](const JudgedCall& c) {
          Numbers x = c.call.arguments;
          change.apply(x);
          return in_blocks(operation, exact(operation.name.data(), x));
        }))
      return fmt::format("where it fails, {} is what {} would give", wrong.subject(), change.text);
  if (std::string text = of_another_frame(operation, places, wrong); !text.empty()) return text;
  return of_coupling(operation, wrong);
}

/// A change of all parts at once, in words; or "".
std::string change_of_all(const Wrong& wrong) {
  for (const auto& [text, factor] : {std::pair("0", 0.0), std::pair("the opposite of the right one", -1.0),
                                     std::pair("twice the right one", 2.0)})
    if (wrong.given_by([factor = factor](const JudgedCall& c) {
          Numbers x = c.right;
          for (double& v : x) v *= factor;
          return x;
        }))
      return fmt::format("where it fails, the result is {}", text);
  return "";
}

/// The calls without arguments so large that results underflow, overflow or lose all digits.
std::vector<JudgedCall> of_ordinary_arguments(std::vector<JudgedCall> calls) {
  std::erase_if(calls, [](const JudgedCall& c) {
    return std::ranges::any_of(c.call.arguments, [](double x) { return !(std::fabs(x) < 1e15); });
  });
  return calls;
}

/// The calls whose results are one number, or have several of like size: of one large number, each error is a factor.
std::vector<JudgedCall> of_several_numbers(const std::vector<JudgedCall>& calls) {
  std::vector<JudgedCall> all;
  std::ranges::copy_if(calls, std::back_inserter(all), [](const JudgedCall& c) {
    double largest = 0;
    for (const double x : c.right) largest = std::max(largest, std::fabs(x));
    return c.right.size() == 1 ||
           std::ranges::count_if(c.right, [&](double x) { return std::fabs(x) > 0.01 * largest; }) > 1;
  });
  return all;
}

}  // namespace

std::string substitution_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  for (const double least : {1e-6, 1e-10}) {
    Wrong wrong(operation, calls, least);
    if (wrong.count() < 4) continue;
    for (const bool of_all : {true, false}) {
      wrong.of_all = of_all;
      if (std::string text = change_of(operation, places_of_arguments(operation), wrong); !text.empty())
        return text;
    }
    const std::size_t parts = is_in_blocks(operation) ? 1 : wrong.results().size();
    const std::vector<JudgedCall> ordinary = of_ordinary_arguments(calls);
    for (std::size_t part = 0; parts > 1 && part <= parts; ++part) {
      const Wrong some(operation, ordinary, least, part == 0 ? std::nullopt : std::optional(part - 1));
      if (some.count() < 4) continue;
      std::string text =
          part == 0 ? change_of_all(some) : change_of(operation, places_of_arguments(operation), some);
      const std::string everywhere = fmt::format("where it fails, {} is ", some.subject());
      // Where it is right, another part may be wrong.
      if (part > 0 && text.starts_with(everywhere))
        text = fmt::format("where {} is wrong, it is {}", some.subject(), text.substr(everywhere.size()));
      if (!text.empty()) return text;
    }
    const std::vector<JudgedCall> several = of_several_numbers(calls);
    const Wrong general(operation, several, least);
    if (general.count() < 4) continue;
    if (std::string text = factor_of(general); !text.empty()) return text;
    if (std::string text = wrong_length_of(operation, several); !text.empty()) return text;
  }
  return "";
}

std::vector<JudgedCall> calls_of_kind(const std::vector<JudgedCall>& calls, int kind) {
  std::vector<JudgedCall> some;
  std::ranges::copy_if(calls, std::back_inserter(some), [&](const JudgedCall& c) {
    return static_cast<int>(c.call.arguments[0]) % 2 == kind;
  });
  return some;
}

std::string substitution_of_one_kind(const Operation& operation, const std::vector<JudgedCall>& calls) {
  if (operation.arguments[0]->name != "order") return "";
  std::string all;
  for (const int kind : {1, 0}) {
    if (const std::string text = substitution_of(operation, calls_of_kind(calls, kind)); !text.empty())
      all +=
          fmt::format("{}of {} axes, {}", all.empty() ? "" : "; ", kind == 1 ? "rotating" : "static", text);
  }
  return all;
}

std::string wrong_length_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  Wrong wrong(operation, calls, 1e-6);
  if (wrong.count() < 4) return "";
  for (const bool of_all : {true, false}) {
    wrong.of_all = of_all;
    if (std::string text = length_of(wrong, places_of_arguments(operation)); !text.empty()) return text;
  }
  return "";
}

}  // namespace liecheck::properties
