#include <lattice/lattice.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <lattice/verdict_file.hpp>
#include <stdexcept>
#include <support/names.hpp>
#include <support/progress.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {
namespace {

Subject subject_named(const std::string& name, const Scalar& scalar) {
  if (name == "look-alikes") return look_alikes(scalar);
  std::string known = "look-alikes";
  for (const Subject* s : subjects(scalar)) {
    if (s->name == name) return *s;
    if (s->name.find(':') == std::string::npos) known += ", " + s->name;
  }
  throw std::invalid_argument(fmt::format("--subject: unknown subject '{}'; known: {}", name, known));
}

/// The named operations. Throws std::invalid_argument for one that no subject can offer.
std::vector<const Operation*> named(const std::vector<std::string>& names) {
  std::vector<const Operation*> all;
  SpatialSlots<double>::for_each([&](const Operation& o) { all.push_back(&o); });
  RobotOperations<double>::for_each([&](const Operation& o) { all.push_back(&o); });
  TreeOperations<double>::for_each([&](const Operation& o) { all.push_back(&o); });
  check_known(names, names_of(all, &Operation::name), "--operation", "operation");
  std::erase_if(all, [&](auto* o) {
    return !names.empty() && std::find(names.begin(), names.end(), o->name) == names.end();
  });
  return all;
}

LawKinds laws_for(const std::vector<const Operation*>& operations) {
  std::size_t trees = 0;
  TreeOperations<double>::for_each(
      [&](const Operation& o) { trees += std::count(operations.begin(), operations.end(), &o); });
  return {trees<operations.size(), trees> 0};
}

class Run {
 public:
  Run(const LatticeOptions& options, const Robot& robot)
      : o_(options),
        robot_(robot),
        operations_(named(o_.operations)),
        file_(o_.resume, fmt::format("liecheck lab lattice, seed {}, {}", o_.seed, o_.scalar)),
        progress_("lattice") {
    result_.options = o_;
    for (const std::string& name : o_.subjects)
      bases_.push_back(subject_named(name, oracles::scalar_named(o_.scalar)));
  }

  LatticeResult all() {
    for (; base_ < bases_.size() && !stop(); ++base_) one_base();
    result_.complete = !stopped_;
    return std::move(result_);
  }

 private:
  bool stop() {
    if (stop_requested || (o_.seconds && progress_.elapsed() > *o_.seconds)) stopped_ = true;
    return stopped_;
  }
  void show(double share_of_base, const std::string& what) {
    const auto base = static_cast<double>(base_), all = static_cast<double>(bases_.size());
    progress_.show((base + share_of_base) / all,
                   [&](double) { return fmt::format("{}, {}", bases_[base_].name, what); });
  }

  void one_base() {
    const Subject& base = bases_[base_];
    Lab lab(base, triggers(), o_.seed, robot_, laws_for(operations_));
    const auto stop_scan = [this] {
      show(0, "looking where triggers fire");
      return stop();
    };
    if (!lab.scan(std::min(o_.cases, first_cases), stop_scan)) return;
    const std::vector<Fault> faults = selected(lab);
    std::vector<std::pair<Fault, std::size_t>> rarer;  // and their rows
    std::size_t done = 0;
    for (const Fault& fault : faults) {
      if (stop()) return;
      show(0.5 * static_cast<double>(done) / static_cast<double>(faults.size()),
           fmt::format("{} of {} faults", done, faults.size()));
      ++done;
      LatticeRow row = row_of(base, fault);
      judge(lab, fault, row, std::min(o_.cases, first_cases));
      if (!row.found_within(o_.cases) && row.verdict.share < common_share && !table_of(fault).is_habit())
        rarer.emplace_back(fault, result_.rows.size());
      result_.rows.push_back(std::move(row));
    }
    result_.failures_of_base[base.name] = lab.failures_of_base();
    for (std::uint64_t cases = 10 * first_cases; cases <= o_.cases; cases *= 10)
      judge_rarer(lab, rarer, cases);
  }

  void judge_rarer(Lab& lab, const std::vector<std::pair<Fault, std::size_t>>& rarer, std::uint64_t cases) {
    const auto stop_scan = [this, cases] {
      show(0.5, fmt::format("rarer triggers in {} cases", cases));
      return stop();
    };
    // A resumed run needs no cases if it has every verdict.
    const auto open = [&](const auto& r) { return !known(result_.rows[r.second], cases); };
    if (std::none_of(rarer.begin(), rarer.end(), open) || !lab.scan(cases, stop_scan)) return;
    for (const auto& [fault, at] : rarer) {
      if (stop()) return;
      if (LatticeRow& row = result_.rows[at]; row.verdict.found != Found::found)
        judge(lab, fault, row, cases);
    }
  }

  /// Whether the row, or the file, has the verdict after so many cases.
  bool known(LatticeRow& row, std::uint64_t cases) const {
    if (const LatticeRow* before = file_.find(row.key()))
      if (before->judged >= cases || before->verdict.found == Found::found) row = *before;
    return row.judged >= cases || row.verdict.found == Found::found;
  }
  void judge(Lab& lab, const Fault& fault, LatticeRow& row, std::uint64_t cases) {
    if (known(row, cases)) return;
    row.verdict = lab.judge(fault);
    row.judged = cases;
    file_.append(row);
  }

  const Trigger& table_of(const Fault& fault) const { return triggers()[fault.trigger]; }
  LatticeRow row_of(const Subject& base, const Fault& fault) const {
    const auto blocks = block_names(*fault.operation);
    const Trigger& trigger = table_of(fault);
    return {base.name,
            std::string(fault.operation->name),
            blocks[fault.perturbation.block % blocks.size()],
            fault.perturbation.name(),
            trigger.family,
            trigger.name,
            {},
            0};
  }
  /// The faults of the selected operations in random order, or a sample of them.
  std::vector<Fault> selected(const Lab& lab) const {
    std::vector<Fault> all = lab.faults();
    std::erase_if(all, [&](const Fault& f) {
      return std::find(operations_.begin(), operations_.end(), f.operation) == operations_.end() ||
             lab.share(f) < o_.least_share;
    });
    Source source({o_.seed, base_, 0, 0});
    for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[source.below(i)]);
    const std::size_t sample = (o_.faults + base_) / bases_.size();
    if (o_.faults > 0 && all.size() > sample) all.resize(sample);
    return all;
  }

  const LatticeOptions& o_;
  const Robot& robot_;
  std::vector<const Operation*> operations_;
  VerdictFile file_;
  Progress progress_;
  LatticeResult result_;
  std::vector<Subject> bases_;
  std::size_t base_ = 0;
  bool stopped_ = false;
};

}  // namespace

Subject look_alikes(const Scalar& scalar) {
  return scalar.with([]<class S>() {
    TypedSubject<S> all;
    for (const TypedSubject<S>* s : typed_subjects<S>())
      if (s->name == "liecheck") all = *s;
    const TypedOperations<S> good = all.operations;
    all.name = "look-alikes";
    for (const TypedSubject<S>* s : typed_subjects<S>())
      if (s->name.starts_with("alike:"))
        SpatialSlots<S>::for_each([&](const auto& o) {
          if (s->operations[o] != good[o]) all.operations[o] = s->operations[o];
        });
    all.operations.robot = nullptr, all.operations.tree = nullptr;
    return erased(all);
  });
}

std::size_t LatticeResult::common() const {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const LatticeRow& r) {
    return r.counts() && r.verdict.share >= common_share;
  }));
}
std::size_t LatticeResult::common_found() const {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const LatticeRow& r) {
    return r.counts() && r.verdict.share >= common_share && r.found_within(first_cases);
  }));
}

LatticeResult run_lattice(const LatticeOptions& options, const Robot& robot) {
  return Run(options, robot).all();
}

}  // namespace liecheck::properties
