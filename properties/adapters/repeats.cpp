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

/// ": number 2 is 1.5, and was 3", of the first number that differs; "" if the second call had no result.
template <class S>
std::string difference(const std::vector<std::byte>& before, const std::vector<std::byte>& now) {
  for (const bool also_signs_of_zero : {false, true})
    for (std::size_t i = 0; i < now.size(); i += sizeof(S)) {
      S was, is;
      std::memcpy(&was, &before[i], sizeof(S)), std::memcpy(&is, &now[i], sizeof(S));
      if (also_signs_of_zero ? std::memcmp(&was, &is, sizeof(S)) != 0 : was != is)
        return fmt::format(": number {} is {}, and was {}", i / sizeof(S) + 1, is, was);
    }
  return "";
}

}  // namespace

std::size_t Repeats::other_result(const CFunction& function, bool is_double, bool reversed,
                                  std::vector<std::byte>& other) const {
  for (std::size_t k = 0; k < calls_.size(); ++k) {
    const std::size_t i = reversed ? calls_.size() - 1 - k : k;
    const FloatEnvironment environment;  // of this thread
    std::vector<std::byte> input = calls_[i].input, result(calls_[i].result.size());
    unsigned char status = liecheck_done;
    try {
      function(1, input.data(), result.data(), &status);
    } catch (...) {
      return other.clear(), i;
    }
    const auto same = is_double ? same_numbers_in<double> : same_numbers_in<float>;
    if (status != liecheck_done || !same(result, calls_[i].result)) return other = result, i;
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
  std::vector<std::byte> now, in_second;
  std::size_t at = other_result(function, b.is_double, true, now);
  const char* when = "after other calls";
  if (at == calls_.size() && threads) {
    when = "when two threads call at the same time";
    std::size_t other = at;
    std::latch both(2);
    std::thread second([&] {
      both.arrive_and_wait();
      other = other_result(function, b.is_double, true, in_second);
    });
    both.arrive_and_wait();
    at = other_result(function, b.is_double, false, now);
    second.join();
    if (other < at) at = other, now = in_second;
  }
  const std::vector<Call> calls = std::exchange(calls_, {});
  if (at == calls.size()) return "";
  const auto in_words = [&]<class S>() {
    return fmt::format("the result of {} is another one {}{}, for the input {}", b.operation.operation, when,
                       difference<S>(calls[at].result, now), numbers<S>(calls[at].input));
  };
  return b.is_double ? in_words.operator()<double>() : in_words.operator()<float>();
}

}  // namespace liecheck::properties::adapters
