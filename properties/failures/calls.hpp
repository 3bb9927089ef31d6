#pragma once
// The calls of the subject in one case: what was given, and what was returned.

#include <campaign/series.hpp>
#include <oracles/orientations.hpp>
#include <oracles/real.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// One call. The numbers are consecutive, as docs/conventions.md orders them.
struct NotedCall {
  const Operation* operation;
  std::vector<double> arguments, result;
  std::string thrown;       ///< the message of what the call threw, or ""
  std::string seen = {};    ///< the reference frame that was asked for, or ""
  std::uint64_t index = 0;  ///< of the case, if the call is one of sampled_calls()
};

/// A call, and its right result. A result of 6x6 numbers is in four blocks, 3x3 numbers each, one after another.
struct JudgedCall {
  NotedCall call;
  std::vector<double> right;
};

/// What a law compared for one output, where it is no result of a call that `expected_of` knows: exact numbers.
struct NotedComparison {
  std::vector<oracles::Real> computed, exact;
  std::string seen = {};  ///< of its call
};

struct NotedCase {
  std::vector<NotedCall> calls;   ///< of operations from which the output is formed, or of its own
  NotedComparison compared;       ///< of the output where it is worst; empty for a law on fixed-size values
  double kappa = 0;               ///< there, also under the forward rule; 0 if the law gives none
  bool quaternion_poses = false;  ///< the subject returns poses as (p, Q)
  bool wrong_branch = false;      ///< the output is on another branch than the exact one
};

/// The arguments of a call as the subject is given them, whose poses may be (p, Q).
std::vector<double> given_numbers(const Series& series, const NotedCall& call);

/// Measures a case once more and notes its calls that concern an output.
NotedCase noted(const Series& series, const CaseId& id, std::size_t output);

/// The calls of an output's operation that returned, in some cases of a seed that is the same in every campaign.
std::vector<NotedCall> sampled_calls(const Series& series, std::size_t output, std::uint64_t from = 0,
                                     std::uint64_t to = 300);

/// Whether Euler angles are unique, so that they can be compared: a tenth or more from gimbal lock.
bool are_unique(const std::vector<double>& angles, const oracles::Order& order);

/// Whether such a case fails in a block of an operation. A result that is not the oracle's may be another right one, as the
/// opposite axis with the opposite angle is.
bool case_fails(const Series& series, std::uint64_t index, const Operation& operation);

/// The result of a call from the oracle at 50 digits; empty if there is none, as for an algorithm on a tree.
std::vector<oracles::Real> expected_of(const NotedCall& call);

/// The result of one operation at given arguments, in each scalar of the subject; empty if it throws.
std::vector<double> result_of(const Series& series, const Operation& operation,
                              const std::vector<double>& arguments);

}  // namespace liecheck::properties
