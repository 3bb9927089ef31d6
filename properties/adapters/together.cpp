#include <adapters/together.hpp>

#include <algorithm>
#include <optional>
#include <support/stop.hpp>
#include <support/together.hpp>
#include <vector>

namespace liecheck::properties::adapters {
namespace {

struct Call : Question {
  Adapter& adapter;
  const Batch& batch;
  std::string why;
  std::optional<AdapterFailed> failed;
  bool given_up = false;

  void alone() try { why = adapter.call(batch); } catch (const AdapterFailed& e) {
    failed = e;
  } catch (const GivenUp&) {
    given_up = true;
  }
  bool like(const Call& o) const {
    return &adapter == &o.adapter && &batch.operation == &o.batch.operation &&
           batch.is_double == o.batch.is_double;
  }
};

/// Calls of one function. Returns false if each must be made alone.
bool called_at_once(std::span<Question* const> calls) try {
  const Call& first = static_cast<const Call&>(*calls.front());
  const std::size_t n = calls.size(), in = first.batch.inputs.size(), out = first.batch.results.size();
  std::vector<std::byte> inputs(n * in), results(n * out);
  std::vector<Status> status(n);
  for (std::size_t i = 0; i < n; ++i)
    std::ranges::copy(static_cast<const Call&>(*calls[i]).batch.inputs, &inputs[i * in]);
  const std::string why = first.adapter.call(
      {first.batch.operation, first.batch.is_double, n, inputs, results, status, {}, true});
  if (std::ranges::any_of(status, [](Status s) {
        return s > Status::refused && s != Status::not_repeatable && s != Status::other_choice;
      }))
    return false;
  for (std::size_t i = 0; i < n; ++i) {
    Call& call = static_cast<Call&>(*calls[i]);
    std::copy_n(&results[i * out], out, call.batch.results.begin());
    call.batch.status[0] = status[i];
    if (status[i] != Status::done) call.why = why;
  }
  return true;
} catch (const AdapterFailed&) {
  return false;
} catch (const GivenUp&) {
  return false;  // so that each is given up alone
}

void answer(std::span<Question* const> all) {
  std::vector<Question*> calls(all.begin(), all.end());
  for (auto from = calls.begin(); from != calls.end();) {
    const auto to = std::stable_partition(
        from, calls.end(),
        [&first = static_cast<Call&>(**from)](Question* q) { return static_cast<Call*>(q)->like(first); });
    if (to - from == 1 || !called_at_once({from, to}))
      std::for_each(from, to, [](Question* q) { static_cast<Call*>(q)->alone(); });
    from = to;
  }
}

}  // namespace

std::string call_together(Adapter& adapter, const Batch& one) {
  if (!can_wait()) return adapter.call(one);
  Call call{{answer}, adapter, one, "", std::nullopt};
  wait_for_answer(call);
  if (call.given_up) throw GivenUp{};
  if (call.failed) throw *call.failed;
  return call.why;
}

}  // namespace liecheck::properties::adapters
