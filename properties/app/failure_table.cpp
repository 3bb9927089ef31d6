// What a campaign found, on the terminal: its findings, a table of its failures, worst first, and what was measured.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <app/campaign_run.hpp>
#include <campaign/expected.hpp>
#include <failures/blocks.hpp>
#include <failures/description.hpp>
#include <failures/findings.hpp>
#include <failures/promises.hpp>
#include <map>
#include <set>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/terminal.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

constexpr std::size_t shown = 25, most_findings = 10;

/// A line of the table, and a guess at the cause below it.
struct Line {
  std::string what, where, how, seen, guess;
};

Line line_of(const FailedBlock& f, bool one_subject) {
  const std::string where = where_of(f);
  return {fmt::format("{} {}", f.operation, f.block),
          where == "everywhere" && f.failed < f.cases ? "at any angle" : where, what_of(f),
          fmt::format("{} of {} cases{}", f.failed, f.cases,
                      one_subject ? "" : fmt::format(" of {} in {}", f.subject, f.scalar)),
          guess_of(f)};
}

void print_table(const std::vector<FailedBlock>& failed, std::size_t lines) {
  std::set<std::pair<std::string, std::string>> subjects;
  for (const FailedBlock& f : failed) subjects.insert({f.subject, f.scalar});
  std::vector<Line> all{{"failed, worst first", "where", "worst of them", "failing", ""}};
  for (std::size_t i = 0; i < lines; ++i) all.push_back(line_of(failed[i], subjects.size() == 1));
  std::size_t what = 0, where = 0, how = 0;
  for (const Line& l : all)
    what = std::max(what, l.what.size()), where = std::max(where, l.where.size()),
    how = std::max(how, l.how.size());
  for (const Line& l : all) {
    const std::string happened = printable(fmt::format("{:<{}}", l.how, how));
    fmt::print("{:<{}}  {:<{}}  {}  {}\n", printable(l.what), what, printable(l.where), where,
               &l == &all.front() ? happened : coloured(Colour::red, happened), printable(l.seen));
    if (!l.guess.empty()) say("    perhaps {}\n", l.guess);
  }
}

/// The blocks of operations in which a finding fails, each with its bands in one scalar.
class FailingBands {
 public:
  using Block = std::tuple<std::string_view, std::string_view, const Bands*>;
  void add(const Block& block, std::size_t band) {
    auto at = std::ranges::find(all_, block, [](const auto& one) { return one.first; });
    if (at == all_.end())
      at = all_.insert(at, {block, std::vector<bool>(std::get<const Bands*>(block)->all().size())});
    at->second[band] = true;
  }
  bool has(const Block& block) const {
    return std::ranges::count(all_, block, [](const auto& one) { return one.first; }) > 0;
  }
  /// The lines of a limits file that expect these failures: all inputs of a block, or intervals of the angle. A band between two
  /// that fail is in the interval: more cases would fail there, too.
  std::vector<std::string> accepting() const {
    std::vector<std::string> lines;
    for (auto [block, bad] : all_) {
      const auto& [operation, name, bands] = block;
      for (std::size_t i = 1; i + 1 < bad.size(); ++i)
        if (const auto axis = bands->all()[i].axis; bad[i - 1] && bad[i + 1] && axis != Axis::none &&
                                                    bands->all()[i - 1].axis == axis &&
                                                    bands->all()[i + 1].axis == axis)
          bad[i] = true;
      std::vector<std::string> inputs;
      for (const auto& [first, last] : runs_of(bands->all(), bad)) {
        const auto more = inputs_of(bands->all(), first, last);
        inputs.insert(inputs.end(), more.begin(), more.end());
      }
      if (bad[0]) inputs = {"any"};
      for (const std::string& text : inputs)
        lines.push_back(fmt::format("{}, {}, {} = WHY, LINK", operation, name, text));
    }
    return lines;
  }

 private:
  std::vector<std::pair<Block, std::vector<bool>>> all_;
};

/// Of each finding. What fails in a hard case is the failure of the finding that has the block, else of the one that has the case.
std::vector<FailingBands> failing_bands(const std::vector<Finding>& findings) {
  std::vector<FailingBands> all(findings.size());
  for (std::size_t i = 0; i < findings.size(); ++i)
    for (const auto* blocks : {&findings[i].own, &findings[i].others})
      for (const FailedBlock* f : *blocks)
        for (const BandOf& b : f->bands)
          if (fails(*b.series, {int(b.output), int(b.band)}, *b.row))
            all[i].add({f->operation, f->block, &b.series->bands()}, b.band);
  for (std::size_t i = 0; i < findings.size(); ++i)
    for (const HardCell* cell : findings[i].hard_cells)
      for (const FailedPlace& p : cell->failing) {
        const FailingBands::Block block{p.operation, p.block, p.bands};
        const auto at = std::ranges::find_if(all, [&](const FailingBands& f) { return f.has(block); });
        (at == all.end() ? all[i] : *at).add(block, p.band);
      }
  return all;
}

void print_in_full(const CampaignResult& r, const FailedBlock& f) {
  const BandOf& w = *f.worst;
  say("\n{}", describe_failure(*w.series, r.options.seed, static_cast<int>(w.output),
                               static_cast<int>(w.band), *w.row, r.robot));
  if (const std::string guess = guess_of(f); !guess.empty()) say("  perhaps   {}\n", guess);
}

}  // namespace

ToldFindings told_findings(const CampaignResult& r, const std::vector<HardRow>& hard_cases, bool all) {
  const Steps shown("looking for the causes of failures");
  ToldFindings told{failed_blocks(r), {}, {}};
  told.findings = findings_of(r, told.failed, hard_cases);
  for (const Finding& f : told.findings)
    if (all || told.texts.size() < most_findings) told.texts.push_back(text_of(f, told.texts.size() + 1, r));
  return told;
}

void print(const ToldFindings& told) {
  for (const std::string& text : told.texts) say("\n{}", text);
  if (const std::size_t more = told.findings.size() - told.texts.size())
    say("\n{} more finding{}: --all prints {}\n", more, more == 1 ? "" : "s", more == 1 ? "it" : "them");
}

void print_failures(const CampaignResult& r, bool all) {
  const auto failed = failed_blocks(r);
  if (failed.empty()) return;
  const std::size_t lines = all ? failed.size() : std::min(failed.size(), shown);
  say("\n");
  print_table(failed, lines);
  if (lines < failed.size()) say("{} more lines: --all prints them\n", failed.size() - lines);
  for (std::size_t i = 0; i < (all ? failed.size() : 1); ++i) print_in_full(r, failed[i]);
  if (!all && failed.size() > 1) say("\nThis is the worst one; --all prints each in full\n");
}

void print_how_to_accept(const ToldFindings& told, bool all) {
  std::vector<std::string> lines;
  std::string by_finding;
  const std::vector<FailingBands> failing = failing_bands(told.findings);
  for (std::size_t i = 0; i < failing.size(); ++i) {
    std::string of_finding;
    for (const std::string& line : failing[i].accepting())
      if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line), of_finding += line + "\n";
    if (!of_finding.empty())
      by_finding += fmt::format("# finding {}, {}\n{}", i + 1, told.findings[i].operation, of_finding);
  }
  if (lines.empty()) return;
  if (all)
    say("lines of a limits file that accept these failures; {} writes lines that other seeds keep, "
        "too:\n[expected]\n{}",
        as_typed("promise"), by_finding);
  else
    say("a limits file accepts a known failure by a line below [expected], such as: {}{}\n", lines.front(),
        lines.size() > 1 ? fmt::format("; --all prints all {}", lines.size()) : "");
}

void print_without_finding(const CampaignResult& r, const ToldFindings& told) {
  std::set<std::string> subjects, passed;
  for (const auto& [series, tally] : r.series) {
    subjects.insert(series->subject);
    for (const auto& [cell, row] : tally.rows)
      if (row.inside() > 0) passed.emplace(series->outputs.at(std::size_t(cell.first)).operation);
  }
  for (const auto& [series, tally] : r.series)  // those that a limits file expects to fail do fail
    for (const auto& [cell, row] : tally.rows)
      if (row.failed > 0) passed.erase(std::string(series->outputs.at(std::size_t(cell.first)).operation));
  for (const Finding& f : told.findings) passed.erase(f.operation);
  if (subjects.size() == 1 && !passed.empty()) say("without a finding: {}\n", fmt::join(passed, ", "));
}

void print_measured(const CampaignResult& r, const std::vector<HardRow>& hard_cases) {
  std::set<std::string> laws, scalars, whose;
  for (const auto& [series, tally] : r.series) {
    laws.insert(series->property), scalars.insert(series->scalar);
    whose.insert(series->own ? printable(series->own->file) : std::string(name_of(series->profile)));
  }
  std::map<std::tuple<const HardCase*, std::string, std::string>, bool> cases;  // whether a law fails
  for (const HardRow& row : hard_cases)
    for (const HardCell& c : row.cells) cases[{row.entry, c.subject, c.scalar}] |= c.failed || c.open;
  const auto failing = std::ranges::count_if(cases, [](const auto& c) { return c.second; });
  const bool on_robot = !r.robot.path.empty() || std::ranges::any_of(r.series, [](const SeriesResult& s) {
    return s.series->on_robot;
  });
  say("measured {} cases of {} law{} in {} in {:.1f} s, seed {}{}; limits {}", r.total_cases, laws.size(),
      laws.size() == 1 ? "" : "s", fmt::join(scalars, " and "), r.elapsed, r.options.seed,
      on_robot ? fmt::format(", robot {}{} ({})", printable(r.robot.name), r.robot.fixed ? ", fixed" : "",
                             r.robot.hash)
               : "",
      fmt::join(whose, ", "));
  const char* const verb = failing == 1 ? "fails or has" : "fail or have";
  if (!cases.empty()) say("; {} hard cases, of which {} {} no verdict", cases.size(), failing, verb);
  say("\n");
}

}  // namespace liecheck::properties
