#include <search/condition.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <invariants/property.hpp>
#include <search/trial.hpp>
#include <span>
#include <support/stop.hpp>

namespace liecheck::properties {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t tried_cases = 2000, least = 3, enough_cases = 1000, enough_failures = 20;
constexpr std::uint64_t enough_elsewhere = 8;  ///< of fewer that pass, a feature separates some by chance
constexpr double most_seconds = 3;             ///< of an idle machine, for slow subjects
constexpr std::size_t most_firsts = 6;         ///< first parts for which a second is searched

// About a thousand ranges are tried. Chance alone makes the best of them gain less than 15 (natural logarithms of
// likelihood), and a border that is no zero or whole number is worth 3.
constexpr double least_gain = 20, gain_of_border = 3;

/// One feature from `low` up to but not `high`.
struct FeatureRange {
  std::size_t feature = 0;
  double low = 0, high = 0;
  bool holds(const Tried& t) const { return t[feature] >= low && t[feature] < high; }
};
/// A range, and how many of some inputs are in it and fail in it.
struct Candidate {
  FeatureRange range;
  std::uint64_t cases = 0, failed = 0;
};

/// How many inputs fail where a condition holds, and where it does not.
struct Counts {
  std::uint64_t failed = 0, cases = 0, failed_elsewhere = 0, elsewhere = 0;
  double inside() const { return cases > 0 ? double(failed) / double(cases) : 0; }
  double all() const { return double(failed + failed_elsewhere) / double(cases + elsewhere); }
  double errors() const { return double(cases - failed + failed_elsewhere); }
  /// How much likelier the failures are with a share inside and one elsewhere than with one share of all.
  double gain() const {
    const auto likelihood = [](std::uint64_t part, std::uint64_t whole) {
      if (part == 0 || part == whole) return 0.0;
      const double share = double(part) / double(whole);
      return double(part) * std::log(share) + double(whole - part) * std::log(1 - share);
    };
    return likelihood(failed, cases) + likelihood(failed_elsewhere, elsewhere) -
           likelihood(failed + failed_elsewhere, cases + elsewhere);
  }
};

class ConditionSearch {
 public:
  ConditionSearch(const Series& series, std::size_t output,
                  const std::function<bool(std::size_t band)>& fails_in)
      : series_(series), trial_(series, output), fails_in_(fails_in) {}

  std::optional<Condition> run(std::uint64_t seed) {
    const auto end = std::chrono::steady_clock::now() + at_this_load(most_seconds);
    for (std::uint64_t i = 0, failed = 0; i < tried_cases; ++i) {
      if (stop_requested || std::chrono::steady_clock::now() > end) break;
      if (i >= enough_cases && failed >= enough_failures) break;
      for (Tried& t : trial_(series_.numbers(series_.id(seed, i))))
        failed += t.failed, all_.push_back(std::move(t));
    }
    if (fails_in_) {
      const Counts of_bands = count_where([&](const Tried& t) { return fails_in_(t.band); });
      if (of_bands.elsewhere > 0) gain_of_bands_ = of_bands.gain();
    }
    if (auto found = separating(); found || !fails_in_) return found;
    std::erase_if(all_, [&](const Tried& t) { return !fails_in_(t.band); });
    in_bands_ = true, gain_of_bands_ = 0;
    return separating();
  }

 private:
  struct Found {
    std::vector<FeatureRange> parts;
    Counts counts;
    double score = -infinity;  ///< the gain without what its borders cost
  };

  std::optional<Condition> separating() {
    const auto failed = static_cast<std::uint64_t>(std::ranges::count_if(all_, &Tried::failed));
    if (failed < least || all_.size() - failed < least) return std::nullopt;
    std::vector<const Tried*> inputs;
    for (const Tried& t : all_) inputs.push_back(&t);
    std::vector<Found> firsts;  // the best of each feature
    Found best;
    const auto search = [&](bool of_several) {
      for (std::size_t i = 0; i < trial_.names().size(); ++i) {
        if (trial_.names()[i].of_several != of_several) continue;
        Found of_feature;
        for (const Candidate& part : candidates(i, inputs)) {
          Found next = with({}, part, inputs.size(), failed, 0);
          const bool little = trial_.names()[i].unit == " eps" && part.range.low < 16;  // it is rounding
          if (is_rounding(trial_.names()[i], part.range.low, part.range.high, in_bands_)) continue;
          if (!holds_for_failures(next.counts)) continue;
          if (next.score > of_feature.score && !little) of_feature = next;
          if (next.score > best.score && is_accepted(next)) best = next;
        }
        if (!of_feature.parts.empty()) firsts.push_back(std::move(of_feature));
      }
    };
    search(false);
    // A second part only where the first leaves much unexplained.
    if (best.counts.inside() < 0.9) {
      std::ranges::stable_sort(firsts, std::greater(), &Found::score);
      if (firsts.size() > most_firsts) firsts.resize(most_firsts);
      const Found alone = best;
      for (const Found& first : firsts) add_second(first, alone, best);
    }
    if (best.parts.empty()) search(true);
    if (best.parts.empty()) return std::nullopt;
    return refined(std::move(best));
  }

  void add_second(const Found& first, const Found& alone, Found& best) const {
    const FeatureName& one = name(first.parts[0]);
    const auto tells_little = [&](const FeatureRange& p) { return name(p).negated && p.low <= 0; };
    // That an input lacks the feature tells little, too, and so does what rounding leaves of a norm.
    const auto lack = [](std::size_t i) { return [i](const Tried& t) { return std::isnan(t[i]); }; };
    if (tells_little(first.parts[0]) || std::ranges::any_of(all_, lack(first.parts[0].feature))) return;
    std::vector<const Tried*> inputs;
    for (const Tried& t : all_)
      if (first.parts[0].holds(t)) inputs.push_back(&t);
    for (std::size_t i = 0; i < trial_.names().size(); ++i) {
      // Of one argument, signs or the kinds of an order may be combined; its zeros and its size follow from each other.
      const FeatureName& other = trial_.names()[i];
      const bool same = !one.argument.empty() && other.argument == one.argument;
      const bool kinds = one.written == other.written && !one.negated && !other.negated &&
                         one.written >= Written::flag && first.parts[0].high != above_zero;
      if (i == first.parts[0].feature || (same && !kinds) || other.of_several) continue;
      if (other.unit == " eps" || std::ranges::any_of(all_, lack(i))) continue;
      for (const Candidate& candidate : candidates(i, inputs)) {
        const FeatureRange& part = candidate.range;
        Found next =
            with(first.parts, candidate, inputs.size(), first.counts.failed, first.counts.failed_elsewhere);
        const bool tells_more = next.counts.inside() >= 1.25 * first.counts.inside() &&
                                next.score >= first.score + least_gain &&
                                next.score >= std::max(0.0, alone.score) + least_gain;
        if (!tells_little(part) && !(same && part.high == above_zero) && tells_more &&
            next.score > best.score && holds_for_failures(next.counts) && is_accepted(next))
          best = std::move(next);
      }
    }
  }

  /// It holds for 95 % of the failing inputs, and of the others at most 2 % fail.
  static bool holds_for_failures(const Counts& c) {
    return 20 * c.failed >= 19 * (c.failed + c.failed_elsewhere) &&
           50 * c.failed_elsewhere <= c.elsewhere + 50;
  }
  /// It must leave out a twentieth of the inputs, or it tells nothing. Where it holds, 90 % fail; or half, if it leaves out a
  /// fifth of all inputs; or a quarter, if that is three times the share of all: a small error is often within its limit. Or
  /// none fails elsewhere, which is no chance.
  bool is_accepted(const Found& f) const {
    const Counts& c = f.counts;
    if (20 * c.elsewhere < all_.size() || c.elsewhere < enough_elsewhere) return false;
    if (c.inside() >= 0.9) return true;
    for (const FeatureRange& part : f.parts)
      if (name(part).angle) return false;
    const bool fifth = 5 * c.elsewhere >= all_.size();
    if (f.parts.size() == 1 &&
        ((c.inside() >= 0.5 && fifth) || (c.inside() >= 0.25 && c.inside() >= 3 * c.all())))
      return true;
    return fifth && c.failed_elsewhere == 0 && c.inside() >= 1.25 * c.all() && f.score >= least_gain &&
           f.score > gain_of_bands_;
  }

  const FeatureName& name(const FeatureRange& part) const { return trial_.names()[part.feature]; }
  /// How many borders of a part are no natural ones: a zero, or those of what has whole numbers.
  int borders(const FeatureRange& part) const {
    if (name(part).written == Written::flag) return 0;
    const auto chosen = [](double border) {
      return std::isfinite(border) && std::fabs(border) > above_zero && border != above_log_of_zero;
    };
    const int all = chosen(part.low) + chosen(part.high);
    return name(part).written == Written::count ? std::min(all, 1) : all;
  }
  template <class Holds>
  Counts count_where(Holds&& holds) const {
    Counts c;
    for (const Tried& t : all_)
      holds(t) ? (++c.cases, c.failed += t.failed) : (++c.elsewhere, c.failed_elsewhere += t.failed);
    return c;
  }
  Counts count(const std::vector<FeatureRange>& parts) const {
    return count_where([&](const Tried& t) {
      return std::ranges::all_of(parts, [&](const FeatureRange& part) { return part.holds(t); });
    });
  }
  /// Parts, of which all but the last hold for so many inputs, and for no others.
  Found with(std::vector<FeatureRange> parts, const Candidate& last, std::uint64_t inputs,
             std::uint64_t failed, std::uint64_t failed_elsewhere) const {
    Found f{std::move(parts), {last.failed, last.cases}, 0};
    f.parts.push_back(last.range);
    f.counts.elsewhere = all_.size() - inputs + (inputs - last.cases);
    f.counts.failed_elsewhere = failed_elsewhere + failed - last.failed;
    f.score = f.counts.gain();
    for (const FeatureRange& part : f.parts) f.score -= gain_of_border * borders(part);
    return f;
  }
  /// The ranges of a feature, open on a side or not, that hold all failing inputs, or all but a twentieth on a side, and leave
  /// out a twentieth of those that have the feature.
  std::vector<Candidate> candidates(std::size_t feature, const std::vector<const Tried*>& inputs) const {
    std::vector<double> of_failed, of_all;
    std::vector<std::uint8_t> fails;  // beside of_all
    std::size_t failed = 0;
    for (const Tried* t : inputs) {
      failed += t->failed;
      if (const double v = (*t)[feature]; v == v) {
        of_all.push_back(v), fails.push_back(t->failed);
        if (t->failed) of_failed.push_back(v);
      }
    }
    if (of_failed.size() < least || 20 * of_failed.size() < 19 * failed) return {};
    const Written written = trial_.names()[feature].written;
    const double zero = written == Written::scale ? above_log_of_zero : above_zero;
    std::vector<Candidate> all;
    const auto add = [&](double from, double to) {
      Candidate c{{feature, from, to}};
      for (std::size_t i = 0; i < of_all.size(); ++i) {
        const bool holds = (of_all[i] >= from) & (of_all[i] < to);
        c.cases += holds, c.failed += holds & fails[i];
      }
      if (from < to && 20 * (of_all.size() - c.cases) >= of_all.size()) all.push_back(c);
    };
    if (written == Written::flag) {
      if (add(zero, infinity); !trial_.names()[feature].unit.empty()) add(-infinity, zero);
      return all;
    }
    add(0, above_zero), add(-infinity, 0), add(0, infinity), add(above_zero, infinity),
        add(-infinity, above_zero);
    if (written == Written::sign) return all;
    std::vector<double> sorted = of_all;
    std::ranges::sort(of_failed), std::ranges::sort(sorted);
    const auto above = [&](double v) {  // the next value that an input has
      const auto at = std::ranges::upper_bound(sorted, v);
      return at == sorted.end() ? infinity : *at;
    };
    const std::size_t few = of_failed.size() / 20;
    const double low = of_failed.front(), high = above(of_failed.back()),
                 most = above(of_failed[of_failed.size() - 1 - few]);
    add(-infinity, of_failed.back() == -infinity ? above_log_of_zero : high);
    add(low, infinity), add(low, high), add(-infinity, most), add(of_failed[few], infinity);
    for (const double to : {high, most})
      if (to < infinity) add(zero, to);
    return all;
  }

  /// Without borders that leave out nearly nothing.
  void simplify(Found& f) const {
    for (std::size_t k = 0; k < f.parts.size(); ++k)
      for (const bool low : {true, false}) {
        if (borders(f.parts[k]) == 0) continue;
        Found simpler = f;
        FeatureRange& part = simpler.parts[k];
        const bool scale = name(part).written == Written::scale;
        const double natural = !low                    ? infinity
                               : std::isinf(part.high) ? part.low
                               : scale                 ? above_log_of_zero
                               : part.high < 0         ? -infinity
                                                       : above_zero;
        if ((low && part.low <= natural) || (!low && part.low < above_zero)) continue;
        (low ? part.low : part.high) = natural;
        simpler.counts = count(simpler.parts);
        const bool same = simpler.counts.gain() >= 0.85 * f.counts.gain() &&
                          simpler.counts.inside() >= 0.9 * f.counts.inside();
        if (same && simpler.counts.elsewhere > 0) f = std::move(simpler);
      }
  }

  Condition refined(Found f) {
    simplify(f);
    for (std::size_t k = 0; k < f.parts.size(); ++k)
      for (const bool low : {true, false}) refine(f, k, low);
    std::ranges::stable_sort(f.parts, std::greater(),
                             [&](const FeatureRange& part) { return borders(part); });
    const FeatureRange& main = f.parts.front();
    Condition c;
    c.in_bands = in_bands_;
    c.feature = name(main).feature, c.low = main.low, c.high = main.high;
    for (const FeatureRange& part : f.parts)
      c.text += (c.text.empty() ? "" : " and ") + text_of(name(part), part.low, part.high, series_.format());
    c.failed = f.counts.failed, c.cases = f.counts.cases;
    c.failed_elsewhere = f.counts.failed_elsewhere, c.elsewhere = f.counts.elsewhere;
    for (const Tried& t : all_)
      if (t.failed && (f.parts.size() == 1 || f.parts.back().holds(t)))
        c.errors.emplace_back(t[main.feature], t.error * series_.eps);
    std::ranges::sort(c.errors);
    return c;
  }
  /// Moves a border of a part to where inputs between a failing and a passing one change.
  void refine(Found& f, std::size_t k, bool low) {
    const FeatureRange part = f.parts[k];
    const double border = low ? part.low : part.high;
    if (std::fabs(border) <= above_zero || border == above_log_of_zero || !std::isfinite(border)) return;
    const auto value = [&](const Tried& t) { return t[part.feature]; };
    const auto others_hold = [&](const Tried& t) {
      return std::ranges::all_of(f.parts,
                                 [&](const FeatureRange& p) { return &p == &f.parts[k] || p.holds(t); });
    };
    const Tried* in = nullptr;  // the nearest to the border
    std::vector<const Tried*> outs;
    for (const Tried& t : all_) {
      const double v = value(t);
      if (v != v || !others_hold(t)) continue;
      if (t.failed && part.holds(t) && (!in || (low ? v < value(*in) : v > value(*in)))) in = &t;
      if (!t.failed && (low ? v < border : v >= border)) outs.push_back(&t);
    }
    if (!in) return;
    if (name(part).written == Written::count) return low ? lower(f, k, *in) : void();
    if (name(part).written > Written::scale) return;
    std::ranges::stable_sort(outs, {}, [&](const Tried* t) { return low ? -value(*t) : value(*t); });
    // Inputs between two may pass for another reason, before the border: three are tried.
    std::optional<std::pair<double, double>> best;  // inside, outside
    int left = 3;
    for (const Tried* out : outs) {
      if (stop_requested || input_between(series_, in->input, out->input, 0.5).empty()) continue;
      if (left-- == 0) break;
      const auto border_to = searched(part, *in, *out);
      if (!best || (low ? border_to.first < best->first : border_to.first > best->first)) best = border_to;
    }
    if (best) move(f, k, low, between(part, best->first, best->second));
  }
  /// The feature of the last failing and of the first passing input that bisection between two finds.
  std::pair<double, double> searched(const FeatureRange& part, const Tried& in, const Tried& out) {
    double inside = in[part.feature], outside = out[part.feature];
    std::vector<double> a = in.input, b = out.input;
    const auto closer = [&](double share) {
      const std::vector<double> x = input_between(series_, a, b, share);
      if (x.empty() || x == a || x == b || !series_.tested_law().valid(x)) return false;
      const auto tried = trial_(x);
      if (tried.size() != 1 || (in_bands_ && !fails_in_(tried[0].band))) return false;
      const double v = tried[0][part.feature];
      if (!(v >= std::min(inside, outside) && v <= std::max(inside, outside))) return false;
      (tried[0].failed ? inside : outside) = v;
      (tried[0].failed ? a : b) = x;
      return true;
    };
    const double shares[] = {0.5, 0.25, 0.75, 0.1, 0.9};  // a vector between two may be shorter than both
    for (int i = 0; i < 40 && a.size() == b.size() && !stop_requested; ++i)
      if (std::ranges::none_of(shares, closer)) break;
    return {inside, outside};
  }
  /// Takes joints from the input until it passes.
  void lower(Found& f, std::size_t k, const Tried& failing) {
    double low = f.parts[k].low;
    for (std::vector<double> x = failing.input; !stop_requested;) {
      x = without_last_joint(series_, x);
      if (x.empty() || !series_.tested_law().valid(x)) break;
      const auto tried = trial_(x);
      const auto fails = std::ranges::find_if(tried, &Tried::failed);
      if (fails == tried.end()) break;
      if (const double v = (*fails)[f.parts[k].feature]; v < low) low = v;
    }
    move(f, k, true, low);
  }
  void move(Found& f, std::size_t k, bool low, double to) const {
    std::vector<FeatureRange> moved = f.parts;
    (low ? moved[k].low : moved[k].high) = to;
    const Counts c = count(moved);
    // Where some inputs pass on either side, a failing one a little beyond tells more than counts.
    const std::uint64_t n = f.counts.cases, outside = f.counts.failed_elsewhere + c.failed_elsewhere;
    const bool necessary = outside == 0 && c.cases >= n && 10 * c.cases < 13 * n;
    if (necessary || c.errors() <= f.counts.errors()) f.parts = moved, f.counts = c;
  }
  /// The border between two values, in the unit in which it is written.
  double between(const FeatureRange& part, double inside, double outside) const {
    if (name(part).written == Written::scale) {  // not the shortest logarithm
      const double most = series_.format().max_exponent, a = std::exp2(inside * most),
                   b = std::exp2(outside * most), size = std::log2(shortest_between(a, b)) / most;
      if (std::isfinite(size)) return size;
    }
    const double unit = name(part).unit == " eps" ? series_.format().epsilon : 1;
    return shortest_between(inside * unit, outside * unit) / unit;
  }

  const Series& series_;
  TrialOfFeatures trial_;
  const std::function<bool(std::size_t band)>& fails_in_;
  double gain_of_bands_ = 0;  ///< a condition without which none fails must tell more than the bands do
  bool in_bands_ = false;
  std::vector<Tried> all_;
};

}  // namespace

std::optional<Condition> condition_of(const Series& series, std::size_t output, std::uint64_t seed,
                                      const std::function<bool(std::size_t band)>& fails_in) try {
  return ConditionSearch(series, output, fails_in).run(seed);
} catch (const GivenUp&) {  // a signal ended a call
  return std::nullopt;
}

}  // namespace liecheck::properties
