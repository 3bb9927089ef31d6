#pragma once
#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace liecheck::multibody_detail {

/// The number of letters to insert, delete or replace to get b from a. Levenshtein (1966).
inline int editDistance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row[b.size()];
}

/// Returns ", the nearest are 'a', 'b' and 'c'" with up to three names, or "" if there are none.
inline std::string nearestNames(const std::string& wanted, const std::vector<std::string>& names) {
  std::vector<std::pair<int, std::string>> ranked;
  for (const std::string& name : names) ranked.emplace_back(editDistance(wanted, name), name);
  std::sort(ranked.begin(), ranked.end());
  ranked.erase(std::unique(ranked.begin(), ranked.end()), ranked.end());
  const std::size_t n = std::min<std::size_t>(ranked.size(), 3);
  std::string text;
  for (std::size_t i = 0; i < n; ++i)
    text += (i == 0      ? (n == 1 ? ", the nearest is '" : ", the nearest are '")
             : i + 1 < n ? ", '"
                         : " and '") +
            ranked[i].second + "'";
  return text;
}

}  // namespace liecheck::multibody_detail
