#include <failures/blocks.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/expected.hpp>
#include <cmath>
#include <failures/result.hpp>
#include <iterator>
#include <map>
#include <search/condition.hpp>
#include <set>
#include <tuple>

namespace liecheck::properties {

namespace {
constexpr std::string_view not_finite = "NaN or Inf", refused = "refused";
}  // namespace

std::vector<std::pair<std::uint64_t, const char*>> outcomes(const Row& r) {
  std::vector<std::pair<std::uint64_t, const char*>> all{
      {r.crashed, "crashed"},
      {r.not_finite, not_finite.data()},
      {r.wrong_branch, "wrong branch"},
      {r.refused, refused.data()},
      {r.not_repeatable, "not repeatable"},
      {r.argument_written, "wrote to an argument"},
      {r.output_unwritten, "left output unwritten"},
      {r.environment_changed, "changed the rounding mode or the treatment of subnormals"},
      {r.printed, "wrote to standard output"}};
  std::erase_if(all, [](const auto& o) { return o.first == 0; });
  return all;
}

double score_of(const BandOf& b) {
  const Budget& budget = b.series->budget(b.output, b.series->bands()[b.band].region);
  return budget.rule == Rule::forward ? b.row->max_error : b.row->max_excess;
}

namespace {

/// Whether a band has angles that are neither small nor near pi.
bool is_moderate(const Band& b) {
  return (b.axis == Axis::theta && b.high == 1) || (b.axis == Axis::none && b.region == Region::to_pi);
}

/// Larger is worse: the kind of outcome, then the error, or the share of the cases with an outcome.
std::pair<int, double> badness(const BandOf& b) {
  const Row& r = *b.row;
  const std::string outcome = worst_outcome(r);
  const int kind = r.crashed ? 5 : outcome == not_finite ? 4 : r.wrong_branch ? 3 : outcome.empty() ? 0 : 2;
  return {kind, kind > 0 ? static_cast<double>(r.failed) / static_cast<double>(r.inside()) : score_of(b)};
}

/// Whether a failure has the outcome of a worse one and, if that is an error, loses as many digits but one.
bool is_as_bad(const BandOf& b, const BandOf& worst) {
  const auto [kind, error] = badness(b);
  const auto [worst_kind, largest] = badness(worst);
  const double all_digits = 1 / b.series->eps;
  return kind == worst_kind &&
         (kind > 0 || 10 * std::min(error, all_digits) >= std::min(largest, all_digits));
}

/// Larger is plainer for a reader: moderate angles, then those that are farther from 0 and pi, then all others.
double plainness(const Band& b) {
  if (is_moderate(b)) return 1;
  if (b.axis == Axis::none) return -400;
  return std::log10(b.low > 0 ? b.low : b.axis == Axis::theta ? 1e-308 : 1e-17);
}

/// A power of ten as 1e-7, any other number with three digits.
std::string short_number(double x) {
  const int e = static_cast<int>(std::lround(std::log10(x)));
  if (x < 1e-100) return fmt::format("1e{}", static_cast<int>(std::floor(std::log10(x))));
  return std::fabs(std::log10(x) - e) < 0.2 && e != 0 ? fmt::format("1e{}", e) : fmt::format("{:.3g}", x);
}

/// The edge of a band below it (`low`) or above it, in words.
std::string edge(const Band& b, bool low) {
  if (b.axis == Axis::theta) return low ? b.low > 0 ? short_number(b.low) : "0" : short_number(b.high);
  if (b.axis == Axis::pi_minus_theta) {
    const double from_pi = low ? b.high : b.low;
    return from_pi > 0 ? "pi - " + short_number(from_pi) : "pi";
  }
  if (b.region == Region::to_pi) return low ? "1" : "pi - 1";
  return low                         ? b.low < 4    ? "pi"
                                       : b.low < 10 ? "near 2 pi k"
                                                    : "100"
         : b.high > 0 && b.high < 10 ? "2 pi"
                                     : "huge";
}

/// The bands first..last, which follow each other, in words.
std::string run_text(const Bands& bands, std::size_t first, std::size_t last) {
  const Band &a = bands[first], &b = bands[last];
  if (first == last && a.axis == Axis::theta && a.high == 0) return "theta = 0";
  if (first == last && a.region == Region::beyond_pi) return a.name;
  if (first == last && a.axis == Axis::pi_minus_theta && a.low == 0) return "theta = pi";
  if (a.axis == Axis::theta && a.low == 0 && b.axis == Axis::theta) return "theta < " + edge(b, false);
  if (first != last && edge(b, false) == "huge") return fmt::format("theta > {}", edge(a, true));
  if (a.axis == Axis::pi_minus_theta && b.axis == Axis::pi_minus_theta)
    return b.low == 0 ? "pi - theta < " + short_number(a.high)
                      : fmt::format("pi - theta {} to {}", short_number(b.low), short_number(a.high));
  return fmt::format("theta {} to {}", edge(a, true), edge(b, false));
}

/// Whether a band has less than 20 cases in each law.
bool is_thin(const FailedBlock& f, std::size_t band) {
  return std::ranges::all_of(f.bands,
                             [&](const BandOf& b) { return b.band != band || b.row->inside() < 20; });
}

}  // namespace

bool is_ordinary(const Band& b) {
  constexpr double near = 0.99e-8;  // below the edge of a band at 1e-8, which is rounded
  if (b.axis == Axis::none) return b.region == Region::to_pi || (b.high > 0 && b.high < 10);
  return b.low >= near || (b.axis == Axis::theta ? b.high == 0 : b.low == 0);
}

std::string outcomes_of(const Row& row) {
  std::string text;
  for (const auto& [number, what] : outcomes(row))
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, what);
  return text;
}

std::string worst_outcome(const Row& row, bool even_if_rare) {
  for (const auto& [n, name] : outcomes(row))
    if (even_if_rare || (name != not_finite && name != refused) || 4 * n >= 3 * row.failed) return name;
  return "";
}

void find_worst(FailedBlock& f) {
  f.worst = nullptr, f.score = 0, f.failed = f.cases = 0;
  const bool ordinary = std::ranges::any_of(f.bands, [](const BandOf& b) {
    return b.fails && b.band > 0 && is_ordinary(b.series->bands()[b.band]);
  });
  for (const BandOf& b : f.bands) {
    if (!b.fails) continue;
    // Band 0 has what is known to have failed in a case, such as a result of another case that changed.
    // A crash comes first. Angles that somebody will meet come before all others.
    const auto place = [](const BandOf& of) {
      const auto [kind, error] = badness(of);
      return std::tuple(of.row->crashed > 0, of.band > 0 && is_ordinary(of.series->bands()[of.band]), kind,
                        of.band > 0, error);
    };
    if (!f.worst || place(b) > place(*f.worst)) f.worst = &b;
    if (!ordinary || is_ordinary(b.series->bands()[b.band])) f.score = std::max(f.score, score_of(b));
    f.failed += b.row->failed, f.cases += b.row->inside();
  }
  if (!f.worst) return;
  const bool of_cases = std::ranges::none_of(f.bands, [](const BandOf& b) { return b.fails && b.band > 0; });
  if (of_cases)  // which pass in their bands
    for (const BandOf& b : f.bands) f.cases += b.fails ? 0 : b.row->inside();
  // The plainest of those that are as bad is its example, unless few cases fail there, as where the result of another case
  // was found to change.
  const BandOf& worst = *f.worst;
  const auto plain = [](const BandOf& b) { return plainness(b.series->bands()[b.band]); };
  const auto share = [](const BandOf& b) { return double(b.row->failed) / double(b.row->inside()); };
  for (const BandOf& b : f.bands)
    if (b.fails && (b.band > 0) == (worst.band > 0) && is_as_bad(b, worst) && 4 * share(b) > share(worst) &&
        plain(b) > plain(*f.worst))
      f.worst = &b;
}

std::vector<FailedBlock> failed_blocks(const CampaignResult& campaign) {
  std::map<std::tuple<std::string, std::string, std::string, std::string>, FailedBlock> all;
  for (const auto& [series, tally] : campaign.series)
    for (const auto& [cell, row] : tally.rows) {
      if (row.inside() == 0) continue;
      const auto output = static_cast<std::size_t>(cell.first), band = static_cast<std::size_t>(cell.second);
      const Output& o = series->outputs.at(output);
      FailedBlock& f = all[{series->subject, series->scalar, std::string(o.operation), std::string(o.block)}];
      const bool unexpected = fails(*series, cell, row);
      f.bands.push_back({series.get(), output, band, &row, unexpected, row.failed > 0 && !unexpected});
    }
  std::vector<FailedBlock> failed;
  for (auto& [key, f] : all) {
    std::tie(f.subject, f.scalar, f.operation, f.block) = key;
    std::ranges::stable_sort(f.bands, {}, &BandOf::band);
    find_worst(f);
    if (f.worst) failed.push_back(std::move(f));
  }
  std::ranges::stable_sort(failed, std::greater(),
                           [](const FailedBlock& f) { return std::pair(badness(*f.worst).first, f.score); });
  return failed;
}

bool fail_together(const FailedBlock& a, const FailedBlock& b) {
  return a.scalar == b.scalar && std::ranges::any_of(a.bands, [&](const BandOf& x) {
           return x.fails && std::ranges::any_of(b.bands, [&](const BandOf& y) {
                    return y.fails && x.band <= y.band + 1 && y.band <= x.band + 1;
                  });
         });
}

bool passes_where_most_fail(const FailedBlock& f, const FailedBlock& other) {
  std::size_t wrong = 0, right = 0;
  for (const BandOf& b : other.bands) {
    if (!b.fails || b.band == 0 || 2 * b.row->failed < b.row->inside() || !(b.row->worst_score > 1e4))
      continue;
    std::uint64_t cases = 0, failed = 0;
    for (const BandOf& own : f.bands)
      if (own.band == b.band) cases += own.row->inside(), failed += own.row->failed;
    if (cases > 2) ++wrong, right += failed == 0;
  }
  return f.scalar == other.scalar && wrong > 2 && 2 * right > wrong;
}

bool share_bands(const FailedBlock& a, const FailedBlock& b) {
  std::set<std::size_t> of_a, of_b, both;
  for (const BandOf& x : a.bands)
    if (x.fails) of_a.insert(x.band);
  for (const BandOf& x : b.bands)
    if (x.fails) of_b.insert(x.band);
  std::ranges::set_intersection(of_a, of_b, std::inserter(both, both.end()));
  return a.scalar == b.scalar && 3 * both.size() >= of_a.size() + of_b.size();
}

double ordinary_loss(const FailedBlock& f) {
  double failed = 0, cases = 0, digits = 0;
  const double eps = f.worst->series->eps;
  for (const BandOf& b : f.bands) {
    if (!is_ordinary(b.series->bands()[b.band])) continue;
    cases += static_cast<double>(b.row->inside());
    if (!b.fails) continue;
    failed += static_cast<double>(b.row->failed);
    const double score = std::clamp(b.row->worst_score, 1.0, 1 / eps);
    digits = std::max(digits, std::log(score) / -std::log(eps));
  }
  return cases > 0 ? failed / cases * digits : 0;
}

std::string what_of(const FailedBlock& f) {
  if (std::string outcome = worst_outcome(*f.worst->row); !outcome.empty()) return outcome;
  std::string lost = digits_lost(f.score, f.worst->series->eps);
  if (lost.empty()) lost = fmt::format("{:.3g} eps", f.score);
  std::uint64_t none = 0;
  for (const BandOf& b : f.bands) none += b.fails ? b.row->not_finite : 0;
  if (none > 0) lost += fmt::format(", {} in {} of {} failures", not_finite, none, f.failed);
  return lost;
}

bool fails_otherwise(const FailedBlock& f, const BandOf& b) {
  return b.fails && worst_outcome(*b.row) != worst_outcome(*f.worst->row);
}

std::string where_of(const FailedBlock& f) {
  const Bands& bands = f.worst->series->bands();
  std::map<std::size_t, bool> fails;  // by band: fails in one of the laws
  for (const BandOf& b : f.bands)
    if (b.band > 0) fails[b.band] = fails[b.band] || b.fails;
  const auto count = std::ranges::count_if(fails, [](const auto& b) { return b.second; });
  if (count == 0 || count == std::ssize(fails)) return "everywhere";
  // A band of few cases that passes between two that fail is no border of the region.
  for (auto at = fails.begin(); at != fails.end(); ++at)
    if (const auto next = std::next(at); !at->second && at != fails.begin() && next != fails.end())
      at->second = std::prev(at)->second && next->second && is_thin(f, at->first);
  std::vector<std::string> runs;
  for (auto at = fails.begin(); at != fails.end(); ++at) {
    if (!at->second) continue;
    const std::size_t first = at->first;
    std::size_t last = first;
    for (; at != fails.end() && at->second; ++at) last = at->first;
    runs.push_back(run_text(bands, first, last));
    if (at == fails.end()) break;
  }
  if (runs.size() <= 4) return fmt::format("{}", fmt::join(runs, ", "));
  return fmt::format("{} of {} bands, worst in {}", count, fails.size(),
                     run_text(bands, f.worst->band, f.worst->band));
}

std::string where_and_how_often(const FailedBlock& f, const CampaignResult& campaign) {
  if (worst_outcome(*f.worst->row) == "not repeatable")
    return fmt::format("found in {} of {} cases in {}; calls are repeated in some of them alone", f.failed,
                       f.cases, f.scalar);
  std::string bands = where_of(f);
  const BandOf& worst = *f.worst;
  const Series& series = *worst.series;
  const bool everywhere = bands == "everywhere", scattered = bands.find(" bands, ") != std::string::npos;
  if (10 * f.failed < 9 * f.cases && f.block != "sign" && worst.row->crashed == 0) {
    std::function<bool(std::size_t)> fails_in;  // of bands that tell something
    if (!scattered)
      fails_in = [&](std::size_t band) {
        return std::ranges::any_of(f.bands, [&](const BandOf& b) { return b.band == band && b.fails; });
      };
    // A number is exactly 0 in few inputs, and others are 0 with it: where three quarters of these pass, it is none.
    if (const auto c = condition_of(series, worst.output, campaign.options.seed, fails_in);
        c && !(4 * c->failed < c->cases && (c->text.ends_with(" = 0") || c->text.ends_with(" is 0"))))
      return fmt::format("{}{}{}: {} of {} cases in {}, elsewhere {} of {}",
                         c->in_bands && !everywhere ? bands + ", and " : "", c->degree(), c->text, c->failed,
                         c->cases, f.scalar, c->failed_elsewhere, c->elsewhere);
    if ((everywhere || scattered) && 2 * f.failed < f.cases)
      bands = "no condition found";
    else if (everywhere)
      bands = "no condition found, in most cases";
  }
  return fmt::format("{}: {} of {} cases in {}", bands, f.failed, f.cases, f.scalar);
}

}  // namespace liecheck::properties
