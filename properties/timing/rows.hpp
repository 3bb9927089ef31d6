#pragma once
// The rows of one scalar: every operation of every subject, with its errors, ready to be timed.

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <invariants/arguments.hpp>
#include <iterator>
#include <map>
#include <subjects/typed.hpp>
#include <timing/batches.hpp>
#include <timing/benchmarks.hpp>
#include <timing/cost.hpp>
#include <timing/inputs.hpp>
#include <timing/passes.hpp>
#include <timing/signature.hpp>

namespace liecheck::properties {

/// What gives a time of sets[set] of the row with index `row`.
struct TimedSet {
  std::size_t row, set;
  Ratio CostSet::*what;
  Timed timed;
};

struct CostPlan {
  const CostOptions& options;
  bool scored;  ///< whether the rows get errors
  std::vector<CostRow> rows;
  std::vector<TimedSet> timed;
  bool wants(const std::vector<std::string>& list, const std::string& name) const {
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
  }
  bool stopped() const { return options.stop && *options.stop; }
};

/// The first order of Euler angles that all of these subjects take, or 0.
inline int common_order(const std::vector<std::string>& names) {
  std::uint32_t all = Taken::every_order;
  for (const Scalar* scalar : {&oracles::scalar_of<float>, &oracles::scalar_of<double>})
    for (const Subject* s : subjects(*scalar))
      if (std::ranges::find(names, s->name) != names.end()) all &= s->takes.orders;
  return all ? std::countr_zero(all) : 0;
}

/// The inputs for every subject of a scalar: `each` inputs of every band, one band after another.
template <class S>
std::vector<std::vector<S>> cost_inputs(const std::vector<Field>& fields, const CostOptions& options,
                                        std::size_t each, int order = 0) {
  std::vector<std::vector<S>> all;
  for (std::size_t b = 0; b < options.bands().size(); ++b)
    for (std::size_t i = 0; i < each; ++i)
      all.push_back(
          cost_input<S>(fields, options.bands()[b], Source({options.seed, b, i, 0x636f7374}), order));
  return all;
}

/// The errors of one operation of one subject on inputs in the scalar Input, by block.
template <class Input>
using Score = std::function<std::vector<BlockErrors>(const std::vector<std::vector<Input>>& inputs)>;

/// An operation of a subject. `score` is null if it is only timed; signature.latency is null for a batch.
template <class Input>
struct Offered {
  std::string subject, version;
  Signature signature;
  AnyFunction function;
  Score<Input> score;
  /// Of an adapter: what is timed of calls with these arguments; null if they are timed elsewhere.
  std::function<Passes(const std::vector<std::vector<double>>&)> passes = nullptr;
  std::string timed = {};  ///< of CostRow
};

/// Adds the row of one operation for each subject that offers it. With `bands`, it also times each band.
template <class Input>
void add_operation_rows(CostPlan& plan, const CostRow& common, std::size_t each, bool bands,
                        const Property& law, const Operation& operation,
                        const std::vector<Offered<Input>>& all) {
  const std::vector<Field> fields = law.fields();
  std::vector<std::string> names;
  for (const Offered<Input>& offered : all) names.push_back(offered.subject);
  const auto inputs = cost_inputs<Input>(fields, plan.options, each, common_order(names));
  std::vector<std::vector<double>> numbers;
  for (const auto& x : inputs) numbers.push_back(FieldPositions(fields).arguments_of(operation, x));
  // The inputs of all bands are shuffled, so that a processor cannot predict the next band.
  auto shuffled = numbers;
  Source source({plan.options.seed, 0, 0, 0x6d6978});
  for (std::size_t n = shuffled.size(); n > 1; --n) std::swap(shuffled[n - 1], shuffled[source.below(n)]);
  std::map<decltype(Signature::arguments), std::array<std::shared_ptr<const char>, 2>> arguments;
  for (const Offered<Input>& offered : all) {
    CostRow row = common;
    row.subject = offered.subject, row.version = offered.version, row.timed = offered.timed;
    const Signature& signature = offered.signature;
    const bool is_adapter = !offered.timed.empty();
    std::array<Passes, 2> passes;  // in order, and shuffled
    if (is_adapter) {
      if (offered.passes) passes = {offered.passes(numbers), offered.passes(shuffled)};
    } else {
      auto& made = arguments[signature.arguments];
      if (!made[0]) made = {signature.arguments(numbers), signature.arguments(shuffled)};
      for (const int i : {0, 1}) passes[i] = function_passes(signature, offered.function, made[i]);
    }
    // Libraries compiled with other flags are timed on all bands together.
    const bool by_band = bands && !plan.options.curve && row.subject.find('@') == std::string::npos;
    CostSet mixed{"mixed", inputs.size(), {}, {}, 0, {}};
    std::vector<TimedSet> timed;  // added to the plan with their row, or not at all
    const auto time = [&](std::size_t set, const Passes& all, std::size_t first, std::size_t n) {
      for (const auto what : {&CostSet::throughput, &CostSet::latency})
        timed.push_back({plan.rows.size(), set, what, all ? all(what, first, n) : Timed{}});
    };
    for (std::size_t b = 0; b < plan.options.bands().size() && !plan.stopped(); ++b) {
      const auto from = inputs.begin() + static_cast<std::ptrdiff_t>(b * each);
      CostSet set{plan.options.bands()[b].name, each, {}, {}, 0, {}};
      if (plan.scored && offered.score)
        set.blocks = offered.score({from, from + static_cast<std::ptrdiff_t>(each)});
      merge_blocks(mixed.blocks, set.blocks);
      if (by_band) time(b, passes[0], b * each, each);
      row.sets.push_back(std::move(set));
    }
    if (plan.stopped()) return;
    time(row.sets.size(), passes[1], 0, inputs.size());
    if (is_adapter)
      timed.push_back({plan.rows.size(), row.sets.size(), &CostSet::interface,
                       passes[1] ? passes[1](&CostSet::interface, 0, inputs.size()) : Timed{}});
    row.sets.push_back(std::move(mixed));
    plan.rows.push_back(std::move(row));
    std::move(timed.begin(), timed.end(), std::back_inserter(plan.timed));
  }
}

/// Adds the rows of every operation that a subject offers and a law measures. Inputs are drawn in the scalar
/// Input; S represents each of them exactly. score(operation, law, subject, signature, function) returns the
/// Score of a function. add_more(operation, law, offered) may append what other subjects offer.
template <class S, class Input, class MakeScore, class AddMore>
void add_cost_rows(CostPlan& plan, const std::string& scalar, double eps,
                   const std::vector<const TypedSubject<S>*>& subjects, std::size_t each, bool bands,
                   const std::vector<std::unique_ptr<Property>>& laws, const MakeScore& score,
                   const AddMore& add_more) {
  const auto add = [&](const Operation& operation, const Signature& signature,
                       const std::vector<AnyFunction>& functions) {
    const Property* law = law_of(operation, laws);
    const std::string name(operation.name);
    if (!law || plan.stopped() || !plan.wants(plan.options.operations, name)) return;
    std::vector<Offered<Input>> offered;
    for (std::size_t i = 0; i < subjects.size(); ++i)
      if (const AnyFunction f = functions[i]) {
        const TypedSubject<S>& subject = *subjects[i];
        Signature own = signature;
        if constexpr (std::is_same_v<S, float> || std::is_same_v<S, double>)
          if (subject.name == batch_subject) own = batch_signature<S>(operation);
        if (own.arguments)
          offered.push_back(
              {subject.name, subject.version, own, f, score(operation, *law, subject, signature, f)});
      }
    add_more(operation, *law, offered);
    if (offered.empty()) return;
    offered.push_back({"call", "", signature, signature.call_only, nullptr});
    const CostRow common{"", "", scalar, name, eps, {}};
    add_operation_rows<Input>(plan, common, each, bands, *law, operation, offered);
  };
  SpatialSlots<S>::for_each([&]<class Op>(const Op& operation) {
    std::vector<AnyFunction> functions;
    for (const TypedSubject<S>* s : subjects)
      functions.push_back(reinterpret_cast<AnyFunction>(s->operations[operation]));
    add(operation, signature_of<S>(typename Op::template Function<S>(nullptr)), functions);
  });
}

/// Adds rows of the library in scalars wider than double, on double's inputs. Null in a program that links none of them.
inline void (*linked_wide_rows)(CostPlan& plan, const std::vector<std::unique_ptr<Property>>& laws) = nullptr;

}  // namespace liecheck::properties
