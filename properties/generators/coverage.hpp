#pragma once
// Counts a campaign's measurements in each class of input_classes.hpp, by output of the law. A campaign is
// incomplete if an output was not measured in a required class: the generator is then defective or too
// narrow, or the law returns before it measures.

#include <array>
#include <generators/input_classes.hpp>
#include <map>
#include <oracles/scalar.hpp>

namespace liecheck::properties {

/// The outputs of a law by what one case says about them; bit i stands for output i. No output is in two
/// sets.
struct MeasuredOutputs {
  std::uint32_t measured = 0;   ///< at least one verdict, and the law did not call the result undetermined
  std::uint32_t ill_posed = 0;  ///< the input does not determine the result
  std::uint32_t outside = 0;    ///< the input is outside the subject's domain
  auto operator<=>(const MeasuredOutputs&) const = default;
};

class Coverage {
 public:
  void add(const std::vector<Field>& fields, const std::vector<double>& input, const oracles::Scalar& scalar,
           MeasuredOutputs outputs = {});
  void merge(const Coverage& o);
  /// text() writes all counts as "MEASURED,ILL_POSED,OUTSIDE:CASES;N,N,...;N,...|...", for each set of
  /// outputs. parse() returns false for any other text.
  std::string text() const;
  bool parse(const std::string& text);

  // The number of cases; only those in a class of a field; only those that measured an output, or in which it
  // is ill-posed.
  using Set = std::uint32_t MeasuredOutputs::*;
  std::uint64_t cases() const;
  std::uint64_t cases(Set set, std::size_t output) const;
  std::uint64_t cases_outside() const;  ///< the cases in which some output is outside the domain
  std::uint64_t count(std::size_t field, std::size_t c) const;
  std::uint64_t count(std::size_t field, std::size_t c, Set set, std::size_t output) const;

 private:
  struct Counts {
    std::uint64_t cases = 0;
    std::vector<std::array<std::uint64_t, 24>> classes;  ///< by field
    std::uint64_t of(std::size_t field, std::size_t c) const {
      return field < classes.size() ? classes[field][c] : 0;
    }
  };
  std::map<MeasuredOutputs, Counts> counts_;
};

/// A class is required if at least this many of its inputs are expected. The chance of no input is e^-30.
inline constexpr std::uint64_t expected_at_least = 30;

}  // namespace liecheck::properties
