#pragma once
// How often a campaign's inputs fell into each class of input_classes.hpp. A campaign fails where a class that must have
// come up never did: then the generator is defective, or somebody narrowed it.

#include <array>
#include <generators/input_classes.hpp>

namespace liecheck::properties {

/// How often each class of each field came up.
class Coverage {
 public:
  template <class S>
  void add(const std::vector<Field>& fields, const std::vector<S>& input);
  void merge(const Coverage& o);
  /// "CASES;N,N,...;N,...": the counts of every field, and back. False where it is not that.
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

/// A class is required once its expected count is this: missing it by chance has probability e^-30.
inline constexpr std::uint64_t expected_at_least = 30;

}  // namespace liecheck::properties
