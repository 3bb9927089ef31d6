#pragma once
// Numbers in JSON, which has no NaN and no infinity: these are the strings "nan", "inf" and "-inf".

#include <cmath>
#include <nlohmann/json.hpp>

namespace liecheck::properties {

inline nlohmann::json number(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
  return x;
}

/// For quantities that are NaN where they are not defined (the attitude of a scene in which nothing rotates): null.
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
