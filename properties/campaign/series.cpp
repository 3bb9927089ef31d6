// Longer than 400 lines: the members of one class, which each measure or judge one case.
#include <campaign/robots.hpp>
#include <campaign/series.hpp>
#include <campaign/window.hpp>
#include <invariants/property.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <invariants/tree_laws.hpp>
#include <limits>
#include <stdexcept>
#include <subjects/call_refused.hpp>
#include <subjects/remote.hpp>
#include <subjects/subject_names.hpp>
#include <support/float_environment.hpp>
#include <support/same_numbers.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>
#include <support/together.hpp>

namespace liecheck::properties {

CaseId Series::id(std::uint64_t seed, std::uint64_t index) const {
  CaseId id;
  id.seed = seed, id.property = property, id.subject = subject, id.scalar = scalar, id.robot = robot;
  id.index = index;
  return id;
}

const ExpectedFailure* Series::expected(std::size_t output, std::size_t band) const {
  if (!own) return nullptr;
  const Output& o = outputs.at(output);
  const auto at = std::find_if(own->expected.begin(), own->expected.end(), [&](const ExpectedFailure& e) {
    return e.operation == o.operation && e.block == o.block && e.inputs.has(bands()[band]);
  });
  return at == own->expected.end() ? nullptr : &*at;
}

std::string hash_of(const SubjectLimits& limits) {
  return hexadecimal(sha256(limits.text)).substr(0, 16);
}

std::string subject_flags(const Series& series) {
  const bool usual =
      series.profile ==
      default_profile(series.own.get(), !series.adapter.empty() || is_other_library(series.subject));
  return (series.adapter.empty() ? "" : " --adapter " + shell_quoted(series.adapter)) +
         (series.own ? " --limits " + shell_quoted(series.own->file) : "") +
         (usual ? "" : " --profile " + name_of(series.profile));
}
std::string replay_flags(const Series& series, const Robot& robot) {
  return (series.on_robot && !robot.path.empty() ? robot_flags(robot) : "") + subject_flags(series);
}

Profile default_profile(const SubjectLimits* own, bool of_adapter) {
  if (own && own->profile) return *own->profile;
  return of_adapter ? Profile::careful : Profile::ours;
}

namespace {

/// The bytes of a measurement in the digest of the results.
struct [[gnu::packed]] Digested {
  std::uint16_t output, band;
  Outcome outcome;
  double error, kappa;
};

/// The calls of one case in this many are checked. A checked call takes a little more than twice as long, but
/// the oracles take most of the time of a case: with 4, no law that was timed became a tenth slower.
constexpr std::uint64_t call_check_interval = 4;
/// In one case in this many, a function of a tree is also called with neighbours of its input.
constexpr std::uint64_t neighbour_interval = 32;
/// One case in this many is also measured at 50 and 100 digits, to test the ball arithmetic. Its calls are
/// checked, so that both oracles measure the same results.
constexpr std::uint64_t cross_check_interval = 512;
static_assert(cross_check_interval % call_check_interval == 0 &&
              neighbour_interval % call_check_interval == 0);

bool any_failed(const std::vector<Judged>& judged) {
  return std::any_of(judged.begin(), judged.end(), [](const Judged& j) { return j.failed; });
}

/// Whether a line of the limits file names this sign: then the subject chooses it as liecheck does.
bool asks_for_sign(const SubjectLimits* own, const Output& output) {
  return own && output.block == "sign" && std::ranges::any_of(own->lines, [&](const Budget& line) {
           return line.operation == output.operation && line.block == output.block;
         });
}

void fail_as(Outcome outcome, Judged& j) {
  j.residual.outcome = outcome, j.failed = true, j.ill_posed = false;
}

bool same(const Judged& a, const Judged& b) {
  const Residual &x = a.residual, &y = b.residual;
  return x.output == y.output && x.band == y.band && x.outcome == y.outcome &&
         same_number(x.error, y.error) && same_number(x.kappa, y.kappa) && a.failed == b.failed &&
         a.ill_posed == b.ill_posed;
}

/// Whether both may be one measurement by two tiers of balls: a case is measured by the tier that decides all its outputs.
bool alike(const Judged& a, const Judged& b) {
  const Residual &x = a.residual, &y = b.residual;
  const double apart = std::fabs(x.error - y.error), size = std::max({1.0, x.error, y.error});
  return x.output == y.output && x.outcome == y.outcome && a.failed == b.failed &&
         (same_number(x.error, y.error) || apart <= 4 * oracles::error_accuracy * size);
}

/// Whether a call without a result ended the case.
bool has_ended(const std::vector<Judged>& judged) {
  return std::ranges::any_of(judged, [](const Judged& j) {
    return j.residual.outcome == Outcome::refused || is_misuse(j.residual.outcome);
  });
}

/// Whether the output was measured the other time, too, and never with this result.
bool differs_from_all(const Judged& j, const std::vector<Judged>& others) {
  bool any = false;
  if (leaves_open(j.residual.outcome)) return false;
  for (const Judged& other : others) {
    if (other.residual.output != j.residual.output || leaves_open(other.residual.outcome)) continue;
    if (alike(j, other)) return false;
    any = true;
  }
  return any;
}

/// Measures with every call checked, so that one that changes the arithmetic does not reach the oracles.
std::vector<Judged> measured_with_checks(const Series& series, const std::vector<double>& x) {
  const Series::Checking checking(series);
  std::vector<Judged> judged = series.measure(x);
  checking.judge(judged);
  return judged;
}

std::uint64_t next_series_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

Series::~Series() = default;

Series::Series(std::unique_ptr<Property> law_tested, const Subject& tested, const Robot& robot_used,
               std::shared_ptr<const SubjectLimits> limits, Profile judging)
    : law_(std::move(law_tested)), subject_(tested), format_(*tested.scalar), number_(next_series_number()) {
  const Statement& stated = law_->statement();
  property = stated.name, law = stated.law, equation = stated.equation, source = stated.source;
  subject = tested.name, subject_version = tested.version, adapter = tested.adapter;
  scalar = format().name, eps = format().epsilon;
  outputs = law_->outputs();
  law_->prepare(robot_used);
  on_robot = law_->needs_robot();
  const std::string drawn_from = law_->draw_for(tested);
  robot = on_robot ? robot_used.hash : drawn_from.empty() ? "none" : drawn_from;
  robot_fixed = robot_used.fixed;
  fields = law_->fields();
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (law_->measures(subject_, outputs[i])) due |= 1u << i;
  of_joints_ = is_tree_law(property) || outputs.front().operation.starts_with("robot_");
  together_ = !of_joints_ && remote_subjects().contains(subject);
  held_ = !(robot_used.mimics && law_->gives_urdf() && tested.takes.reads_urdf && !tested.takes.mimics);
  own = std::move(limits);
  profile = judging;
  domain_ = Domain(own ? own->domain : std::vector<DomainBound>(), fields, outputs);
  if (own) own_table_ = with_own_limits(budgets(subject, profile, eps), own->lines);
  const std::vector<Budget>& table = own ? own_table_ : budgets(subject, profile, eps);
  for (const Output& o : outputs)
    limits_.push_back({o.definition,
                       {&budget_in(table, o.operation, o.block, Region::to_pi),
                        &budget_in(table, o.operation, o.block, Region::beyond_pi)},
                       profile != Profile::ours && !asks_for_sign(own.get(), o)});
}

void Series::run(std::uint64_t seed, std::uint64_t index, Tally& tally) const {
  Case c = generated(seed, index);
  measure(c);
  add(c, seed, tally);
}

std::uint64_t Series::run(std::uint64_t seed, Range cases, Tally& tally, const std::atomic<bool>& stop) const
    try {
  auto& [next, last] = cases;
  if (together_) {
    Window window;
    while (next < last && !stop) {
      std::vector<Case> all;
      for (std::uint64_t n = window.next(last - next), k = 0; k < n; ++k)
        all.push_back(generated(seed, next + k));
      std::vector<CallLog*> own(all.size());
      run_together(
          all.size(), [&](std::size_t k) { measure(all[k]); },
          [&](std::size_t k) { std::swap(CallLog::current(), own[k]); });
      for (const Case& c : all) add(c, seed, tally), ++next;
    }
  }
  for (; next < last && !stop; ++next) run(seed, next, tally);
  return next;
} catch (const GivenUp&) {
  return cases.first;
}

auto Series::generated(std::uint64_t seed, std::uint64_t index) const -> Case {
  Source stream(CaseId::key_of(key_of(seed), index));
  return {index, law_->generate(stream), judge_of_balls()};
}

void Series::measure(Case& c) const {
  std::vector<Judged>& judged = c.judge.judged;
  const FloatEnvironment environment;
  if (c.index % call_check_interval != 0) {
    c.decided = measure_by_balls(c.x, c.judge);
    if (!c.decided) judged = measure_by_digits(c.x, limits_, every_kappa);
  } else {
    const Checking checking(*this, c.index);
    c.decided = measure_by_balls(c.x, c.judge);
    if (c.decided && c.index % cross_check_interval == 0) {
      c.checked = true;
      c.disagreed = !agree(judged, measure_by_digits(c.x, limits_, every_kappa));
    }
    if (!c.decided) judged = measure_by_digits(c.x, limits_, every_kappa);
    checking.judge(judged);
  }
  if (environment.restore())  // by a call that was not checked: the oracles may have been wrong
    judged = measured_with_checks(*this, c.x);
  else if (any_failed(judged))
    confirm(c.x, judged);
}

void Series::add(const Case& c, std::uint64_t seed, Tally& tally) const {
  const Source::Key& series = key_of(seed);
  const auto& [index, x, judge, decided, checked, disagreed] = c;
  const std::vector<Judged>& judged = judge.judged;
  tally.checked += checked;
  if (disagreed) tally.disagreed.push_back(index);
  tally.fast += decided;
  tally.coverage.add(fields, x, format(), measured_outputs(judged));
  thread_local std::string record;
  record.clear();
  const auto add = [](const void* from, std::size_t n) { record.append(static_cast<const char*>(from), n); };
  add(&series, sizeof series);
  add(&index, sizeof index);
  format().with([&]<class S>() {  // the digest covers the bytes of the scalar
    for (const double number : x) {
      const S own = static_cast<S>(number);
      add(&own, sizeof own);
    }
  });
  tally.inputs.add(record.data(), record.size());
  record.resize(sizeof series + sizeof index);
  record += subject;
  for (const Judged& j : judged) {
    const Residual& r = j.residual;
    tally.rows.of(r.output, r.band).add(j, index);
    const Digested digested{r.output, r.band, r.outcome, r.error, r.kappa};
    add(&digested, sizeof digested);
  }
  tally.results.add(record.data(), record.size());
  ++tally.cases;
}

/// The key of this series and a seed. Each thread caches the last key.
const Source::Key& Series::key_of(std::uint64_t seed) const {
  thread_local struct {
    std::uint64_t series = 0, seed = 0;
    Source::Key key{};
  } last;
  if (last.series != number_ || last.seed != seed) last = {number_, seed, id(seed, 0).series_key()};
  return last.key;
}

std::vector<std::string> Series::input(const CaseId& address) const {
  std::vector<std::string> text;
  for (const double v : numbers(address)) text.push_back(hexadecimal_float(v));
  return text;
}

std::vector<double> Series::numbers(const CaseId& address) const {
  if (!address.raw) {
    Source stream(address.key());
    return law_->generate(stream);
  }
  const std::vector<double> x = parsed(address);
  check_valid(x, address);
  return x;
}

std::vector<double> Series::parsed(const CaseId& address) const {
  std::vector<double> x;
  for (const std::string& text : address.input) x.push_back(parse_float(text, format()));
  std::size_t expected = 0;
  for (const Field& f : fields) expected += static_cast<std::size_t>(f.size);
  if (!law_->takes(x.size()))
    throw std::invalid_argument(
        fmt::format("case ID: property {} takes {} numbers, {} were given", property, expected, x.size()));
  return x;
}

namespace {

/// What the numbers of a field must be, beside finite.
const char* demand_on(Kind kind) {
  switch (kind) {
    case Kind::quaternion:
    case Kind::direction:
      return " of length 1";
    case Kind::any_quaternion:
      return " that are not all 0";
    case Kind::rotation_matrix:
      return " of a rotation matrix";
    case Kind::near_rotation:
      return " of a matrix A with |A^T A - I| <= 0.4 and det A > 0";
    case Kind::fraction:
      return " in [0, 1]";
    default:
      return "";
  }
}

}  // namespace

void Series::check_valid(const std::vector<double>& x, const CaseId& address) const {
  if (law_->valid(x)) return;
  std::vector<std::string> taken;
  for (const Field& f : fields)
    taken.push_back(
        fmt::format("{}: {} number{}{}", f.name, f.size, f.size == 1 ? "" : "s", demand_on(f.kind)));
  throw std::invalid_argument(fmt::format("case ID: not a valid input of property {}: {}; it takes {}",
                                          property, fmt::join(address.input, ","), fmt::join(taken, ", ")));
}

namespace {

/// Whether the fourth power of a rotation vector's norm, or the square of another one, may overflow, or the square of a
/// quaternion's norm is nearly subnormal. Ordinary code forms such powers, and only the profile `ours` demands a result
/// there.
bool powers_leave_the_range(const Scalar& scalar, const std::vector<Field>& fields,
                            const std::vector<double>& x) {
  const double of_angles = std::ldexp(1.0, scalar.max_exponent / 4 - 2),
               of_others = std::ldexp(1.0, scalar.max_exponent / 2 - 4),
               of_quaternions = std::ldexp(1.0, (scalar.min_exponent + scalar.digits) / 2);
  auto next = x.begin();
  for (const Field& field : fields) {
    double largest = 0;
    for (int i = 0; i < field.size; ++i) largest = std::max(largest, std::fabs(*next++));
    if (largest > (field.kind == Kind::rotation_vector ? of_angles : of_others)) return true;
    if (field.kind == Kind::any_quaternion && largest < of_quaternions) return true;
  }
  return false;
}

/// Whether the norm of a quaternion is far from 1, so that a library may refuse it: no product of unit quaternions, and no
/// sum of a few, comes there.
bool norm_is_far_from_one(const std::vector<Field>& fields, const std::vector<double>& x) {
  auto next = x.begin();
  for (const Field& field : fields) {
    double largest = 0;
    for (int i = 0; i < field.size; ++i) largest = std::max(largest, std::fabs(*next++));
    if (field.kind == Kind::any_quaternion && !(largest > 1e-4 && largest < 1e4)) return true;
  }
  return false;
}

/// Whether a law hands matrices that are no rotations to an operation that takes rotations, so that a library may refuse them.
bool gives_no_rotations(const Statement& law) {
  return law.formed.size() > 0 && std::ranges::any_of(law.fields, [](const ConstantField& field) {
           return field.kind == Kind::near_rotation;
         });
}

}  // namespace

std::vector<std::string_view> Series::formed_from(const Operation& quantity) const {
  std::vector<std::string_view> all;
  for (const Formed& f : law_->statement().formed)
    if (f.quantity == &quantity)
      for (const Operation* from : f.from) all.push_back(from->name);
  return all;
}

auto Series::scope_of(const std::vector<double>& x) const -> Scope {
  Scope scope;
  scope.subject = &subject_;
  std::vector<bool> outside;
  if (profile != Profile::ours && powers_leave_the_range(format(), fields, x))
    outside.assign(outputs.size(), true);
  else if (!domain_.has_everything())
    outside = domain_.outside(x);
  const auto any = std::find(outside.begin(), outside.end(), true);
  if (any == outside.end()) return scope;
  auto reduced = std::make_unique<Subject>(*scope.subject);
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (outside[i]) reduced->operations.take(*outputs[i].record, {});
  scope.nothing_left = true;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const bool is_due = due >> i & 1;
    // The functions of a robot or of a tree are called together: if one is outside, none is called.
    outside[i] = is_due && (outside[i] || of_joints_ || !law_->measures(*reduced, outputs[i]));
    scope.nothing_left = scope.nothing_left && (outside[i] || !is_due);
  }
  scope.outside = std::move(outside);
  scope.reduced = std::move(reduced);
  scope.subject = scope.reduced.get();
  return scope;
}

void Series::close(const std::vector<double>& x, const Scope& scope, Judge& judge) const {
  if (!scope.outside.empty()) {
    std::erase_if(judge.judged, [&](const Judged& j) {  // a refusal concerns the whole law
      return scope.outside[j.residual.output] && j.residual.outcome != Outcome::refused;
    });
    for (std::size_t i = 0; i < outputs.size(); ++i)
      if (scope.outside[i]) judge.outcome(outputs[i], band_of_input(x, i), Outcome::outside_domain);
  }
  judge.close(due);
  if (!held_ && any_failed(judge.judged))
    for (Judged& j : judge.judged)
      if (j.failed || j.residual.outcome == Outcome::unmeasured)
        j.residual.outcome = Outcome::outside_domain, j.failed = false;
}

std::size_t Series::band_of_input(const std::vector<double>& x, std::size_t output) const {
  const double angle = of_joints_ ? -1 : domain_.angle(x, output);
  return angle < 0 ? 0 : bands().classify(oracles::Real(angle));
}

void Series::record_thrown(const std::exception& thrown, const std::vector<double>& x, Judge& judge) const {
  if (dynamic_cast<const std::bad_alloc*>(&thrown)) throw;  // says nothing about the subject
  const auto* failed = dynamic_cast<const CallFailed*>(&thrown);
  const bool of_others = profile != Profile::ours;
  if ((!failed || failed->outcome == Outcome::refused) &&
      ((of_others && norm_is_far_from_one(fields, x)) ||
       ((of_others || !adapter.empty()) && gives_no_rotations(law_->statement()))))
    return judge.close(due, Outcome::outside_domain);
  if (failed && failed->outcome == Outcome::outside_domain) {
    for (std::size_t i = 0; i < outputs.size(); ++i)
      if (due >> i & 1) judge.outcome(outputs[i], 0, failed->outcome);
    return;
  }
  const auto* refused = dynamic_cast<const CallRefused*>(&thrown);
  const std::string_view operation = failed ? failed->operation : refused ? refused->operation : "";
  auto of = std::ranges::find(outputs, operation, &Output::operation);
  if (of == outputs.end())  // what the law forms next from results of the operation
    of = std::ranges::find_if(outputs, [&](const Output& o) {
      return std::ranges::count(formed_from(*o.record), operation) &&
             std::ranges::none_of(judge.judged, [&](const Judged& j) {
               return outputs[j.residual.output].definition == o.definition;
             });
    });
  if (of == outputs.end()) of = outputs.begin() + (due ? std::countr_zero(due) : 0);
  const Outcome outcome = failed ? failed->outcome : Outcome::refused;
  // What an adapter finds when it repeats calls may be of an earlier input, so it has no angle.
  const bool earlier = failed && outcome == Outcome::not_repeatable;
  judge.outcome(*of, earlier ? 0 : band_of_input(x, static_cast<std::size_t>(of - outputs.begin())), outcome);
}

std::vector<Judged> Series::measure(const std::vector<double>& x, const Limits& limits) const {
  Judge judge(limits, format(), oracles::error_accuracy, every_kappa);
  return measure_by_balls(x, judge) ? std::move(judge.judged) : measure_by_digits(x, limits, every_kappa);
}

std::vector<Judged> Series::measure_case(const std::vector<double>& x, std::uint64_t index) const {
  if (index % call_check_interval != 0) {
    const FloatEnvironment environment;
    std::vector<Judged> judged = measure(x);
    return environment.restore() ? measured_with_checks(*this, x) : judged;
  }
  const Checking checking(*this, index);
  std::vector<Judged> judged = measure(x);
  checking.judge(judged);
  return judged;
}

std::vector<Judged> Series::measure_twice(const std::vector<double>& x) const {
  std::vector<Judged> judged = measure(x);
  confirm(x, judged);
  return judged;
}

bool Series::measure_by_balls(const std::vector<double>& x, Judge& judge) const {
  const Scope scope = scope_of(x);
  bool decided = true;
  for (std::size_t tier = 0; !scope.nothing_left; ++tier) try {
      if (CallLog* log = CallLog::current()) log->trees = 0;
      decided = law_->measure_fast(*scope.subject, x, judge, tier);
      break;
    } catch (const oracles::Undecided&) {
      judge.clear();
    } catch (const std::exception& e) {
      record_thrown(e, x, judge);
      break;
    }
  if (decided) close(x, scope, judge);
  return decided;
}

std::vector<Judged> Series::measure_by_digits(const std::vector<double>& x, const Limits& limits,
                                              bool all_kappas, std::string* refusal) const {
  Judge judge(limits, format(), 0, all_kappas);
  const Scope scope = scope_of(x);
  try {
    if (CallLog* log = CallLog::current()) log->trees = 0;
    if (!scope.nothing_left) law_->measure(*scope.subject, x, judge);
  } catch (const std::exception& e) {
    if (refusal) *refusal = e.what();
    record_thrown(e, x, judge);
  }
  close(x, scope, judge);
  return std::move(judge.judged);
}

void Series::confirm(const std::vector<double>& x, std::vector<Judged>& judged) const {
  const Checking checking(*this);
  const std::vector<Judged> again = measure(x);
  checking.judge(judged);
  const bool ended = has_ended(judged) || has_ended(again);
  const bool any_apart = !std::ranges::equal(judged, again, alike);
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const Outcome o = judged[i].residual.outcome;
    if (is_misuse(o) || o == Outcome::outside_domain) continue;
    // A call without a result ends a case. What was not measured then tells nothing about other operations. Where one output
    // differs, another tier may have measured the others.
    const bool differs = ended                           ? differs_from_all(judged[i], again)
                         : again.size() != judged.size() ? true
                         : any_apart                     ? !alike(judged[i], again[i])
                                                         : !same(judged[i], again[i]);
    if (differs) fail_as(Outcome::not_repeatable, judged[i]);
  }
}

Series::Checking::Checking(const Series& series, std::uint64_t index)
    : Checking(series, index % cross_check_interval == 0) {
  log_.calls_neighbours = index % neighbour_interval == 0;
}

void Series::Checking::judge(std::vector<Judged>& judged) const {
  for (const CallLog::Finding& f : log_.findings) {
    // If the operation has no row, those are void that the law forms from it, and without such ones every row.
    const auto is_own = [&](const Judged& j) {
      return series_.outputs[j.residual.output].record == f.operation;
    };
    const auto is_formed = [&](const Judged& j) {
      return std::ranges::count(series_.formed_from(*series_.outputs[j.residual.output].record),
                                f.operation->name) > 0;
    };
    const bool own_rows = std::ranges::any_of(judged, is_own),
               formed_rows = std::ranges::any_of(judged, is_formed);
    for (Judged& j : judged)
      if (j.residual.outcome != Outcome::outside_domain && !is_misuse(j.residual.outcome) &&
          (own_rows ? is_own(j) : !formed_rows || is_formed(j)))
        fail_as(f.outcome, j);
  }
}

}  // namespace liecheck::properties
