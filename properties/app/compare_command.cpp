#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <app/command.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <record/record.hpp>
#include <rules/rules.hpp>
#include <sstream>
#include <store/comment.hpp>
#include <store/picture.hpp>
#include <store/store_path.hpp>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>

namespace liecheck::properties {

namespace {

struct CompareFlags {
  std::string before, after, markdown, picture, json;
  std::vector<std::string> cost;
  bool rules = false, strict = false;
};

/// Why a comparison with a store is incomplete: it lacks cases of its campaign or verdicts on them. A shard is a whole part.
void add_what_is_open(const std::string& name, const StoredCampaign& c, std::vector<std::string>& open) {
  if (const std::string lacks = c.not_measured(); !lacks.empty())
    open.push_back(fmt::format("{}: {}", name, lacks));
  if (c.spec.cases > 0 && !c.complete())
    open.push_back(fmt::format("{} is unfinished", name));
  else if (c.spec.cases > 0 && c.spec.last - c.spec.first < c.spec.cases)
    warn(fmt::format("liecheck: {}: a shard, cases {} to {} of {} in each series\n", name, c.spec.first,
                     c.spec.last - 1, c.spec.cases));
}

/// "mylib 1.0, other 2.0".
std::string subjects_of(const StoredCampaign& c) {
  std::vector<std::string> all;
  for (const StoredSeries& s : c.series)
    if (std::ranges::find(all, s.subject) == all.end()) all.push_back(s.subject);
  return all.empty() ? "no subject" : fmt::format("{}", fmt::join(all, ", "));
}

/// Prints what differs between two versions of the rules.
int compare_rules(const CompareFlags& f) {
  const auto lines = differences(rules_named(f.before), rules_named(f.after));
  for (const std::string& line : lines) say("{}\n", line);
  say("rules {} and {}: {} differences\n", f.before, f.after, lines.size());
  return lines.empty() ? within_budget : property_failed;
}

/// The changes as they are in the record.
nlohmann::json record_of(const std::vector<Change>& changes) {
  nlohmann::json all = nlohmann::json::array();
  for (const Change& c : changes)
    all.push_back({{"subject", c.name[0]},
                   {"scalar", c.name[1]},
                   {"property", c.name[2]},
                   {"operation", c.name[3]},
                   {"block", c.name[4]},
                   {"band", c.name[5]},
                   {"what", c.what},
                   {"worst_case", c.worst_case}});
  return all;
}

/// Prints the worst cell of each block, and below it the replay of its worst case.
void print_changes(const std::vector<Change>& changes) {
  std::string text;
  {
    Counted drawn("drawing the worst cases", "cells", 16);  // which clears its line before the text
    for (const Change& c : by_block(changes)) {
      drawn.next();
      text += c.text() + "\n";
      std::istringstream replay(replay_of(c));
      for (std::string line; std::getline(replay, line);) text += "  " + line + "\n";
    }
  }
  say("{}", text);
}

int run(const CompareFlags& f) {
  if (f.rules) return compare_rules(f);
  if (!f.cost.empty() && f.cost.size() != 2)
    throw std::invalid_argument("--cost: give it twice, for the times of A and for those of B");
  std::optional<TimeChanges> times;  // they never decide the verdict: a busy machine is no fault of the code
  if (!f.cost.empty()) times = time_changes(f.cost[0], f.cost[1]);
  const StoredCampaign a = load_campaign(f.before), b = load_campaign(f.after);
  std::vector<std::string> open;
  add_what_is_open(f.before, a, open), add_what_is_open(f.after, b, open);
  const std::size_t cells = cells_in_both(a, b);
  if (cells == 0)
    open.push_back(fmt::format("{} ({}) and {} ({}) have no cell with a verdict in common", f.before,
                               subjects_of(a), f.after, subjects_of(b)));
  const Comparison all = compared(a, b, f.strict);
  for (const std::string& sentence : all.unjudged)
    open.push_back(fmt::format("not judged in {}: {}", f.after, sentence));
  const bool failed = cells > 0 && !all.worse.empty(), partial = !open.empty();
  if (!f.markdown.empty())
    write_whole(f.markdown, in_markdown(all, {cells, f.picture, times ? &*times : nullptr, open}));
  if (!f.picture.empty()) write_whole(f.picture, picture_of(all, a, b));
  if (!f.json.empty())
    write_record(f.json, {{"verdict", verdict_of(!partial || failed, !failed)},
                          {"compared_cells", cells},
                          {"open", open},
                          {"no_longer_measured", all.lost},
                          {"first_measured", all.gained},
                          {"worse", record_of(all.worse)},
                          {"better", record_of(all.better)},
                          {"other", record_of(all.other)}});
  if (cells > 0) print_changes(all.worse);
  if (times) say("{}", text_of(*times));
  say("{}{}\n", summary_of(all, cells, open), all.other.empty() ? "" : " (--markdown and --json list them)");
  return failed ? property_failed : partial ? incomplete : within_budget;
}

}  // namespace

Command compare_command(CLI::App& program) {
  CommandWith<CompareFlags> a(
      program, "compare",
      "print what got worse from store A to store B: failures, NaN, wrong branches, "
      "cliffs and failing hard cases that are new, operations in another convention, and "
      "errors that more than doubled and thereby used up a quarter of their limit. "
      "Exit code 0 if nothing did; 1 if "
      "anything did; 2 for bad input; 3 if a store lacks cases or verdicts");
  a.text("A", a->before, "", "the earlier store").required();
  a.text("B", a->after, "", "the later store").required();
  a.output("--markdown", a->markdown, "FILE",
           "also write what got worse and better as Markdown, for a comment on a pull request");
  a.output("--picture", a->picture, "FILE.svg",
           "also draw what got worse and better; the Markdown shows the picture by this name");
  a.toggle("--strict", a->strict,
           "every difference beyond a rounding is worse or better, however far from its limit");
  a.list("--cost", a->cost, "FILE",
         "compare times, too: the record of 'liecheck cost --json' for A, and again for B");
  a.json(a->json, "also write what got worse and better, with the worst case of each cell, to FILE");
  a.toggle("--rules", a->rules,
           "compare two versions of the rules instead of stores; \"present\" is this liecheck's");
  return a.runs(run);
}

}  // namespace liecheck::properties
