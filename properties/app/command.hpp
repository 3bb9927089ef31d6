#pragma once
// The commands of the program, each in a file of its name. Flags, exit codes, signals and records, which the
// commands share, are declared here, too. This header hides CLI11, which takes five seconds to compile.

#include <cstdint>
#include <failures/wrong_calls.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace liecheck::properties {

struct CostOptions;
struct CostResult;
struct HardRow;
struct Robot;
struct Selection;

/// Exit codes of the program.
enum Exit { within_budget = 0, property_failed = 1, bad_input = 2, incomplete = 3 };

struct Command {
  const CLI::App* arguments;  ///< knows whether the command was given
  std::function<int()> run;   ///< returns the exit code
};

/// A flag or a positional argument of a command.
class Flag {
 public:
  explicit Flag(CLI::Option* option = nullptr) : option_(option) {}
  Flag required() const;
  Flag needs(Flag other) const;
  Flag excludes(Flag other) const;
  Flag with_default_in_help() const;
  bool given() const;  ///< whether the parsed command line has it

 private:
  CLI::Option* option_;
};

/// Adds a command to a program and flags to the command. A target is filled when the command line is parsed,
/// and must live until then. `value` names the value in the help; if it is "", an empty value is accepted.
/// Numbers are checked here, because CLI11 also reads octal and hexadecimal, "" as 0, and -1 as 2^64-1.
class Arguments {
 public:
  Arguments(CLI::App& parent, const std::string& name, const std::string& help);

  Flag text(const std::string& names, std::string& target, const std::string& value, const std::string& help);
  /// A value that must be one of `words`.
  Flag choice(const std::string& names, std::string& target, const std::vector<std::string>& words,
              const std::string& value, const std::string& help);
  /// A flag that may be repeated.
  Flag list(const std::string& names, std::vector<std::string>& target, const std::string& value,
            const std::string& help);
  Flag toggle(const std::string& names, bool& target, const std::string& help);
  /// A flag that the program passes to itself. The help does not show it.
  Flag hidden_toggle(const std::string& names, bool& target);

  /// A whole number in decimal digits, from low to high. The help shows its default if that is in this range.
  template <class T>
  Flag number(const std::string& names, T& target, std::uint64_t low, std::uint64_t high,
              const std::string& help) {
    return add_number(names, target, low, high, help,
                      [&target](std::uint64_t n) { target = static_cast<T>(n); });
  }
  /// Like number(), but the flag may be repeated: "--steps 4 --steps 8", not "--steps 4 8".
  Flag numbers(const std::string& names, std::vector<long>& target, std::uint64_t low, std::uint64_t high,
               const std::string& help);

  /// "30s", "5m", "1h" or plain seconds, up to 10^7 s. T is double or std::optional<double>.
  template <class T>
  Flag duration(const std::string& names, T& seconds, const std::string& help) {
    return add_duration(names, help, [&seconds](double s) { seconds = s; });
  }

  Flag seed(std::uint64_t& target, const std::string& help);
  /// The number of threads; by default one for each core.
  Flag jobs(unsigned& target);
  /// --read-outside, of the commands that read scenes.
  Flag outside(std::vector<std::string>& target);
  /// A file that the command writes. Before it runs, throws if the file cannot be written, or is one that another argument
  /// names. From then on, no file that is no output is replaced.
  Flag output(const std::string& names, std::string& target, const std::string& value,
              const std::string& help);
  /// A file that the command may read and write, such as a store.
  Flag updated(const std::string& names, std::string& target, const std::string& value,
               const std::string& help);
  /// --json, an output.
  Flag json(std::string& target, const std::string& help) { return output("--json", target, "FILE", help); }

  /// Returns the command, after its flags were added.
  Command command(std::function<int()> run) const;

 private:
  Flag add_number(const std::string& names, std::uint64_t value, std::uint64_t low, std::uint64_t high,
                  const std::string& help, const std::function<void(std::uint64_t)>& set);
  Flag add_duration(const std::string& names, const std::string& help,
                    const std::function<void(double)>& set);

  CLI::App& command_;
  std::vector<const CLI::Option*> outputs_, updated_;
};

/// The arguments of a command with flags, which live as long as the command.
template <class Flags>
class CommandWith : public Arguments {
 public:
  using Arguments::Arguments;
  Flags* operator->() const { return flags_.get(); }
  Command runs(int (*run)(const Flags&)) const {
    return command([run, flags = flags_] { return run(*flags); });
  }

 private:
  std::shared_ptr<Flags> flags_ = std::make_shared<Flags>();
};

/// --robot and --root.
struct RobotFlags {
  std::string file, root = "free-flyer";

  /// Adds both flags. Returns --robot.
  Flag add(Arguments& arguments,
           const std::string& help = "robot of the laws that need one; default: the built-in mixed_joints");
  /// Reads the file, which may be a pipe: call it once.
  Robot read() const;
};

/// --limits, which may be repeated, and --profile: what judges the subjects.
struct LimitsFlags {
  std::vector<std::string> files;
  std::string profile;

  /// Adds the flags and returns them.
  std::vector<Flag> add(Arguments& arguments);
  /// The selection with these limits and this profile. Reads the files, each once.
  Selection judging(Selection selection) const;
};

/// What a probe of adapters finds, a sentence each.
struct Differences {
  std::vector<std::string> conventions;  ///< others than liecheck's
  std::vector<std::string> choices;  ///< that the adapter does not state, and that are others than liecheck's
  std::vector<std::string> outside = {};  ///< what the adapter lacks, and what is therefore not judged
  std::vector<ProbedOperation> probed = {};  ///< those in another convention, and the wrong ones
};
/// What is wrong, and what is not judged, and the remarks, those on choices if `verbose`: an empty line before each.
std::string text_of(const Differences& found, const std::vector<WrongCall>& wrong_calls, bool verbose);

/// --adapter, which may be repeated.
struct AdapterFlags {
  std::vector<std::string> adapters;

  /// Adds the flag and returns it.
  Flag add(Arguments& arguments);
  /// Starts the adapters, so that their subjects are known, and returns the names of these.
  std::vector<std::string> start() const;
  /// The operations that a convention concerns in which an adapter differs are withheld, because nearly every case would
  /// fail. Warns of what an adapter states and does not do, unless `quiet`.
  Differences withhold_others(bool quiet = false) const;
  /// What is outside the domain of each adapter: what it refuses, and the mimics of a robot that it does not take.
  std::vector<std::string> outside(const Robot& robot) const;
};

/// Why no operation is judged: the conventions in which adapters differ, and what to do.
std::string nothing_judged(const Differences& found);
/// Leaves out the adapters of whose operations every one is withheld. Throws std::invalid_argument, with the conventions in
/// which they differ, if none is left.
void leave_out_withheld(Selection& selection, const Differences& found);

/// Throws std::invalid_argument with the conventions in which an adapter differs from liecheck.
void check_conventions(const std::string& adapter);

/// --subject, --adapter, --property, --scalar, --limits, --profile and --json.
struct SelectionFlags {
  std::vector<std::string> subjects, properties, scalars;
  AdapterFlags adapters;
  LimitsFlags limits;
  std::string json;

  /// Adds the flags and returns them.
  std::vector<Flag> add(Arguments& arguments);
  /// All but --subject and --adapter.
  std::vector<Flag> add_laws(Arguments& arguments);
  /// Starts the adapters. By default their subjects, or liecheck, in float and double; the subject "all" means
  /// all subjects.
  Selection selection() const;
};

/// Handles Ctrl-C, SIGTERM and SIGHUP as support/stop.hpp says. A second signal ends the program at once. Two
/// signals within 0.3 s are treated as one, because `timeout` sends its signal to the program and then to its
/// process group. A busy machine delays a signal by less than 0.3 s, and a user takes longer to press Ctrl-C
/// again. A signal that nohup ignores stays ignored.
void handle_signals();

/// From now on, a signal does not end the program but sets stop_requested: the command returns its results so
/// far. Call this after the input was read, because reading may wait for a pipe, and before anything is
/// written.
void stop_on_signals();

/// Prints lines on standard error. Unlike fmt::print, it does not throw if standard error is lost.
void warn(const std::string& lines);
/// Prints the warnings of a URDF as warn() does, a line each.
void print_warnings(const std::vector<std::string>& warnings);

/// Calls first() and then second(), even if first() throws; that error is thrown at the end. So a full disk
/// does not lose a table, and a closed terminal does not lose a record.
void do_both(const std::function<void()>& first, const std::function<void()>& second);

/// Throws std::runtime_error naming the file.
void write_record(const std::string& file, const nlohmann::json& record);

/// Writes the record of a result, or of a scene and its run, unless `file` is empty.
template <class... Results>
void write_record_of(const std::string& file, const Results&... results);

/// Prints the hard cases: counts for each subject and scalar, and the failures, each in full or a
/// line for each block and the worst in full.
void print_hard_case_summary(const std::vector<HardRow>& rows, bool in_full);

// The command `report` runs the next functions, too. They show progress, and stop at stop_requested.

/// Before anything runs, throws std::invalid_argument that names an unknown operation, subject or scalar.
CostResult run_cost(CostOptions options);
/// Adds the subjects of adapters, and the forms of add_forms() beside them if no other subject was selected.
void add_subjects(CostOptions& options, const std::vector<std::string>& adapters);
/// Adds the textbook and liecheck in each precision, in the operations that the subjects offer: what a formula can reach,
/// beside one library.
void add_forms(CostOptions& options);

// A command is added to a program or to a group of commands, such as "scene".

/// The names in their order, each once.
std::vector<std::string> without_repeats(const std::vector<std::string>& names);

Command list_command(CLI::App& program);
Command adapter_check_command(CLI::App& adapter);
Command adapter_serve_command(CLI::App& adapter);
Command adapter_tellings_command(CLI::App& adapter);
/// typed_line: the whole command line, quoted for a shell.
Command campaign_command(CLI::App& program, const std::string& typed_line);
/// The campaign of one adapter.
Command test_command(CLI::App& program, const std::string& typed_line);
Command hard_cases_command(CLI::App& program);
Command hunt_command(CLI::App& program);
Command promise_command(CLI::App& program);
Command environments_command(CLI::App& program);
Command robot_command(CLI::App& program);
Command cost_command(CLI::App& program);
Command scene_run_command(CLI::App& scene);
Command scene_explain_command(CLI::App& scene);
Command scene_keys_command(CLI::App& scene);
Command replay_command(CLI::App& program);
Command report_command(CLI::App& program);
Command merge_command(CLI::App& program);
Command export_command(CLI::App& program);
Command compare_command(CLI::App& program);
Command completion_command(CLI::App& program);
Command lab_command(CLI::App& program);
Command lab_scene_sweep_command(CLI::App& scene);

}  // namespace liecheck::properties
