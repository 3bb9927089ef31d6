#include <adapters/check.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <adapters/chosen.hpp>
#include <adapters/converted.hpp>
#include <adapters/sizes.hpp>
#include <adapters/tree_check.hpp>
#include <algorithm>
#include <conventions/choices.hpp>
#include <limits>
#include <operations/argument_kinds.hpp>
#include <support/same_numbers.hpp>

namespace liecheck::properties::adapters {
namespace {

/// Those of conventions::probe_arguments, and one for each kind of an argument that has kinds.
template <class S>
std::vector<conventions::Numbers> probe_arguments_of_kinds(const Operation& operation) {
  std::vector<conventions::Numbers> all = conventions::probe_arguments<S>(operation);
  std::size_t first = 0;
  const ArgumentKinds* const kinds = argument_kinds(operation, first);
  if (!kinds || kinds == &order_kinds) return all;
  for (int k = 0; k < kinds->count; ++k) {
    all.push_back(all[static_cast<std::size_t>(k)]);
    for (std::size_t i = first; const double x : kinds->example(k)) all.back()[i++] = static_cast<S>(x);
  }
  return all;
}

/// Fills `answers`, and returns what is wrong with how they were given.
template <class S>
std::string asked(Adapter& adapter, const OperationSizes& o,
                  const std::vector<conventions::Numbers>& arguments,
                  std::vector<conventions::Answer>& answers) try {
  const std::size_t n = arguments.size();
  std::vector<S> inputs, together(n * o.results), single(n * o.results);
  for (const conventions::Numbers& x : arguments)
    for (const double number : x) inputs.push_back(static_cast<S>(number));
  std::vector<Status> status(n);
  const auto call = [&](std::size_t first, std::size_t count, std::vector<S>& results) {
    return adapter.call(
        {o, sizeof(S) == 8, count,
         std::as_bytes(std::span(inputs).subspan(first * o.inputs, count * o.inputs)),
         std::as_writable_bytes(std::span(results).subspan(first * o.results, count * o.results)),
         std::span(status).subspan(first, count)});
  };
  const std::string why = call(0, n, together);
  const std::vector<Status> first = status;
  std::size_t place = 0;  // a library may lack some kinds of an argument
  const bool some = argument_kinds(conventions::operation_named(o.operation), place);
  for (const Status s : first)
    if (s != Status::done && !(some && s == Status::refused)) return in_words(s, why);
  for (std::size_t k = 0; k < n; ++k) {
    if (first[k] != Status::done) continue;
    call(k, 1, single);
    const auto alone = std::span(single).subspan(k * o.results, o.results),
               batch = std::span(together).subspan(k * o.results, o.results);
    if (status[k] != Status::done || !same_numbers<S>(alone, batch))
      return fmt::format("gives {:.6g} in a batch of {} inputs, and {:.6g} for the same input alone",
                         fmt::join(batch, " "), n, fmt::join(alone, " "));
    answers.push_back({arguments[k], {alone.begin(), alone.end()}});
  }
  return answers.empty() ? in_words(Status::refused, why) : "";
} catch (const AdapterFailed& e) {
  return e.what();
}

/// Adds the answer at an argument at which libraries choose; one that breaks a stated choice is a complaint.
template <class S>
void choose(Adapter& adapter, const OperationSizes& o, const conventions::Numbers& argument,
            std::vector<conventions::Answer>& answers, std::string& complaint) try {
  const std::vector<S> inputs(argument.begin(), argument.end());
  std::vector<S> results(o.results);
  std::vector<Status> status(1);
  const std::string why = adapter.call({o, sizeof(S) == 8, 1, std::as_bytes(std::span(inputs)),
                                        std::as_writable_bytes(std::span(results)), status});
  if (status[0] == Status::other_choice && complaint.empty())
    complaint = fmt::format("{}, at {:.6g}", why, fmt::join(argument, " "));
  if (status[0] == Status::done) answers.push_back({argument, {results.begin(), results.end()}});
} catch (const AdapterFailed& e) {
  if (complaint.empty()) complaint = e.what();
}

template <class S>
std::vector<conventions::Finding> check_in(const char* scalar, Adapter& adapter,
                                           std::vector<CheckedOperation>& to) {
  std::vector<conventions::Probed> probed, choosing;
  for (const OperationSizes& o : operation_sizes()) {
    if (!adapter.description().offered.contains({std::string(o.operation), scalar})) continue;
    conventions::Probed p{&conventions::operation_named(o.operation), {}};
    to.push_back({std::string(o.operation), scalar,
                  asked<S>(adapter, o, probe_arguments_of_kinds<S>(*p.operation), p.answers)});
    if (!p.answers.empty()) probed.push_back(std::move(p));
    conventions::Probed c{&conventions::operation_named(o.operation), {}};
    std::string& complaint = to.back().complaint;
    for (const auto& x : conventions::choice_arguments<S>(*c.operation))
      if (complaint.empty()) choose<S>(adapter, o, x, c.answers, complaint);  // one that hangs does so once
    if (!c.answers.empty() && complaint.empty()) choosing.push_back(std::move(c));
  }
  auto findings = conventions::explain(probed);
  for (const conventions::Finding& f : findings)
    for (CheckedOperation& o : to)
      if (o.scalar == scalar && std::ranges::count(f.operations, o.operation) > 0)
        o.complaint = f.named ? "differs in a convention" : "is wrong";
  std::erase_if(choosing, [&](const conventions::Probed& c) {
    return std::ranges::any_of(findings, [&](const conventions::Finding& f) {
      return std::ranges::count(f.operations, c.operation->name) > 0;
    });
  });
  const auto choices = conventions::choices_made(choosing, adapter.description().conventions,
                                                 std::numeric_limits<S>::epsilon());
  findings.insert(findings.end(), choices.begin(), choices.end());
  return findings;
}

/// Whether two findings, in two scalars, are the same.
bool same(const conventions::Finding& a, const conventions::Finding& b) {
  return a.named == b.named && a.choice == b.choice &&
         (a.named || a.choice ? a.sentence == b.sentence : a.operations == b.operations);
}

Checked check_as_it_is(Adapter& adapter) {
  Checked all;
  const auto in_double = check_in<double>("double", adapter, all.operations);
  const auto in_float = check_in<float>("float", adapter, all.operations);
  const auto among = [](const auto& findings, const conventions::Finding& f) {
    return std::ranges::any_of(findings, [&](const conventions::Finding& other) { return same(f, other); });
  };
  /// A finding in one of two scalars says in which.
  const auto only = [&](conventions::Finding f, const char* scalar, const char* other) {
    if (std::ranges::any_of(f.operations, [&](const std::string& o) {
          return adapter.description().offered.contains({o, other});
        }))
      f.sentence = fmt::format("in {}: {}", scalar, f.sentence);
    return f;
  };
  for (const conventions::Finding& f : in_double)
    all.findings.push_back(among(in_float, f) ? f : only(f, "double", "float"));
  for (const conventions::Finding& f : in_float)
    if (!among(in_double, f)) all.findings.push_back(only(f, "float", "double"));
  return all;
}

/// check_as_it_is(), or the statement of the adapter without which its results are right.
Checked check_poses(Adapter& adapter) {
  Checked all = check_as_it_is(adapter);
  const auto* const chosen = dynamic_cast<const Chosen*>(&adapter);
  const auto* const converted = chosen ? dynamic_cast<const Converted*>(&chosen->own()) : nullptr;
  const auto right = [](const Checked& c) {
    return std::ranges::all_of(c.findings, &conventions::Finding::choice);
  };
  if (right(all) || !converted) return all;
  const conventions::Statements& stated = adapter.description().conventions;
  for (const auto& [name, value] : stated) {
    if (name == conventions::pose_form) continue;  // it says how many numbers the adapter reads
    conventions::Statements others = stated;
    others.erase(name);
    Converted without = converted->with(others);
    if (right(check_as_it_is(without)))
      all.findings = {
          {true,
           fmt::format("the adapter states \"{}\": \"{}\", but its results are right without that", name,
                       value),
           {}}};
  }
  return all;
}

}  // namespace

Checked check(Adapter& adapter) {
  Checked all = check_poses(adapter);
  const Checked trees = check_trees(adapter);
  all.operations.insert(all.operations.end(), trees.operations.begin(), trees.operations.end());
  all.findings.insert(all.findings.end(), trees.findings.begin(), trees.findings.end());
  return all;
}

}  // namespace liecheck::properties::adapters
