#pragma once
// How a call of a subject, or the measurement of its result, ended.

#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace liecheck::properties {

/// A law records ill_posed if the input does not determine the result, or if its equation does not hold for
/// the input. Only the judge records unmeasured.
enum class Outcome : std::uint8_t {
  measured,
  not_finite,
  wrong_branch,
  unresolved,
  refused,
  ill_posed,
  unmeasured,
  not_repeatable,       ///< another call with the same arguments gave another result
  argument_written,     ///< the call changed one of its arguments
  output_unwritten,     ///< the call left a number of its result unwritten
  outside_domain,       ///< the subject does not promise a result for the input: nothing was called
  crashed,              ///< the subject's process crashed, did not answer in time, or broke the protocol
  environment_changed,  ///< the call changed the rounding mode or the treatment of subnormals
  printed               ///< the call wrote to standard output, which belongs to the answers
};
/// For messages, in the order of Outcome.
inline constexpr const char* outcome_words[] = {"",
                                                "NaN or Inf",
                                                "wrong branch",
                                                "unresolved",
                                                "refused",
                                                "ill-posed",
                                                "unmeasured",
                                                "not repeatable",
                                                "argument written",
                                                "output unwritten",
                                                "outside the domain",
                                                "crashed",
                                                "environment changed",
                                                "printed"};
static_assert(std::size(outcome_words) == static_cast<std::size_t>(Outcome::printed) + 1);
/// Whether the outcome leaves the verdict on a case open, so that the campaign is incomplete.
constexpr bool leaves_open(Outcome o) {
  return o == Outcome::unresolved || o == Outcome::unmeasured;
}
/// Whether the outcome concerns the call, not its result.
constexpr bool is_misuse(Outcome o) {
  return o == Outcome::not_repeatable || o == Outcome::argument_written || o == Outcome::output_unwritten ||
         o == Outcome::crashed || o == Outcome::environment_changed || o == Outcome::printed;
}
/// A call without a result, which `outcome` describes.
struct CallFailed : std::runtime_error {
  CallFailed(const std::string& reason, std::string_view its_operation, Outcome its_outcome)
      : std::runtime_error(reason), operation(its_operation), outcome(its_outcome) {}
  std::string_view operation;
  Outcome outcome;
};

}  // namespace liecheck::properties
