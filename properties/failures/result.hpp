#pragma once
// What a failure says of one result: input, error, limit, what was returned and what is right.

#include <campaign/series.hpp>

namespace liecheck::properties {

struct NotedCall;  // calls.hpp
struct NotedCase;

/// "7.4 of 15.7 digits lost" for an error or excess in eps; "" below 2 eps.
std::string digits_lost(double score, double eps);

/// "2.25e+07 eps, kappa 1" or, for a measurement without an error, its outcome: "NaN or Inf".
std::string error_text(const Judged& judged);

/// "3.9 eps kappa, liecheck's budget (reason)": the limit of an output in a band and whose it is.
std::string limit_text(const Series& series, std::size_t output, std::size_t band);

/// Lines with the numbers of an input, by field, in decimals that read back as the same numbers.
std::string input_text(const Series& series, const std::vector<std::string>& hexadecimal);

/// The call whose result is farthest from the oracle's, preferably of the output's own operation; null if none.
const NotedCall* worst_call(const Output& output, const NotedCase& noted);

/// Lines with what the subject returned and what the oracle says, of the numbers that differ most: in decimal with 17
/// digits, and the nearest number of the scalar in hexadecimal.
std::string comparison_text(const Series& series, const Output& output, const NotedCase& noted,
                            const std::vector<std::string>& input);

/// A number of a result in hexadecimal, as the subject returned it, or "inf", "-inf" or "nan"; and the number of the
/// scalar nearest to the exact one.
struct ComparedNumber {
  std::string name, got, expected;
};

/// The numbers of one result that differ most from the oracle's, at most `most`.
struct ComparedResult {
  std::string operation;  ///< whose result it is; empty if the case has no result that the oracle knows
  std::vector<ComparedNumber> numbers;
};
ComparedResult comparison_of(const Series& series, const Output& output, const NotedCase& noted,
                             std::size_t most);

/// "phi[0] is 1, and -1 is right", of the number that differs most; "" if the oracle does not know the result.
std::string worst_number_text(const Series& series, const Output& output, const NotedCase& noted);

/// "exp3_quaternion(phi = 0, 0, 1)"; "" if the arguments have hundreds of numbers.
std::string called_with(const Series& series, const NotedCall& call);

}  // namespace liecheck::properties
