#include <subjects/number_function.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <subjects/call_log.hpp>
#include <subjects/call_observer.hpp>
#include <support/float_environment.hpp>

namespace liecheck::properties {
namespace {

/// Room for some numbers, which lies on the stack if they are few. They are not set.
template <class S>
class Room {
 public:
  explicit Room(std::size_t n) : more_(n > few ? n : 0) {}
  S* data() { return more_.empty() ? few_ : more_.data(); }

 private:
  static constexpr std::size_t few = 64;
  S few_[few];
  std::vector<S> more_;
};

/// Calls a function whose numbers have `size` bytes each, and notes in the log what is wrong with the call.
void call_checked(CallLog& log, const NumberFunction& f, std::size_t size, std::span<std::byte> in,
                  std::span<std::byte> out) {
  std::string given;
  if (log.keeps_results) {
    given.assign(reinterpret_cast<const char*>(in.data()), in.size());
    for (const CallLog::Noted& n : log.results)
      if (n.operation == f.operation && n.tree == f.tree && n.arguments == given)
        return void(
            std::memcpy(out.data(), static_cast<const std::string*>(n.result.get())->data(), out.size()));
  }
  constexpr std::byte one{0xa5}, other{0x5a};  // as numbers both are finite and normal
  const auto found = [&](Outcome outcome) { log.findings.push_back({f.operation, outcome}); };
  const std::vector<std::byte> before(in.begin(), in.end());
  std::vector<std::byte> again = before, second(out.size());
  const FloatEnvironment outside;
  if (!mode_of_calls.is_usual()) FloatEnvironment::set(mode_of_calls);
  const FloatEnvironment environment;
  std::ranges::fill(out, one);
  f.compute(in.data(), out.data());
  bool changed = environment.restore(), repeated = true;
  std::ranges::fill(second, other);
  try {
    f.compute(again.data(), second.data());
  } catch (const std::exception&) {  // which the first call did not throw: the call is not repeatable
    repeated = false;
  }
  changed = environment.restore() || changed;
  outside.restore();
  if (changed) found(Outcome::environment_changed);
  const auto keeps = [size](auto bytes, std::size_t at, std::byte pattern) {
    return std::ranges::all_of(bytes.subspan(at, size), [pattern](std::byte b) { return b == pattern; });
  };
  bool unwritten = false;
  for (std::size_t at = 0; at < out.size() && repeated && !unwritten; at += size)
    unwritten = keeps(out, at, one) && keeps(std::span(second), at, other);
  if (unwritten)
    found(Outcome::output_unwritten);
  else if (!repeated || std::memcmp(out.data(), second.data(), out.size()) != 0)
    found(Outcome::not_repeatable);
  if (!std::ranges::equal(in, before)) found(Outcome::argument_written);
  if (!log.keeps_results) return;
  auto result = std::make_shared<const std::string>(reinterpret_cast<const char*>(out.data()), out.size());
  if (CallObserver* const observer = call_observer())
    (*observer)(*f.operation, given + static_cast<char>(f.tree), *result);
  log.results.push_back({f.operation, f.tree, std::move(given), std::move(result)});
}

template <class S>
void call(const NumberFunction& f, std::span<S> in, std::span<S> out) {
  if (CallLog* const log = CallLog::current())
    call_checked(*log, f, sizeof(S), std::as_writable_bytes(in), std::as_writable_bytes(out));
  else
    f.compute(in.data(), out.data());
}

/// The conversions stand outside the call, which may flush subnormal numbers.
void call_in_scalar(const NumberFunction& f, std::span<double> in, std::span<double> out) {
  if (!f.scalar->is_float()) return call(f, in, out);
  Room<float> rounded(in.size()), result(out.size());
  std::transform(in.begin(), in.end(), rounded.data(), [](double x) { return static_cast<float>(x); });
  call(f, std::span(rounded.data(), in.size()), std::span(result.data(), out.size()));
  std::copy_n(result.data(), out.size(), out.data());
}

/// Operations of one signature share this function.
template <class R, class... A>
void fill(std::function<R(const A&...)>& slot, NumberFunction f) {
  if (!f.compute) return;
  const std::size_t n = count_numbers(f.operation->arguments, f.model),
                    m = count_numbers(f.operation->results, f.model);
  slot = [f = std::move(f), n, m](const A&... arguments) -> R {
    Room<double> in(n), out(m);
    double* to = in.data();
    (put_numbers(arguments, to), ...);
    call_in_scalar(f, std::span(in.data(), n), std::span(out.data(), m));
    const double* from = out.data();
    return take_numbers<R>(from, *f.operation->results[0], f.model);
  };
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

CallObserver*& call_observer() {
  thread_local CallObserver* observer = nullptr;
  return observer;
}

}  // namespace liecheck::properties
