#pragma once
// When ball arithmetic decides nothing, and how accurate it is where it does.

#include <exception>

namespace liecheck::oracles {

/// The error bound is too wide to decide a comparison.
struct Undecided : std::exception {
  const char* what() const noexcept override {
    return "the error bound of ball arithmetic is too wide to decide";
  }
};

/// The accuracy of an error from ball arithmetic, relative to the larger of the error and 1 eps.
inline constexpr double error_accuracy = 1e-4;

}  // namespace liecheck::oracles
