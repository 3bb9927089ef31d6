#pragma once
// The corpus and the laws on one subject in one environment, and what became of each case beside another environment.

#include <campaign/selection.hpp>
#include <cstdint>
#include <environments/environments.hpp>
#include <functional>
#include <hard_cases/corpus.hpp>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace liecheck::properties::environments {

struct MeasureOptions {
  std::uint64_t cases = 200;  ///< of each law and scalar
  std::uint64_t seed = 42;
  unsigned jobs = 1;
  bool hard_cases = true;
  std::vector<std::string> properties = {}, scalars = {};
  /// The share of the cases that is done. Threads call it one after another.
  std::function<void(double)> progress = {};
};

/// One measurement of a case.
struct Verdict {
  std::uint16_t output = 0;
  Outcome outcome = Outcome::measured;
  bool failed = false, ill_posed = false;
  /// It has a verdict, and no failure.
  bool right() const { return !failed && !leaves_open(outcome); }
  double error = 0;  ///< [eps], or [eps kappa] where the excess rule holds
  double limit = 0;  ///< in the same unit
};

struct Case {
  std::vector<Verdict> verdicts;
  bool small = false;  ///< a number of the input is subnormal, or loses digits: 0 < |x| < min_normal/eps
  std::string id;      ///< of a replay
  std::vector<std::pair<std::size_t, std::size_t>>
      calls;                                   ///< hashes of arguments and result, of generated cases
  std::vector<std::uint16_t> call_operations;  ///< of `calls`: indices of Measured::operations
};

struct Measured {
  struct Law {
    std::string property, scalar;
    std::vector<std::string> outputs, blocks;  ///< operations and blocks
    std::vector<Case> cases;                   ///< the generated ones, then the hard cases
  };
  std::vector<Law> laws;
  std::vector<std::string> operations;
};

/// Runs every case on the subject, with its calls in `mode`. Returns nothing if stop_requested.
std::optional<Measured> measure(const std::string& subject, Profile profile, const FloatMode& mode,
                                const MeasureOptions& options);

/// One operation in one scalar.
struct Figures {
  std::uint64_t cases = 0, calls = 0, same_calls = 0, same_verdicts = 0;
  std::uint64_t small = 0;  ///< not judged: Promise::flushed
  std::uint64_t worse = 0;  ///< beyond what is expected, where the other environment is stable or refuses
  std::uint64_t not_finite = 0, wrong_branch = 0,
                refused = 0;  ///< where it has a finite result on the right branch
  double of_limit = 0;        ///< the largest error over its limit
  double digits_lost = 0;     ///< the most that one case loses
  std::string worst, block;   ///< the case and the block of the largest of them

  void add(const Figures& other);
};

/// By operation and scalar: `now` beside `before`.
std::map<std::pair<std::string, std::string>, Figures> compared(const Measured& before, const Measured& now,
                                                                Promise promise);

}  // namespace liecheck::properties::environments
