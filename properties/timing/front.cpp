#include <timing/front.hpp>

#include <limits>

namespace liecheck::properties {
namespace {

bool counts(const BlockErrors& b) {
  return b.block.find("defect") == std::string::npos;
}

/// The largest error; infinite if a case has none.
double largest(const BlockErrors& b) {
  return b.not_finite + b.wrong_branch + b.refused + b.unresolved > 0
             ? std::numeric_limits<double>::infinity()
             : b.largest();
}

const Spread& time_of(const CostRow& row, TimeOf kind) {
  return kind == TimeOf::throughput ? row.sets.back().throughput : row.sets.back().latency;
}

}  // namespace

double error_of(const CostRow& row) {
  double most = 0;
  for (const BlockErrors& b : row.sets.back().blocks)
    if (counts(b)) most = std::max(most, largest(b) * row.eps);
  return most;
}

std::string worst_block(const CostRow& row) {
  std::string name;
  double most = -1;
  for (const BlockErrors& b : row.sets.back().blocks)
    if (counts(b) && largest(b) > most) most = largest(b), name = b.block;
  return name;
}

std::vector<int> dominators(const std::vector<CostRow>& rows, TimeOf kind) {
  std::vector<int> by(rows.size(), -1);
  std::vector<double> error;
  for (const CostRow& row : rows) error.push_back(error_of(row));
  const auto compared = [&](const CostRow& row) {
    return !row.sets.back().blocks.empty() && time_of(row, kind).repetitions > 0 &&
           row.subject.find('@') == std::string::npos;
  };
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j) {
      if (rows[i].operation != rows[j].operation || !compared(rows[i]) || !compared(rows[j])) continue;
      const Spread &a = time_of(rows[i], kind), &b = time_of(rows[j], kind);
      const bool dominated =
          (b.high < a.low && error[j] <= error[i]) || (b.median <= a.median && error[j] < error[i]);
      if (dominated && (by[i] < 0 || b.median < time_of(rows[static_cast<std::size_t>(by[i])], kind).median))
        by[i] = static_cast<int>(j);
    }
  return by;
}

}  // namespace liecheck::properties
