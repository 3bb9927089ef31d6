#include <fmt/format.h>
#include <algorithm>
#include <app/command.hpp>
#include <campaign/needs.hpp>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <support/files.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

struct Flags {
  CampaignOptions options;
  std::uint64_t check_cases = 0;  ///< 0: ten times --cases
  std::string out;
  RobotFlags robot;
};

/// One column for each subject, one row for each line of the table of limits.
void print_table(const std::map<std::string, Needs>& all) {
  fmt::print(
      "largest errors [eps, or eps kappa where the rule is excess]; 'budget' is the limit of the table\n\n");
  std::set<LimitKey> lines;
  fmt::print("{:<31}{:<22}{:<10}{:<8}{:>7}", "operation", "block", "region", "rule", "budget");
  for (const auto& [subject, needs] : all) {
    fmt::print("{:>17}", subject.substr(subject.find(':') + 1));
    for (const auto& [key, need] : needs) lines.insert(key);
  }
  fmt::print("\n");
  for (const LimitKey& key : lines) {
    std::string cells;
    double budget = 0;
    for (const auto& [subject, needs] : all) {
      const auto need = needs.find(key);
      cells += need == needs.end()   ? fmt::format("{:>17}", "-")
               : need->second.broken ? fmt::format("{:>17}", fmt::format("broken {}", need->second.broken))
                                     : fmt::format("{:>17.3g}", need->second.largest);
      if (need != needs.end()) budget = need->second.budget;
    }
    fmt::print("{:<31}{:<22}{:<10}{:<8}{:>7.3g}{}\n", key.operation, key.block, key.region, key.rule, budget,
               cells);
  }
}

/// Prints what exceeds the limits, and returns whether anything does.
bool print_accusations(const std::string& subject, const std::vector<Accusation>& all) {
  if (all.empty()) fmt::print("{}: nothing is accused\n", subject);
  for (const auto& [key, found, limit] : all)
    fmt::print("{}: {}, {}, {}: {:.4g} > {:.4g}; {} broken, {} unresolved; worst {}\n", subject,
               key.operation, key.block, key.region, found.largest, limit, found.broken, found.unresolved,
               found.worst);
  return !all.empty();
}

void write_limits(const std::string& folder, const std::string& subject, const Needs& needs,
                  const std::string& reason) {
  std::string name = subject;
  std::replace(name.begin(), name.end(), ':', '_');
  write_whole(std::filesystem::path(folder) / (name + ".limits"),
              text_of(subject, limits_for(needs), reason));
}

int run(const Flags& f) {
  CampaignOptions o = f.options;
  if (o.selection.subjects.empty())
    for (const std::string& name : subject_names())
      if (name.starts_with("correct:")) o.selection.subjects.push_back(name);
  const Robot robot = f.robot.read();
  stop_on_signals();
  const CampaignResult measured = run_campaign(o, robot);
  const auto needs = needs_of(measured);
  print_table(needs);
  if (stop_requested) return incomplete;
  const std::string reason =
      fmt::format("{} times the largest error in {} cases of seed {}", allowance, o.cases, o.seed);
  if (!f.out.empty())
    for (const auto& [subject, own] : needs) write_limits(f.out, subject, own, reason);

  const std::uint64_t seed = o.seed++;
  const std::uint64_t measured_cases = o.cases;
  o.cases = f.check_cases ? f.check_cases : 10 * o.cases;
  const CampaignResult checked = run_campaign(o, robot);
  if (stop_requested) {
    fmt::print("\ninterrupted: the check has no result\n");
    return incomplete;
  }
  fmt::print("\nlimits of {} times the maxima over {} cases of seed {}, checked in {} cases of seed {}:\n",
             allowance, measured_cases, seed, o.cases, o.seed);
  bool accused = false;
  for (const auto& [subject, found] : needs_of(checked))
    accused |= print_accusations(subject, accusations(found, limits_for(needs.at(subject))));
  return accused ? property_failed : within_budget;
}

}  // namespace

Command bench_limits_command(CLI::App& bench) {
  CommandWith<Flags> a(
      bench, "limits",
      "what limits subjects need: the largest errors over --cases cases, and whether limits of four times "
      "these hold in --check-cases cases of the next seed. Exit code 0 if nothing is accused; 1 otherwise; 2 "
      "for bad input; 3 if stopped");
  CampaignOptions& o = a->options;
  o.jobs = default_jobs();
  a.list("--subject", o.selection.subjects, "NAME", "a subject; default: every correct:NAME");
  a.list("--property", o.selection.properties, "LAW", "a law; default: all");
  a.list("--scalar", o.selection.scalars, "SCALAR", "float or double; default: both");
  a.seed(o.seed, "seed of the measured cases; the next one is that of the check");
  constexpr std::uint64_t most = 1'000'000'000;
  a.number("--cases", o.cases, 1, most, "measured cases of each law, subject and scalar");
  a.number("--check-cases", a->check_cases, 1, most, "cases of the check; default: ten times --cases");
  a.jobs(o.jobs);
  a.text("--out", a->out, "FOLDER", "write the limits of each subject to FOLDER, one file per subject");
  a->robot.add(a);
  return a.runs(run);
}

}  // namespace liecheck::properties
