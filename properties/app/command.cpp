#include <app/command.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <charconv>
#include <csignal>
#include <ctime>
#include <nlohmann/json.hpp>
#include <support/files.hpp>
#include <support/stop.hpp>
#include <thread>

namespace liecheck::properties {

namespace {

/// Throws CLI::ValidationError naming the flag.
std::uint64_t decimal(const std::string& flag, const std::string& text, std::uint64_t low,
                      std::uint64_t high) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool plain =
      error == std::errc() && end == text.data() + text.size() && std::to_string(value) == text;
  if (!plain || value < low || value > high)
    throw CLI::ValidationError(flag,
                               fmt::format("'{}' is not a decimal number from {} to {}", text, low, high));
  return value;
}

/// Returns the duration in seconds. Throws CLI::ValidationError naming the flag.
double parse_duration(const std::string& flag, const std::string& text) {
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  const std::string unit(end, text.data() + text.size());
  const double factor = unit.empty() || unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
  if (error != std::errc() || factor == 0 || !(value > 0) || !(value * factor <= 1e7))
    throw CLI::ValidationError(flag,
                               fmt::format("not a duration up to 1e7 s: '{}' (write 30s, 5m or 1h)", text));
  return value * factor;
}

/// Names the option's value in the help, and forbids an empty value.
Flag named(CLI::Option* option, const std::string& value) {
  const auto empty_error = [](const std::string& text) -> std::string {
    return text.empty() ? "may not be empty" : "";
  };
  return Flag(value.empty() ? option : option->type_name(value)->check(empty_error, ""));
}

std::string long_name(const std::string& names) {
  return names.substr(names.rfind("--"));
}

extern "C" void on_signal(int number) {
  static std::atomic<long> stopped_at{-1};  // [ms]
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  const long now = t.tv_sec * 1000 + t.tv_nsec / 1000000;
  long first = -1;
  if (!stopped_at.compare_exchange_strong(first, now) && now - first > 300)
    std::signal(number, SIG_DFL), std::raise(number);
  stop_requested = true;
}

}  // namespace

Flag Flag::required() const {
  return Flag(option_->required());
}
Flag Flag::needs(Flag other) const {
  return Flag(option_->needs(other.option_));
}
Flag Flag::excludes(Flag other) const {
  return Flag(option_->excludes(other.option_));
}
Flag Flag::with_default_in_help() const {
  return Flag(option_->capture_default_str());
}
bool Flag::given() const {
  return option_ && option_->count() > 0;
}

Arguments::Arguments(CLI::App& parent, const std::string& name, const std::string& help)
    : command_(*parent.add_subcommand(name, help)) {}

Flag Arguments::text(const std::string& names, std::string& target, const std::string& value,
                     const std::string& help) {
  return named(command_.add_option(names, target, help), value);
}

Flag Arguments::choice(const std::string& names, std::string& target, const std::vector<std::string>& words,
                       const std::string& value, const std::string& help) {
  return named(command_.add_option(names, target, help)->check(CLI::IsMember(words)), value);
}

Flag Arguments::list(const std::string& names, std::vector<std::string>& target, const std::string& value,
                     const std::string& help) {
  return named(command_.add_option(names, target, help), value);
}

Flag Arguments::toggle(const std::string& names, bool& target, const std::string& help) {
  return Flag(command_.add_flag(names, target, help));
}

Flag Arguments::add_number(const std::string& names, std::uint64_t value, std::uint64_t low,
                           std::uint64_t high, const std::string& help,
                           const std::function<void(std::uint64_t)>& set) {
  const auto read = [set, flag = long_name(names), low, high](const std::string& text) {
    set(decimal(flag, text, low, high));
  };
  return Flag(command_.add_option_function<std::string>(names, read, help)
                  ->type_name("N")
                  ->default_str(value < low || value > high ? "" : std::to_string(value)));
}

Flag Arguments::numbers(const std::string& names, std::vector<long>& target, std::uint64_t low,
                        std::uint64_t high, const std::string& help) {
  const auto read = [&target, flag = long_name(names), low, high](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) target.push_back(static_cast<long>(decimal(flag, text, low, high)));
  };
  return Flag(command_.add_option_function<std::vector<std::string>>(names, read, help)
                  ->type_name("N")
                  ->allow_extra_args(false));
}

Flag Arguments::add_duration(const std::string& names, const std::string& help,
                             const std::function<void(double)>& set) {
  const auto read = [set, flag = long_name(names)](const std::string& text) {
    set(parse_duration(flag, text));
  };
  return named(command_.add_option_function<std::string>(names, read, help), "DURATION");
}

Flag Arguments::seed(std::uint64_t& target, const std::string& help) {
  return number("--seed", target, 0, UINT64_MAX, help);
}

Flag Arguments::jobs(unsigned& target) {
  return number("-j,--jobs", target, 1, 1024, "number of threads; the digests do not depend on it");
}

Flag Arguments::json(std::string& target, const std::string& help) {
  json_ = &target;
  return text("--json", target, "FILE", help);
}

Command Arguments::command(std::function<int()> run) const {
  return {&command_, [json = json_, run = std::move(run)] {
            if (json && !json->empty()) check_writable(*json);
            return run();
          }};
}

unsigned default_jobs() {
  return std::max(1u, std::thread::hardware_concurrency());
}

Flag RobotFlags::add(Arguments& a, const std::string& help) {
  const Flag robot = a.text("--robot", file, "URDF", help);
  a.choice("--root", root, {"free-flyer", "fixed"}, "ROOT", "root joint of the robot: free-flyer or fixed")
      .with_default_in_help()
      .needs(robot);
  return robot;
}

Robot RobotFlags::read() const {
  return file.empty() ? built_in_robot() : load_robot(file, root == "fixed");
}

void SelectionFlags::add(Arguments& a) {
  a.list("--subject", subjects, "NAME",
         "a subject, repeatable, or 'all'; default liecheck in float and double");
  a.list("--property", properties, "NAME", "a property, repeatable; default every one");
  a.list("--scalar", scalars, "SCALAR", "float, double or float128, repeatable");
  a.json(json, "write the record to FILE");
}

Selection SelectionFlags::selection() const {
  Selection s{subjects, properties, scalars};
  if (subjects.empty()) {
    s.subjects = {"liecheck"};
    if (scalars.empty()) s.scalars = {"float", "double"};
  } else if (std::erase(s.subjects, "all") > 0) {
    check_subjects(s.subjects);
    s.subjects.clear();
  }
  return s;
}

void stop_on_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(number, on_signal) == SIG_IGN) std::signal(number, SIG_IGN);
}

void write_record(const std::string& file, const nlohmann::json& record) {
  write_whole(file, record.dump(1) + "\n");
}

}  // namespace liecheck::properties
