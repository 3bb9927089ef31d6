#include <campaign/series.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <support/embedded.hpp>
#include <hard_cases/input_domain.hpp>
#include <search/hunt.hpp>
#include <campaign/judge.hpp>
#include <search/shrink.hpp>
#include <support/text.hpp>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <liecheck/urdf/urdf.hpp>
#include <limits>
#include <set>
#include <stdexcept>

namespace liecheck::properties {

CaseId Series::id(std::uint64_t seed, std::uint64_t index) const {
  CaseId id;
  id.seed = seed, id.property = property, id.subject = subject, id.scalar = scalar, id.robot = robot;
  id.index = index;
  return id;
}

namespace {

/// Bytes one after the other, in memory that is kept.
class Bytes {
 public:
  void clear() { size_ = 0; }
  template <class T>
  void add(const T& value) {
    append(&value, sizeof value);
  }
  void append(const void* from, std::size_t n) {
    if (size_ + n > bytes_.size()) bytes_.resize(2 * (size_ + n));
    std::memcpy(bytes_.data() + size_, from, n);
    size_ += n;
  }
  const std::byte* data() const { return bytes_.data(); }
  std::size_t size() const { return size_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t size_ = 0;
};

/// Of the series made in this process, from 1.
std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

template <class S>
class SeriesOf final : public Series {
 public:
  SeriesOf(std::unique_ptr<Property<S>> law_tested, const Subject<S>& tested, const Robot& robot_used)
      : property_(std::move(law_tested)), subject_(tested) {
    property = property_->name();
    law = property_->law(), equation = property_->equation(), source = property_->source();
    subject = tested.name, subject_version = tested.version;
    scalar = scalar_name<S>();
    eps = std::ldexp(1.0, 1 - std::numeric_limits<S>::digits);
    outputs = property_->outputs();
    property_->prepare(robot_used);
    robot = property_->needs_robot() ? robot_used.hash : "none";
    robot_fixed = robot_used.fixed;
    fields = property_->fields();
    for (const Output& o : outputs)
      budgets_.push_back({&budget_of(subject, o.operation, o.block, Region::to_pi),
                          &budget_of(subject, o.operation, o.block, Region::beyond_pi)});
  }

  const Bands& bands() const override { return Bands::of<S>(); }

  void run(std::uint64_t seed, std::uint64_t index, Tally& tally) const override {
    const Source::Key& series = key_of(seed);
    Source stream(CaseId::key_of(series, index));
    const std::vector<S> x = property_->generate(stream);
    tally.coverage.add(fields, x);
    Judge judge(budgets_, bands(), eps, oracles::error_accuracy);
    const bool fast = decided_fast(x, judge);
    if (fast) {
      ++tally.fast;
      if (index % checked_every == 0) {
        ++tally.checked;
        if (!agree(judge.judged, measure_slowly(x))) tally.disagreed.push_back(index);
      }
    } else {
      judge.judged = measure_slowly(x);
    }
    thread_local Bytes record;
    record.clear();
    record.add(series);
    record.add(index);
    for (const S& v : x) {
      if constexpr (std::is_floating_point_v<S>)
        record.add(v);
      else
        record.add(v.backend().value());
    }
    tally.inputs.add(record.data(), record.size());
    record.clear();
    record.add(series);
    record.add(index);
    record.append(subject.data(), subject.size());
    for (const Judged& j : judge.judged) {
      tally.rows.of(j.residual.output, j.residual.band).add(j, index);
      record.add(j.residual.output);
      record.add(j.residual.band);
      record.add(j.residual.outcome);
      record.add(j.residual.error);
      record.add(j.residual.kappa);
    }
    tally.results.add(record.data(), record.size());
    ++tally.cases;
  }

  std::vector<std::string> input(const CaseId& address) const override {
    std::vector<std::string> text;
    for (const S& v : numbers(address)) text.push_back(hexadecimal_float(v));
    return text;
  }

  std::string program(const Output& output, const std::vector<std::string>& texts) const override {
    std::vector<S> x;
    for (const std::string& text : texts) x.push_back(parse_float<S>(text));
    return property_->program(output, x);
  }
  std::vector<Judged> replay(const CaseId& address) const override { return measure(numbers(address)); }

  Trial attempt(const CaseId& address) const override {
    Trial trial;
    std::vector<S> x;
    if (address.raw) {
      x = parsed(address);
      std::vector<S> in_domain = x;
      trial.in_domain = !set_identity_where_off(property_->fields(), in_domain);
      check_valid(in_domain, address);
    } else {
      x = numbers(address);
    }
    for (const S& v : x) trial.input.push_back(hexadecimal_float(v));
    Judge fast(budgets_, bands(), eps, oracles::error_accuracy);
    try {
      check_entrance(subject_.operations, property_->fields(), x);
      trial.judged = measure_slowly(x, budgets_, true, &trial.refusal);
      // The hard cases are a test of the fast oracles too, in the domain that they are made for.
      if (trial.in_domain && trial.refusal.empty() && decided_fast(x, fast) &&
          !agree(fast.judged, measure_slowly(x)))
        for (Judged& j : trial.judged) j.residual.outcome = Outcome::unresolved;
    } catch (const std::exception& e) {
      trial.refusal = e.what();
      fast.judged.clear();
      fast.outcome(0, 0, Outcome::refused);
      trial.judged = std::move(fast.judged);
    }
    if (!trial.in_domain)
      for (Judged& j : trial.judged) {
        if (j.residual.outcome == Outcome::refused) j.failed = false;
        // The oracle knows no answer because there is none: whatever was answered is on a wrong branch.
        if (j.residual.outcome == Outcome::unresolved)
          j.residual.outcome = Outcome::wrong_branch, j.failed = true;
      }
    return trial;
  }

  Shrunk shrink(const CaseId& address, int output, int evaluations) const override {
    const std::vector<S> x = numbers(address);
    std::optional<Outcome> outcome;  // of the case itself: what is smaller must fail in the same way
    const auto fails = [&](const std::vector<S>& y) -> std::optional<Judged> {
      if (!property_->valid(y)) return std::nullopt;
      for (const Judged& j : measure(y))
        if (j.failed && j.residual.output == output && (!outcome || j.residual.outcome == *outcome)) return j;
      return std::nullopt;
    };
    if (const auto j = fails(x)) outcome = j->residual.outcome;
    const std::vector<S> small = shrink_input<S>(
        x, fields, [&](const auto& x) { return fails(x).has_value(); }, evaluations,
        [&](const auto& x) { return property_->simpler(x); });
    Shrunk s;
    s.id = address;
    s.id.raw = true;
    for (const S& v : small) {
      s.id.input.push_back(hexadecimal_float(v));
      s.decimal.push_back(decimal_float(v));
    }
    if (const auto j = fails(small)) s.judged = *j;
    return s;
  }

  HuntResult hunt(const HuntOptions& options) const override {
    HuntProblem<S> problem;
    problem.key = fmt::format("{}.{}.{}", property, scalar, options.operation);
    problem.fields = fields;
    problem.bands = bands().all().size();
    // kappa of every case, or the figures that the budgets judge.
    static const Budget ratio{"", "", "any", Rule::excess, -1, ""};
    const Limits ratios(outputs.size(), {&ratio, &ratio});
    const auto& table = options.excess ? ratios : budgets_;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      if (outputs[i].operation != options.operation ||
          (!options.block.empty() && outputs[i].block != options.block))
        continue;
      Worst w;
      w.output = static_cast<int>(i);
      w.by_kappa = table[i][0]->rule == Rule::excess && table[i][1]->rule == Rule::excess;
      problem.objectives.push_back(w);
    }
    problem.generate = [this](Source& stream) { return property_->generate(stream); };
    problem.valid = [this](const std::vector<S>& x) { return property_->valid(x); };
    problem.measure = [&](const std::vector<S>& x) { return measure(x, table); };
    problem.score = [](const Worst& w, const Judged& j) {
      if (j.budget->rule == Rule::forward) return j.residual.error;
      return w.by_kappa && !j.ill_posed ? j.excess : -1.0;
    };
    HuntResult result = hunt_worst(problem, options);
    for (Worst& w : result.worst)
      for (CaseId* id : {&w.id, &w.first_broken_id})
        id->property = property, id->subject = subject, id->scalar = scalar, id->robot = robot;
    return result;
  }

 private:
  /// The series' key of a seed, computed once a thread.
  const Source::Key& key_of(std::uint64_t seed) const {
    thread_local struct {
      std::uint64_t series = 0, seed = 0;
      Source::Key key{};
    } last;
    if (last.series != number_ || last.seed != seed) last = {number_, seed, id(seed, 0).series_key()};
    return last.key;
  }

  std::vector<S> numbers(const CaseId& address) const {
    if (!address.raw) {
      Source stream(address.key());
      return property_->generate(stream);
    }
    const std::vector<S> x = parsed(address);
    check_valid(x, address);
    return x;
  }

  std::vector<S> parsed(const CaseId& address) const {
    std::vector<S> x;
    for (const std::string& text : address.input) x.push_back(parse_float<S>(text));
    std::size_t expected = 0;
    for (const Field& f : property_->fields()) expected += static_cast<std::size_t>(f.size);
    if (x.size() != expected)
      throw std::invalid_argument(
          fmt::format("case ID: property {} takes {} numbers, {} were given", property, expected, x.size()));
    return x;
  }

  void check_valid(const std::vector<S>& x, const CaseId& address) const {
    if (!property_->valid(x))
      throw std::invalid_argument(fmt::format("case ID: not a valid input of property {}: {}", property,
                                              fmt::join(address.input, ",")));
  }

  /// By ball arithmetic first, at 50 and 100 digits where that leaves the verdict open (Ziv 1991).
  std::vector<Judged> measure(const std::vector<S>& x) const { return measure(x, budgets_); }
  std::vector<Judged> measure(const std::vector<S>& x, const Limits& limits) const {
    Judge judge(limits, bands(), eps, oracles::error_accuracy);
    return decided_fast(x, judge) ? std::move(judge.judged) : measure_slowly(x, limits);
  }
  bool decided_fast(const std::vector<S>& x, Judge& judge) const {
    for (std::size_t tier = 0;; ++tier) try {
        return property_->measure_fast(subject_, x, judge, tier);
      } catch (const oracles::Undecided&) {
        judge.judged.clear();
      } catch (const std::exception&) {
        judge.outcome(0, 0, Outcome::refused);
        return true;
      }
  }
  std::vector<Judged> measure_slowly(const std::vector<S>& x) const { return measure_slowly(x, budgets_); }
  std::vector<Judged> measure_slowly(const std::vector<S>& x, const Limits& limits, bool every_kappa = false,
                                     std::string* refusal = nullptr) const {
    Judge judge(limits, bands(), eps, 0, every_kappa);
    try {
      property_->measure(subject_, x, judge);
    } catch (const std::exception& e) {
      if (refusal) *refusal = e.what();
      judge.outcome(0, 0, Outcome::refused);
    }
    return std::move(judge.judged);
  }
  static constexpr std::uint64_t checked_every = 512;

  std::unique_ptr<Property<S>> property_;
  const Subject<S>& subject_;
  Limits budgets_;
  const std::uint64_t number_ = next_number();  ///< no address, which a later series may have again
};

/// A variant of a subject, such as textbook:1e-4, runs where it is named.
bool on_request(const std::string& subject) {
  return subject.find(':') != std::string::npos;
}

template <class S>
void add_series(const Selection& selection, const Robot& robot, std::vector<std::unique_ptr<Series>>& all) {
  const auto wanted = [](const std::vector<std::string>& list, const std::string& name) {
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
  };
  if (!wanted(selection.scalars, scalar_name<S>())) return;
  for (const Subject<S>* subject : subjects<S>()) {
    if (!wanted(selection.subjects, subject->name)) continue;
    if (selection.subjects.empty() && on_request(subject->name)) continue;
    for (auto& property : make_properties<S>()) {
      if (!wanted(selection.properties, property->name()) || !property->offered(*subject)) continue;
      all.push_back(std::make_unique<SeriesOf<S>>(std::move(property), *subject, robot));
    }
  }
}

void check_names(const std::vector<std::string>& given, const std::vector<std::string>& known,
                 const char* what) {
  for (const std::string& name : given) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::vector<std::string> plain;
    std::copy_if(known.begin(), known.end(), std::back_inserter(plain),
                 [](auto& n) { return !on_request(n); });
    throw std::invalid_argument(fmt::format(
        "--{0}: unknown {0} '{1}'; known: {2}{3}", what, name, fmt::join(plain, ", "),
        plain.size() < known.size() ? ", and the variants and bugs that 'liecheck list' tells of" : ""));
  }
}

}  // namespace

std::vector<std::unique_ptr<Series>> select(const Selection& selection, const Robot& robot) {
  check_subjects(selection.subjects);
  check_names(selection.properties, property_names(), "property");
  check_names(selection.scalars, {"float", "double", "float128"}, "scalar");
  std::vector<std::unique_ptr<Series>> all;
  add_series<float>(selection, robot, all);
  add_series<double>(selection, robot, all);
  add_series<float128>(selection, robot, all);
  return all;
}

std::unique_ptr<Series> series_of(const std::string& property, const Subject<double>& subject,
                                  const Robot& robot) {
  check_names({property}, property_names(), "property");
  for (auto& p : make_properties<double>())
    if (p->name() == property) return std::make_unique<SeriesOf<double>>(std::move(p), subject, robot);
  return nullptr;
}

std::vector<std::string> subject_names() {
  std::set<std::string> names;
  for (const auto* s : subjects<float>()) names.insert(s->name);
  for (const auto* s : subjects<double>()) names.insert(s->name);
  for (const auto* s : subjects<float128>()) names.insert(s->name);
  return {names.begin(), names.end()};
}

void check_subjects(const std::vector<std::string>& names) {
  check_names(names, subject_names(), "subject");
}

std::vector<std::string> property_names() {
  std::vector<std::string> names;
  for (const auto& p : make_properties<double>()) names.push_back(p->name());
  return names;
}

Robot robot_of(const std::string& urdf, const std::string& path, bool fixed) {
  Robot r;
  r.urdf = urdf, r.path = path, r.fixed = fixed;
  r.hash = hexadecimal(sha256(fixed ? urdf + "\nroot fixed\n" : urdf)).substr(0, 16);
  const std::string source = path.empty() ? "the built-in robot" : path;
  const auto model = buildModelFromUrdfText(urdf, fixed ? RootJoint::Fixed : RootJoint::FreeFlyer, source);
  if (model.nv == 0)
    throw UrdfError(source, 0, "nothing moves: no joint but fixed ones, and --root fixed", model.name);
  for (std::size_t j = 1; j < model.joints.size(); ++j)
    if (model.nqs[j] == 4)
      throw UrdfError(source, 0, "a planar joint: no law measures one yet", model.names[j]);
  r.name = model.name;
  return r;
}

Robot load_robot(const std::string& path, bool fixed) {
  return robot_of(readUrdf(path), path, fixed);
}

std::string robot_flags(const Robot& robot) {
  return " --robot " + shell_quoted(robot.path) + (robot.fixed ? " --root fixed" : "");
}

Robot built_in_robot() {
  return robot_of(built_in_robot_urdf, "");
}

}  // namespace liecheck::properties
