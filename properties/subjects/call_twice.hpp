#pragma once
// How a call is checked (call_log.hpp), whatever the types of its arguments and its result.

#include <exception>
#include <subjects/call_log.hpp>
#include <support/float_environment.hpp>

namespace liecheck::properties {

/// What fills the memory of the first and of the second result. As numbers both are finite and normal.
inline constexpr unsigned char first_pattern = 0xa5, second_pattern = 0x5a;

/// Makes both calls in the environment that mode_of_calls says. Returns whether one of them changed it. An exception of the
/// second call, which the first did not throw, is the caller's to notice: there is no second result.
template <class First, class Second>
bool call_twice(const First& first, const Second& second) {
  const FloatEnvironment outside;
  if (!mode_of_calls.is_usual()) FloatEnvironment::set(mode_of_calls);
  const FloatEnvironment environment;
  first();
  const bool changed = environment.restore();
  try {
    second();
  } catch (const std::exception&) {
  }
  return environment.restore() || changed;
}

/// What two calls with the same arguments showed.
struct TwoCalls {
  bool environment_changed, output_unwritten, same_results, arguments_kept;
};
inline void note(CallLog& log, const Operation& operation, const TwoCalls& calls) {
  const auto found = [&](Outcome outcome) { log.findings.push_back({&operation, outcome}); };
  if (calls.environment_changed) found(Outcome::environment_changed);
  if (calls.output_unwritten)
    found(Outcome::output_unwritten);
  else if (!calls.same_results)
    found(Outcome::not_repeatable);
  if (!calls.arguments_kept) found(Outcome::argument_written);
}

}  // namespace liecheck::properties
