#pragma once
// A set of case numbers as disjoint, coalesced ranges [first, last).

#include <cstdint>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace liecheck::properties {

using Range = std::pair<std::uint64_t, std::uint64_t>;  ///< [first, last)

class Ranges {
 public:
  /// Adds [first, last). Adds nothing and returns false if a part of it is already in the set.
  bool add(std::uint64_t first, std::uint64_t last) {
    if (first >= last) return first == last;
    auto next = ranges_.lower_bound(first);
    if (next != ranges_.end() && next->first < last) return false;
    if (next != ranges_.begin()) {
      const auto before = std::prev(next);
      if (before->second > first) return false;
      if (before->second == first) first = before->first, ranges_.erase(before);
    }
    if (next != ranges_.end() && next->first == last) last = next->second, ranges_.erase(next);
    ranges_[first] = last;
    return true;
  }
  /// The parts of [first, last) that are missing.
  std::vector<Range> gaps(std::uint64_t first, std::uint64_t last) const {
    std::vector<Range> all;
    for (const auto& [from, to] : ranges_) {
      if (from >= last) break;
      if (from > first) all.emplace_back(first, from);
      if (to > first) first = to;
    }
    if (first < last) all.emplace_back(first, last);
    return all;
  }
  std::uint64_t count() const {
    std::uint64_t n = 0;
    for (const auto& [from, to] : ranges_) n += to - from;
    return n;
  }
  bool covers(std::uint64_t first, std::uint64_t last) const { return gaps(first, last).empty(); }
  auto begin() const { return ranges_.begin(); }
  auto end() const { return ranges_.end(); }
  bool operator==(const Ranges&) const = default;

 private:
  std::map<std::uint64_t, std::uint64_t> ranges_;
};

}  // namespace liecheck::properties
