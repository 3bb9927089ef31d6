#include <invariants/property.hpp>
#include <lattice/lab.hpp>
#include <search/condition.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/judge.hpp>
#include <invariants/tree_laws.hpp>

namespace liecheck::properties {
namespace {

/// One case of this many runs on a second thread, as with two jobs.
constexpr std::uint64_t second_thread_interval = 64;
/// If laws measured a fault so often and always granted it, its error is below their limits. A change of less
/// than 1 eps of its block is rounding, and no oracle measures it.
constexpr std::uint64_t enough_grants = 100;

/// Whether a quaternion is the block of a result whose sign no law measures, so that -Q is right too.
bool either_sign(const Operation& operation, unsigned of_block) {
  const auto& parts = operation.results[0]->parts;
  return of_block < parts.size() && parts[of_block].size == 4 &&
         std::none_of(operation.blocks.begin(), operation.blocks.end(), [](const Block& b) {
           return b.name.text == block::sign.text || b.name.text == block::quaternion.text;
         });
}

bool fails_output(const std::vector<Judged>& judged, std::uint16_t output) {
  return std::any_of(judged.begin(), judged.end(),
                     [&](const Judged& j) { return j.failed && j.residual.output == output; });
}

bool any_failed(const std::vector<Judged>& judged) {
  return std::any_of(judged.begin(), judged.end(), [](const Judged& j) { return j.failed; });
}

}  // namespace

Lab::Lab(const Subject& base, const std::vector<Trigger>& table, std::uint64_t seed, const Robot& robot,
         LawKinds kinds)
    : triggers_(table), seed_(seed), watch_(table), subject_(watch_.watched(base)) {
  for (auto& law : make_properties(*base.scalar)) {
    const bool of_trees = is_tree_law(law->name());
    if (!(of_trees ? kinds.trees : kinds.single) || !law->offered(subject_)) continue;
    LawRun& run = laws_.emplace_back();
    run.of_trees = of_trees;
    run.series = std::make_unique<Series>(std::move(law), subject_, robot);
    run.key = run.series->id(seed, 0).series_key();
  }
  if (laws_.empty()) throw std::invalid_argument("lattice: no law applies to subject " + base.name);
}

std::vector<Judged> Lab::run(const LawRun& law, std::uint64_t index) {
  Source source(CaseId::key_of(law.key, index));
  const std::vector<double> x = law.series->tested_law().generate(source);
  std::vector<Judged> judged;
  const auto measure = [&] {
    const Watch::Active active(watch_);
    judged = law.series->measure_case(x, index);
  };
  if (index % second_thread_interval == second_thread_interval - 1)
    std::thread(measure).join();
  else
    measure();
  return judged;
}

void Lab::scan_case(LawRun& law, std::uint64_t index) {
  watch_.seen = [&](const Operation& operation, const Features& features) {
    std::vector<bool>& applies = applies_[&operation];
    applies.resize(triggers_.size());
    for (std::size_t t = 0; t < triggers_.size(); ++t) {
      if (!triggers_[t].applies(features)) continue;
      applies[t] = true;
      if (!triggers_[t].fires(features)) continue;
      Noted& noted = law.noted[{&operation, t}];
      const bool again = !noted.cases.empty() && noted.cases.back() == index;
      if (!noted.often && !again) noted.cases.push_back(static_cast<std::uint32_t>(index));
    }
  };
  if (index < first_cases) law.calls_before.push_back(watch_.calls);
  const bool failed = any_failed(run(law, index));
  law.base_fails.push_back(failed);
  law.failed += failed;
  watch_.seen = nullptr;
}

bool Lab::scan(std::uint64_t cases, const std::function<bool()>& stop) {
  watch_.fault = nullptr;
  for (LawRun& law : laws_) {
    const std::uint64_t end = law.of_trees ? std::max(cases / 10, std::min(cases, first_cases)) : cases;
    watch_.forget();
    watch_.calls.clear();
    for (; law.scanned < end; ++law.scanned) {
      if (stop()) return false;
      if (law.scanned == first_cases)
        for (auto& [where, noted] : law.noted)
          noted.often = static_cast<double>(noted.cases.size()) >= common_share * first_cases ||
                        triggers_[where.second].is_habit();
      scan_case(law, law.scanned);
    }
  }
  return true;
}

Perturbation Lab::drawn(const Operation& operation, std::size_t trigger) const {
  std::uint64_t word = 0xcbf29ce484222325;  // FNV-1a of the names
  for (const std::string& text : {subject_.name, std::string(operation.name), triggers_[trigger].name})
    for (const char c : text) word = (word ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  Source source({seed_, word, 0, 0});
  const auto number = [&](std::uint64_t n) { return static_cast<unsigned>(source.below(n)); };
  Perturbation p;
  constexpr PlantedChange others[] = {PlantedChange::not_a_number, PlantedChange::sign,
                                      PlantedChange::whole_sign,   PlantedChange::zero,
                                      PlantedChange::swap,         PlantedChange::stale};
  p.change = source.chance(3, 5) ? PlantedChange::size : others[number(std::size(others))];
  p.k = source.between(5, 50);
  p.block = number(block_names(operation).size());
  p.component = number(1 << 16);
  p.other = p.component + 1 + number(2);
  if (p.change == PlantedChange::whole_sign && either_sign(operation, p.block))
    p.change = PlantedChange::sign;
  return p;
}

std::vector<Fault> Lab::faults() const {
  std::vector<Fault> all;
  for (const Operation* operation : all_operations()) {
    const auto applies = applies_.find(operation);
    if (applies == applies_.end()) continue;
    for (std::size_t t = 0; t < triggers_.size(); ++t) {
      if (!applies->second[t]) continue;
      Fault fault{operation, t, drawn(*operation, t)};
      if (triggers_[t].feature != Feature::one) {
        all.push_back(fault);
        continue;
      }
      for (int change = static_cast<int>(PlantedChange::size);
           change <= static_cast<int>(PlantedChange::argument); ++change) {
        fault.perturbation.change = static_cast<PlantedChange>(change);
        if (fault.perturbation.change != PlantedChange::whole_sign ||
            !either_sign(*operation, fault.perturbation.block))
          all.push_back(fault);
      }
    }
  }
  return all;
}

bool Lab::fails(const LawRun& law, std::uint64_t index, const Fault& fault, Trial& trial, std::string& by) {
  watch_.forget();
  watch_.fault = &fault;
  watch_.planted = false;
  if (index > 0 && (fault.perturbation.remembers() || triggers_[fault.trigger].is_habit()))
    run(law, index - 1);
  if (index < law.calls_before.size()) watch_.calls = law.calls_before[index];
  watch_.planted = true, watch_.moved = 0;
  const std::vector<Judged> judged = run(law, index);
  watch_.fault = nullptr;
  const double moved = watch_.moved;
  if (moved == 0) return false;
  const std::vector<Judged> base = law.base_fails[index] ? run(law, index) : std::vector<Judged>();
  for (const Judged& j : judged)
    if (j.failed && !fails_output(base, j.residual.output)) {
      const Output& o = law.series->outputs.at(j.residual.output);
      by = fmt::format("{}: {}, {}", law.series->property, o.operation, o.block);
      trial.output = static_cast<std::size_t>(j.residual.output);
      return true;
    }
  if (law.base_fails[index]) return false;
  trial.changed = true;
  trial.granted += moved < 1 || !agree(judged, run(law, index));
  return false;
}

void Lab::tell(const LawRun& law, const Fault& fault, std::size_t output, FaultVerdict& verdict) {
  const Trigger& trigger = triggers_[fault.trigger];
  if (trigger.is_angle() || trigger.is_habit() || law.failed > 0) return;
  watch_.forget();
  watch_.fault = &fault, watch_.planted = true;
  std::optional<Condition> condition;
  {
    const Watch::Active active(watch_);
    condition = condition_of(*law.series, output, seed_);
  }
  watch_.fault = nullptr, watch_.planted = false;
  verdict.told = Told::silent;
  if (!condition) return;
  verdict.condition = condition->text;
  const auto& fired = law.noted.at({fault.operation, fault.trigger}).cases;
  const auto first = std::ranges::count_if(fired, [](std::uint32_t i) { return i < first_cases; });
  const double due = static_cast<double>(first) / first_cases,
               got = static_cast<double>(condition->cases) /
                     static_cast<double>(condition->cases + condition->elsewhere);
  const double spread = 3 * std::sqrt(due / first_cases);
  verdict.told = std::fabs(got - due) <= 0.2 * due + spread ? Told::right : Told::other;
}

double Lab::share(const Fault& fault) const {
  double share = 0;
  for (const LawRun& law : laws_) {
    const auto noted = law.noted.find({fault.operation, fault.trigger});
    if (noted == law.noted.end()) continue;
    const std::uint64_t scanned = noted->second.often ? first_cases : law.scanned;
    share = std::max(share, static_cast<double>(noted->second.cases.size()) / static_cast<double>(scanned));
  }
  return share;
}

FaultVerdict Lab::judge(const Fault& fault) {
  FaultVerdict verdict;
  verdict.share = share(fault);
  std::vector<std::pair<std::uint32_t, const LawRun*>> cases;
  for (const LawRun& law : laws_) {
    const auto noted = law.noted.find({fault.operation, fault.trigger});
    if (noted == law.noted.end()) continue;
    for (const std::uint32_t index : noted->second.cases) cases.emplace_back(index, &law);
  }
  std::stable_sort(cases.begin(), cases.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  Trial trial;
  for (const auto& [index, law] : cases) {
    if (fails(*law, index, fault, trial, verdict.by)) {
      verdict.found = Found::found, verdict.cases = index + 1;
      tell(*law, fault, trial.output, verdict);
      return verdict;
    }
    if (trial.granted >= enough_grants) break;
  }
  verdict.found = trial.granted > 0 ? Found::granted
                  : trial.changed   ? Found::unseen
                  : cases.empty()   ? Found::unfired
                                    : Found::unchanged;
  return verdict;
}

double Lab::failures_of_base() const {
  std::uint64_t cases = 0, failed = 0;
  for (const LawRun& law : laws_) cases += law.scanned, failed += law.failed;
  return cases > 0 ? static_cast<double>(failed) / static_cast<double>(cases) : 0;
}

}  // namespace liecheck::properties
