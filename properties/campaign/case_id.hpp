#pragma once
// The address of a case, and conversions between numbers and text.
//
//   g4.SEED.PROPERTY.SUBJECT.SCALAR.ROBOT.INDEX    generated: the input follows from the address
//   raw.PROPERTY.SUBJECT.SCALAR.ROBOT.X,X,...      shrunk or typed: the input itself, hexadecimal floats
//
// ROBOT is "none" or Robot::hash, or says from what the inputs are drawn for a subject that does not take all of them:
// "revolute_prismatic" joints, "orders_11", "fractions_1" for t = 1/2. The generator's key does not depend on the subject, so all subjects that take
// the same get the same inputs in one scalar.

#include <cstdint>
#include <generators/random_bits.hpp>
#include <oracles/scalar.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

inline constexpr int generator_version = 4;

struct CaseId {
  bool raw = false;
  std::uint64_t seed = 0;
  std::string property, subject, scalar, robot;
  std::uint64_t index = 0;
  std::vector<std::string> input;  ///< the numbers of a raw case

  std::string text() const;
  /// Throws std::invalid_argument with one line that says what is wrong.
  static CaseId parse(const std::string& text);
  /// The key of a series and seed. The key of a case adds the index of the case to the last word.
  Source::Key series_key() const;
  Source::Key key() const { return key_of(series_key(), index); }
  static Source::Key key_of(Source::Key series, std::uint64_t index) {
    series[3] += index;
    return series;
  }
};

/// The exact value, such as -0x1.8p-3; "nan", "inf" or "-inf" if x is not finite.
std::string hexadecimal_float(double x);
/// The number of the scalar nearest to the text. Throws std::invalid_argument with the text, also for a number that
/// would become 0 or infinite.
double parse_float(const std::string& text, const oracles::Scalar& scalar);
/// The shortest decimal number that reads back as x in the scalar: for display only.
std::string decimal_float(double x, const oracles::Scalar& scalar);

}  // namespace liecheck::properties
