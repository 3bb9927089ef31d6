#include <store/counterexamples.hpp>

#include <algorithm>
#include <campaign/expected.hpp>
#include <stdexcept>
#include <support/stop.hpp>

namespace liecheck::properties {

Counterexamples replay_counterexamples(const std::vector<Counterexample>& all,
                                       const std::vector<SeriesResult>& series) {
  Counterexamples result;
  for (const Counterexample& c : all) {
    if (stop_requested) {
      result.complete = false;
      break;
    }
    const auto found = std::find_if(series.begin(), series.end(), [&](const SeriesResult& s) {
      return s.series->property == c.property && s.series->subject == c.subject &&
             s.series->scalar == c.scalar && s.series->robot == c.robot;
    });
    if (found == series.end()) {
      ++result.skipped;
      continue;
    }
    CaseId id;
    std::vector<Judged> judged;
    try {
      id = CaseId::parse("raw." + c.property + "." + c.subject + "." + c.scalar + "." + c.robot + "." +
                         c.input);
      judged = found->series->replay(id);
    } catch (const std::invalid_argument&) {  // the law has changed and does not accept this input
      ++result.skipped;
      continue;
    }
    ++result.replayed;
    const auto still = [&](const Judged& j) {
      const Output& o = found->series->outputs.at(j.residual.output);
      return fails(*found->series, j) && o.operation == c.operation && o.block == c.block;
    };
    if (std::any_of(judged.begin(), judged.end(), still))
      result.failing.push_back({c.operation, c.block, id.text()});
  }
  return result;
}

}  // namespace liecheck::properties
