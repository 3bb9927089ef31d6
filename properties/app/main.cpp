// The liecheck program: it reads the command line and runs one command.

#include <fcntl.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <app/command.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <initializer_list>
#include <iostream>
#include <support/text.hpp>

namespace {

using namespace liecheck::properties;

/// Adds a group of commands.
CLI::App& group(CLI::App& program, const std::string& name, const std::string& help) {
  CLI::App& g = *program.add_subcommand(name, help);
  g.require_subcommand(1);
  return g;
}

/// Adds all commands, in the order of the help.
std::vector<Command> add_commands(CLI::App& program, const std::string& typed_line) {
  std::vector<Command> all;
  using Adder = std::function<Command(CLI::App&)>;
  const auto add = [&](CLI::App& parent, std::initializer_list<Adder> commands) {
    for (const Adder& command : commands) all.push_back(command(parent));
  };
  const auto campaign = [&](CLI::App& parent) { return campaign_command(parent, typed_line); };
  add(program, {list_command, campaign, hard_cases_command, hunt_command});
  add(group(program, "bench", "benchmarks of the harness"), {bench_bugs_command, bench_speed_command});
  add(program, {sweep_command, robot_command, cost_command});
  add(group(program, "scene", "simulate a motion that a file describes: fixtures/scenes/README.md"),
      {scene_run_command, scene_explain_command, scene_sweep_command, scene_keys_command});
  add(program, {replay_command, report_command, merge_command, export_command, compare_command});
  return all;
}

/// CLI11's message, or one that names an unknown command or option.
std::string usage_error(const CLI::App& program, const CLI::ParseError& e) {
  const CLI::App* at = &program;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  const auto commands = at->get_subcommands([](const CLI::App*) { return true; });
  const auto rest = at->remaining();
  if (commands.empty() || (rest.empty() && at == &program)) return e.what();
  std::vector<std::string> known;
  for (const CLI::App* command : commands) known.push_back(command->get_name());
  if (rest.empty()) return fmt::format("{}: which one? {}", at->get_name(), fmt::join(known, ", "));
  return fmt::format("unknown {} '{}'; commands{}: {}", rest[0].rfind('-', 0) == 0 ? "option" : "command",
                     rest[0], at == &program ? "" : " of " + at->get_name(), fmt::join(known, ", "));
}

/// The command line, with each argument quoted if a shell needs it.
std::string command_line(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) line += (i ? " " : "") + shell_quoted(argv[i]);
  return line;
}

/// Flushes standard output. Returns `code`, or bad_input if output was lost.
int finish(int code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.flush()) return code;
  // Not fmt::print, which throws if stderr is lost, too.
  std::fprintf(stderr, "liecheck: standard output: cannot be written%s%s\n", errno ? ": " : "",
               errno ? std::strerror(errno) : "");
  return bad_input;
}

int refuse(const std::string& why) {
  std::fprintf(stderr, "liecheck: %s\n", printable(why).c_str());
  return finish(bad_input);
}

}  // namespace

int main(int argc, char** argv) {
  // After this, writing to a closed pipe or beyond a file size limit fails, but does not end the program.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  // Replaces closed standard streams, so that no file that is opened later takes their place.
  for (int fd = 0; fd < 3; ++fd)
    if (::fcntl(fd, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) != fd) return bad_input;
  CLI::App program{"liecheck " LIECHECK_VERSION
                   ": finds the numerical bugs in SE(3) and floating-base code before a robot does."};
  program.require_subcommand(1);
  program.set_version_flag("--version", LIECHECK_VERSION);
  const std::vector<Command> commands = add_commands(program, command_line(argc, argv));
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return e.get_exit_code() == 0 ? finish(program.exit(e)) : refuse(usage_error(program, e));
  }
  try {
    for (const Command& command : commands)
      if (command.arguments->parsed()) return finish(command.run());
    return refuse("no command");
  } catch (const std::exception& e) {
    return std::ferror(stdout) ? finish(bad_input) : refuse(e.what());
  }
}
