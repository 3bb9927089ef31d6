#include <subjects/number_function.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <subjects/call_log.hpp>
#include <subjects/call_observer.hpp>
#include <subjects/call_twice.hpp>

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
  const std::vector<std::byte> before(in.begin(), in.end());
  std::vector<std::byte> again = before, second(out.size());
  bool repeated = false;
  const auto fill = [](std::span<std::byte> bytes, unsigned char pattern) {
    std::ranges::fill(bytes, std::byte(pattern));
  };
  const bool changed = call_twice([&] { fill(out, first_pattern), f.compute(in.data(), out.data()); },
                                  [&] {
                                    fill(second, second_pattern), f.compute(again.data(), second.data());
                                    repeated = true;
                                  });
  const auto keeps = [size](std::span<const std::byte> bytes, std::size_t at, unsigned char pattern) {
    return std::ranges::all_of(bytes.subspan(at, size),
                               [pattern](std::byte b) { return b == std::byte(pattern); });
  };
  bool unwritten = false;
  for (std::size_t at = 0; at < out.size() && repeated && !unwritten; at += size)
    unwritten = keeps(out, at, first_pattern) && keeps(second, at, second_pattern);
  note(log, *f.operation,
       {changed, unwritten, repeated && std::ranges::equal(out, second), std::ranges::equal(in, before)});
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
