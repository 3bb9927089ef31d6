// The command line. The only file that compiles CLI11.

#include <adapters/liecheck_adapter.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <adapters/adapter.hpp>
#include <algorithm>
#include <app/command.hpp>
#include <app/command_line.hpp>
#include <app/completion.hpp>
#include <app/programs.hpp>
#include <charconv>
#include <initializer_list>
#include <iostream>
#include <liecheck/text/from_chars.hpp>
#include <liecheck/text/utf8.hpp>
#include <rules/rules.hpp>
#include <stdexcept>
#include <support/files.hpp>
#include <support/text.hpp>
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
      fromChars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
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

using Options = std::vector<const CLI::Option*>;

bool names_files(const CLI::Option& o) {
  const std::string type = o.get_type_name();
  return type == "TEXT" || type == "URDF" || type == "SCENE" || type == "ADAPTER" || type.starts_with("FILE");
}

/// Throws std::invalid_argument if an output would replace a file that another argument names. Keeps the files of all
/// arguments that the command only reads.
void check_files(const CLI::App& command, const Options& outputs, const Options& updated) {
  for (const CLI::Option* o : command.get_options()) {
    if (!names_files(*o)) continue;
    for (const std::string& argument : o->results()) {
      for (const CLI::Option* output : outputs)
        for (const std::string& written : output->results())
          for (const std::string& file : files_named(argument))
            if (output != o && same_file(file, written))
              throw std::invalid_argument(
                  fmt::format("{} {}: would replace the file of {}: give it another name", output->get_name(),
                              written, o->get_name()));
      if (!std::ranges::count(outputs, o) && !std::ranges::count(updated, o))
        keep_files(argument, "the file of " + o->get_name());
    }
  }
  for (const CLI::Option* output : outputs)
    for (const std::string& file : output->results()) check_writable(file);
}

std::string long_name(const std::string& names) {
  return names.substr(names.rfind("--"));
}

/// Adds to `all` the commands of a program or of a group, as a shell completes them.
void describe(const CLI::App& parent, const std::string& group, std::vector<CompletedCommand>& all) {
  for (const CLI::App* c : parent.get_subcommands([](const CLI::App*) { return true; })) {
    const bool is_group = !c->get_subcommands([](const CLI::App*) { return true; }).empty();
    all.push_back({group, c->get_name(), c->get_description(), {}, is_group});
    if (is_group) {
      describe(*c, c->get_name(), all);
      continue;
    }
    for (const CLI::Option* o : c->get_options()) {
      if (o->get_positional() || o->get_group().empty()) continue;
      CompletedFlag flag{{}, o->get_description(), o->get_expected_max() > 0};
      for (const std::string& name : o->get_snames()) flag.names.push_back("-" + name);
      for (const std::string& name : o->get_lnames()) flag.names.push_back("--" + name);
      all.back().flags.push_back(flag);
    }
  }
}

/// The help of a program: a line for each command, under the headings; without exit codes, which the help of each
/// command has.
std::string help_of(const CLI::App& program, const std::string& name) {
  std::string text =
      fmt::format("{}\nUsage: {} COMMAND ...; '{} COMMAND --help' prints its flags and exit codes\n",
                  program.get_description(), name, name);
  std::string heading;
  for (const CLI::App* c : program.get_subcommands([](const CLI::App*) { return true; })) {
    if (c->get_group() != heading) text += (heading = c->get_group()) + "\n";
    text += fmt::format("  {:<14}{}\n", c->get_name(), brief(c->get_description()));
  }
  return text;
}

/// CLI11's message, or one that says that an option is given twice.
std::string given_twice(const CLI::ParseError& e) {
  const std::string text = e.what();
  const auto at = text.find(": At Most 1 required");
  return at == text.npos ? text : text.substr(0, at) + ": given more than once, perhaps by its other name";
}

/// CLI11's message, or one that names an unknown command or option.
std::string usage_error(const CLI::App& program, const CLI::ParseError& e) {
  const CLI::App* at = &program;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  const auto commands = at->get_subcommands([](const CLI::App*) { return true; });
  const auto rest = at->remaining();
  if (at != &program && dynamic_cast<const CLI::RequiredError*>(&e) && !rest.empty() &&
      rest[0].starts_with('-'))
    return fmt::format("{}: '{}' is none of its options; a file of this name is ./{}", at->get_name(),
                       rest[0], rest[0]);
  if (commands.empty() || (rest.empty() && (at == &program || at->get_require_subcommand_min() == 0)))
    return given_twice(e);
  std::vector<std::string> known;
  for (const CLI::App* command : commands) known.push_back(command->get_name());
  if (rest.empty()) return fmt::format("{}: which one? {}", at->get_name(), fmt::join(known, ", "));
  return fmt::format("unknown {} '{}'; commands{}: {}", rest[0].rfind('-', 0) == 0 ? "option" : "command",
                     rest[0], at == &program ? "" : " of " + at->get_name(), fmt::join(known, ", "));
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
  CLI::Option* const option = command_.add_option(names, target, help);
  if (names.starts_with('-'))
    option->allow_extra_args(false);  // a flag takes no argument that follows its value
  return named(option, value);
}

Flag Arguments::toggle(const std::string& names, bool& target, const std::string& help) {
  return Flag(command_.add_flag(names, target, help));
}

Flag Arguments::hidden_toggle(const std::string& names, bool& target) {
  return Flag(command_.add_flag(names, target)->group(""));
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
  target = std::max(1u, std::thread::hardware_concurrency());
  return number("-j,--jobs", target, 1, 1024, "number of threads; the digests do not depend on it");
}

Flag Arguments::outside(std::vector<std::string>& target) {
  return list("--read-outside", target, "DIR",
              "also let the scene name files in this folder, beside those in its own, repeatable");
}

Flag Arguments::output(const std::string& names, std::string& target, const std::string& value,
                       const std::string& help) {
  const Flag flag = text(names, target, value, help);
  outputs_.push_back(command_.get_option(names));
  return flag;
}

Flag Arguments::updated(const std::string& names, std::string& target, const std::string& value,
                        const std::string& help) {
  const Flag flag = text(names, target, value, help);
  updated_.push_back(command_.get_option(names));
  return flag;
}

Command Arguments::command(std::function<int()> run) const {
  return {&command_, [&command = command_, outputs = outputs_, updated = updated_, run = std::move(run)] {
            check_files(command, outputs, updated);
            return run();
          }};
}

std::string one_line(const std::string& message) {
  const std::string text = printable(message);
  std::string valid;
  for (std::size_t from = 0; from < text.size();) {
    const std::string_view rest = std::string_view(text).substr(from);
    const std::size_t good = firstInvalidUtf8(rest);
    valid += rest.substr(0, good);
    if (good < rest.size()) valid += fmt::format("\\x{:02x}", static_cast<unsigned char>(rest[good]));
    from += good + 1;
  }
  if (valid.size() <= 2000) return valid;
  const auto boundary = [&](std::size_t at) {
    while (at > 0 && (static_cast<unsigned char>(valid[at]) & 0xC0U) == 0x80) --at;
    return at;
  };
  const std::size_t first = boundary(1300), last = boundary(valid.size() - 600);
  return fmt::format("{} ... ({} bytes left out) ... {}", valid.substr(0, first), last - first,
                     valid.substr(last));
}

void Commands::add(std::initializer_list<Adder> commands) {
  for (const Adder& command : commands) {
    all_.push_back(command(program_));
    program_.get_subcommands([](const CLI::App*) { return true; }).back()->group(heading_);
  }
}

void Commands::add_group(const std::string& name, const std::string& help,
                         std::initializer_list<Adder> commands) {
  CLI::App& group = *program_.add_subcommand(name, help)->group(heading_);
  group.require_subcommand(1);
  for (const Adder& command : commands) all_.push_back(command(group));
}

void Commands::add_with(const std::string& name, const Adder& command, std::initializer_list<Adder> below) {
  const Command own = command(program_);  // after its subcommands: they set it as given, too
  CLI::App& group = *program_.get_subcommand(name)->group(heading_);
  for (const Adder& other : below) all_.push_back(other(group));
  all_.push_back(own);
}

/// Prints the script by which a shell completes the command line.
Command completion_command(CLI::App& program) {
  struct Flags {
    std::string shell;
    const CLI::App* program;
  };
  CommandWith<Flags> a(program, "completion",
                       "print the script by which a shell completes commands, flags and names. Exit code 0");
  a->program = &program;
  a.choice("SHELL", a->shell, {"bash", "zsh", "fish"}, "", "bash, zsh or fish").required();
  return a.runs(+[](const Flags& f) -> int {
    std::vector<CompletedCommand> all;
    describe(*f.program, "", all);
    std::cout << completion_script(f.program->get_name(), f.shell, all);
    return within_budget;
  });
}

struct CommandLine::Parts {
  CLI::App program;
  Commands commands{program};
};

CommandLine::CommandLine(const Program& p, const std::string& typed_line)
    : parts_(std::make_unique<Parts>()) {
  CLI::App& program = parts_->program;
  program.name(p.name);
  program.description(fmt::format("{} " LIECHECK_VERSION ": {}.", p.name, p.title));
  program.require_subcommand(1);
  program.set_version_flag("--version", [] {
    return fmt::format(LIECHECK_VERSION "\nrules {}\nC interface 1 to {}, process protocol {}",
                       known_rules().back().version, LIECHECK_ADAPTER_VERSION, adapters::protocol_version);
  });
  p.add_commands(parts_->commands, typed_line);
  program.formatter_fn([name = p.name](const CLI::App* a, const std::string&, CLI::AppFormatMode) {
    return help_of(*a, name);
  });
}
CommandLine::~CommandLine() = default;

std::optional<int> CommandLine::read(int argc, const char* const* argv) {
  try {
    parts_->program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return parts_->program.exit(e);
    throw std::invalid_argument(usage_error(parts_->program, e));
  }
  return std::nullopt;
}

int CommandLine::run() const {
  for (const Command& command : parts_->commands.all())
    if (command.arguments->parsed()) return command.run();
  throw std::invalid_argument("no command");
}

int run_program(const Program& program, int argc, char** argv, const std::string& typed_line) {
  CommandLine line(program, typed_line);
  if (const auto code = line.read(argc, argv)) return *code;
  return line.run();
}

}  // namespace liecheck::properties
