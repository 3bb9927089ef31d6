#pragma once
// A series: the cases of one law on one subject.
//
// An input is measured by ball arithmetic first. If that leaves a verdict open, it is measured again at 50
// and 100 digits (Ziv 1991). Where the input is outside the domain of an operation, the subject under test is
// one that does not offer it.

#include <atomic>
#include <budgets/limits.hpp>
#include <campaign/case_id.hpp>
#include <campaign/judge.hpp>
#include <campaign/ranges.hpp>
#include <campaign/tally.hpp>
#include <invariants/measurement.hpp>
#include <memory>
#include <subjects/call_log.hpp>

namespace liecheck::properties {

class Series {
 public:
  /// `tested` must outlive the series.
  Series(std::unique_ptr<Property> law, const Subject& tested, const Robot& robot,
         std::shared_ptr<const SubjectLimits> limits = nullptr, Profile profile = Profile::ours);
  ~Series();

  std::string property, subject, subject_version, scalar, robot;
  std::string adapter;  ///< how the subject was given with --adapter, or ""
  bool robot_fixed = false;
  bool on_robot =
      false;  ///< `robot` is the hash of one; otherwise it says from what the inputs are drawn, or "none"
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
  /// What the subject's numbers are rounded to; `scalar` is its name.
  const Scalar& format() const { return format_; }
  const Bands& bands() const { return Bands::of(format()); }
  const Budget& budget(std::size_t output, Region region) const {
    return *limits_.at(output).budgets[region == Region::to_pi ? 0 : 1];
  }
  /// Generates case `index`, measures it and adds it to the tally. The calls of one case in four are checked, and those
  /// of every case that fails. A failing case is measured again; if the results differ, it is not repeatable.
  void run(std::uint64_t seed, std::uint64_t index, Tally& tally) const;
  /// Runs the cases [first, last) until `stop`, and returns the number of the first that was not run. A subject in
  /// another process is called for many cases at once.
  std::uint64_t run(std::uint64_t seed, Range cases, Tally& tally, const std::atomic<bool>& stop) const;
  std::vector<std::string> input(const CaseId& id) const;  ///< hexadecimal floats
  /// Measures one case twice, the second time with checks of its calls: what differs is not repeatable.
  /// Throws std::invalid_argument for a raw input that the law rejects.
  std::vector<Judged> replay(const CaseId& id) const { return measure_twice(numbers(id)); }

  const Property& tested_law() const { return *law_; }
  /// The names of the operations from whose results the law forms a quantity; none of the result of an operation.
  std::vector<std::string_view> formed_from(const Operation& quantity) const;
  const Subject& tested_subject() const { return subject_; }
  const Limits& limits() const { return limits_; }

  /// The input of a generated or a raw case. Throws std::invalid_argument if the law rejects a raw one.
  std::vector<double> numbers(const CaseId& id) const;
  /// A raw input as it was typed. Only the count of its numbers is checked.
  std::vector<double> parsed(const CaseId& id) const;
  /// Throws std::invalid_argument if the law rejects the input.
  void check_valid(const std::vector<double>& x, const CaseId& id) const;

  std::vector<Judged> measure(const std::vector<double>& x) const { return measure(x, limits_); }
  std::vector<Judged> measure(const std::vector<double>& x, const Limits& limits) const;
  /// Measures like run(): checks the calls of one case in four.
  std::vector<Judged> measure_case(const std::vector<double>& x, std::uint64_t index) const;
  /// Measures like replay().
  std::vector<Judged> measure_twice(const std::vector<double>& x) const;
  /// Measures by ball arithmetic alone. Returns false if a verdict stays open.
  bool measure_by_balls(const std::vector<double>& x, Judge& judge) const;
  /// Measures at 50 and 100 digits. `refusal` receives the message of an exception.
  std::vector<Judged> measure_by_digits(const std::vector<double>& x, const Limits& limits,
                                        bool all_kappas = false, std::string* refusal = nullptr) const;
  Judge judge_of_balls() const { return {limits_, format(), oracles::error_accuracy, every_kappa}; }

  /// While it exists, the calls on this thread are checked; with `one_result`, equal calls have one result:
  /// subjects/call_log.hpp.
  class Checking {
   public:
    explicit Checking(const Series& series, bool one_result = false)
        : series_(series), before_(std::exchange(CallLog::current(), &log_)) {
      log_.keeps_results = one_result;
    }
    /// Of the case with this index.
    Checking(const Series& series, std::uint64_t index);
    Checking(const Checking&) = delete;
    Checking& operator=(const Checking&) = delete;
    ~Checking() { CallLog::current() = before_; }
    /// Gives the measurements of an operation that was called in vain its outcome.
    void judge(std::vector<Judged>& judged) const;
    const CallLog& log() const { return log_; }

   private:
    const Series& series_;
    CallLog log_;
    CallLog* before_;
  };

 private:
  /// What one input is measured on: the subject under test, and the outputs whose domain excludes the input.
  struct Scope {
    const Subject* subject = nullptr;
    std::unique_ptr<const Subject> reduced;
    std::vector<bool> outside;  ///< by output; empty if the domain has the input
    bool nothing_left = false;  ///< then nothing is called
  };
  Scope scope_of(const std::vector<double>& x) const;
  /// A generated case.
  struct Case {
    std::uint64_t index;
    std::vector<double> x;
    Judge judge;
    bool decided = false, checked = false, disagreed = false;  ///< by ball arithmetic; see Tally
  };
  Case generated(std::uint64_t seed, std::uint64_t index) const;
  void measure(Case& c) const;
  void add(const Case& c, std::uint64_t seed, Tally& tally) const;
  /// Ends a case: records what is outside the domain, in place of anything that was measured of it, and what
  /// was not measured.
  void close(const std::vector<double>& x, const Scope& scope, Judge& judge) const;
  /// The band of the angle by which the output is judged, as far as the input alone tells it; else 0.
  std::size_t band_of_input(const std::vector<double>& x, std::size_t output) const;
  /// Ends a case in which a call threw.
  void record_thrown(const std::exception& thrown, const std::vector<double>& x, Judge& judge) const;
  /// Measures again, with checks of the calls, and marks in `judged` what differs or what was called in vain.
  void confirm(const std::vector<double>& x, std::vector<Judged>& judged) const;
  const Source::Key& key_of(std::uint64_t seed) const;

  std::unique_ptr<Property> law_;
  const Subject& subject_;
  const Scalar& format_;
  std::vector<Budget> own_table_;  ///< if it has a limits file
  Limits limits_;
  Domain domain_;
  bool of_joints_ = false;      ///< the law is one of trees or of a robot
  bool held_ = true;            ///< false: it reads a URDF with mimics, and does not say that it couples them
  bool together_ = false;       ///< its functions are called for many cases at once
  const std::uint64_t number_;  ///< unique in this process, unlike an address, which a later series may reuse
};

/// The first 16 digits of the SHA-256 of a limits file.
std::string hash_of(const SubjectLimits& limits);
/// The profile that judges a subject if the user names none: that of its limits file, or else `careful` for a
/// subject of an adapter.
Profile default_profile(const SubjectLimits* own, bool of_adapter);
/// The flags --adapter, --limits and --profile that the series needs, each with a space before it, or "".
std::string subject_flags(const Series& series);
/// " --robot FILE", if the law measures a robot from a file, and subject_flags().
std::string replay_flags(const Series& series, const Robot& robot);

}  // namespace liecheck::properties
