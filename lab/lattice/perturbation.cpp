#include <lattice/perturbation.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace liecheck::properties {
namespace {

/// The block [first row, last row) x [first column, last column) of a matrix with `columns` columns.
ResultBlock submatrix(const char* name, std::size_t columns, std::array<std::size_t, 4> range) {
  ResultBlock b{name, {}, true};
  for (std::size_t i = range[0]; i < range[1]; ++i)
    for (std::size_t j = range[2]; j < range[3]; ++j) b.numbers.push_back(i * columns + j);
  return b;
}

}  // namespace

std::vector<ResultBlock> blocks_of(const Operation& operation, std::size_t n) {
  const auto& parts = operation.results[0]->parts;
  if (parts.size() == 1 && parts[0].size == 36)
    return {submatrix("upper left", 6, {0, 3, 0, 3}), submatrix("upper right", 6, {0, 3, 3, 6}),
            submatrix("lower left", 6, {3, 6, 0, 3}), submatrix("lower right", 6, {3, 6, 3, 6})};
  if (parts.size() == 1 && parts[0].size == 42)
    return {submatrix("translation", 6, {0, 3, 0, 3}), submatrix("quaternion", 6, {3, 7, 3, 6}),
            submatrix("upper right", 6, {0, 3, 3, 6}), submatrix("lower left", 6, {3, 7, 0, 3})};
  std::vector<ResultBlock> all;
  std::size_t at = 0;
  for (const Part& part : parts) {
    ResultBlock b{std::string(part.name), {}};
    const std::size_t size = part.size > 0 ? static_cast<std::size_t>(part.size) : n / parts.size();
    for (std::size_t i = 0; i < size; ++i) b.numbers.push_back(at++);
    all.push_back(b);
  }
  return all;
}

std::vector<std::string> block_names(const Operation& operation) {
  std::vector<std::string> names;
  for (const ResultBlock& b : blocks_of(operation, 0)) names.push_back(b.name);
  return names;
}

std::string Perturbation::name() const {
  const std::string word = change_words[static_cast<std::size_t>(change)];
  if (change == PlantedChange::size) return fmt::format("2^{} eps", k);
  if (change == PlantedChange::argument) return fmt::format("{}, 2^{} eps", word, k);
  return word;
}

void Perturbation::apply(std::vector<double>& result, const oracles::Scalar& scalar,
                         const std::vector<ResultBlock>& blocks, std::vector<double> before) const {
  const auto& [name, numbers, submatrix] = blocks[block % blocks.size()];
  if (numbers.empty()) return;
  if (before.size() != result.size()) before.assign(result.size(), 0);
  const std::size_t i = numbers[component % numbers.size()];
  double& x = result[i];
  switch (change) {
    case PlantedChange::size: {
      double largest = 0;
      for (const std::size_t j : numbers) largest = std::max(largest, std::fabs(result[j]));
      if (largest == 0 && submatrix)  // relative to the whole matrix; other zeros stay zero
        for (const double y : result) largest = std::max(largest, std::fabs(y));
      x = scalar.rounded(x + largest * std::ldexp(scalar.epsilon, k));
      return;
    }
    case PlantedChange::not_a_number:
      x = std::numeric_limits<double>::quiet_NaN();
      return;
    case PlantedChange::sign:
      x = -x;
      return;
    case PlantedChange::whole_sign:
      for (const std::size_t j : numbers) result[j] = -result[j];
      return;
    case PlantedChange::zero:
      x = 0;
      return;
    case PlantedChange::swap:
      std::swap(x, result[numbers[other % numbers.size()]]);
      return;
    case PlantedChange::stale:
      x = before[i];
      return;
    case PlantedChange::unwritten:
      result = before;
      return;
    case PlantedChange::none:
    case PlantedChange::argument:
      return;
  }
}

}  // namespace liecheck::properties
