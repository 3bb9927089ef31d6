#include <campaign/typed_series.hpp>

#include <fmt/format.h>
#include <atomic>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace liecheck::properties {

CaseId Series::id(std::uint64_t seed, std::uint64_t index) const {
  CaseId id;
  id.seed = seed, id.property = property, id.subject = subject, id.scalar = scalar, id.robot = robot;
  id.index = index;
  return id;
}

namespace {

static_assert(sizeof(float128) == 16);  // so the digests cover the same bytes as those of a __float128

/// The bytes of a measurement in the digest of the results.
struct [[gnu::packed]] Digested {
  std::uint16_t output, band;
  Outcome outcome;
  double error, kappa;
};

/// One case in this many is also measured at 50 and 100 digits, to test the ball arithmetic.
constexpr std::uint64_t cross_check_interval = 512;

std::uint64_t next_series_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

template <class S>
TypedSeries<S>::TypedSeries(std::unique_ptr<Property<S>> law_tested, const Subject<S>& tested,
                            const Robot& robot_used)
    : law_(std::move(law_tested)), subject_(tested), number_(next_series_number()) {
  const Statement& stated = law_->statement();
  property = stated.name, law = stated.law, equation = stated.equation, source = stated.source;
  subject = tested.name, subject_version = tested.version;
  scalar = scalar_name<S>();
  eps = std::ldexp(1.0, 1 - std::numeric_limits<S>::digits);
  outputs = law_->outputs();
  law_->prepare(robot_used);
  robot = law_->needs_robot() ? robot_used.hash : "none";
  robot_fixed = robot_used.fixed;
  fields = law_->fields();
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (law_->measures(subject_, outputs[i])) due |= 1u << i;
  for (const Output& o : outputs)
    limits_.push_back({o.definition,
                       {&budget_of(subject, o.operation, o.block, Region::to_pi),
                        &budget_of(subject, o.operation, o.block, Region::beyond_pi)}});
}

template <class S>
void TypedSeries<S>::run(std::uint64_t seed, std::uint64_t index, Tally& tally) const {
  const Source::Key& series = key_of(seed);
  Source stream(CaseId::key_of(series, index));
  const std::vector<S> x = law_->generate(stream);
  Judge judge = judge_of_balls();
  const bool decided = measure_by_balls(x, judge);
  if (decided) {
    ++tally.fast;
    if (index % cross_check_interval == 0) {
      ++tally.checked;
      if (!agree(judge.judged, measure_by_digits(x, limits_))) tally.disagreed.push_back(index);
    }
  } else {
    judge.judged = measure_by_digits(x, limits_);
  }
  tally.coverage.add(fields, x, measured_outputs(judge.judged));
  thread_local std::string record;
  record.clear();
  const auto add = [](const void* from, std::size_t n) { record.append(static_cast<const char*>(from), n); };
  add(&series, sizeof series);
  add(&index, sizeof index);
  add(x.data(), x.size() * sizeof(S));
  tally.inputs.add(record.data(), record.size());
  record.resize(sizeof series + sizeof index);
  record += subject;
  for (const Judged& j : judge.judged) {
    const Residual& r = j.residual;
    tally.rows.of(r.output, r.band).add(j, index);
    const Digested digested{r.output, r.band, r.outcome, r.error, r.kappa};
    add(&digested, sizeof digested);
  }
  tally.results.add(record.data(), record.size());
  ++tally.cases;
}

/// The key of this series and a seed. Each thread caches the last key.
template <class S>
const Source::Key& TypedSeries<S>::key_of(std::uint64_t seed) const {
  thread_local struct {
    std::uint64_t series = 0, seed = 0;
    Source::Key key{};
  } last;
  if (last.series != number_ || last.seed != seed) last = {number_, seed, id(seed, 0).series_key()};
  return last.key;
}

template <class S>
std::vector<std::string> TypedSeries<S>::input(const CaseId& address) const {
  std::vector<std::string> text;
  for (const S& v : numbers(address)) text.push_back(hexadecimal_float(v));
  return text;
}

template <class S>
std::vector<S> TypedSeries<S>::numbers(const CaseId& address) const {
  if (!address.raw) {
    Source stream(address.key());
    return law_->generate(stream);
  }
  const std::vector<S> x = parsed(address);
  check_valid(x, address);
  return x;
}

template <class S>
std::vector<S> TypedSeries<S>::parsed(const CaseId& address) const {
  std::vector<S> x;
  for (const std::string& text : address.input) x.push_back(parse_float<S>(text));
  std::size_t expected = 0;
  for (const Field& f : fields) expected += static_cast<std::size_t>(f.size);
  if (x.size() != expected)
    throw std::invalid_argument(
        fmt::format("case ID: property {} takes {} numbers, {} were given", property, expected, x.size()));
  return x;
}

template <class S>
void TypedSeries<S>::check_valid(const std::vector<S>& x, const CaseId& address) const {
  if (!law_->valid(x))
    throw std::invalid_argument(fmt::format("case ID: not a valid input of property {}: {}", property,
                                            fmt::join(address.input, ",")));
}

template <class S>
std::vector<Judged> TypedSeries<S>::measure(const std::vector<S>& x, const Limits& limits) const {
  Judge judge(limits, bands(), eps, oracles::error_accuracy);
  return measure_by_balls(x, judge) ? std::move(judge.judged) : measure_by_digits(x, limits);
}

template <class S>
bool TypedSeries<S>::measure_by_balls(const std::vector<S>& x, Judge& judge) const {
  for (std::size_t tier = 0;; ++tier) try {
      const bool decided = law_->measure_fast(subject_, x, judge, tier);
      if (decided) judge.close(due);
      return decided;
    } catch (const oracles::Undecided&) {
      judge.clear();
    } catch (const std::exception&) {
      judge.outcome(outputs.front(), 0, Outcome::refused);
      return true;
    }
}

template <class S>
std::vector<Judged> TypedSeries<S>::measure_by_digits(const std::vector<S>& x, const Limits& limits,
                                                      bool every_kappa, std::string* refusal) const {
  Judge judge(limits, bands(), eps, 0, every_kappa);
  try {
    law_->measure(subject_, x, judge);
    judge.close(due);
  } catch (const std::exception& e) {
    if (refusal) *refusal = e.what();
    judge.outcome(outputs.front(), 0, Outcome::refused);
  }
  return std::move(judge.judged);
}

template class TypedSeries<float>;
template class TypedSeries<double>;
template class TypedSeries<float128>;

}  // namespace liecheck::properties
