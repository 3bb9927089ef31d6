#pragma once
// Worst-case search: finds the input with the largest error of one operation of one subject.
//
// Random sampling fills an archive with the worst input of each band and output. Each later step takes one of
// these inputs, mutates it (mutations.hpp) and stores the result if it is the worst of its band so far
// (MAP-Elites, Mouret & Clune 2015). So every decade of angle has its own search, and a mutation may also
// improve another band. Four separate archives (islands) keep the search diverse. The error found is a lower
// bound of the maximum.

#include <campaign/series.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace liecheck::properties {

struct HuntOptions {
  std::string operation, block;  ///< an empty block: every block of the operation
  std::uint64_t seed = 42;
  std::uint64_t evaluations = 0;  ///< 0: limited by time
  double seconds = 30;            ///< duration, if no number of evaluations is given
  bool excess = false;            ///< maximise error / kappa instead of the error
  bool random = false;            ///< sample at random, as a plain test does, instead of hunting
  std::function<void(std::uint64_t evaluations, double share, double worst)> progress;
};

/// What a search found in one band of one output.
struct WorstOfBand {
  double score = -1;  ///< as Worst::score
  std::uint64_t broken = 0;
  Outcome outcome = Outcome::measured;  ///< of the first broken one
};

/// The worst input of one output.
struct Worst {
  int output = 0;
  bool by_kappa = false;  ///< `score` is error / kappa, because of HuntOptions::excess or the budgets' rule
  double score = -1;      ///< eps or eps kappa; negative if nothing was measured
  Judged judged;
  CaseId id;  ///< a raw case
  std::vector<std::string> decimal;
  std::uint64_t at = 0;       ///< the evaluation that found it
  std::uint64_t half_at = 0;  ///< the first evaluation within a factor of two of `score`
  std::uint64_t broken = 0;   ///< number of results that are NaN, Inf, wrong branch or refused
  Judged first_broken;
  CaseId first_broken_id;
  std::uint64_t open = 0;  ///< number of evaluations without a verdict: unresolved or unmeasured
  CaseId first_open_id;
  std::vector<WorstOfBand> bands;
};

struct HuntResult {
  std::vector<Worst> worst;  ///< by output; empty if the series does not measure the operation
  std::uint64_t evaluations = 0;
  double elapsed = 0;  ///< s
  bool stopped = false;
};

/// Searches for the worst input of each block of an operation that the series measures, outside the inputs where
/// the subject's limits file expects a failure. Stops early at
/// stop_requested. The result is deterministic for a given number of evaluations.
HuntResult hunt(const Series& series, const HuntOptions& options);

}  // namespace liecheck::properties
