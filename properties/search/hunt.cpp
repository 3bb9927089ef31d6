#include <search/hunt.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <campaign/series.hpp>
#include <chrono>
#include <search/mutations.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t islands = 4;
constexpr double sampling_share = 0.2;  ///< part of the evaluations before the first climb

struct Elite {
  double score = -1;
  std::vector<double> x;
};

CaseId raw_id(const std::vector<double>& x) {
  CaseId id;
  id.raw = true;
  for (const double v : x) id.input.push_back(hexadecimal_float(v));
  return id;
}

/// The figure that is maximised. It is negative for a case that is ill-posed, or whose budget has the rule
/// excess although the error is maximised; the search ignores these cases.
double score_of(const Worst& w, const Judged& j) {
  if (j.budget->rule == Rule::forward) return j.residual.error;
  return w.by_kappa && !j.ill_posed ? j.excess : -1.0;
}

/// The archive of one output: the worst input of each band and island, and the worst of all.
struct Climb {
  Worst worst;
  const Scalar* scalar;
  std::vector<double> x;
  std::vector<std::pair<std::uint64_t, double>> history;
  std::vector<std::array<Elite, islands>> cells;

  /// The worst input of three random cells or, with probability 1/3, of all cells.
  const Elite* pick(Source& source, std::size_t island) const {
    const Elite* best = nullptr;
    const bool all = source.chance(1, 3);
    for (std::size_t k = 0; k < (all ? cells.size() : 3); ++k) {
      const Elite& e = cells[all ? k : source.below(cells.size())][island];
      if (!e.x.empty() && (!best || e.score > best->score)) best = &e;
    }
    return best;
  }

  /// Stores the input if its measurement is the worst of its band and island, or of all.
  void take(const Judged& j, const std::vector<double>& input, std::size_t island, std::uint64_t evaluation) {
    // A refusal concerns all blocks of an operation, although it is recorded under one.
    if (worst.output != j.residual.output && j.residual.outcome != Outcome::refused) return;
    if (j.residual.outcome == Outcome::outside_domain) return;
    if (leaves_open(j.residual.outcome) && worst.open++ == 0) worst.first_open_id = raw_id(input);
    if (j.residual.outcome != Outcome::measured) {
      if (!j.failed) return;
      if (worst.broken++ == 0) worst.first_broken = j, worst.first_broken_id = raw_id(input);
      WorstOfBand& b = worst.bands[j.residual.band];
      if (b.broken++ == 0) b.outcome = j.residual.outcome;
      return;
    }
    const double score = score_of(worst, j);
    if (!(score >= 0)) return;
    worst.bands[j.residual.band].score = std::max(worst.bands[j.residual.band].score, score);
    Elite& e = cells[j.residual.band][island];
    if (score >= e.score) e = {score, input};
    if (score > worst.score) {
      worst.score = score, worst.judged = j, worst.at = evaluation, x = input;
      history.push_back({evaluation, score});
    }
  }

  /// The worst case with its input, and when the search came within a factor of two of it.
  Worst summary() const {
    Worst w = worst;
    w.id = raw_id(x);
    for (const double v : x) w.decimal.push_back(decimal_float(v, *scalar));
    for (const auto& [at, score] : history)
      if (score >= w.score / 2) {
        w.half_at = at;
        break;
      }
    return w;
  }
};

/// The outputs to search, each with the figure that is maximised.
std::vector<Worst> objectives_of(const Series& series, const HuntOptions& options, const Limits& limits) {
  std::vector<Worst> all;
  for (std::size_t i = 0; i < series.outputs.size(); ++i) {
    const Output& o = series.outputs[i];
    if (o.operation != options.operation || (!options.block.empty() && o.block != options.block)) continue;
    Worst w;
    w.output = static_cast<int>(i);
    w.by_kappa = limits[i].budgets[0]->rule == Rule::excess && limits[i].budgets[1]->rule == Rule::excess;
    all.push_back(w);
  }
  return all;
}

HuntResult hunt_in(const Series& series, const HuntOptions& options) {
  // With `excess` every case is judged by error / kappa, whatever rule its budget has.
  static const Budget ratio{"", "", "any", Rule::excess, -1, ""};
  Limits limits = series.limits();
  if (options.excess)
    for (OutputLimits& l : limits) l.budgets = {&ratio, &ratio};
  const Property& law = series.tested_law();
  const Mutations mutations(series.fields, series.format());
  Source source(sha256(fmt::format("hunt.{}.{}.{}.{}.{}", options.seed, options.random, series.property,
                                   series.scalar, options.operation)));
  std::vector<Climb> climbs;
  for (const Worst& w : objectives_of(series, options, limits)) {
    climbs.push_back({w, &series.format(), {}, {}, {}});
    climbs.back().cells.resize(series.bands().all().size());
    climbs.back().worst.bands.resize(series.bands().all().size());
  }
  HuntResult result;
  if (climbs.empty()) return result;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };

  const auto evaluate = [&](const std::vector<double>& x, std::size_t island) {
    ++result.evaluations;
    try {
      for (const Judged& j : series.measure(x, limits))
        if (!series.expected(j.residual.output, j.residual.band))
          if (series.outputs.at(static_cast<std::size_t>(j.residual.output)).operation == options.operation)
            for (Climb& c : climbs) c.take(j, x, island, result.evaluations);
    } catch (const GivenUp&) {  // the search ends
      --result.evaluations;
    }
  };

  double share = 0;
  for (std::uint64_t step = 0, attempts = 0; share < 1 && !stop_requested; ++step) {
    const std::size_t island = step % islands, target = step / islands % climbs.size();
    std::vector<double> x;
    const Elite* from = options.random || share < sampling_share || source.chance(1, 50)
                            ? nullptr
                            : climbs[target].pick(source, island);
    if (from) {
      x = from->x;
      mutations.apply(x, law.generate(source), source);
      // An invalid input costs no evaluation. Every 64th one is replaced by a generated input.
      if (!law.valid(x) && ++attempts % 64 != 0) {
        if (options.evaluations == 0) share = elapsed() / options.seconds;
        continue;
      }
    }
    if (x.empty() || !law.valid(x)) {
      x = law.generate(source);
      if (options.random || step % 4 == 3) mutations.uniform(x, source);  // a smooth error may peak anywhere
    }
    if (law.valid(x))
      evaluate(x, island);
    else
      ++result.evaluations;  // valid() rejects this generated input, so it is not measured
    share = options.evaluations
                ? static_cast<double>(result.evaluations) / static_cast<double>(options.evaluations)
                : elapsed() / options.seconds;
    if (options.progress && step % 64 == 0)
      options.progress(result.evaluations, share, climbs[target].worst.score);
  }
  result.stopped = stop_requested;
  result.elapsed = elapsed();
  for (Climb& c : climbs) result.worst.push_back(c.summary());
  return result;
}

}  // namespace

HuntResult hunt(const Series& series, const HuntOptions& options) {
  HuntResult result = hunt_in(series, options);
  for (Worst& w : result.worst)
    for (CaseId* id : {&w.id, &w.first_broken_id, &w.first_open_id})
      id->property = series.property, id->subject = series.subject, id->scalar = series.scalar,
      id->robot = series.robot;
  return result;
}

}  // namespace liecheck::properties
