#pragma once
// `liecheck bench bugs`: how soon the laws kill each known bug, and which weaker styles of test would have.
// `liecheck bench speed`: how many cases a second are measured against an oracle.

#include <campaign/series.hpp>
#include <string>

namespace liecheck::properties {

struct BenchFlags {
  std::string scalar = "double", json;
  std::uint64_t seed = 42;
  double seconds = 60;  ///< for each bug; a tenth of it for each look-alike
};

/// One line a bug. 0 where every bug was killed and no look-alike, 1 otherwise, 3 where it was stopped.
int run_bench(const BenchFlags& flags, const Robot& robot);

/// Cases a second: exp6, beside rc::check with an oracle of 50 digits; every law of liecheck in float and double;
/// two jobs beside one. Five interleaved rounds, of which the best counts. 0, 1 where rc::check falsified exp6, or 3
/// where it was stopped.
int run_speed_bench(const BenchFlags& flags, const Robot& robot);

}  // namespace liecheck::properties
