#pragma once
// Numbers in JSON. JSON has no NaN and no infinity; the strings "nan", "inf" and "-inf" stand for them.

#include <cmath>
#include <nlohmann/json.hpp>

namespace liecheck::properties {

inline nlohmann::json number(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
  return x;
}

/// The same, but NaN becomes null: for undefined quantities, such as an attitude if nothing rotates.
inline nlohmann::json number_or_null(double x) {
  return std::isnan(x) ? nlohmann::json() : number(x);
}

template <class Numbers>
nlohmann::json numbers(const Numbers& list) {
  nlohmann::json all = nlohmann::json::array();
  for (double x : list) all.push_back(number(x));
  return all;
}

}  // namespace liecheck::properties
