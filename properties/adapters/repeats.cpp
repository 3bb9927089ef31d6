#include <adapters/repeats.hpp>

#include <adapters/liecheck_adapter.h>
#include <fmt/format.h>
#include <algorithm>
#include <cstring>
#include <iterator>
#include <latch>
#include <support/float_environment.hpp>
#include <support/same_numbers.hpp>
#include <thread>
#include <utility>

namespace liecheck::properties::adapters {
namespace {

/// The numbers in hexadecimal.
template <class S>
std::string numbers(const std::vector<std::byte>& bytes) {
  std::vector<S> all(bytes.size() / sizeof(S));
  std::memcpy(all.data(), bytes.data(), bytes.size());
  std::string text;
  for (const S x : all) text += fmt::format("{}{:a}", text.empty() ? "" : " ", x);
  return text;
}

}  // namespace

std::size_t Repeats::other_result(const CFunction& function, bool is_double, bool reversed) const {
  for (std::size_t k = 0; k < calls_.size(); ++k) {
    const std::size_t i = reversed ? calls_.size() - 1 - k : k;
    const FloatEnvironment environment;  // of this thread
    std::vector<std::byte> input = calls_[i].input, result(calls_[i].result.size());
    unsigned char status = liecheck_done;
    try {
      function(1, input.data(), result.data(), &status);
    } catch (...) {
      return i;
    }
    const auto same = is_double ? same_numbers_in<double> : same_numbers_in<float>;
    if (status != liecheck_done || !same(result, calls_[i].result)) return i;
  }
  return calls_.size();
}

std::string Repeats::note(const Batch& b, const CFunction& function, bool threads) {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < b.n; ++i)
    if (inputs_++ % each == 0 && b.status[i] == Status::done) {
      const auto part = [&](auto bytes) {
        const auto own = bytes.subspan(i * (bytes.size() / b.n), bytes.size() / b.n);
        return std::vector<std::byte>(own.begin(), own.end());
      };
      calls_.push_back({part(b.inputs), part(b.results)});
    }
  if (calls_.size() < enough) return "";
  std::size_t at = other_result(function, b.is_double, true);
  const char* when = "after other calls";
  if (at == calls_.size() && threads) {
    when = "when two threads call at the same time";
    std::size_t other = at;
    std::latch both(2);
    std::thread second([&] {
      both.arrive_and_wait();
      other = other_result(function, b.is_double, true);
    });
    both.arrive_and_wait();
    at = other_result(function, b.is_double, false);
    second.join();
    at = std::min(at, other);
  }
  const std::vector<Call> calls = std::exchange(calls_, {});
  if (at == calls.size()) return "";
  return fmt::format("the result of {} for the input {} is another one {}", b.operation.operation,
                     b.is_double ? numbers<double>(calls[at].input) : numbers<float>(calls[at].input), when);
}

}  // namespace liecheck::properties::adapters
