#include <algorithm>
#include <campaign/tally.hpp>
#include <limits>

namespace liecheck::properties {

void Row::add(const Judged& j, std::uint64_t index) {
  ++count;
  if (j.residual.outcome == Outcome::outside_domain) {
    ++outside_domain;
    return;
  }
  double score = std::numeric_limits<double>::infinity();
  if (const Outcome o = j.residual.outcome; o != Outcome::measured && o != Outcome::ill_posed) {
    not_finite += o == Outcome::not_finite, wrong_branch += o == Outcome::wrong_branch;
    unresolved += o == Outcome::unresolved, refused += o == Outcome::refused;
    unmeasured += o == Outcome::unmeasured;
    not_repeatable += o == Outcome::not_repeatable, argument_written += o == Outcome::argument_written;
    output_unwritten += o == Outcome::output_unwritten, crashed += o == Outcome::crashed;
    environment_changed += o == Outcome::environment_changed, printed += o == Outcome::printed;
  } else if (j.ill_posed) {
    ++ill_posed;
    score = 0;
  } else {
    errors.add(j.residual.error);
    max_error = std::max(max_error, j.residual.error);
    max_excess = std::max(max_excess, j.excess);
    score = j.budget->rule == Rule::forward ? j.residual.error : j.excess;
  }
  take_worst(j.failed, score, index, j.residual.kappa);
  if (j.failed) ++failed;
}

/// A case that failed is worse than any case that passed, whatever its score.
void Row::take_worst(bool other_failed, double score, std::uint64_t index, double kappa) {
  const bool had_failed = failed > 0;
  if (other_failed != had_failed ? other_failed
                                 : score > worst_score || (score == worst_score && index < worst_index))
    worst_score = score, worst_index = index, worst_kappa = kappa;
}

void Row::merge(const Row& o) {
  take_worst(o.failed > 0, o.worst_score, o.worst_index, o.worst_kappa);
  count += o.count, ill_posed += o.ill_posed, unresolved += o.unresolved, not_finite += o.not_finite;
  wrong_branch += o.wrong_branch, refused += o.refused, failed += o.failed, unmeasured += o.unmeasured;
  not_repeatable += o.not_repeatable, argument_written += o.argument_written;
  output_unwritten += o.output_unwritten, outside_domain += o.outside_domain, crashed += o.crashed;
  environment_changed += o.environment_changed, printed += o.printed;
  errors.merge(o.errors);
  max_error = std::max(max_error, o.max_error);
  max_excess = std::max(max_excess, o.max_excess);
}

MeasuredOutputs measured_outputs(const std::vector<Judged>& judged) {
  MeasuredOutputs sets;
  std::uint32_t undetermined = 0;  // by the law itself, whatever else it recorded
  for (const Judged& j : judged) {
    const std::uint32_t bit = 1u << j.residual.output;
    if (leaves_open(j.residual.outcome)) continue;
    if (j.residual.outcome == Outcome::outside_domain) {
      sets.outside |= bit;
      continue;
    }
    if (j.residual.outcome == Outcome::ill_posed) undetermined |= bit;
    (j.ill_posed ? sets.ill_posed : sets.measured) |= bit;
  }
  sets.measured &= ~(undetermined | sets.outside);
  sets.ill_posed &= ~(sets.measured | sets.outside);
  return sets;
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
