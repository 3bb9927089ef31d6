#pragma once
// Some calls of a function are repeated later, after other calls and from two threads. A result that then has
// other bits, where one NaN is as good as another, depends on more than its input.

#include <adapters/adapter.hpp>
#include <mutex>
#include <string>
#include <vector>

namespace liecheck::properties::adapters {

/// The noted calls of one function in one scalar.
class Repeats {
 public:
  /// Notes every twentieth input with its result. Once 32 are noted, each call is repeated in the opposite order and,
  /// if `threads`, by two threads at the same time in opposite orders. Returns in words which result was another one,
  /// or "".
  std::string note(const Batch& b, const CFunction& function, bool threads);

 private:
  struct Call {
    std::vector<std::byte> input, result;
  };
  /// The index of the first call whose result is another one now, which `other` becomes, or of no call.
  std::size_t other_result(const CFunction& function, bool is_double, bool reversed,
                           std::vector<std::byte>& other) const;

  static constexpr unsigned each = 20;
  static constexpr std::size_t enough = 32;
  std::mutex mutex_;
  unsigned inputs_ = 0;
  std::vector<Call> calls_;
};

}  // namespace liecheck::properties::adapters
