#include <failures/description.hpp>

#include <fmt/format.h>
#include <campaign/long_sums.hpp>
#include <campaign/robots.hpp>
#include <failures/blocks.hpp>
#include <failures/program.hpp>
#include <failures/result.hpp>
#include <search/shrink.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

std::string case_text(const Series& series, const CaseId& id, const std::vector<std::string>& input,
                      const Judged& judged) {
  const auto output = static_cast<std::size_t>(judged.residual.output);
  const NotedCase case_noted = noted(series, id, output);
  std::string program;
  if (!series.adapter.empty()) program = adapter_program(series, series.outputs[output], case_noted, id);
  Judged with_kappa = judged;
  if (judged.residual.kappa == 0) with_kappa.residual.kappa = case_noted.kappa;
  std::string lost;
  if (judged.residual.outcome == Outcome::measured)
    lost = digits_lost(
        judged.budget && judged.budget->rule == Rule::excess ? judged.excess : judged.residual.error,
        series.eps);
  return fmt::format("  error     {}{}\n  limit     {}\n", error_text(with_kappa),
                     lost.empty() ? "" : "; " + lost, limit_text(series, output, judged.residual.band)) +
         comparison_text(series, series.outputs[output], case_noted, input) + program;
}

namespace {

/// What follows after the case was measured again: the shrunk case, if it fails again.
std::string measured_again(const Series& series, const CaseId& id, int output, int band,
                           const std::string& flags) try {
  const GivesUpLongSums long_sums;
  const Shrunk s = shrink(series, id, output, 2000);
  if (!s.reproduced)
    return fmt::format("  not repeatable: measured again, this case {}; so it is not shrunk\n",
                       s.judged.failed ? "gives other results" : "passes");
  std::string text;
  if (const std::size_t shown = s.judged.residual.band; shown != static_cast<std::size_t>(band) && shown > 0)
    text += fmt::format("  shown     a simpler input that fails in the same way, in the band {}\n",
                        series.bands()[shown].name);
  text += input_text(series, s.id.input) + case_text(series, s.id, s.id.input, s.judged);
  text += fmt::format("  replay    {}\n", replay_words(s.id.text(), flags));
  if (!series.adapter.empty()) return text;  // with its own program
  const auto at = static_cast<std::size_t>(output);
  const Output& o = series.outputs.at(at);
  const std::string own = own_program(series, o, noted(series, s.id, at));
  const std::string program = own.empty() ? program_of(series, o, s.id.input) : own;
  if (!program.empty()) text += "  as C++:\n\n" + program;
  return text;
} catch (const GivenUp&) {
  return "  interrupted: this case is not measured again, and not shrunk\n";
}

}  // namespace

std::string describe_failure(const Series& series, std::uint64_t seed, int output, int band, const Row& row,
                             const Robot& robot) {
  const Output& o = series.outputs.at(static_cast<std::size_t>(output));
  const CaseId id = series.id(seed, row.worst_index);
  const std::string flags = replay_flags(series, robot);
  std::string text;
  text += fmt::format("FAILED  {}: {}\n", series.property, series.law);
  text += fmt::format("  law       {}\n", series.equation);
  text += fmt::format("  subject   {} {} in {}\n", series.subject, series.subject_version, series.scalar);
  const std::string in_band =
      band > 0 ? ", " + series.bands()[static_cast<std::size_t>(band)].name : "";  // 0: no angle
  text += fmt::format("  where     {}, block {}{}; {} of {} cases there fail\n", o.operation, o.block,
                      in_band, row.failed, row.inside());
  if (const std::string outcomes = outcomes_of(row); !outcomes.empty())
    text += fmt::format("  outcomes  {}\n", outcomes);
  text += fmt::format("  found     {}\n", replay_words(id.text(), flags));
  return text + measured_again(series, id, output, band, flags);
}

}  // namespace liecheck::properties
