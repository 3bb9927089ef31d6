#pragma once
// What a fault of the lattice does to the result of a call.

#include <cstdint>
#include <operations/operations.hpp>
#include <oracles/scalar.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

enum class PlantedChange : std::uint8_t {
  none,          ///< for tests: changes nothing
  size,          ///< adds 2^k eps of the block's largest number to one component; to zeros, see ResultBlock
  not_a_number,  ///< one component becomes NaN
  sign,          ///< one component changes its sign
  whole_sign,    ///< the block changes its sign
  zero,          ///< one component becomes zero
  swap,          ///< two components of the block are exchanged
  stale,         ///< one component is that of the result before
  unwritten,     ///< the whole result is that of the call before
  argument       ///< 2^k eps of itself is added to one number of the first argument after the call
};
inline constexpr const char* change_words[] = {"none", "size", "NaN",   "sign",      "sign of the block",
                                               "zero", "swap", "stale", "unwritten", "argument written to"};
static_assert(std::size(change_words) == static_cast<std::size_t>(PlantedChange::argument) + 1);

/// A part of a result that laws measure on its own, by the positions of its numbers.
struct ResultBlock {
  std::string name;
  std::vector<std::size_t> numbers;
  bool submatrix = false;  ///< a zero one gets 2^k eps of the whole matrix; other blocks of zeros stay zero
};
/// The blocks of a result with n numbers: the parts of its layout, and those of a Jacobian.
std::vector<ResultBlock> blocks_of(const Operation& operation, std::size_t n);
/// The names of these blocks; their number does not depend on n.
std::vector<std::string> block_names(const Operation& operation);

struct Perturbation {
  PlantedChange change = PlantedChange::none;
  int k = 0;                          ///< for size and argument
  unsigned block = 0;                 ///< which block
  unsigned component = 0, other = 0;  ///< which numbers of it, modulo its size

  std::string name() const;
  /// Whether it depends on the call before.
  bool remembers() const { return change == PlantedChange::stale || change == PlantedChange::unwritten; }

  /// Changes the numbers of a result, which stay numbers of the scalar. `before` is the result of the call before of
  /// the same operation; if it has another size, zeros take its place.
  void apply(std::vector<double>& result, const oracles::Scalar& scalar,
             const std::vector<ResultBlock>& blocks, std::vector<double> before) const;
};

}  // namespace liecheck::properties
