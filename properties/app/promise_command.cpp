#include <fmt/format.h>
#include <algorithm>
#include <app/campaign_run.hpp>
#include <app/command.hpp>
#include <campaign/cliffs.hpp>
#include <campaign/needs.hpp>
#include <filesystem>
#include <search/hunt.hpp>
#include <set>
#include <stdexcept>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

/// A limit is this many times the largest error found.
constexpr double slack = 2;

struct PromiseFlags {
  std::string subject, out;
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

/// Adds what a search finds on one series: each operation gets its share of as many evaluations as the series
/// had cases.
void hunt_on(const Series& series, std::uint64_t cases, std::uint64_t seed, Needs& needs) {
  std::set<std::string> operations;
  for (std::size_t i = 0; i < series.outputs.size(); ++i)
    if (series.due >> i & 1) operations.emplace(series.outputs[i].operation);
  for (const std::string& operation : operations) {
    HuntOptions o;
    o.operation = operation, o.seed = seed;
    o.evaluations = std::max<std::uint64_t>(1, cases / operations.size());
    for (const Worst& w : hunt(series, o).worst) {
      const Judged& j = w.broken ? w.first_broken : w.judged;
      if (!j.budget) continue;
      const bool forward = j.budget->rule == Rule::forward;
      Need& need =
          needs[{j.budget->operation, j.budget->block, j.budget->region, forward ? "forward" : "excess"}];
      if (w.broken) need.worst = w.first_broken_id.text();
      need.largest = std::max(need.largest, w.score), need.broken += w.broken;
    }
  }
}

/// What no limit can promise: comments of the file. An error without a right digit is taken from the needs.
std::string not_promised(const CampaignResult& r, Needs& needs) {
  double eps = 1;
  for (const auto& [series, tally] : r.series) eps = std::min(eps, series->eps);
  std::string text;
  std::erase_if(needs, [&](const auto& entry) {
    const auto& [key, need] = entry;
    const bool none = need.largest * eps >= 1;
    if (none)
      text += fmt::format("# not promised, no digit is right: {}, {}, {}\n", key.operation, key.block,
                          key.region);
    return none;
  });
  for (const auto& [key, need] : needs)
    if (need.broken)
      text += fmt::format(
          "# not promised: {}, {}, {}: {} results are not finite, on a wrong branch, refused or not "
          "repeatable: "
          "liecheck replay {}\n",
          key.operation, key.block, key.region, need.broken, need.worst);
  for (const auto& [series, tally] : r.series)
    for (const Cliff& c : cliffs_of(*series, tally))
      text += fmt::format("# not promised, a cliff: {}, {}\n", series->scalar, text_of(*series, c));
  return text;
}

int run(const PromiseFlags& f) {
  if (std::filesystem::exists(f.out))
    throw std::invalid_argument(fmt::format("--out: '{}' exists: give another name, or remove it", f.out));
  check_writable(f.out);
  CampaignOptions o = f.cases.options;
  const std::string subject = subject_of(f);
  o.selection = {{subject}, {}, f.scalars};
  o.selection.profiles[""] = Profile::careful;
  o.every_kappa = true;
  const Robot robot = f.cases.robot.read();
  if (select(o.selection, robot).empty())
    throw std::invalid_argument(fmt::format("{} offers no property in these scalars", subject));
  stop_on_signals();
  const CampaignResult r = run_campaign(o, robot);
  Needs needs = needs_of(r)[subject];
  Progress line("hunt", o.quiet);
  for (std::size_t i = 0; i < r.series.size() && !stop_requested; ++i) {
    line.show(static_cast<double>(i) / static_cast<double>(r.series.size()),
              [&](double) { return r.series[i].series->property; });
    hunt_on(*r.series[i].series, r.series[i].tally.cases, o.seed, needs);
  }
  if (stop_requested) {
    std::fputs("interrupted: no file was written\n", stderr);
    return incomplete;
  }
  const std::string broken = not_promised(r, needs),
                    from = fmt::format("{:g} times the largest error found", slack),
                    in = fmt::format("{} cases of all laws (seed {}) and a hunt of as many", r.total_cases,
                                     o.seed);
  const std::string text = fmt::format(
      "# What {0} promises, written by liecheck promise from {1}.\nversion = 2\nsubject = {0}\nprofile = "
      "careful\n\n"
      "{2}{3}[limits]\n{4}",
      subject, in, broken, broken.empty() ? "" : "\n", limit_lines(needs, slack, from));
  const SubjectLimits written = parse_limits(f.out, text);
  write_whole(f.out, text);
  say("{}{}: {} limits of {} in {}\n", broken, f.out, written.lines.size(), from, in);
  return broken.empty() ? within_budget : property_failed;
}

}  // namespace

Command promise_command(CLI::App& program) {
  CommandWith<PromiseFlags> a(
      program, "promise",
      "write a first limits file: twice the largest error of each operation and block in a "
      "campaign and a hunt. Exit code 0 if every result can be promised; 1 if some are NaN, on "
      "a wrong branch or a cliff, which the file names; 2 for bad input; 3 if stopped, without a file");
  a.text("SUBJECT", a->subject, "", "the subject; default: that of the adapter");
  a->adapters.add(a);
  a.list("--scalar", a->scalars, "SCALAR", "float or double, repeatable; default all it has");
  a->cases.add(a);
  a.text("--out", a->out, "FILE", "the file to write, which must not exist").required();
  return a.runs(run);
}

}  // namespace liecheck::properties
