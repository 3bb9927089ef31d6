#include <timing/cost.hpp>

#include <fmt/format.h>
#include <chrono>
#include <cmath>
#include <set>
#include <stdexcept>
#include <timing/kernels.hpp>
#include <timing/rows.hpp>
#include <timing/score.hpp>

namespace liecheck::properties {

Spread spread_of(std::vector<double>& x) {
  if (x.empty()) return {};
  std::sort(x.begin(), x.end());
  const std::size_t n = x.size();
  // The interval is from the k-th smallest to the k-th largest sample, with the largest k for which
  // P(fewer than k of n samples are below the true median) <= 1/40.
  double probability = std::pow(0.5, static_cast<double>(n)), below = 0;
  std::size_t k = 0;
  while (k < n / 2 && below + probability <= 0.025) {
    below += probability;
    probability *= static_cast<double>(n - k) / static_cast<double>(k + 1);
    ++k;
  }
  const std::size_t edge = k > 0 ? k - 1 : 0;
  return {n % 2 ? x[n / 2] : (x[n / 2 - 1] + x[n / 2]) / 2, x[edge], x[n - 1 - edge], n};
}

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

/// The selected subjects; by default those of a campaign and liecheck's variants.
template <class S>
std::vector<const Subject<S>*> subjects_of(const CostPlan& plan) {
  std::vector<const Subject<S>*> all;
  for (const Subject<S>* s : subjects<S>())
    if (plan.options.subjects.empty()
            ? s->name.find(':') == std::string::npos || s->name.rfind("liecheck:", 0) == 0
            : plan.wants(plan.options.subjects, s->name))
      all.push_back(s);
  if constexpr (std::is_same_v<S, double>)
    if (plan.options.flags) {
      static const std::vector<Subject<double>> kernels = load_kernels();
      for (const Subject<double>& s : kernels) all.push_back(&s);
    }
  return all;
}

using Laws = std::vector<std::unique_ptr<Property<double>>>;

template <class S>
void add_scalar(CostPlan& plan, const std::string& scalar, const Laws& laws) {
  if (!plan.wants(plan.options.scalars, scalar)) return;
  std::map<std::string, std::unique_ptr<Property<S>>> laws_in_S;
  for (auto& law : make_properties<S>()) laws_in_S.emplace(law->name(), std::move(law));
  add_cost_rows<S, S>(plan, scalar, static_cast<double>(std::numeric_limits<S>::epsilon()),
                      subjects_of<S>(plan), plan.options.inputs_per_band, true, laws,
                      [&](const Operation& operation, const Property<double>& law, const Subject<S>& subject,
                          const Signature&, AnyFunction) -> Score<S> {
                        Subject<S> only;
                        only.operations.take(operation, subject.operations);
                        return [only, &operation, &law = *laws_in_S.at(law.name())](const auto& inputs) {
                          return score(law, operation, only, inputs);
                        };
                      });
}

void check_known(const std::vector<std::string>& given, const std::vector<std::string>& known,
                 const char* flag, const char* what) {
  for (const std::string& name : given)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw std::invalid_argument(
          fmt::format("{}: unknown {} '{}'; known: {}", flag, what, name, fmt::join(known, ", ")));
}

}  // namespace

std::vector<std::string> cost_operations() {
  std::vector<std::string> all;
  const Laws laws = make_properties<double>();
  SpatialSlots<double>::for_each([&](const Operation& operation) {
    if (law_of(operation, laws)) all.emplace_back(operation.name);
  });
  return all;
}

std::vector<std::string> cost_subjects() {
  std::set<std::string> names;
  for (const auto* s : subjects<float>()) names.insert(s->name);
  for (const auto* s : subjects<double>()) names.insert(s->name);
  return {names.begin(), names.end()};
}

CostResult measure_cost(const CostOptions& options) {
  check_known(options.operations, cost_operations(), "--op", "operation");
  check_known(options.subjects, cost_subjects(), "--subject", "subject");
  check_known(options.scalars, cost_scalars(), "--scalar", "scalar");
  const auto start = std::chrono::steady_clock::now();
  CostPlan plan{options, {}, {}};
  const Laws laws = make_properties<double>();
  add_scalar<float>(plan, "float", laws);
  add_scalar<double>(plan, "double", laws);
  add_tiers(plan, laws);
  if (plan.rows.empty() && !plan.stopped())
    throw std::invalid_argument(
        "nothing to time: no selected subject offers a selected operation in that scalar");

  std::vector<Timed> timed;
  for (const TimedSet& t : plan.timed)
    for (const auto pass : {&Signature::throughput, &Signature::latency})
      if (t.signature.*pass) timed.push_back({t.pass(pass), t.n, {}, {}});
  CostResult result{options, {}, false, 0, ""};
  result.no_counter =
      run_interleaved(timed, {options.seconds, options.repetitions, options.stop, options.progress});
  auto next = timed.begin();
  for (const TimedSet& t : plan.timed) {
    CostSet& set = plan.rows[t.row].sets[t.set];
    set.instructions = spread_of(next->instructions).median;
    set.throughput = spread_of((next++)->ns);
    if (t.signature.latency) set.latency = spread_of((next++)->ns);
  }
  result.rows = std::move(plan.rows);
  result.complete = !plan.stopped();
  result.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace liecheck::properties
