#include <timing/cost.hpp>

#include <fmt/format.h>
#include <adapters/sizes.hpp>
#include <chrono>
#include <cmath>
#include <operations/list.hpp>
#include <stdexcept>
#include <subjects/subject_names.hpp>
#include <support/names.hpp>
#include <support/stop.hpp>
#include <timing/direct.hpp>
#include <timing/kernels.hpp>
#include <timing/rows.hpp>
#include <timing/score.hpp>

namespace liecheck::properties {

double BlockErrors::quantile(double q) const {
  if (errors.empty()) return 0;
  std::vector<double> sorted = errors;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(q * static_cast<double>(errors.size()))) - 1;
  const auto at = sorted.begin() + std::max<std::ptrdiff_t>(0, rank);
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

void merge_blocks(std::vector<BlockErrors>& all, const std::vector<BlockErrors>& more) {
  for (const BlockErrors& b : more) {
    auto a = std::find_if(all.begin(), all.end(), [&](const BlockErrors& x) { return x.block == b.block; });
    if (a == all.end()) a = all.insert(all.end(), BlockErrors{b.block, {}});
    a->errors.insert(a->errors.end(), b.errors.begin(), b.errors.end());
    a->not_finite += b.not_finite, a->wrong_branch += b.wrong_branch;
    a->unresolved += b.unresolved, a->refused += b.refused;
  }
}

namespace {

/// By default the subjects of a campaign and liecheck's variants, or those of a curve.
bool is_selected(const CostPlan& plan, const std::string& subject) {
  if (plan.options.curve && plan.options.subjects.empty())
    return subject == "liecheck" || subject.starts_with("textbook:") || subject.starts_with("series:");
  return plan.options.subjects.empty()
             ? subject.find(':') == std::string::npos || subject.starts_with("liecheck:")
             : plan.wants(plan.options.subjects, subject);
}
template <class S>
std::vector<const TypedSubject<S>*> subjects_of(const CostPlan& plan) {
  std::vector<const TypedSubject<S>*> all;
  for (const TypedSubject<S>* s : typed_subjects<S>())
    if (is_selected(plan, s->name)) all.push_back(s);
  if constexpr (std::is_same_v<S, double>)
    if (plan.options.flags) {
      static const std::vector<TypedSubject<double>> kernels = load_kernels();
      for (const TypedSubject<double>& s : kernels) all.push_back(&s);
    }
  return all;
}

using Laws = std::vector<std::unique_ptr<Property>>;

template <class S>
void add_scalar(CostPlan& plan, const std::string& scalar, const Laws& laws) {
  if (!plan.wants(plan.options.scalars, scalar)) return;
  std::map<std::string, std::shared_ptr<Property>> own_laws;
  for (auto& law : make_properties(oracles::scalar_of<S>)) own_laws.emplace(law->name(), std::move(law));
  const auto score_of = [&](const Operation& operation, const Property& law, Subject only) -> Score<S> {
    return [only = std::move(only), &operation, law = own_laws.at(law.name())](const auto& inputs) {
      std::vector<std::vector<double>> numbers;
      for (const auto& x : inputs) numbers.push_back(oracles::as_doubles<S>(x));
      try {
        return score(*law, operation, only, numbers);
      } catch (const GivenUp&) {  // the row is left out
        return std::vector<BlockErrors>();
      }
    };
  };
  // Foreign code is loaded only where it is timed, in a process of its own.
  const auto add_adapters = [&](const Operation& operation, const Property& law,
                                std::vector<Offered<S>>& offered) {
    for (const Subject* s : subjects(oracles::scalar_of<S>)) {
      if (s->adapter.empty() || !is_selected(plan, s->name) || !s->operations.has(operation)) continue;
      const std::string name(operation.name);
      const conventions::Statements& stated = adapters::description_of(s->adapter)->conventions;
      const std::size_t at = adapters::place_of(*adapters::sizes_of(name));
      const adapters::OperationSizes& sizes =
          s->takes.quaternion_poses ? adapters::quaternion_sizes()[at] : adapters::all_sizes()[at];
      const bool is_library = !adapters::library_in(s->adapter).empty();
      const auto& loops = adapters::description_of(s->adapter)->timed;
      const std::string timed = loops.contains(name) ? loops.at(name) : is_library ? "calls" : "";
      if (timed.empty()) continue;  // its times would be those of a pipe
      Subject only{s->name, s->version, s->adapter, s->scalar};
      only.operations.take(operation, s->operations);
      Offered<S> row{s->name, s->version, {}, nullptr, score_of(operation, law, std::move(only))};
      row.timed = timed;
      if (!plan.scored)
        row.passes = [&operation, stated, is_library, timed,
                      calls = AdapterCalls<S>{s->adapter, name, scalar, sizes, {}}](
                         const std::vector<std::vector<double>>& inputs) mutable {
          calls.inputs.clear();
          for (const auto& x : inputs)
            for (const double number :
                 conventions::given(operation, stated, x, oracles::scalar_of<S>.is_float()))
              calls.inputs.push_back(static_cast<S>(number));
          return is_library ? library_passes(calls) : program_passes(calls, timed);
        };
      offered.push_back(std::move(row));
    }
  };
  add_cost_rows<S, S>(
      plan, scalar, static_cast<double>(std::numeric_limits<S>::epsilon()), subjects_of<S>(plan),
      plan.options.inputs_per_band, true, laws,
      [&](const Operation& operation, const Property& law, const TypedSubject<S>& subject, const Signature&,
          AnyFunction) -> Score<S> {
        TypedSubject<S> only;
        only.operations.take(operation, subject.operations);
        return score_of(operation, law, erased(only));
      },
      add_adapters);
}

}  // namespace

std::vector<std::string>& linked_wide_scalars() {
  static std::vector<std::string> names;
  return names;
}

std::vector<std::string> cost_scalars() {
  std::vector<std::string> all = {"float", "double"};
  all.insert(all.end(), linked_wide_scalars().begin(), linked_wide_scalars().end());
  return all;
}

std::vector<std::string> cost_operations() {
  std::vector<std::string> all;
  const Laws laws = make_properties(oracles::scalar_of<double>);
  SpatialSlots<double>::for_each([&](const Operation& operation) {
    if (law_of(operation, laws)) all.emplace_back(operation.name);
  });
  return all;
}

std::vector<std::string> cost_operations_of(const std::vector<std::string>& names) {
  std::vector<std::string> all = cost_operations();
  std::erase_if(all, [&](const std::string& name) {
    return std::ranges::none_of(subjects(oracles::scalar_of<double>), [&](const Subject* s) {
      return std::ranges::count(names, s->name) > 0 &&
             std::ranges::any_of(all_operations(), [&](const Operation* o) {
               return o->name == name && s->operations.has(*o);
             });
    });
  });
  return all;
}

namespace {

/// All rows, with their errors if `scored`. Throws std::invalid_argument if there are none.
CostPlan plan_of(const CostOptions& options, bool scored) {
  check_known(options.operations, cost_operations(), "--op", "operation");
  check_known(options.subjects, subject_names(), "--subject", "subject");
  check_known(options.scalars, cost_scalars(), "--scalar", "scalar");
  CostPlan plan{options, scored, {}, {}};
  const Laws laws = make_properties(oracles::scalar_of<double>);
  add_scalar<float>(plan, "float", laws);
  add_scalar<double>(plan, "double", laws);
  if (linked_wide_rows) linked_wide_rows(plan, laws);
  if (plan.rows.empty() && !plan.stopped())
    throw std::invalid_argument(
        "nothing to time: no selected subject offers a selected operation in that scalar");
  return plan;
}

/// The passes that are timed, in the order of the plan.
std::vector<Timed> passes_of(const CostPlan& plan) {
  std::vector<Timed> all;
  for (const TimedSet& t : plan.timed) all.push_back(t.timed);
  return all;
}

}  // namespace

std::string times_in_this_process(const CostOptions& options) {
  return written(run_interleaved(passes_of(plan_of(options, false)),
                                 {options.seconds, options.repetitions, options.stop, options.progress}));
}

CostResult measure_cost(const CostOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  CostPlan plan = plan_of(options, true);
  CostResult result{options, {}, false, 0, {}, no_counter()};
  std::vector<std::vector<Repetition>> repetitions(plan.timed.size());
  for (std::size_t p = 0; p < options.processes && !plan.stopped(); ++p) {
    const double share = 1 / static_cast<double>(options.processes);
    if (const auto text = options.times_in_a_process(share * options.seconds))
      append_written(repetitions, *text, p);
    options.progress(share * static_cast<double>(p + 1));
  }
  result.machine = keep_undisturbed(repetitions);
  std::vector<double> spreads;
  auto next = repetitions.begin();
  for (const TimedSet& t : plan.timed) {
    CostSet& set = plan.rows[t.row].sets[t.set];
    set.*t.what = ratio_of(*next);
    if ((set.*t.what).processes > 0) spreads.push_back((set.*t.what).spread());
    if (t.what == &CostSet::throughput)
      set.instructions = counted(*next, &Repetition::instructions),
      set.cycles = counted(*next, &Repetition::cycles);
    ++next;
  }
  result.machine.spread = spread_of(std::move(spreads)).median;
  result.rows = std::move(plan.rows);
  result.complete = !plan.stopped();
  result.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace liecheck::properties
