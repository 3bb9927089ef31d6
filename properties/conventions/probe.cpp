#include <conventions/probe.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <compare>
#include <conventions/reference.hpp>
#include <conventions/table.hpp>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <oracles/ball_arithmetic.hpp>
#include <stdexcept>
#include <utility>

namespace liecheck::properties::conventions {
namespace {

/// A set of conventions.
struct Mask {
  std::uint64_t low = 0, high = 0;
  auto operator<=>(const Mask&) const = default;
  explicit operator bool() const { return low || high; }
  Mask operator|(Mask o) const { return {low | o.low, high | o.high}; }
  Mask operator&(Mask o) const { return {low & o.low, high & o.high}; }
  Mask operator^(Mask o) const { return {low ^ o.low, high ^ o.high}; }
  Mask operator~() const { return {~low, ~high}; }
  int size() const { return std::popcount(low) + std::popcount(high); }
  std::size_t first() const {
    return static_cast<std::size_t>(low ? std::countr_zero(low) : 64 + std::countr_zero(high));
  }
};
constexpr Mask none;

Mask one(std::size_t convention) {
  if (convention >= 128) throw std::logic_error("a set has at most 128 conventions");
  const std::uint64_t bit = std::uint64_t(1) << (convention % 64);
  return convention < 64 ? Mask{bit, 0} : Mask{0, bit};
}

/// The first part that is wrong by more than a thousandth of its size, and by more than a millionth, or null. Q and -Q are
/// the same rotation, and angles that differ by 2 pi the same angle.
const Part* wrong_part(const Layout& layout, std::span<const double> got, std::span<const double> right) {
  std::size_t at = 0;
  const Kind kind = kind_of(layout);
  const bool turns = kind == Kind::angle || kind == Kind::euler_angles;
  for (const Part& part : layout.parts) {
    double size = probe_tolerance, apart = 0, apart_of_minus = 0;  // the arguments are of order 1
    for (const std::size_t end = at + static_cast<std::size_t>(part.size); at < end; ++at) {
      if (!std::isfinite(got[at])) return &part;
      size = std::max(size, std::fabs(right[at]));
      const double by = got[at] - right[at];
      apart = std::max(apart, std::fabs(turns ? std::remainder(by, 2 * std::numbers::pi) : by));
      apart_of_minus = std::max(apart_of_minus, std::fabs(got[at] + right[at]));
    }
    if (std::min(apart, part.size == 4 ? apart_of_minus : apart) > probe_tolerance * size) return &part;
  }
  return nullptr;
}

const Layout& result_of(const Operation& o) {
  return *o.results[0];
}

/// The right result where the functions in `set` have the meaning of their convention.
Numbers meant(const Operation& o, const Numbers& arguments, Mask set) {
  if (!set) return reference(o, arguments);
  const auto first = set.first();
  const Convention& c = conventions()[first];
  const Mask others = set & ~one(first);
  if (!c.formula || c.operations.find(fmt::format(" {} ", o.name)) == c.operations.npos)
    return meant(o, arguments, others);
  return c.formula(o, arguments,
                   [&](const Operation& next, const Numbers& x) { return meant(next, x, others); });
}

/// Turns what is in this convention into liecheck's.
void decode(const Operation& o, const Convention& c, Numbers& arguments, Numbers& result) {
  if (!c.decode) return;
  if (c.side != Side::result)
    for_each_argument(o, arguments, [&](const Layout& l, std::span<double> x) { c.decode(kind_of(l), x); });
  if (c.side != Side::arguments) c.decode(kind_of(result_of(o)), result);
}

/// Whether two triples of Euler angles of one order, the first argument, or two pairs of a unit axis and an angle are the same
/// rotation.
bool same_rotation(const Operation& o, const Numbers& arguments, const Numbers& a, const Numbers& b) {
  const Kind kind = kind_of(result_of(o));
  if (kind != Kind::euler_angles && kind != Kind::axis_angle) return false;
  if (!std::ranges::all_of(a, [](double x) { return std::isfinite(x); })) return false;
  const bool euler = kind == Kind::euler_angles;
  if (!euler && !(std::fabs(std::hypot(a[0], a[1], a[2]) - 1) <= probe_tolerance)) return false;
  const Operation& to = operation_named(euler ? "euler_to_quaternion" : "quaternion_from_axis_angle");
  const auto quaternion = [&](const Numbers& x) {
    return reference(to, euler ? Numbers{arguments[0], x[0], x[1], x[2]} : x);
  };
  return !wrong_part(result_of(to), quaternion(a), quaternion(b));
}

bool explains_answer(const Operation& o, const Answer& answer, Mask set) try {
  Numbers arguments = answer.arguments, result = answer.result;
  for (std::size_t c = 0; c < conventions().size(); ++c)
    if (set & one(c)) decode(o, conventions()[c], arguments, result);
  const Numbers right = meant(o, arguments, set);
  return !wrong_part(result_of(o), result, right) || same_rotation(o, arguments, result, right);
} catch (const oracles::Undecided&) {
  return false;
}

/// Which conventions change the arguments, the result or the meaning of an operation.
Mask affecting(const Operation& o) {
  Mask set = none;
  const Numbers arguments = probe_arguments<double>(o)[0], result = reference(o, arguments);
  for (std::size_t c = 0; c < conventions().size(); ++c) {
    Convention convention = conventions()[c];
    Numbers x = arguments, y = result;
    const Side side = std::exchange(convention.side, Side::both);
    decode(o, convention, x, y);
    const bool values = side == Side::both ? x != arguments || y != result : x != arguments && y != result;
    if (values || convention.operations.find(fmt::format(" {} ", o.name)) != std::string_view::npos)
      set = set | one(c);
  }
  return set;
}

/// What explains each operation; nothing for those that remain unexplained.
using Explanation = std::vector<std::optional<Mask>>;

class Search {
 public:
  explicit Search(const std::vector<Probed>& all) : all_(all) {
    for (const Probed& p : all) {
      affecting_.push_back(affecting(*p.operation));
      std::vector<Mask> sets{none};
      for (std::size_t a = 0; a < conventions().size(); ++a)
        if (affecting_.back() & one(a)) sets.push_back(one(a));
      const std::size_t singles = sets.size();
      for (std::size_t a = 1; a < singles; ++a)
        for (std::size_t b = a + 1; b < singles; ++b) sets.push_back(sets[a] | sets[b]);
      few_.push_back(sets);
    }
  }

  /// The cheapest explanation, which starts from conventions that are common to all operations.
  Explanation run() {
    std::vector<Mask> commons{none};
    Explanation best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < commons.size() && i < most_commons; ++i) {
      const Mask common = commons[i];
      const auto [explanation, cost] = with(common);
      if (cost < least - 1e-9) least = cost, best = explanation;
      for (std::size_t k = 0; k < all_.size(); ++k) {
        if (explains(k, common)) continue;
        for (const Mask set : few_[k])
          if ((common | set).size() <= most_common && std::ranges::count(commons, common | set) == 0 &&
              explains(k, common | set))
            commons.push_back(common | set);
      }
    }
    return best;
  }

  bool affects(std::size_t c, std::size_t k) const { return bool(affecting_[k] & one(c)); }

  /// Whether the conventions of `set` that affect operation k explain its answers.
  bool explains(std::size_t k, Mask set) {
    set = set & affecting_[k];
    const auto [at, is_new] = known_.try_emplace({k, set}, false);
    if (is_new)
      at->second = std::ranges::all_of(
          all_[k].answers, [&](const Answer& a) { return explains_answer(*all_[k].operation, a, set); });
    return at->second;
  }

  /// The operations that contradict convention c: it affects them, and they are explained without it.
  std::vector<std::size_t> contradicting(std::size_t c, const Explanation& e) {
    std::vector<std::size_t> others;
    for (std::size_t k = 0; k < all_.size(); ++k)
      if (e[k] && affects(c, k) && !(*e[k] & one(c)) && !explains(k, *e[k] | one(c))) others.push_back(k);
    return others;
  }

 private:
  static constexpr int most_common = 5;
  static constexpr std::size_t most_commons = 300;

  /// The explanation by `common`, with deviations of single operations where they need it, and its cost.
  std::pair<Explanation, double> with(Mask common) {
    Explanation e(all_.size());
    double cost = common.size();
    for (std::size_t k = 0; k < all_.size(); ++k)
      if (explains(k, common)) e[k] = common & affecting_[k];
    const Explanation by_common = e;
    for (std::size_t k = 0; k < all_.size(); ++k) {
      if (e[k]) continue;
      double least = 4;  // unexplained
      for (const Mask set : few_[k]) {
        const Mask deviation = set ^ (common & affecting_[k]);
        double here = 1.5 * deviation.size();
        if (here >= least || !explains(k, set)) continue;
        for (std::size_t c = 0; c < conventions().size(); ++c)
          if (deviation & set & one(c))
            here += 0.01 * static_cast<double>(contradicting(c, by_common).size());
        if (here < least) least = here, e[k] = set;
      }
      cost += least;
    }
    return {e, cost};
  }

  const std::vector<Probed>& all_;
  std::vector<Mask> affecting_;
  std::vector<std::vector<Mask>> few_;  ///< of each operation: no convention, each one, each two
  std::map<std::pair<std::size_t, Mask>, bool> known_;
};

/// "a, b and c", with at most eight names.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  const std::size_t shown = names.size() > most ? most - 1 : names.size() - 1;
  const std::string last =
      names.size() > most ? fmt::format("{} others", names.size() - shown) : names.back();
  if (shown == 0) return last;
  return fmt::format("{} and {}", fmt::join(names.begin(), names.begin() + std::ptrdiff_t(shown), ", "),
                     last);
}

/// The arguments as text of at most one line of 100 characters.
std::string shortened(const Operation& o, Numbers arguments) {
  std::string text;
  for_each_argument(o, arguments, [&](const Layout& l, std::span<const double> x) {
    text += fmt::format("{}{} = ({:.6g})", text.empty() ? "" : ", ", l.name, fmt::join(x, ", "));
  });
  return text.size() > 100 ? text.substr(0, text.rfind(',', 96)) + ", ..." : text;
}

/// Two lines: the first number that is wrong, and where.
std::string unexplained(const Probed& p) {
  const Operation& o = *p.operation;
  for (const Answer& a : p.answers) {
    const Numbers right = reference(o, a.arguments);
    const Part* const part = wrong_part(result_of(o), a.result, right);
    if (!part) continue;
    std::size_t from = 0;
    for (const Part* before = result_of(o).parts.begin(); before != part; ++before)
      from += static_cast<std::size_t>(before->size);
    const auto size = static_cast<std::size_t>(part->size);
    const std::span got = std::span(a.result).subspan(from, size),
                    expected = std::span(right).subspan(from, size);
    double largest = 0;
    for (const double x : expected) largest = std::max(largest, std::fabs(x));
    std::size_t first = size, wrong = 0;
    for (std::size_t i = size; i-- > 0;)
      if (!(std::fabs(got[i] - expected[i]) <= probe_tolerance * largest)) first = i, ++wrong;
    return fmt::format(
        "no known convention explains {}: its {} is {:.6g}, and {:.6g} is right; {} of {} numbers "
        "of {} {} wrong\n  at {}",
        o.name, number_name(*part, first), got[first], expected[first], wrong, size, part->name,
        wrong == 1 ? "is" : "are", shortened(o, a.arguments));
  }
  return "";
}

}  // namespace

std::vector<Finding> explain(const std::vector<Probed>& all) {
  Search search(all);
  const Explanation e = search.run();
  const auto names = [&](const std::vector<std::size_t>& ks) {
    std::vector<std::string> list;
    for (const std::size_t k : ks) list.emplace_back(all[k].operation->name);
    return list;
  };
  std::vector<Finding> findings;
  for (std::size_t c = 0; c < conventions().size(); ++c) {
    std::vector<std::size_t> those;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (e[k] && *e[k] & one(c)) those.push_back(k);
    if (those.empty()) continue;
    const auto others = search.contradicting(c, e);
    std::string sentence = conventions()[c].meaning;
    bool several = false;
    for (std::size_t d = 0; d < conventions().size(); ++d) {
      const bool as_good = d != c && std::ranges::all_of(those, [&](std::size_t k) {
                             return search.affects(d, k) && !(*e[k] & one(d)) &&
                                    search.explains(k, (*e[k] & ~one(c)) | one(d));
                           });
      Explanation by_d = e;
      for (const std::size_t k : those) by_d[k] = (*e[k] & ~one(c)) | one(d);
      if (as_good && search.contradicting(d, by_d).size() <= others.size())
        sentence += fmt::format(", or {}", conventions()[d].meaning), several = true;
    }
    if (several)
      sentence += " (these operations do not tell which)";
    else if (conventions()[c].side != Side::both)
      sentence += ",";  // behind "but only as results"
    sentence += " in " + listed(names(those));
    if (!others.empty()) sentence += ", but not in " + listed(names(others));
    sentence += fmt::format(": {}", conventions()[c].advice);
    const Statement& s = conventions()[c].statement;
    if (conventions()[c].exact && others.empty())
      sentence += fmt::format(", or state \"{}\": \"{}\"", s.name, s.value);
    findings.push_back({others.size() < those.size(), sentence, names(those)});
  }
  for (std::size_t k = 0; k < all.size(); ++k)
    if (!e[k]) findings.push_back({false, unexplained(all[k]), names({k})});
  return findings;
}

}  // namespace liecheck::properties::conventions
