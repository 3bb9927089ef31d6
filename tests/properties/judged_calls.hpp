#pragma once
// Calls of an operation, with results that are right but for a change.

#include <cmath>
#include <failures/relations.hpp>
#include <failures/substitutions.hpp>
#include <vector>

namespace liecheck::properties {

/// The call of an operation as the subject of liecheck answers it, changed by `plant`, at eight arguments.
inline std::vector<JudgedCall> calls_of(const Operation& operation,
                                        const std::vector<std::vector<double>>& arguments,
                                        void (*plant)(const std::vector<double>& x,
                                                      std::vector<double>& result)) {
  std::vector<JudgedCall> all;
  for (const std::vector<double>& x : arguments) {
    JudgedCall call{{&operation, x, {}, ""}, {}};
    for (const oracles::Real& number : expected_of(call.call))
      call.right.push_back(static_cast<double>(number));
    call.call.result = call.right;
    plant(x, call.call.result);
    all.push_back(std::move(call));
  }
  return all;
}
inline std::vector<std::vector<double>> numbers(std::size_t size) {
  std::vector<std::vector<double>> all;
  for (int k = 1; k <= 8; ++k) {
    std::vector<double>& x = all.emplace_back();
    for (std::size_t i = 0; i < size; ++i) x.push_back(std::sin(k + 2.3 * static_cast<double>(i)));
  }
  return all;
}

}  // namespace liecheck::properties
