#pragma once
// The number of a campaign's inputs in each class of input_classes.hpp. A campaign without any input of a required
// class fails: its generator is defective, or has been narrowed.

#include <array>
#include <generators/input_classes.hpp>

namespace liecheck::properties {

/// The number of inputs in each class of each field.
class Coverage {
 public:
  template <class S>
  void add(const std::vector<Field>& fields, const std::vector<S>& input);
  void merge(const Coverage& o);
  /// "CASES;N,N,...;N,...": the counts of every field, and their parser, which returns false for any other text.
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

/// A class is required where at least so many inputs of it are expected; to have none by chance then has probability
/// e^-30.
inline constexpr std::uint64_t expected_at_least = 30;

}  // namespace liecheck::properties
