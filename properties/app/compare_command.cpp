#include <fmt/format.h>
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

/// Prints on stderr if a store lacks cases of its campaign or verdicts on them, because then the comparison
/// is partial, too. Returns whether it is incomplete; a shard is a whole part.
bool print_if_partial(const std::string& name, const StoredCampaign& c) {
  const std::string open = c.not_measured();
  if (!open.empty()) warn(fmt::format("liecheck: {}: {}\n", name, open));
  const bool unfinished = c.spec.cases > 0 && !c.complete();
  if (unfinished)
    warn(fmt::format("liecheck: {}: unfinished\n", name));
  else if (c.spec.cases > 0 && c.spec.last - c.spec.first < c.spec.cases)
    warn(fmt::format("liecheck: {}: a shard, cases {} to {} of {} in each series\n", name, c.spec.first,
                     c.spec.last - 1, c.spec.cases));
  return unfinished || !open.empty();
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
  bool partial = print_if_partial(f.before, a);
  partial = print_if_partial(f.after, b) || partial;
  const std::size_t cells = cells_in_both(a, b);
  if (cells == 0) {
    warn(fmt::format("liecheck: {} and {} have no cell with a verdict in common\n", f.before, f.after));
    partial = true;
  }
  const Comparison all = compared(a, b, f.strict);
  const bool failed = !all.worse.empty();
  if (!f.markdown.empty())
    write_whole(f.markdown, in_markdown(all, {cells, f.picture, times ? &*times : nullptr}));
  if (!f.picture.empty()) write_whole(f.picture, picture_of(all, a, b));
  if (!f.json.empty())
    write_record(f.json, {{"verdict", verdict_of(!partial || failed, !failed)},
                          {"compared_cells", cells},
                          {"worse", record_of(all.worse)},
                          {"better", record_of(all.better)},
                          {"other", record_of(all.other)}});
  print_changes(all.worse);
  if (times) say("{}", text_of(*times));
  say("{}{}\n", summary_of(all), all.other.empty() ? "" : " (--markdown and --json list them)");
  return failed ? property_failed : partial ? incomplete : within_budget;
}

}  // namespace

Command compare_command(CLI::App& program) {
  CommandWith<CompareFlags> a(program, "compare",
                              "print what got worse from store A to store B: failures, NaN, wrong branches "
                              "and cliffs that are new, and "
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
