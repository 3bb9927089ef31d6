#pragma once
// A series for one scalar type. It holds the law and the subject, and measures an input.
//
// An input is measured by ball arithmetic first. If that leaves a verdict open, it is measured again at 50
// and 100 digits (Ziv 1991). Where the input is outside the domain of an operation, the subject under test is
// one that does not offer it.

#include <atomic>
#include <campaign/call_checks.hpp>
#include <campaign/judge.hpp>
#include <campaign/series.hpp>

namespace liecheck::properties {

template <class S>
class TypedSeries final : public Series {
 public:
  TypedSeries(std::unique_ptr<Property<S>> law, const Subject<S>& subject, const Robot& robot,
              std::shared_ptr<const SubjectLimits> limits = nullptr, Profile profile = Profile::ours);

  const Bands& bands() const override { return Bands::of<S>(); }
  const Budget& budget(std::size_t output, Region region) const override {
    return *limits_.at(output).budgets[region == Region::to_pi ? 0 : 1];
  }
  /// The calls of one case in four are checked, and those of every case that fails. A failing case is
  /// measured again; if the results differ, it is not repeatable.
  void run(std::uint64_t seed, std::uint64_t index, Tally& tally) const override;
  /// Runs the cases [first, last) until `stop`, and returns the number of the first that was not run. A subject in
  /// another process is called for many cases at once.
  std::uint64_t run(std::uint64_t seed, Range cases, Tally& tally, const std::atomic<bool>& stop) const;
  std::vector<std::string> input(const CaseId& id) const override;
  std::vector<Judged> replay(const CaseId& id) const override { return measure_twice(numbers(id)); }

  const Property<S>& tested_law() const { return *law_; }
  const Subject<S>& tested_subject() const { return subject_; }
  const Limits& limits() const { return limits_; }

  /// The input of a generated or a raw case. Throws std::invalid_argument if the law rejects a raw one.
  std::vector<S> numbers(const CaseId& id) const;
  /// A raw input as it was typed. Only the count of its numbers is checked.
  std::vector<S> parsed(const CaseId& id) const;
  /// Throws std::invalid_argument if the law rejects the input.
  void check_valid(const std::vector<S>& x, const CaseId& id) const;

  std::vector<Judged> measure(const std::vector<S>& x) const { return measure(x, limits_); }
  std::vector<Judged> measure(const std::vector<S>& x, const Limits& limits) const;
  /// Measures like run(): checks the calls of one case in four.
  std::vector<Judged> measure_case(const std::vector<S>& x, std::uint64_t index) const;
  /// Measures like replay().
  std::vector<Judged> measure_twice(const std::vector<S>& x) const;
  /// Measures by ball arithmetic alone. Returns false if a verdict stays open.
  bool measure_by_balls(const std::vector<S>& x, Judge& judge) const;
  /// Measures at 50 and 100 digits. `refusal` receives the message of an exception.
  std::vector<Judged> measure_by_digits(const std::vector<S>& x, const Limits& limits,
                                        bool all_kappas = false, std::string* refusal = nullptr) const;
  Judge judge_of_balls() const { return {limits_, bands(), eps, oracles::error_accuracy, every_kappa}; }

  /// While it exists, the calls on this thread are checked; with `one_result`, equal calls have one result:
  /// call_checks.hpp.
  class Checking {
   public:
    explicit Checking(const TypedSeries& series, bool one_result = false)
        : series_(series), active_(series.checked_, &log_) {
      log_.keeps_results = one_result;
    }
    /// Gives the measurements of an operation that was called in vain its outcome.
    void judge(std::vector<Judged>& judged) const;

   private:
    const TypedSeries& series_;
    CallLog log_;
    typename CheckedSubject<S>::Active active_;
  };

 private:
  /// What one input is measured on: the subject under test, and the outputs whose domain excludes the input.
  struct Scope {
    const Subject<S>* subject = nullptr;
    std::unique_ptr<const Subject<S>> reduced;
    std::vector<bool> outside;  ///< by output; empty if the domain has the input
    bool nothing_left = false;  ///< then nothing is called
  };
  Scope scope_of(const std::vector<S>& x) const;
  /// A generated case.
  struct Case {
    std::uint64_t index;
    std::vector<S> x;
    Judge judge;
    bool decided = false, checked = false, disagreed = false;  ///< by ball arithmetic; see Tally
  };
  Case generated(std::uint64_t seed, std::uint64_t index) const;
  void measure(Case& c) const;
  void add(const Case& c, std::uint64_t seed, Tally& tally) const;
  /// Ends a case: records what is outside the domain, in place of anything that was measured of it, and what
  /// was not measured.
  void close(const std::vector<S>& x, const Scope& scope, Judge& judge) const;
  /// Ends a case in which a call threw.
  void record_thrown(const std::exception& thrown, Judge& judge) const;
  /// Measures again, with checks of the calls, and marks in `judged` what differs or what was called in vain.
  void confirm(const std::vector<S>& x, std::vector<Judged>& judged) const;
  const Source::Key& key_of(std::uint64_t seed) const;

  std::unique_ptr<Property<S>> law_;
  const Subject<S>& subject_;
  CheckedSubject<S> checked_;
  std::vector<Budget> own_table_;  ///< if it has a limits file
  Limits limits_;
  Domain domain_;
  bool of_joints_ = false;      ///< the law is one of trees or of a robot
  bool together_ = false;       ///< its functions are called for many cases at once
  const std::uint64_t number_;  ///< unique in this process, unlike an address, which a later series may reuse
};

/// Calls f with the series as a TypedSeries of its scalar.
template <class F>
auto with_scalar(const Series& series, const F& f) {
  if (const auto* s = dynamic_cast<const TypedSeries<double>*>(&series)) return f(*s);
  if (const auto* s = dynamic_cast<const TypedSeries<float>*>(&series)) return f(*s);
  return f(dynamic_cast<const TypedSeries<float128>&>(series));
}

}  // namespace liecheck::properties
