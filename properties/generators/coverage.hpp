#pragma once
// Counts a campaign's inputs in each class of input_classes.hpp. A campaign fails if a required class has no
// input: its generator is then defective or too narrow.

#include <array>
#include <generators/input_classes.hpp>

namespace liecheck::properties {

class Coverage {
 public:
  template <class S>
  void add(const std::vector<Field>& fields, const std::vector<S>& input);
  void merge(const Coverage& o);
  /// text() writes all counts as "CASES;N,N,...;N,...". parse() returns false for any other text.
  std::string text() const;
  bool parse(const std::string& text);
  std::uint64_t cases() const { return cases_; }
  std::uint64_t count(std::size_t field, std::size_t c) const {
    return field < counts_.size() ? counts_[field][c] : 0;
  }

 private:
  std::uint64_t cases_ = 0;
  std::vector<std::array<std::uint64_t, 24>> counts_;
};

/// A class is required if at least this many of its inputs are expected. The chance of no input is e^-30.
inline constexpr std::uint64_t expected_at_least = 30;

}  // namespace liecheck::properties
