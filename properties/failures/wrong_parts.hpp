#pragma once
// The parts of results that are wrong, and whether another formula gives them.

#include <failures/calls.hpp>
#include <failures/part_changes.hpp>
#include <functional>
#include <optional>

namespace liecheck::properties {

double distance(const PartPlace& at, const Numbers& a, const Numbers& b);
double size_of_part(const PartPlace& at, const Numbers& x);

/// The result of 6x6 numbers as its four 3x3 blocks, one after another, since one may be far smaller than the others; else itself.
bool is_in_blocks(const Operation& operation);
Numbers in_blocks(const Operation& operation, const Numbers& x);

/// So many wrong calls tell enough, and 100 changes of each are soon tried.
inline constexpr std::size_t enough_calls = 12;
/// The wrong calls of an operation, and which parts of their results are wrong by more than a share.
class Wrong {
 public:
  /// Of one part of the results, or of all.
  Wrong(const Operation& operation, const std::vector<JudgedCall>& calls, double least,
        std::optional<std::size_t> only = {});
  std::size_t count() const { return calls_.size(); }
  const std::vector<PartPlace>& results() const { return results_; }

  /// Whether the results are those that `other` gives for all calls, or for four of five.
  bool of_all = true;
  bool given_by(const std::function<Numbers(const JudgedCall&)>& other) const;
  /// Whether the numbers of wrong parts are those of a float, beside right ones that are not, in four calls and all that do not
  /// overflow.
  bool has_floats() const;
  /// By what the right numbers must be multiplied to be those of the first call in which they are large; 0 if there is none.
  double factor(const PartPlace& at) const;
  /// The parts that are wrong, in words, if they are the same ones in all calls.
  std::string subject() const;

 private:
  bool gives(std::size_t i, const std::function<Numbers(const JudgedCall&)>& other) const;

  std::vector<PartPlace> results_;
  std::optional<std::size_t> only_;
  std::vector<const JudgedCall*> calls_;
  std::vector<std::vector<PartPlace>> parts_;
};

}  // namespace liecheck::properties
