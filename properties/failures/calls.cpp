#include <failures/calls.hpp>

#include <algorithm>
#include <campaign/series.hpp>
#include <cmath>
#include <conventions/reference.hpp>
#include <conventions/values.hpp>
#include <invariants/property.hpp>
#include <invariants/witness.hpp>
#include <operations/numbers.hpp>
#include <operations/quaternion_poses.hpp>
#include <subjects/hooked.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

/// Appends the numbers of a value. A reference has none.
template <class T>
void append_numbers(std::vector<double>& to, const T& value) {
  if constexpr (!std::is_enum_v<T>)
    for_each_number(value, [&to](const auto& number) { to.push_back(static_cast<double>(number)); });
}
template <class T>
void note_reference(NotedCall& call, const T& value) {
  constexpr const char* names[] = {"WORLD", "LOCAL", "LOCAL_WORLD_ALIGNED"};
  if constexpr (std::is_same_v<T, Seen>) call.seen = names[static_cast<int>(value)];
}

/// The hook of a subject whose calls are noted.
struct Noting {
  std::shared_ptr<std::vector<NotedCall>> calls = std::make_shared<std::vector<NotedCall>>();

  template <class F, class... A>
  auto operator()(const Operation& operation, const F& function, const A&... arguments) const {
    NotedCall call{&operation, {}, {}, ""};
    (append_numbers(call.arguments, arguments), ...);
    (note_reference(call, arguments), ...);
    try {
      auto result = function(arguments...);
      append_numbers(call.result, result);
      calls->push_back(std::move(call));
      return result;
    } catch (const std::exception& e) {
      call.thrown = e.what();
      calls->push_back(std::move(call));
      throw;
    }
  }
};

/// Whether a call concerns an output: it is of its operation, or of one that it is formed from.
bool concerns(const Property& law, const Output& output, const NotedCall& call) {
  if (call.operation == output.record) return true;
  for (const Formed& f : law.statement().formed)
    if (f.quantity == output.record && std::ranges::find(f.from, call.operation) != f.from.end()) return true;
  return false;
}

/// The measurement of the output that is worst by the rule of its limit, as an index among all of the output.
std::size_t worst_of(const Series& series, const std::vector<Judged>& all) {
  const auto score = [&](const Judged& j) {
    if (j.residual.outcome != Outcome::measured) return std::numeric_limits<double>::infinity();
    const Region region = series.bands()[j.residual.band].region;
    return series.budget(j.residual.output, region).rule == Rule::excess ? j.excess : j.residual.error;
  };
  return static_cast<std::size_t>(std::ranges::max_element(all, {}, score) - all.begin());
}

NotedCase noted_in(const Series& series, const CaseId& id, std::size_t output) {
  const Output& of = series.outputs.at(output);
  const std::vector<double> x = series.parsed(id);
  Subject subject = series.tested_subject();
  const Noting noting;
  subject.operations = hooked(subject.operations, noting);
  // Judged by error / kappa, so that kappa is known under the forward rule, too.
  static const Budget ratio{"", "", "any", Rule::excess, std::numeric_limits<double>::infinity(), ""};
  Limits limits = series.limits();
  for (OutputLimits& l : limits) l.budgets = {&ratio, &ratio};
  Judge judge(limits, series.format(), 0, true);
  Witness witness{of.operation, of.block, false, {}};
  Witness* const before = std::exchange(Witness::current(), &witness);
  try {
    series.tested_law().measure(subject, x, judge);
  } catch (const std::exception&) {  // noted with its call
  }
  Witness::current() = before;
  NotedCase all;
  all.quaternion_poses = series.tested_subject().takes.quaternion_poses;
  for (NotedCall& call : *noting.calls)
    if (concerns(series.tested_law(), of, call)) all.calls.push_back(std::move(call));
  std::erase_if(judge.judged, [&](const Judged& j) { return j.residual.output != output; });
  for (const Judged& j : judge.judged) all.wrong_branch |= j.residual.outcome == Outcome::wrong_branch;
  if (judge.judged.empty()) return all;
  const std::size_t worst = worst_of(series, judge.judged), measured = judge.judged.size();
  all.kappa = judge.judged[worst].residual.kappa;
  if (witness.all.empty()) return all;
  Witness::Compared& compared = witness.all.size() == measured ? witness.all[worst] : witness.all.back();
  all.compared = {std::move(compared.computed), std::move(compared.exact)};
  std::vector<const NotedCall*> own;
  for (const NotedCall& call : all.calls)
    if (call.operation == of.record) own.push_back(&call);
  if (own.size() == measured) all.compared.seen = own[worst]->seen;
  return all;
}

}  // namespace

std::vector<double> given_numbers(const Series& series, const NotedCall& call) {
  if (!series.tested_subject().takes.quaternion_poses) return call.arguments;
  return poses_as_quaternions(*call.operation, call.arguments, series.format().is_float());
}

NotedCase noted(const Series& series, const CaseId& id, std::size_t output) {
  CaseId raw = id;
  if (!id.raw) raw.raw = true, raw.input = series.input(id);
  return noted_in(series, raw, output);
}

namespace {
CaseId sampled_case(const Series& series, std::uint64_t index) {
  constexpr std::uint64_t any_seed = 42;
  return series.id(any_seed, index);
}
}  // namespace

bool are_unique(const std::vector<double>& angles, const oracles::Order& order) {
  return std::fabs(order.axes[0] == order.axes[2] ? std::sin(angles[1]) : std::cos(angles[1])) > 0.1;
}

bool case_fails(const Series& series, std::uint64_t index, const Operation& operation) try {
  const auto judged = series.measure(series.numbers(sampled_case(series, index)));
  return std::ranges::any_of(judged, [&](const Judged& j) {
    return j.failed && series.outputs.at(static_cast<std::size_t>(j.residual.output)).record == &operation;
  });
} catch (const GivenUp&) {  // a signal ended a call
  return false;
}

std::vector<NotedCall> sampled_calls(const Series& series, std::size_t output, std::uint64_t from,
                                     std::uint64_t to) {
  std::vector<NotedCall> all;
  try {
    for (std::uint64_t i = from; i < to && !stop_requested; ++i)
      for (NotedCall& call : noted(series, sampled_case(series, i), output).calls)
        if (call.operation == series.outputs.at(output).record && call.thrown.empty() && !call.result.empty())
          call.index = i, all.push_back(std::move(call));
  } catch (const GivenUp&) {  // a signal ended a call
  }
  return all;
}

std::vector<oracles::Real> expected_of(const NotedCall& call) try {
  if (call.arguments.empty() || !call.operation->results.size()) return {};
  std::vector<oracles::Real> x;
  for (const double number : call.arguments) x.emplace_back(number);
  return conventions::exact_result(*call.operation, x);
} catch (const std::exception&) {  // it is not in the oracle's list, or the oracle cannot decide
  return {};
}

std::vector<double> result_of(const Series& series, const Operation& operation,
                              const std::vector<double>& arguments) {
  std::vector<double> result;
  const Operations& o = series.tested_subject().operations;
  Operations::for_each([&](const auto& one) {
    if (static_cast<const Operation*>(&one) != &operation || !o[one]) return;
    try {
      result = called(o[one], one, arguments.data());
    } catch (const std::exception&) {  // refused
    }
  });
  return result;
}

}  // namespace liecheck::properties
