#pragma once
// Results of the laboratory as records: how soon known bugs are found, and how many cases run per second.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace liecheck::properties {

/// How soon a known bug was found, or whether a look-alike was refused.
struct BugRow {
  std::string name, fault, origin;
  bool killed = false;
  std::string by;            ///< law, operation and block that failed
  std::string not_measured;  ///< of a look-alike: what a law did not measure or the oracle did not resolve
  std::uint64_t cases = 0;
  double seconds = 0;
  std::vector<std::pair<std::string, bool>> weaker_styles;  ///< name, and whether it finds the bug

  bool alike() const { return name.rfind("alike:", 0) == 0; }
};

struct BugBench {
  std::uint64_t seed = 42;
  std::string scalar;
  double seconds_each = 60;
  std::vector<BugRow> rows;
  bool complete = false;  ///< every subject had its time

  /// The number of look-alikes or of bugs, or only of those that were killed.
  std::size_t count(bool alike, bool only_killed = false) const;
  /// Whether every case of the look-alikes has a verdict.
  bool measured() const;
  /// Whether every bug was killed and no look-alike refused.
  bool passed() const { return count(false, true) == count(false) && count(true, true) == 0; }
};

nlohmann::json record_of(const BugBench& bench);

struct HistoryBench;
nlohmann::json record_of(const HistoryBench& bench);

struct LatticeResult;
nlohmann::json record_of(const LatticeResult& result);

struct SpeedBench {
  std::uint64_t seed = 42;
  std::vector<std::pair<std::string, double>> rates;  ///< name, best rate of the rounds [cases/s]
  bool complete = false;               ///< otherwise only the rounds before a signal, and no means
  double all_laws = 0, tree_laws = 0;  ///< harmonic means [cases/s]
  double exp6_over_rapidcheck = 0, two_jobs_over_one = 0;
  int falsified = 0;  ///< how often rc::check failed on exp6; if not 0, the rates of exp6 mean nothing
};

nlohmann::json record_of(const SpeedBench& bench);

/// What it costs to call a function through an adapter.
struct WireBench {
  struct Row {
    std::string name;
    double rate;                ///< the best of the rounds [cases/s]
    double ratio, least, most;  ///< to the first row in the same round: the median, and all
  };
  std::uint64_t seed = 42;
  unsigned jobs = 1;
  std::vector<Row> rows;
  std::uint64_t failed = 0;
  bool complete = false;
};

nlohmann::json record_of(const WireBench& bench);

}  // namespace liecheck::properties
