#include <fmt/format.h>
#include <algorithm>
#include <budgets/limits.hpp>
#include <campaign/needs.hpp>
#include <cstdio>
#include <filesystem>
#include <invariants/tree_laws.hpp>
#include <set>
#include <stdexcept>
#include <support/files.hpp>
#include <support/folder.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

struct FormLimitsFlags {
  CampaignOptions options;
  std::uint64_t check_cases = 0;  ///< 0: ten times --cases
  std::uint64_t tree_cases = 0;   ///< of both campaigns; 0: a tenth of --cases
  std::string out;
  RobotFlags robot;
};

/// One column for each subject, one row for each line of the table of limits.
void print_table(const std::map<std::string, Needs>& all) {
  say("largest errors [eps, or eps kappa where the rule is excess]; 'budget' is the limit of the table\n\n");
  std::set<LimitKey> lines;
  say("{:<31}{:<22}{:<10}{:<8}{:>7}", "operation", "block", "region", "rule", "budget");
  for (const auto& [subject, needs] : all) {
    say("{:>17}", subject.substr(subject.find(':') + 1));
    for (const auto& [key, need] : needs) lines.insert(key);
  }
  say("\n");
  for (const LimitKey& key : lines) {
    std::string cells;
    double budget = 0;
    for (const auto& [subject, needs] : all) {
      const auto need = needs.find(key);
      cells += need == needs.end()   ? fmt::format("{:>17}", "-")
               : need->second.broken ? fmt::format("{:>17}", fmt::format("broken {}", need->second.broken))
                                     : fmt::format("{:>17.3g}", need->second.largest);
      if (need != needs.end()) budget = need->second.limit;
    }
    say("{:<31}{:<22}{:<10}{:<8}{:>7.3g}{}\n", key.operation, key.block, key.region, key.rule, budget, cells);
  }
}

/// Prints what exceeds its limit, and returns whether anything does.
bool print_accusations(const std::string& subject, const Needs& found) {
  bool accused = false;
  for (const auto& [key, need] : found)
    if (need.accused()) {
      accused = true;
      say("{}: {}, {}, {}: {:.4g}, limit {:.4g}; {} broken, {} not measured; worst {}\n", subject,
          key.operation, key.block, key.region, need.largest, need.limit, need.broken, need.unmeasured,
          need.worst);
    }
  if (!accused) say("{}: nothing is accused\n", subject);
  return accused;
}

/// What one subject needs: laws on trees run `tree_cases`, the others `cases`.
Needs needs_of(CampaignOptions o, const Robot& robot, std::uint64_t cases, std::uint64_t tree_cases) {
  Needs needs;
  const std::vector<std::string> laws =
      o.selection.properties.empty() ? property_names() : o.selection.properties;
  for (const bool trees : {false, true}) {
    o.selection.properties = laws;
    std::erase_if(o.selection.properties, [&](const std::string& law) { return is_tree_law(law) != trees; });
    o.cases = trees ? tree_cases : cases;
    if (o.selection.properties.empty() || stop_requested) continue;
    auto all = needs_of(run_campaign(o, robot));
    for (auto& [subject, found] : all) needs.merge(found);
  }
  return needs;
}

std::string file_of(std::string subject) {
  std::replace(subject.begin(), subject.end(), ':', '_');
  return subject + ".limits";
}

/// Each subject in turn is measured, written to its file and checked.
int run(const FormLimitsFlags& f) {
  std::vector<std::string> subjects = f.options.selection.subjects;
  if (subjects.empty())
    for (const std::string& name : subject_names())
      if (name.starts_with("correct:")) subjects.push_back(name);
  check_subjects(subjects);
  if (!f.out.empty() && !std::filesystem::is_directory(f.out))
    throw std::invalid_argument(fmt::format("--out: '{}' is not a folder", f.out));
  for (const std::string& subject : subjects)
    if (!f.out.empty()) file_in(f.out, file_of(subject));
  const Robot robot = f.robot.read();
  stop_on_signals();
  const std::uint64_t tree_cases =
                          f.tree_cases ? f.tree_cases : std::max<std::uint64_t>(1, f.options.cases / 10),
                      check_cases = f.check_cases ? f.check_cases : 10 * f.options.cases;
  say("limits of {} times the maxima over {} cases of seed {}, checked in {} of seed {}; in laws on "
      "trees over {} cases and in {}:\n",
      allowance, f.options.cases, f.options.seed, check_cases, f.options.seed + 1, tree_cases, tree_cases);
  std::map<std::string, Needs> all;
  bool accused = false;
  for (const std::string& subject : subjects) {
    CampaignOptions o = f.options;
    o.selection.subjects = {subject};
    o.every_kappa = true;
    const Needs needs = needs_of(o, robot, o.cases, tree_cases);
    if (stop_requested) break;
    const std::string text =
        limits_text(subject, needs,
                    fmt::format("{} times the largest error in {} cases ({} of trees) of seed {}", allowance,
                                o.cases, tree_cases, o.seed));
    if (!f.out.empty()) write_whole(file_in(f.out, file_of(subject)), text);
    o.every_kappa = false;
    o.selection.limits = {std::make_shared<const SubjectLimits>(parse_limits(file_of(subject), text))};
    ++o.seed;
    const Needs checked = needs_of(o, robot, check_cases, tree_cases);
    if (stop_requested) break;
    accused |= print_accusations(subject, checked);
    std::fflush(stdout);
    all[subject] = needs;
  }
  say("\n");
  print_table(all);
  if (stop_requested) {
    say("\ninterrupted: the other subjects have no result\n");
    return incomplete;
  }
  return accused ? property_failed : within_budget;
}

}  // namespace

Command limits_command(CLI::App& lab) {
  CommandWith<FormLimitsFlags> a(
      lab, "limits",
      "measure what limits subjects need: the largest errors in --cases cases, and whether limits of four "
      "times "
      "these hold in --check-cases cases of the next seed. Exit code 0 if they do; 1 otherwise; 2 "
      "for bad input; 3 if stopped");
  CampaignOptions& o = a->options;
  a.list("--subject", o.selection.subjects, "NAME", "a subject; default: every correct:NAME");
  a.list("--property", o.selection.properties, "LAW", "a law; default: all");
  a.list("--scalar", o.selection.scalars, "SCALAR", "float or double; default: both");
  a.seed(o.seed, "seed of the measured cases; the next one is that of the check");
  constexpr std::uint64_t most = 1'000'000'000;
  a.number("--cases", o.cases, 1, most, "measured cases of each law, subject and scalar");
  a.number("--check-cases", a->check_cases, 1, most, "cases of the check; default: ten times --cases");
  a.number("--tree-cases", a->tree_cases, 1, most,
           "cases of laws on trees, measured and checked; default: a tenth of --cases");
  a.jobs(o.jobs);
  a.text("--out", a->out, "FOLDER", "write the limits of each subject to FOLDER, one file per subject");
  a->robot.add(a);
  return a.runs(run);
}

}  // namespace liecheck::properties
