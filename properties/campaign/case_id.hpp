#pragma once
// A case's address, and numbers as text.
//
//   g3.SEED.PROPERTY.SUBJECT.SCALAR.ROBOT.INDEX    generated: the input follows from the address
//   raw.PROPERTY.SUBJECT.SCALAR.ROBOT.X,X,...      shrunk or typed: the input itself, hexadecimal floats
//
// ROBOT is "none" or the first 16 digits of the SHA-256 of the URDF. The generator's key leaves out the
// subject's name: every subject of one scalar sees the same inputs.

#include <boost/multiprecision/float128.hpp>
#include <cstdint>
#include <generators/random_bits.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

inline constexpr int generator_version = 3;

struct CaseId {
  bool raw = false;
  std::uint64_t seed = 0;
  std::string property, subject, scalar, robot;
  std::uint64_t index = 0;
  std::vector<std::string> input;  ///< of a raw case

  std::string text() const;
  /// Throws std::invalid_argument with one line that says what is wrong.
  static CaseId parse(const std::string& text);
  /// Of a whole series and seed; the key of a case adds its index to the last word.
  Source::Key series_key() const;
  Source::Key key() const { return key_of(series_key(), index); }
  static Source::Key key_of(Source::Key series, std::uint64_t index) {
    series[3] += index;
    return series;
  }
};

template <class S>
std::string scalar_name();

/// Exact: sign, 0x1.…p±e. "nan", "inf" and "-inf" for what is not finite.
template <class S>
std::string hexadecimal_float(const S& x);
/// Throws std::invalid_argument naming the text.
template <class S>
S parse_float(const std::string& text);
/// Shortest or 36 digits: for reading only.
template <class S>
std::string decimal_float(const S& x);

}  // namespace liecheck::properties
