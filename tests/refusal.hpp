#pragma once
// What functions refuse, and what they say.

#include <gtest/gtest.h>

#include <concepts>
#include <stdexcept>
#include <string>

namespace liecheck::test {

/// Whether the text contains the part. A failure shows both.
inline testing::AssertionResult has(const std::string& text, const std::string& part) {
  return (text.find(part) != text.npos ? testing::AssertionSuccess() : testing::AssertionFailure())
         << "'" << part << "' in:\n"
         << text;
}
/// The message of the exception that f throws; empty if f throws nothing.
template <class Exception = std::invalid_argument, std::invocable F>
std::string refusal(F f) {
  try {
    f();
  } catch (const Exception& e) {
    return e.what();
  }
  return {};
}

}  // namespace liecheck::test
