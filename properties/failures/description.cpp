#include <failures/description.hpp>

#include <fmt/format.h>
#include <campaign/robots.hpp>
#include <failures/program.hpp>
#include <search/shrink.hpp>

namespace liecheck::properties {

std::string describe_failure(const Series& series, std::uint64_t seed, int output, int band, const Row& row,
                             const Robot& robot) {
  const Output& o = series.outputs.at(static_cast<std::size_t>(output));
  const Band& b = series.bands()[static_cast<std::size_t>(band)];
  const Budget& budget = series.budget(static_cast<std::size_t>(output), b.region);
  const CaseId id = series.id(seed, row.worst_index);
  const Shrunk s = shrink(series, id, output, 2000);
  const std::string flags =
      (series.robot != "none" && !robot.path.empty() ? robot_flags(robot) : "") + subject_flags(series);
  std::string text;
  text += fmt::format("FAILED  {}: {}\n", series.property, series.law);
  text += fmt::format("  law       {}\n", series.equation);
  text += fmt::format("  subject   {} {} in {}\n", series.subject, series.subject_version, series.scalar);
  text += fmt::format("  where     {}, block {}, band {}\n", o.operation, o.block, b.name);
  text += fmt::format("  error     {:.4g} eps, budget {} {} ({}); {} of {} cases in the band fail\n",
                      row.worst_score, budget.limit, budget.rule == Rule::forward ? "eps" : "eps kappa",
                      budget.reason, row.failed, row.inside());
  if (row.not_finite + row.wrong_branch + row.refused > 0)
    text += fmt::format("  outcomes  {} NaN or Inf, {} wrong branch, {} refused\n", row.not_finite,
                        row.wrong_branch, row.refused);
  std::string calls;
  for (const auto& [number, what] :
       {std::pair{row.not_repeatable, "not repeatable"},
        {row.argument_written, "wrote to an argument"},
        {row.output_unwritten, "left output unwritten"},
        {row.crashed, "crashed"},
        {row.environment_changed, "changed the rounding mode or the treatment of subnormals"},
        {row.printed, "wrote to standard output"}})
    if (number > 0) calls += fmt::format("{}{} {}", calls.empty() ? "" : ", ", number, what);
  if (!calls.empty()) text += "  calls     " + calls + "\n";
  text += fmt::format("  worst     liecheck replay {}{}\n", id.text(), flags);
  if (!s.reproduced)
    return text + fmt::format("  not repeatable: measured again, this case {}; so it is not shrunk\n",
                              s.judged.failed ? "gives other results" : "passes");
  text += fmt::format("  shrunk    error {:.4g} eps, kappa {:.3g}{}{}\n", s.judged.residual.error,
                      s.judged.residual.kappa, s.judged.residual.outcome == Outcome::measured ? "" : ", ",
                      outcome_words[static_cast<int>(s.judged.residual.outcome)]);
  text += fmt::format("    decimal     {}\n", fmt::join(s.decimal, ", "));
  text += fmt::format("    hexadecimal {}\n", fmt::join(s.id.input, ", "));
  text += fmt::format("  replay    liecheck replay {}{}\n", s.id.text(), flags);
  const std::string program = program_of(series, o, s.id.input);
  if (!program.empty()) text += "  as C++:\n\n" + program;
  return text;
}

}  // namespace liecheck::properties
