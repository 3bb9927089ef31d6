#pragma once
// A series for one scalar type. It holds the law and the subject, and measures an input.
//
// An input is measured by ball arithmetic first. If that leaves a verdict open, it is measured again at 50
// and 100 digits (Ziv 1991).

#include <campaign/judge.hpp>
#include <campaign/series.hpp>

namespace liecheck::properties {

template <class S>
class TypedSeries final : public Series {
 public:
  TypedSeries(std::unique_ptr<Property<S>> law, const Subject<S>& subject, const Robot& robot);

  const Bands& bands() const override { return Bands::of<S>(); }
  void run(std::uint64_t seed, std::uint64_t index, Tally& tally) const override;
  std::vector<std::string> input(const CaseId& id) const override;
  std::vector<Judged> replay(const CaseId& id) const override { return measure(numbers(id)); }

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
  /// Measures by ball arithmetic alone. Returns false if a verdict stays open.
  bool measure_by_balls(const std::vector<S>& x, Judge& judge) const;
  /// Measures at 50 and 100 digits. `refusal` receives the message of an exception.
  std::vector<Judged> measure_by_digits(const std::vector<S>& x, const Limits& limits,
                                        bool every_kappa = false, std::string* refusal = nullptr) const;
  Judge judge_of_balls() const { return {limits_, bands(), eps, oracles::error_accuracy}; }

 private:
  const Source::Key& key_of(std::uint64_t seed) const;

  std::unique_ptr<Property<S>> law_;
  const Subject<S>& subject_;
  Limits limits_;
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
