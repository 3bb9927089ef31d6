#include <subjects/number_function.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <subjects/call_log.hpp>
#include <support/float_environment.hpp>
#include <support/same_numbers.hpp>

namespace liecheck::properties {
namespace {

/// What fills the memory of the first and of the second result. As numbers both are finite and normal.
constexpr std::byte first_pattern{0xa5}, second_pattern{0x5a};

void compute(const NumberFunction& f, void* arguments, void* results) {
  if (CallHook* const hook = call_hook())
    (*hook)(f, arguments, results);
  else
    f.compute(arguments, results);
}

/// Makes both calls in the environment that mode_of_calls says. Returns whether one of them changed it.
template <class First, class Second>
bool call_twice(const First& first, const Second& second) {
  const FloatEnvironment outside;
  if (!mode_of_calls.is_usual()) FloatEnvironment::set(mode_of_calls);
  const FloatEnvironment environment;
  first();
  const bool changed = environment.restore();
  try {
    second();
  } catch (const std::exception&) {  // which the first call did not throw: there is no second result
  }
  return environment.restore() || changed;
}

/// Calls a function of a tree for neighbours of its input, which are as valid: with -q, and v, a and tau times -1/2; then
/// with the first number of q as it is, and then with q as it is. Where a library keeps what it computed for as
/// long as the first number of q, or q, is the same, a call with the input itself now finds what belongs to a neighbour.
template <class S>
void call_neighbours(const NumberFunction& f, std::span<const std::byte> in, std::span<std::byte> out) {
  Room<S> x(in.size() / sizeof(S));
  for (const std::size_t kept_of_q : {std::size_t(0), std::size_t(1), x.all().size()}) {
    std::memcpy(x.data(), in.data(), in.size());
    S* at = x.data();
    bool any = false;
    for (const Layout* layout : f.operation->arguments) {
      const bool of_joints = layout->parts.size() == 1 && layout->parts[0].size < 0;
      const std::size_t n = count_numbers(std::span(&layout, 1), f.model);
      const bool is_q = of_joints && layout->parts[0].size == nq;
      for (std::size_t i = is_q ? kept_of_q : 0; of_joints && i < n; ++i, any = true)
        at[i] *= is_q ? S(-1) : S(-0.5);
      at += n;
    }
    try {
      if (any) compute(f, x.data(), out.data());
    } catch (const std::exception&) {  // of an input that no law asks for
    }
  }
}

/// Calls a function, and notes in the log what is wrong with the call.
void call_checked(CallLog& log, const NumberFunction& f, std::span<std::byte> in, std::span<std::byte> out) {
  std::string given;
  if (log.keeps_results) {
    given.assign(reinterpret_cast<const char*>(in.data()), in.size());
    for (const CallLog::Noted& n : log.results)
      if (n.operation == f.operation && n.tree == f.tree && n.arguments == given)
        return void(std::ranges::copy(std::as_bytes(std::span(n.result)), out.begin()));
  }
  Room<std::byte, 512> before(in.size()), again(in.size()), second(out.size());
  std::ranges::copy(in, before.data()), std::ranges::copy(in, again.data());
  bool repeated = false;
  const bool changed =
      call_twice([&] { std::ranges::fill(out, first_pattern), compute(f, in.data(), out.data()); },
                 [&] {
                   if (log.calls_neighbours && f.model.nq > 0)
                     f.scalar->with([&]<class S>() { call_neighbours<S>(f, again.all(), second.all()); });
                   std::ranges::fill(second.all(), second_pattern), compute(f, again.data(), second.data());
                   repeated = true;
                 });
  const auto keeps = [&f](std::span<const std::byte> bytes, std::size_t at, std::byte pattern) {
    return std::ranges::all_of(bytes.subspan(at, f.scalar->size),
                               [pattern](std::byte b) { return b == pattern; });
  };
  bool unwritten = false;
  for (std::size_t at = 0; at < out.size() && repeated && !unwritten; at += f.scalar->size)
    unwritten = keeps(out, at, first_pattern) && keeps(second.all(), at, second_pattern);
  const auto found = [&](Outcome outcome) { log.findings.push_back({f.operation, outcome}); };
  const auto same = [](std::span<const std::byte> a, std::span<const std::byte> b) {
    return std::memcmp(a.data(), b.data(), a.size()) == 0;
  };
  if (changed) found(Outcome::environment_changed);
  if (unwritten)
    found(Outcome::output_unwritten);
  else if (!repeated || !f.scalar->with([&]<class S>() { return same_numbers_in<S>(out, second.all()); }))
    found(Outcome::not_repeatable);
  if (!same(in, before.all())) found(Outcome::argument_written);
  if (log.keeps_results)
    log.results.push_back(
        {f.operation, f.tree, std::move(given), {reinterpret_cast<const char*>(out.data()), out.size()}});
}

template <class S>
void call(const NumberFunction& f, std::span<S> in, std::span<S> out) {
  if (CallLog* const log = CallLog::current())
    call_checked(*log, f, std::as_writable_bytes(in), std::as_writable_bytes(out));
  else
    compute(f, in.data(), out.data());
}

}  // namespace

// Where a law rounds the input of a float subject itself: rounded_calls.hpp.
void call_in_scalar(const NumberFunction& f, std::span<double> in, std::span<double> out) {
  if (!f.scalar->is_float()) return call(f, in, out);
  Room<float> rounded(in.size()), result(out.size());
  std::transform(in.begin(), in.end(), rounded.data(), [](double x) { return static_cast<float>(x); });
  call(f, rounded.all(), result.all());
  std::ranges::copy(result.all(), out.begin());
}

namespace {

/// Operations of one signature share this function.
template <class R, class... A>
void fill(std::function<R(const A&...)>& slot, NumberFunction f) {
  if (!f.compute) return;
  const std::size_t n = count_numbers(f.operation->arguments, f.model),
                    m = count_numbers(f.operation->results, f.model);
  slot = [f = std::move(f), n, m](const A&... arguments) { return by_numbers<R>(f, n, m, arguments...); };
}
template <class S, const auto&... all>
void fill_each(Slots<S, all...>& slots, const FindFunction& find) {
  (fill(slots[all], find(all)), ...);
}

}  // namespace

void fill_slots(SpatialSlots<Doubles>& slots, const FindFunction& find) {
  fill_each(slots, find);
}
void fill_slots(RobotOperations<double>& slots, const FindFunction& find) {
  fill_each(slots, find);
}
void fill_slots(TreeOperations<double>& slots, const FindFunction& find) {
  fill_each(slots, find);
}

int next_tree() {
  CallLog* const log = CallLog::current();
  return log ? ++log->trees : 0;
}

CallLog*& CallLog::current() {
  thread_local CallLog* log = nullptr;
  return log;
}

CallHook*& call_hook() {
  thread_local CallHook* hook = nullptr;
  return hook;
}

}  // namespace liecheck::properties
