#include <app/command.hpp>

#include <fmt/format.h>
#include <unistd.h>
#include <adapters/asked.hpp>
#include <adapters/check.hpp>
#include <adapters/child.hpp>
#include <adapters/subjects.hpp>

#include <algorithm>
#include <atomic>
#include <campaign/campaign.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <csignal>
#include <ctime>
#include <exception>
#include <optional>
#include <support/files.hpp>
#include <support/json.hpp>
#include <support/progress.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

extern "C" void on_signal(int number) {
  if (!Unfinished::any()) {
    constexpr char said[] = "interrupted\n";
    [[maybe_unused]] const auto written = ::write(2, said, sizeof said - 1);
    adapters::kill_children();
    ::_exit(incomplete);
  }
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  const long now = t.tv_sec * 1000 + t.tv_nsec / 1000000;
  long first = 0;
  if (signalled_at.compare_exchange_strong(first, now)) {
    if (tells_what_it_waits_for) ::alarm(1);
  } else if (now - first > 300) {
    adapters::kill_children();
    std::signal(number, SIG_DFL), std::raise(number);
  }
  stop_requested = true;
}

}  // namespace

Flag RobotFlags::add(Arguments& a, const std::string& help) {
  const Flag robot = a.text("--robot", file, "URDF", help);
  a.choice("--root", root, {"free-flyer", "fixed"}, "ROOT", "root joint of the robot: free-flyer or fixed")
      .with_default_in_help()
      .needs(robot);
  return robot;
}

Robot RobotFlags::read() const {
  if (file.empty()) return built_in_robot();
  std::vector<std::string> warnings;
  Robot robot = load_robot(file, root == "fixed", &warnings);
  print_warnings(warnings);
  return robot;
}

std::vector<Flag> SelectionFlags::add(Arguments& a) {
  const Flag subject =
      a.list("--subject", subjects, "NAME",
             "a library under test, as 'liecheck list' names it, repeatable, or 'all'; default liecheck");
  std::vector<Flag> all{subject, adapters.add(a)};
  for (const Flag& flag : add_laws(a)) all.push_back(flag);
  return all;
}

std::vector<Flag> SelectionFlags::add_laws(Arguments& a) {
  std::vector<Flag> all{a.list("--property", properties, "NAME",
                               "a law, as 'liecheck list' names it, repeatable; default every one"),
                        a.list("--scalar", scalars, "SCALAR", "float or double, repeatable; default both")};
  for (const Flag& flag : limits.add(a)) all.push_back(flag);
  all.push_back(a.json(json, "write the record to FILE"));
  return all;
}

Flag AdapterFlags::add(Arguments& a) {
  return a.list("--adapter", adapters, "ADAPTER",
                "a library from outside: a command, or a shared library (docs/start.md), repeatable");
}

std::vector<std::string> AdapterFlags::start() const {
  std::vector<std::string> names;
  for (const std::string& adapter : adapters) names.push_back(adapters::register_adapter(adapter));
  return names;
}

namespace {

/// Adds what differs in one adapter, and withholds the operations that it concerns.
void withhold(const std::string& text, bool quiet, Differences& all) try {
  std::vector<std::string> unexplained, withheld;
  std::optional<Steps> probed(std::in_place, "probing " + text);
  const auto adapter = adapters::start(text);
  if (const auto* d = adapters::description_of(text))
    if (const std::string how = adapters::changed(*d, adapter->description()); !how.empty())
      throw std::invalid_argument(fmt::format("--adapter: '{}': {}", printable(text), how));
  const adapters::Checked checked = adapters::check(*adapter);
  probed.reset();
  for (const conventions::Finding& found : checked.findings) {
    const bool wrong = !found.named && !found.choice && found.operations.size() == 1;
    if (found.named) withheld.insert(withheld.end(), found.operations.begin(), found.operations.end());
    if (found.named || wrong)
      for (const std::string& o : found.operations)
        all.probed.push_back({adapter->description().name, o, found.sentence, wrong});
    if (!wrong && !found.usual)
      (found.named ? all.conventions : found.choice ? all.choices : unexplained).push_back(found.sentence);
  }
  for (const adapters::CheckedOperation& o : checked.operations)
    if (o.complaint.starts_with("the adapter states"))
      unexplained.push_back(fmt::format("{} in {}: {}", o.operation, o.scalar, o.complaint));
  if (!quiet) print_warnings(unexplained);
  if (!withheld.empty()) adapters::withhold(text, withheld);
} catch (const adapters::AdapterFailed& e) {
  if (!quiet) print_warnings({e.what()});
}

}  // namespace

Differences AdapterFlags::withhold_others(bool quiet) const {
  Differences all;
  for (const std::string& adapter : adapters) withhold(adapter, quiet, all);
  return all;
}

std::vector<std::string> AdapterFlags::outside(const Robot& robot) const {
  std::vector<std::string> all;
  for (const std::string& adapter : adapters) {
    const adapters::Description* const d = adapters::description_of(adapter);
    if (!d) continue;
    for (const std::string& sentence : adapters::refusals(*d)) all.push_back(sentence);
    if (robot.mimics && d->models.contains("urdf") && !d->models.contains("mimics"))
      all.push_back(fmt::format(
          "{} reads {} itself, which has mimic joints: they are independent joints here, and what "
          "differs is not judged. A reader that couples them states it: \"mimics\" in the list "
          "\"models\"",
          d->name, robot.name));
  }
  return all;
}

std::string text_of(const Differences& found, const std::vector<WrongCall>& wrong_calls, bool verbose) {
  std::string text;
  for (const WrongCall& call : wrong_calls)
    text += fmt::format("\nWRONG  {}: {}\n", call.subject, call.sentence);
  for (const std::string& sentence : found.conventions) text += fmt::format("\nNOT JUDGED  {}\n", sentence);
  std::vector<std::string> remarks = verbose ? found.choices : std::vector<std::string>();
  remarks.insert(remarks.end(), found.outside.begin(), found.outside.end());
  for (const std::string& sentence : remarks) text += fmt::format("\nremark  {}\n", sentence);
  return text;
}

std::string nothing_judged(const Differences& found) {
  return fmt::format(
      "nothing is judged: {}. Change it in the adapter, state it, or judge the library as it is with "
      "--no-probe",
      fmt::join(found.conventions, "; "));
}

void leave_out_withheld(Selection& selection, const Differences& found) {
  const auto known = subject_names();
  const bool any = !selection.subjects.empty();
  std::erase_if(selection.subjects, [&](const std::string& name) {
    return std::ranges::find(known, name) == known.end() &&
           std::ranges::any_of(found.probed, [&](const ProbedOperation& o) { return o.subject == name; });
  });
  if (any && selection.subjects.empty()) throw std::invalid_argument(nothing_judged(found));
}

void check_conventions(const std::string& text) {
  const Differences found = AdapterFlags{{text}}.withhold_others();
  for (const ProbedOperation& o : found.probed)
    if (o.wrong) print_warnings({o.sentence});
  if (!found.conventions.empty())
    throw std::invalid_argument(
        fmt::format("--adapter: '{}' has other conventions than liecheck: {}. Change them in the adapter",
                    text, fmt::join(found.conventions, "; ")));
}

std::vector<Flag> LimitsFlags::add(Arguments& a) {
  const Flag
      limits = a.list("--limits", files, "FILE",
                      "the limits that a subject promises, and its domain (docs/limits.md), repeatable"),
      judge = a.choice(
          "--profile", profile, profile_names(), "PROFILE",
          "the limits where --limits gives none: ours (what liecheck promises), careful (64 eps) or half "
          "(half of the digits); default careful for an --adapter and for the libraries of others, else "
          "ours");
  return {limits, judge};
}

Selection LimitsFlags::judging(Selection selection) const {
  for (const std::string& file : files)
    selection.limits.push_back(std::make_shared<const SubjectLimits>(read_limits(file)));
  if (const auto named = profile_named(profile)) selection.profiles[""] = *named;
  return selection;
}

Selection SelectionFlags::selection() const {
  const std::vector<std::string> given = adapters.start();
  Selection s = limits.judging({subjects, properties, scalars});
  if (subjects.empty()) {
    s.subjects = given.empty() ? std::vector<std::string>{"liecheck"} : given;
    if (scalars.empty()) s.scalars = {"float", "double"};
  } else if (std::erase(s.subjects, "all") > 0) {
    check_subjects(s.subjects);
    s.subjects.clear();
  }
  return s;
}

void handle_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(number, on_signal) == SIG_IGN) std::signal(number, SIG_IGN);
}

void stop_on_signals() {
  static const Unfinished results;
}

void warn(const std::string& lines) {
  std::fputs(printable_lines(lines).c_str(), stderr);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) warn(fmt::format("warning: {}\n", warning));
}

void do_both(const std::function<void()>& first, const std::function<void()>& second) {
  std::exception_ptr error;
  try {
    first();
  } catch (...) {
    error = std::current_exception();
  }
  second();
  if (error) std::rethrow_exception(error);
}

void write_record(const std::string& file, const nlohmann::json& record) {
  write_whole(file, dumped(record, 1) + "\n");
}

std::vector<std::string> without_repeats(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names)
    if (!std::ranges::count(all, name)) all.push_back(name);
  return all;
}

}  // namespace liecheck::properties
