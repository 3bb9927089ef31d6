#pragma once

#include <stdexcept>
#include <string>

namespace liecheck::test {

/// The message of the std::invalid_argument that f throws; empty if f throws nothing.
template <class F>
std::string refusal(F f) {
  try {
    f();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return {};
}

}  // namespace liecheck::test
