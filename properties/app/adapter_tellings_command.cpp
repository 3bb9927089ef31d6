#include <fmt/format.h>
#include <adapters/subjects.hpp>
#include <app/command.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <support/files.hpp>
#include <support/folder.hpp>
#include <support/say.hpp>
#include <tellings/cells.hpp>

namespace liecheck::properties {

namespace {

struct AdapterTellingsFlags {
  std::string adapter, out;
  RobotFlags robot;
  bool all = false;
  league::MeasureOptions options;
};

/// A reader that is right loses some digits to rounding; one that is wrong loses more than half of them, or gives nothing.
bool differs(const nlohmann::json& cell) {
  return cell["grade"] == "D" || cell["grade"] == "F";
}

int tell(const AdapterTellingsFlags& f) {
  const Robot robot = f.robot.read();
  const std::string subject = f.adapter.empty() ? "liecheck" : adapters::register_adapter(f.adapter);
  if (!f.out.empty()) {
    make_folder("--out", f.out);
    const auto all = league::tellings(robot);
    for (const league::Telling& t : all) file_in(f.out, t.name + ".urdf");
    for (const league::Telling& t : all) write_whole(file_in(f.out, t.name + ".urdf"), t.urdf);
  }
  bool any = false;
  std::string details;
  say("{:<22}{:<7}{:>12}{:>8}{:>8}  {:<10}{}\n", "telling", "grade", "worst [eps]", "cases", "failed",
      "reader", "what it tells otherwise");
  for (const auto& [telling, cell] : league::measure_tellings(subject, robot, f.options)) {
    const bool wrong = differs(cell);
    any = any || wrong;
    say("{:<22}{:<7}{:>12}{:>8}{:>8}  {:<10}{}\n", telling.name, cell["grade"].get<std::string>(),
        cell["worst_eps"].is_number() ? fmt::format("{:.3g}", cell["worst_eps"].get<double>()) : "inf",
        cell["cases"].get<std::uint64_t>(), cell["failed"].get<std::uint64_t>(), wrong ? "DIFFERS" : "agrees",
        telling.how);
    if (wrong && cell["failure"].is_object())
      details += fmt::format("\n{}: {}\n", telling.name, cell["failure"]["text"].get<std::string>());
  }
  if (f.all) say("{}", details);
  return any ? property_failed : within_budget;
}

}  // namespace

Command adapter_tellings_command(CLI::App& adapter) {
  CommandWith<AdapterTellingsFlags> a(
      adapter, "tellings",
      "tell a robot in up to twelve equivalent ways, and compare what a URDF reader makes of each "
      "with its exact motion. "
      "Exit code 0; 1 if a telling differs; 2 for bad input");
  a.text("--adapter", a->adapter, "ADAPTER", "the reader, as a campaign takes it; default: liecheck's own");
  a->robot.add(a, "the robot; default: the built-in mixed_joints");
  a.text("--out", a->out, "DIR", "write the tellings, a URDF each");
  a.toggle("--all", a->all, "print the worst case of each telling that differs");
  a->options.cases = league::most_told_cases;
  a.number("--cases", a->options.cases, 1, league::most_told_cases, "cases of each law; at most 20");
  a.seed(a->options.seed, "seed of the cases");
  a.jobs(a->options.jobs);
  return a.runs(tell);
}

}  // namespace liecheck::properties
