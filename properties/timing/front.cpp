#include <algorithm>
#include <limits>
#include <timing/cost.hpp>

namespace liecheck::properties {
namespace {

bool is_defect(const BlockErrors& b) {
  return b.block.find("defect") != std::string::npos;
}

/// The largest error; infinite if the error of an input could not be measured, or if there is none.
double largest(const BlockErrors& b) {
  return b.errors.empty() || b.not_finite + b.wrong_branch + b.refused + b.unresolved > 0
             ? std::numeric_limits<double>::infinity()
             : b.largest();
}

/// The block with the largest error, and this error in eps.
std::pair<std::string, double> worst(const CostSet& set) {
  std::pair<std::string, double> all{"", -1};
  for (const BlockErrors& b : set.blocks)
    if (!is_defect(b) && largest(b) > all.second) all = {b.block, largest(b)};
  return all;
}

}  // namespace

double error_of(const CostRow& row) {
  return error_of(row, row.sets.back());
}

double error_of(const CostRow& row, const CostSet& set) {
  return std::max(0.0, worst(set).second * row.eps);
}

std::string worst_block(const CostRow& row) {
  return worst(row.sets.back()).first;
}

std::vector<int> dominators(const std::vector<CostRow>& rows, Ratio CostSet::*time) {
  std::vector<int> by(rows.size(), -1);
  std::vector<double> error;
  for (const CostRow& row : rows) error.push_back(error_of(row));
  const auto compared = [&](const CostRow& row) {
    const auto& blocks = row.sets.back().blocks;
    const bool measured = std::any_of(blocks.begin(), blocks.end(), [](const BlockErrors& b) {
      return b.errors.size() + b.not_finite + b.wrong_branch + b.refused + b.unresolved > 0 && !is_defect(b);
    });
    return measured && (row.sets.back().*time).processes > 0 && row.subject.find('@') == std::string::npos;
  };
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j) {
      if (rows[i].operation != rows[j].operation || !compared(rows[i]) || !compared(rows[j])) continue;
      const Ratio &a = rows[i].sets.back().*time, &b = rows[j].sets.back().*time;
      const bool dominated =
          (b.high < a.low && error[j] <= error[i]) || (b.median <= a.median && error[j] < error[i]);
      const auto best = static_cast<std::size_t>(by[i]);
      if (dominated && (by[i] < 0 || b.median < (rows[best].sets.back().*time).median))
        by[i] = static_cast<int>(j);
    }
  return by;
}

}  // namespace liecheck::properties
