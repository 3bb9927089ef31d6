#include <failures/tree_substitutions.hpp>

#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <failures/tree_changes.hpp>
#include <failures/wrong_steps.hpp>
#include <invariants/property.hpp>
#include <invariants/tree_laws.hpp>
#include <invariants/witness.hpp>
#include <map>
#include <optional>
#include <search/trial.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

using Numbers = std::vector<double>;

/// What a law compares on one tree for an output in its measurements, one for each reference frame, and which is worst.
struct Comparisons {
  struct One {
    Numbers computed, exact;
    std::string operation, block;
    std::size_t measurement;
  };
  std::vector<One> all;  ///< of all outputs
  std::vector<Numbers> exact;
  std::optional<std::size_t> failed;  ///< the worst measurement, if it fails
  Numbers got;                        ///< there
};
Numbers as_numbers(const std::vector<oracles::Real>& x) {
  Numbers all;
  for (const oracles::Real& number : x) all.push_back(static_cast<double>(number));
  return all;
}
Comparisons comparisons_of(const Series& series, std::size_t output, const Numbers& x) {
  const Output& of = series.outputs.at(output);
  Witness witness{of.operation, of.block, true, {}};
  Witness* const before = std::exchange(Witness::current(), &witness);
  std::vector<Judged> judged;
  try {
    judged = series.measure(x);
  } catch (...) {
    Witness::current() = before;
    throw;
  }
  Witness::current() = before;
  std::erase_if(judged, [&](const Judged& j) { return j.residual.output != output; });
  Comparisons c;
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> counts;
  for (const Witness::Compared& one : witness.all)
    c.all.push_back({as_numbers(one.computed), as_numbers(one.exact), std::string(one.operation),
                     std::string(one.block), counts[{one.operation, one.block}]++});
  std::vector<const Comparisons::One*> own;
  for (const Comparisons::One& one : c.all)
    if (one.operation == of.operation && one.block == of.block) own.push_back(&one);
  if (own.size() != judged.size()) return c;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    c.exact.push_back(own[i]->exact);
    if (judged[i].failed && judged[i].residual.outcome == Outcome::measured &&
        (!c.failed || judged[i].residual.error > judged[*c.failed].residual.error))
      c.failed = i;
  }
  if (c.failed) c.got = own[*c.failed]->computed;
  return c;
}

/// A tree on which an output is wrong, in one of its measurements.
struct WrongTree {
  Numbers input;
  std::size_t measurement;
  Numbers got, right;
  std::vector<Comparisons::One> all;  ///< what is compared on it
};

double distance(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum = std::hypot(sum, a[i] - b[i]);
  return sum;
}
/// Whether `other` is what was got, to a hundredth of the error.
bool has_got(const WrongTree& tree, const Numbers& other) {
  return other.size() == tree.got.size() && distance(tree.got, other) < 0.01 * distance(tree.got, tree.right);
}

std::vector<WrongTree> wrong_trees(const Series& series, std::size_t output) {
  constexpr std::uint64_t any_seed = 42, most = 400;
  constexpr std::size_t enough = 10;
  std::vector<WrongTree> all;
  const auto end = std::chrono::steady_clock::now() + at_this_load(1);
  for (std::uint64_t i = 0; i < most && all.size() < enough && !stop_requested; ++i) {
    if (std::chrono::steady_clock::now() > end) break;
    const Numbers x = series.numbers(series.id(any_seed, i));
    if (!series.tested_law().valid(x)) continue;
    Comparisons c = comparisons_of(series, output, x);
    if (!c.failed) continue;
    Numbers right = c.exact[*c.failed];
    // An error of rounding alone is none of another formula.
    if (c.got.size() != right.size() ||
        !(distance(c.got, right) > 1e-9 * distance(right, Numbers(right.size(), 0))))
      continue;
    all.push_back({x, *c.failed, std::move(c.got), std::move(right), std::move(c.all)});
  }
  std::ranges::sort(all, {}, [](const WrongTree& tree) { return tree.input.size(); });
  return all;
}

/// On how many trees an alternative gives what was got; 0 if it does not on nine of ten trees, and on three at least. Trees
/// for which it has no result, since it would make them singular, do not count.
template <class Alternative>
std::size_t explains(const std::vector<WrongTree>& trees, const Alternative& alternative) {
  std::size_t given = 0, missed = 0;
  for (const WrongTree& tree : trees) {
    if (stop_requested) return 0;
    const std::optional<Numbers> other = alternative(tree);
    if (!other) continue;
    if (has_got(tree, *other))
      ++given;
    else if (++missed > trees.size() / 10)
      return 0;
  }
  return given >= 3 ? given : 0;
}

/// Changes of a result alone, in words that follow "the result is". `wrong` tells which numbers are.
struct ChangedResult {
  const char* text;
  double (*number)(double right, bool wrong);
};
constexpr ChangedResult changed_results[]{
    {"0", [](double, bool) { return 0.0; }},
    {"the opposite of the right one", [](double x, bool) { return -x; }},
    {"twice the right one", [](double x, bool) { return 2 * x; }},
    {"rounded to float", [](double x, bool) { return oracles::rounded_to_float(x); }},
    {"half of the right one", [](double x, bool) { return x / 2; }}};
/// Those that say least, after all others.
constexpr ChangedResult changed_numbers[]{
    {"right but for numbers that are 0", [](double x, bool wrong) { return wrong ? 0 : x; }},
    {"right but for numbers of the opposite sign", [](double x, bool wrong) { return wrong ? -x : x; }}};

/// Whether the wrong numbers are beside the diagonal of a square matrix, on one side of it: " below" or " above" it; or "".
std::string side_of_diagonal(const std::vector<WrongTree>& trees) {
  bool below = true, above = true;
  for (const WrongTree& tree : trees) {
    const auto n = static_cast<std::size_t>(std::lround(std::sqrt(tree.right.size())));
    if (n * n != tree.right.size()) return "";
    const double scale = distance(tree.got, tree.right) / 100 / std::sqrt(tree.right.size());
    for (std::size_t i = 0; i < n * n; ++i)
      if (const std::size_t row = i / n, column = i % n; std::fabs(tree.got[i] - tree.right[i]) > scale)
        below &= row > column, above &= row < column;
  }
  return below == above ? "" : below ? " below the diagonal" : " above the diagonal";
}

template <std::size_t N>
std::string change_of_result(const ChangedResult (&changes)[N], const std::vector<WrongTree>& trees) {
  for (const ChangedResult& change : changes)
    if (explains(trees, [&](const WrongTree& tree) {
          Numbers x = tree.right;
          const double scale = distance(tree.got, tree.right) / 100 / std::sqrt(x.size());
          for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = change.number(x[i], std::fabs(tree.got[i] - x[i]) > scale);
          return x;
        }))
      return fmt::format("where it fails, the result is {}", change.text);
  return "";
}

/// The right result of another operation, block or reference frame of the same tree that was got, in words.
std::string other_result(const std::vector<WrongTree>& trees, const Output& of) {
  for (const Comparisons::One& other : trees.front().all) {
    const bool own = other.operation == of.operation && other.block == of.block;
    if (!explains(trees, [&](const WrongTree& tree) -> std::optional<Numbers> {
          for (const Comparisons::One& one : tree.all)
            if (one.operation == other.operation && one.block == other.block &&
                one.measurement == (own ? other.measurement : tree.measurement))
              return one.exact;
          return {};
        }))
      continue;
    constexpr const char* frames[] = {"WORLD", "LOCAL", "LOCAL_WORLD_ALIGNED"};
    return fmt::format("where it fails, the result is that of {}",
                       own && other.measurement < 3      ? frames[other.measurement]
                       : other.operation == of.operation ? other.block
                                                         : other.operation);
  }
  return "";
}

/// Whether errors are those of a float in nine of ten trees: q of many turns, which some have, makes them larger.
bool is_of_float(const std::vector<WrongTree>& trees) {
  const auto small = std::ranges::count_if(trees, [](const WrongTree& tree) {
    const double error = distance(tree.got, tree.right) / distance(tree.right, Numbers(tree.right.size(), 0));
    return error > 1e-10 && error < 1e-6;
  });
  return 10 * small >= 9 * std::ssize(trees);
}

/// Whether an output is right on nine of ten trees, and on three at least, after a change of them, and not only 0.
bool is_right_with(const TreeChange& change, const Series& series, std::size_t output,
                   const std::vector<WrongTree>& trees) {
  std::size_t right = 0, wrong = 0;
  for (const WrongTree& tree : trees) {
    if (stop_requested || wrong > trees.size() / 10) return false;
    Numbers x = tree.input;
    change.apply(x);
    if (x != tree.input && !series.tested_law().valid(x)) continue;
    const Comparisons c = comparisons_of(series, output, x);
    if (tree.measurement >= c.exact.size()) continue;
    const bool only_zero = distance(c.exact[tree.measurement], Numbers(tree.right.size(), 0)) == 0;
    (c.failed || only_zero ? wrong : right) += 1;
  }
  return right >= 3 && wrong <= trees.size() / 10;
}

/// Whether a law compares J v in place of J: there v = 0 tells nothing.
bool is_of_columns(const Series& series, std::size_t output) {
  static constexpr std::array<std::string_view, 3> all{"frame_jacobian", "tree_momentum_map",
                                                       "frame_jacobian_rate"};
  return std::ranges::find(all, series.outputs.at(output).operation) != all.end();
}

}  // namespace

std::string tree_substitution_of(const Series& series, std::size_t output) try {
  if (series.on_robot || !is_tree_law(series.property)) return "";
  const std::vector<WrongTree> trees = wrong_trees(series, output);
  if (trees.size() < 3) return "";
  const Output& of = series.outputs[output];
  const bool of_halves = of.operation == "rnea_of_split_bodies";  // one of which may give half of the result
  if (std::string text = of_halves ? "" : change_of_result(changed_results, trees); !text.empty())
    return text;
  if (std::string text = other_result(trees, of); !text.empty()) return text;
  std::string best;
  std::size_t most = 0;
  /// The first of those that explain most trees.
  const auto attempt = [&](const std::string& text, const auto& alternative) {
    if (most == trees.size()) return;
    if (const std::size_t given = explains(trees, alternative); given > most)
      most = given, best = fmt::format("where it fails, the result is what {} would give", text);
  };
  std::vector<spatial::Tree> links;
  for (const WrongTree& tree : trees) links.emplace_back(tree.input);
  for (const spatial::WrongStep& step : spatial::wrong_steps(of.operation, of.block))
    attempt(step.text, [&](const WrongTree& tree) {
      return step.result(links[static_cast<std::size_t>(&tree - trees.data())], tree.measurement);
    });
  const bool of_columns = is_of_columns(series, output);
  for (const TreeChange& change : of_halves ? changes_of_halves() : tree_changes()) {
    const std::string& text = of_columns ? change.of_columns : change.text;
    if (text.empty()) continue;
    attempt(text, [&](const WrongTree& tree) -> std::optional<Numbers> {
      Numbers x = tree.input;
      change.apply(x);
      if (x == tree.input) return tree.right;
      if (!change.any_inertia && !series.tested_law().valid(x)) return {};
      const Comparisons c = comparisons_of(series, output, x);
      if (tree.measurement >= c.exact.size()) return {};
      return c.exact[tree.measurement];
    });
  }
  if (!best.empty()) return best;
  if (series.eps < 1e-10 && is_of_float(trees))
    return fmt::format("a constant or a step of the calculation has too few digits, such as one in float{}",
                       of.operation.find("derivative") != of.operation.npos
                           ? ", or a difference of two results stands for a derivative"
                           : "");
  const std::string text = change_of_result(changed_numbers, trees);
  return text.ends_with("that are 0") ? text + side_of_diagonal(trees) : text;
} catch (const GivenUp&) {  // a signal ended a call
  return "";
}

std::string needed_term_of(const Series& series, std::size_t output) try {
  if (series.on_robot || !is_tree_law(series.property)) return "";
  const std::vector<WrongTree> trees = wrong_trees(series, output);
  if (trees.size() < 3) return "";
  std::vector<std::string> with;
  for (const TreeChange& change : tree_changes()) {
    if (!change.leaves_out || (is_of_columns(series, output) && change.of_columns != change.text)) continue;
    const bool of_kind = change.text.starts_with("v = 0 of ");  // follows v = 0
    if (of_kind && (with.empty() || with.back() != "v = 0")) continue;
    if (with.size() == 2 && !of_kind) break;
    if (!is_right_with(change, series, output, trees)) continue;
    if (of_kind)
      with.back() = change.text;
    else
      with.push_back(change.text);
  }
  if (with.empty()) return "";
  return fmt::format("it is right with {}, so a term that is 0 then is wrong or missing",
                     fmt::join(with, ", and with "));
} catch (const GivenUp&) {  // a signal ended a call
  return "";
}

}  // namespace liecheck::properties
