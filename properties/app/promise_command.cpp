#include <fmt/format.h>
#include <algorithm>
#include <app/campaign_run.hpp>
#include <app/command.hpp>
#include <failures/promises.hpp>
#include <filesystem>
#include <stdexcept>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

/// So many times the cases of a campaign are measured, so that campaigns with other seeds keep the promises.
constexpr std::uint64_t campaigns = 30;
constexpr int hunts = 3;         ///< of each operation
constexpr int most_rounds = 20;  ///< of the hard cases

struct PromiseFlags {
  std::string subject, out, domain;
  AdapterFlags adapters;
  std::vector<std::string> scalars;
  CaseFlags cases;
};

/// The subject that is named, or the one that the adapter gives.
std::string subject_of(const PromiseFlags& f) {
  const std::vector<std::string> given = f.adapters.start();
  if (!f.subject.empty()) return f.subject;
  if (given.size() != 1) throw std::invalid_argument("SUBJECT: name one subject, or give one with --adapter");
  return given.front();
}

/// Adds what searches find on one series: for each operation as many evaluations as a campaign has cases, by error and,
/// where the rule of a block differs beyond pi, by error / kappa.
void hunt_on(const Series& series, std::uint64_t seed, std::uint64_t evaluations, Promises& promises) {
  std::map<std::string, bool> operations;  // whether the rules differ
  for (std::size_t i = 0; i < series.outputs.size(); ++i)
    if (series.due >> i & 1) {
      bool& differ = operations[std::string(series.outputs[i].operation)];
      differ = differ || series.budget(i, Region::to_pi).rule != series.budget(i, Region::beyond_pi).rule;
    }
  for (const auto& [operation, differ] : operations)
    for (const bool excess : {false, true}) {
      if (excess && !differ) continue;
      HuntOptions o;
      o.operation = operation, o.seed = seed, o.excess = excess;
      o.evaluations = evaluations;
      for (const Worst& w : hunt(series, o).worst) promises.add(series, w);
    }
}

/// The domain of a limits file, which is all that counts of it.
std::vector<std::shared_ptr<const SubjectLimits>> domain_in(const std::string& file,
                                                            const std::string& subject) {
  if (file.empty()) return {};
  SubjectLimits all = read_limits(file);
  if (all.subject != subject)
    throw std::invalid_argument(fmt::format("{}: is of the subject '{}'", file, all.subject));
  all.lines.clear(), all.expected.clear();
  return {std::make_shared<const SubjectLimits>(std::move(all))};
}

std::string section(const char* name, const std::string& lines) {
  return lines.empty() ? "" : fmt::format("\n[{}]\n{}", name, lines);
}

int run(const PromiseFlags& f) {
  if (std::filesystem::exists(f.out))
    throw std::invalid_argument(fmt::format("--out: '{}' exists: give another name, or remove it", f.out));
  CampaignOptions o = f.cases.options;
  const std::string subject = subject_of(f);
  o.selection = {{subject}, {}, f.scalars};
  o.selection.profiles[""] = Profile::careful;
  o.selection.limits = domain_in(f.domain, subject);
  o.every_kappa = true;
  const Robot robot = f.cases.robot.read();
  if (select(o.selection, robot).empty())
    throw std::invalid_argument(fmt::format("{} offers no property in these scalars", subject));
  stop_on_signals();
  CampaignOptions larger = o;
  larger.cases *= campaigns;
  const CampaignResult r = run_campaign(larger, robot);
  Promises promises(r);
  const std::string in = fmt::format("{} cases of all laws (seed {}){}", r.total_cases, o.seed,
                                     stop_requested ? "" : ", hunts and the hard cases");
  const auto written_now = [&] {
    const auto [limits, domain, expected] = promises.promised();
    return fmt::format(
        "# What {0} promises, written by liecheck promise from {1}{2}.\nversion = 3\nsubject = {0}\n"
        "profile = careful\n{3}{4}{5}",
        subject, in, stop_requested ? ", interrupted: campaigns may break what stands here" : "",
        section("limits", limits), section("domain", domain), section("expected", expected));
  };
  std::string text;
  // A hunt leaves out the inputs whose failures the file expects by then. A hard case shows its worst block alone, so that
  // others may fail by the file that is written for it.
  Progress line("hunt", o.quiet);
  bool fails = true;
  for (int round = 0; (round <= hunts || (fails && round < most_rounds)) && !stop_requested; ++round) {
    text = written_now();
    Selection judged = o.selection;
    judged.limits = {std::make_shared<const SubjectLimits>(parse_limits(f.out, text))};
    const auto all = round < hunts ? select(judged, robot) : std::vector<std::unique_ptr<Series>>();
    for (std::size_t i = 0; i < all.size() && !stop_requested; ++i) {
      line.show((round + static_cast<double>(i) / static_cast<double>(all.size())) / hunts,
                [&](double) { return all[i]->property; });
      all[i]->every_kappa = true;
      hunt_on(*all[i], o.seed + static_cast<std::uint64_t>(round), o.cases, promises);
    }
    fails = promises.add(run_hard_cases(judged, robot, built_in_corpus(), o.jobs));
  }
  if (stop_requested && r.total_cases == 0) {
    std::fputs("interrupted: nothing was measured, and no file was written\n", stderr);
    return incomplete;
  }
  if (stop_requested) text = written_now();
  const SubjectLimits written = parse_limits(f.out, text);
  write_whole(f.out, text);
  std::vector<std::string> not_promised;
  for (const DomainBound& b : written.domain)
    if (!b.reason.empty())
      not_promised.push_back(fmt::format("{}, {} {} {:g}: {}", b.operation ? b.operation->name : "*",
                                         quantity_names()[static_cast<std::size_t>(b.quantity)],
                                         b.lower ? "below" : "above", b.bound, b.reason));
  for (const ExpectedFailure& e : written.expected)
    not_promised.push_back(fmt::format("{} {} at {}: {}", e.operation, e.block, e.inputs.text, e.reason));
  constexpr std::size_t most_lines = 6;
  for (std::size_t i = 0; i < std::min(most_lines, not_promised.size()); ++i)
    say("not promised: {}\n", not_promised[i]);
  if (not_promised.size() > most_lines)
    say("and {} more, which stand in the file\n", not_promised.size() - most_lines);
  say("{}: {} limits of {:g} times the largest error found in {}\n", f.out, written.lines.size(), allowance,
      in);
  if (stop_requested) {
    std::fputs("interrupted: campaigns may break what stands in the file\n", stderr);
    return incomplete;
  }
  return written.expected.empty() ? within_budget : property_failed;
}

}  // namespace

Command promise_command(CLI::App& program) {
  CommandWith<PromiseFlags> a(
      program, "promise",
      "write a first limits file, which campaigns with other seeds keep: four times the largest error of "
      "each "
      "operation and "
      "block, without the angles at which it is NaN, on a wrong branch or far larger, whose failures the "
      "file expects. "
      "Exit code 0 if there are none; 1 if there are some; 2 for bad input; 3 if stopped, with a file of "
      "what was measured");
  a.text("SUBJECT", a->subject, "", "the subject; default: that of the adapter");
  a->adapters.add(a);
  a.list("--scalar", a->scalars, "SCALAR", "float or double, repeatable; default all it has");
  a.text("--limits", a->domain, "FILE", "a limits file, of which the domain counts");
  a->cases.add(a);
  a.output("--out", a->out, "FILE", "the file to write, which must not exist").required();
  return a.runs(run);
}

}  // namespace liecheck::properties
