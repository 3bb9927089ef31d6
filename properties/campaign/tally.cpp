#include <algorithm>
#include <campaign/tally.hpp>
#include <limits>

namespace liecheck::properties {

void Row::add(const Judged& j, std::uint64_t index) {
  ++count;
  const double infinity = std::numeric_limits<double>::infinity();
  double score = infinity;
  switch (j.residual.outcome) {
    case Outcome::not_finite:
      ++not_finite;
      break;
    case Outcome::wrong_branch:
      ++wrong_branch;
      break;
    case Outcome::unresolved:
      ++unresolved;
      break;
    case Outcome::refused:
      ++refused;
      break;
    case Outcome::measured:
      if (j.ill_posed) {
        ++ill_posed;
        score = 0;
        break;
      }
      errors.add(j.residual.error);
      max_error = std::max(max_error, j.residual.error);
      max_excess = std::max(max_excess, j.excess);
      score = j.budget->rule == Rule::forward ? j.residual.error : j.excess;
  }
  // A case that failed is worse than any case that passed, whatever its score.
  const bool had_failed = failed > 0;
  if (j.failed) ++failed;
  if (j.failed != had_failed ? j.failed
                             : score > worst_score || (score == worst_score && index < worst_index)) {
    worst_score = score;
    worst_index = index;
    worst_kappa = j.residual.kappa;
  }
}

void Row::merge(const Row& o) {
  const bool had_failed = failed > 0, other_failed = o.failed > 0;
  count += o.count, ill_posed += o.ill_posed, unresolved += o.unresolved, not_finite += o.not_finite;
  wrong_branch += o.wrong_branch, refused += o.refused, failed += o.failed;
  errors.merge(o.errors);
  max_error = std::max(max_error, o.max_error);
  max_excess = std::max(max_excess, o.max_excess);
  if (other_failed != had_failed
          ? other_failed
          : o.worst_score > worst_score || (o.worst_score == worst_score && o.worst_index < worst_index)) {
    worst_score = o.worst_score, worst_index = o.worst_index, worst_kappa = o.worst_kappa;
  }
}

void Tally::merge(const Tally& o) {
  for (const auto& [key, row] : o.rows) rows[key].merge(row);
  inputs.merge(o.inputs);
  results.merge(o.results);
  coverage.merge(o.coverage);
  cases += o.cases, fast += o.fast, checked += o.checked;
  disagreed.insert(disagreed.end(), o.disagreed.begin(), o.disagreed.end());
  for (const auto& [first, last] : o.done) done.add(first, last);
}

}  // namespace liecheck::properties
