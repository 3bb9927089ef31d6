#pragma once
// One scalar's rows: every operation of every subject, scored, and ready to be timed.

#include <algorithm>
#include <timing/arguments.hpp>
#include <timing/benchmarks.hpp>
#include <timing/cost.hpp>
#include <timing/inputs.hpp>
#include <timing/loops.hpp>

namespace liecheck::properties {

/// The row and the set that receive the times of these loops.
struct TimedSet {
  std::size_t row, set;
  Loops loops;
};

struct CostPlan {
  const CostOptions& options;
  std::vector<CostRow> rows;
  std::vector<TimedSet> timed;

  bool wants(const std::vector<std::string>& list, const std::string& name) const {
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
  }
  bool stopped() const { return options.stop && *options.stop; }
};

/// The same samples for every subject of a scalar: band after band, `each` of them.
template <class S>
std::vector<std::vector<S>> cost_inputs(const std::vector<Field>& fields, std::uint64_t seed,
                                        std::size_t each) {
  std::vector<std::vector<S>> all;
  for (std::size_t b = 0; b < cost_bands.size(); ++b)
    for (std::size_t i = 0; i < each; ++i)
      all.push_back(cost_input<S>(fields, cost_bands[b], Source({seed, b, i, 0x636f7374})));
  return all;
}

/// All bands together are called in an order that a processor cannot foresee.
template <class T>
void shuffle(std::vector<T>& all, std::uint64_t seed) {
  Source source({seed, 0, 0, 0x6d6978});
  for (std::size_t n = all.size(); n > 1; --n) std::swap(all[n - 1], all[source.below(n)]);
}

/// The row of one operation for each subject that offers it. score(operation, law, function, inputs) -> blocks. Input is
/// the scalar in which inputs are sampled; S holds it exactly. bands: time each band as well as all together.
template <class S, class Input, class Score, class Op, class R, class... A>
void add_operation_rows(CostPlan& plan, const CostRow& common, const std::vector<const Subject<S>*>& subjects,
                        std::size_t each, bool bands, const Property<double>& law, const Score& score,
                        const Op& operation, R (*)(const A&...)) {
  const std::vector<Field> fields = law.fields();
  const FieldPositions positions(fields);
  const auto flat = cost_inputs<Input>(fields, plan.options.seed, each);
  std::vector<std::tuple<A...>> tuples;
  for (const auto& x : flat)
    tuples.push_back(arguments_of(operation, positions, std::vector<S>(x.begin(), x.end())));
  const auto inputs = std::make_shared<const std::vector<std::tuple<A...>>>(tuples);
  shuffle(tuples, plan.options.seed);
  const auto shuffled = std::make_shared<const std::vector<std::tuple<A...>>>(std::move(tuples));
  const auto add = [&](const std::string& subject, const std::string& version, R (*f)(const A&...),
                       bool scored) {
    CostRow row = common;
    row.subject = subject, row.version = version;
    const bool by_band = bands && subject.find('@') == std::string::npos;  // other flags: all together
    CostSet mixed{"mixed", flat.size(), {}, {}, 0, {}};
    for (std::size_t b = 0; b < cost_bands.size() && !plan.stopped(); ++b) {
      const auto from = flat.begin() + static_cast<std::ptrdiff_t>(b * each);
      CostSet set{cost_bands[b].name, each, {}, {}, 0, {}};
      if (scored)
        set.blocks = score(operation, law, f,
                           std::vector<std::vector<Input>>(from, from + static_cast<std::ptrdiff_t>(each)));
      merge_blocks(mixed.blocks, set.blocks);
      if (by_band) plan.timed.push_back({plan.rows.size(), b, loops_of<R, A...>(f, inputs, b * each, each)});
      row.sets.push_back(std::move(set));
    }
    if (plan.stopped()) return;
    plan.timed.push_back({plan.rows.size(), row.sets.size(), loops_of<R, A...>(f, shuffled, 0, flat.size())});
    row.sets.push_back(std::move(mixed));
    plan.rows.push_back(std::move(row));
  };
  const auto rows_before = plan.rows.size();
  for (const Subject<S>* s : subjects)
    if (s->operations[operation]) add(s->name, s->version, s->operations[operation], true);
  if (plan.rows.size() > rows_before) add("call", "", &timing_detail::call_only<R, A...>, false);
}

/// The rows of every operation that a subject offers and a law measures.
template <class S, class Input, class Score>
void add_cost_rows(CostPlan& plan, const std::string& scalar, double eps,
                   const std::vector<const Subject<S>*>& subjects, std::size_t each, bool bands,
                   const std::vector<std::unique_ptr<Property<double>>>& laws, const Score& score) {
  SpatialSlots<S>::for_each([&]<class Op>(const Op& operation) {
    const Property<double>* law = law_of(operation, laws);
    if (!law || plan.stopped() || !plan.wants(plan.options.operations, std::string(operation.name))) return;
    const CostRow common{"", "", scalar, std::string(operation.name), eps, {}};
    const typename Op::template Function<S> signature = nullptr;
    add_operation_rows<S, Input>(plan, common, subjects, each, bands, *law, score, operation, signature);
  });
}

}  // namespace liecheck::properties
