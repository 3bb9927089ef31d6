#pragma once
// Worst-case search: the input on which one operation of one subject errs most.
//
// A random sweep over the bands fills an archive with the worst input of each band and output; then each step
// takes one of them, mutates it (mutations.hpp) and keeps the result where it is the worst of its band so far, as
// in Mouret & Clune 2015 (MAP-Elites). Every decade of angle is climbed by itself, and a climb that walks into
// another band goes on there. Four islands keep the climbs from being one. What is found is a lower bound.

#include <campaign/series.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace liecheck::properties {

struct HuntOptions {
  std::string operation, block;  ///< an empty block: each of the operation's
  std::uint64_t seed = 42;
  std::uint64_t evaluations = 0;  ///< 0: by time
  double seconds = 30;            ///< where no number of evaluations is given
  bool excess = false;            ///< maximise error / kappa instead of the error
  bool random = false;            ///< sample as a plain test does instead of hunting
  std::function<void(std::uint64_t evaluations, double share, double worst)> progress;
};

/// The worst input of one output.
struct Worst {
  int output = 0;
  bool by_kappa = false;  ///< score is error / kappa: asked for, or the budget's rule everywhere
  double score = -1;      ///< eps or eps kappa; negative where nothing was measured
  Judged judged;
  CaseId id;  ///< raw
  std::vector<std::string> decimal;
  std::uint64_t at = 0;       ///< the evaluation that found it
  std::uint64_t half_at = 0;  ///< the first evaluation within a factor of two of it
  std::uint64_t broken = 0;   ///< NaN, Inf, wrong branch or refused
  Judged first_broken;
  CaseId first_broken_id;
};

struct HuntResult {
  std::vector<Worst> worst;  ///< by output; empty where the series does not measure the operation
  std::uint64_t evaluations = 0;
  double elapsed = 0;  ///< s
  bool stopped = false;
};

/// The worst input of each block of an operation; no block where the series' law does not measure it. Stops early at
/// stop_requested. Deterministic for a number of evaluations.
HuntResult hunt(const Series& series, const HuntOptions& options);

}  // namespace liecheck::properties
