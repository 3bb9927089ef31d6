#pragma once
// Worst-case search: the input on which one operation of one subject errs most.
//
// A random sweep over the bands fills an archive with the worst input of each band and output; then each step
// takes one of them, moves it (moves.hpp) and keeps the result where it is the worst of its band so far, as
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

/// What a search needs to know of a series.
template <class S>
struct HuntProblem {
  std::vector<Field> fields;
  std::vector<Worst> objectives;  ///< output and by_kappa set
  std::size_t bands = 1;
  std::string key;  ///< names the stream of random bits
  std::function<std::vector<S>(Source&)> generate;
  std::function<bool(const std::vector<S>&)> valid;
  std::function<std::vector<Judged>(const std::vector<S>&)> measure;
  /// What is maximised; negative where the case is outside the hunt.
  std::function<double(const Worst&, const Judged&)> score;
};

/// Stops early at stop_requested. Deterministic for a number of evaluations.
template <class S>
HuntResult hunt_worst(const HuntProblem<S>& problem, const HuntOptions& options);

}  // namespace liecheck::properties
