#pragma once
// Numbers and lists in JSON. JSON has no NaN and no infinity; the strings "nan", "inf" and "-inf" stand for
// them.

#include <cmath>
#include <nlohmann/json.hpp>

namespace liecheck::properties {

inline nlohmann::json number(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
  return x;
}

/// Like number(), but NaN becomes null. For quantities that may be undefined, such as an attitude.
inline nlohmann::json number_or_null(double x) {
  return std::isnan(x) ? nlohmann::json() : number(x);
}

/// The list of record(element) for each element.
template <class List, class Record>
nlohmann::json list_of(const List& list, const Record& record) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& element : list) all.push_back(record(element));
  return all;
}

template <class Numbers>
nlohmann::json numbers(const Numbers& list) {
  return list_of(list, number);
}

}  // namespace liecheck::properties
