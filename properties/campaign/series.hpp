#pragma once
// A series: the cases of one law on one subject in one scalar.
//
// search/shrink.hpp, search/hunt.hpp, hard_cases/attempt.hpp and failures/program.hpp work on single cases.
// They reach the law and the subject through typed_series.hpp.

#include <budgets/limits.hpp>
#include <campaign/case_id.hpp>
#include <campaign/tally.hpp>
#include <memory>

namespace liecheck::properties {

class Series {
 public:
  virtual ~Series() = default;
  std::string property, subject, subject_version, scalar, robot;
  std::string adapter;  ///< how the subject was given with --adapter, or ""
  bool robot_fixed = false;
  std::string law, equation, source;
  double eps = 0;
  std::vector<Output> outputs;
  std::uint32_t due = 0;  ///< bit i: the subject offers outputs[i], and every case must record it
  std::vector<Field> fields;
  Profile profile = Profile::ours;           ///< judges what `own` does not name
  std::shared_ptr<const SubjectLimits> own;  ///< the limits file that judges the subject, or null
  /// Condition numbers are computed even if an error passes for each of them, so that the excess is exact.
  bool every_kappa = false;

  CaseId id(std::uint64_t seed, std::uint64_t index) const;
  /// The line of the limits file that expects failures of this output in this band, or null.
  const ExpectedFailure* expected(std::size_t output, std::size_t band) const;
  virtual const Bands& bands() const = 0;
  virtual const Budget& budget(std::size_t output, Region region) const = 0;
  /// Generates case `index`, measures it and adds it to the tally.
  virtual void run(std::uint64_t seed, std::uint64_t index, Tally& tally) const = 0;
  virtual std::vector<std::string> input(const CaseId& id) const = 0;  ///< hexadecimal floats
  /// Measures one case twice, the second time with checks of its calls: what differs is not repeatable.
  /// Throws std::invalid_argument for a raw input that the law rejects.
  virtual std::vector<Judged> replay(const CaseId& id) const = 0;
};

/// The first 16 digits of the SHA-256 of a limits file.
std::string hash_of(const SubjectLimits& limits);
/// The profile that judges a subject if the user names none: that of its limits file, or else `careful` for a
/// subject of an adapter.
Profile default_profile(const SubjectLimits* own, bool of_adapter);
/// The flags --adapter, --limits and --profile that the series needs, each with a space before it, or "".
std::string subject_flags(const Series& series);

}  // namespace liecheck::properties
