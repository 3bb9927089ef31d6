#include <fmt/format.h>
#include <adapters/adapter.hpp>
#include <adapters/exchange.hpp>
#include <adapters/subjects.hpp>
#include <algorithm>
#include <app/command.hpp>
#include <cmath>
#include <environments/build.hpp>
#include <environments/measure.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <support/environment.hpp>
#include <support/files.hpp>
#include <support/json_number.hpp>
#include <support/names.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

using namespace environments;
using nlohmann::json;
using Table = std::map<std::pair<std::string, std::string>, Figures>;

struct EnvironmentsFlags {
  std::vector<std::string> subjects, only;
  std::string source, compile, link, folder, json;
  MeasureOptions options;
  bool all = false, no_hard_cases = false;
};

/// A subject that is measured: in this program, or by its adapter.
struct Tested {
  std::string name;
  Profile profile = Profile::careful;
  bool linked = false, has_source = false;
  std::string linked_name, adapter_name;  ///< of the registered subjects; "" until it is registered
};

constexpr const char* promises[] = {"same", "four times the limits", "flushed", "none"};

Figures sum_of(const Table& table) {
  Figures sum;
  for (const auto& [key, f] : table) sum.add(f);
  return sum;
}

/// 99.9 % is never shown as 100 %.
std::string share(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "-";
  if (part == whole) return "100 %";
  return fmt::format("{:.1f} %",
                     std::floor(1000.0 * static_cast<double>(part) / static_cast<double>(whole)) / 10);
}

void print_header() {
  say("{:<18} {:<17}{:>7}{:>11}{:>11}{:>8}{:>12}{:>8}  {}\n", "subject", "environment", "checks", "same bits",
      "verdicts", "worse", "of limit", "digits", "of");
}

void print_row(const std::string& subject, const std::string& name, const std::string& of, const Figures& f) {
  say("{:<18} {:<17}{:>7}{:>11}{:>11}{:>8}{:>12.3g}{:>8.1f}  {}\n", subject, name, f.cases,
      share(f.same_calls, f.calls), share(f.same_verdicts, f.cases), f.worse, f.of_limit, f.digits_lost, of);
}

json json_of(const Figures& f) {
  return {{"checks", f.cases},
          {"calls", f.calls},
          {"same_calls", f.same_calls},
          {"same_verdicts", f.same_verdicts},
          {"not_judged", f.small},
          {"worse", f.worse},
          {"not_finite", f.not_finite},
          {"wrong_branch", f.wrong_branch},
          {"refused", f.refused},
          {"of_limit", number(f.of_limit)},
          {"digits_lost", number(f.digits_lost)},
          {"block", f.block},
          {"worst", f.worst}};
}

class Run {
 public:
  explicit Run(const EnvironmentsFlags& f) : flags_(f), environments_(chosen(f.only)) {
    if (std::ranges::any_of(environments_, [](const Environment& e) { return !e.mode; }) ||
        !f.subjects.empty() || !f.source.empty()) {
      try {
        sources_ = Sources::of_build_tree();
      } catch (const std::runtime_error& e) {
        no_sources_ = e.what();
      }
    }
    folder_ = f.folder.empty() ? default_folder() : f.folder;
    if (!f.folder.empty()) check_folder(f.folder);
    std::vector<std::string> names = without_repeats(f.subjects);
    if (!f.source.empty())
      names.push_back(add_source(f));
    else if (!f.compile.empty() || !f.link.empty())
      throw std::invalid_argument("--compile and --link need --source");
    if (names.empty()) names = {"liecheck"};
    const auto linked = subject_names();
    for (const std::string& name : names) {
      Tested t;
      t.name = name;
      t.profile = name == "liecheck" ? Profile::ours : Profile::careful;
      t.linked = std::ranges::count(linked, name) > 0, t.has_source = sources_.adapters.contains(name);
      t.linked_name = t.linked ? name : "";
      if (!t.linked && !t.has_source) unknown(name);
      subjects_.push_back(t);
    }
    if (subjects_.size() > adapters::most_adapters)
      throw std::invalid_argument(fmt::format("--subject: more than {} subjects", adapters::most_adapters));
  }

  int all() {
    say("{}\nThis program rounds to nearest and keeps subnormal numbers; subjects are compared with {}.\n\n",
        environment_line(), "its own build of them");
    print_header();
    for (Tested& t : subjects_) {
      if (stop_requested) break;
      measure_all(t);
    }
    for (const Environment& e : environments_)
      if (const std::string why = missing(e); !why.empty()) {
        say("absent: {} ({}): {}\n", e.name, e.what, why);
        absent_.push_back({{"environment", e.name}, {"what", e.what}, {"why", why}});
        complete_ = complete_ && flags_.only.empty();  // it was asked for
      }
    for (const std::string& line : lines_) say("{}\n", line);
    const int code = stop_requested || !complete_ || rows_.empty() ? incomplete : within_budget;
    const int result = broken_ > 0 ? property_failed : code;
    say("\n{}\n",
        result == property_failed
            ? fmt::format("{} of {} environments x subjects break what is expected of them", broken_,
                          measured_)
        : stop_requested ? "interrupted"
        : result == incomplete
            ? "incomplete: something that was asked for is absent or not built, or no check passes"
            : fmt::format("in all {} environments x subjects, no check is worse than expected", measured_));
    if (!flags_.json.empty())
      write_record(flags_.json, {{"environments", 1},
                                 {"version", LIECHECK_VERSION},
                                 {"verdict", result == within_budget     ? "pass"
                                             : result == property_failed ? "fail"
                                                                         : "incomplete"},
                                 {"environment", environment()},
                                 {"seed", flags_.options.seed},
                                 {"cases", flags_.options.cases},
                                 {"own", own_},
                                 {"rows", rows_},
                                 {"absent", absent_},
                                 {"not_built", not_built_}});
    return result;
  }

 private:
  static std::string default_folder() {
    return (std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "environments")
        .string();
  }
  static void check_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder, error))
      throw std::invalid_argument(fmt::format("--dir: {}: cannot be a folder: {}", folder, error.message()));
    try {
      check_writable(std::filesystem::path(folder) / "new");
    } catch (const std::runtime_error& e) {
      throw std::invalid_argument(fmt::format("--dir: {}", e.what()));
    }
  }
  static std::vector<Environment> chosen(const std::vector<std::string>& only) {
    if (only.empty()) return environments::all();
    check_known(only, names_of(environments::all(), &Environment::name), "--only", "environment");
    std::vector<Environment> some;
    for (const std::string& name : without_repeats(only))
      some.push_back(*std::ranges::find(environments::all(), name, &Environment::name));
    return some;
  }
  std::string add_source(const EnvironmentsFlags& f) {
    if (!no_sources_.empty()) throw std::invalid_argument("--source: " + no_sources_);
    try {
      const std::string name = std::filesystem::path(f.source).stem().string();
      if (std::ranges::count(subject_names(), name))
        throw std::invalid_argument(fmt::format("{}: a subject is named '{}' already", f.source, name));
      return sources_.add(f.source, f.compile, f.link);
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument(std::string("--source: ") + e.what());
    }
  }
  [[noreturn]] void unknown(const std::string& name) const {
    if (!no_sources_.empty())
      throw std::invalid_argument(
          fmt::format("--subject: '{}' is no subject of the program, and {}", name, no_sources_));
    std::string known;
    for (const auto& [other, source] : sources_.adapters) known += (known.empty() ? "" : ", ") + other;
    throw std::invalid_argument(
        fmt::format("--subject: unknown subject '{}'; those with an adapter in one source file: {}; "
                    "'liecheck list' shows those "
                    "of the program, which are called in other modes only",
                    name, known));
  }

  void measure_all(Tested& t) {
    std::optional<Measured> before;
    std::string own_library;
    try {
      if (!t.linked) {
        own_library = built_for_program(sources_, t.name, folder_);
        forgetting(t, own_build, [&] { register_as(t, own_library); });
      }
      before = measured(t.linked ? t.linked_name : t.adapter_name, t, {}, "its own build");
    } catch (const std::exception& why) {
      if (!stop_requested) not_built(t, "this program", why.what());
    }
    if (!before) return;
    const bool safe = report_own(t, *before);
    const std::string& own = t.linked ? t.linked_name : t.adapter_name;
    for (const Environment& e : environments_) {
      if (stop_requested) return;
      if (!missing(e).empty()) continue;
      try {
        if (e.mode) {
          // Modes are set in this process, which code that ends or hangs would take along.
          if (!safe) throw std::runtime_error("it crashes or hangs in its own build");
          if (!t.linked) adapters::exchange_adapter(t.adapter_name, "in-process:" + own_library);
          report(t, e, *before, measured(own, t, *e.mode, e.name));
        } else if (t.has_source) {
          const std::string command = built(sources_, t.name, e, folder_);
          forgetting(t, e.name, [&] { register_as(t, command); });
          report(t, e, *before, measured(t.adapter_name, t, {}, e.name));
        }
      } catch (const std::exception& why) {  // not built, or not started
        if (!stop_requested) not_built(t, e.name, why.what());
      }
    }
    if (!t.has_source && std::ranges::any_of(environments_, [](const Environment& e) { return !e.mode; })) {
      // Whoever names the environments, or liecheck itself, expects a build.
      if (!no_sources_.empty() || !flags_.only.empty())
        not_built(t, "other environments",
                  no_sources_.empty() ? "it has no adapter in one source file" : no_sources_);
      else
        lines_.push_back(
            fmt::format("{} has no adapter in one source file: it is called in other modes only", t.name));
    }
  }

  /// If `start` fails, the next call builds again.
  template <class Start>
  void forgetting(const Tested& t, const std::string& environment, const Start& start) {
    try {
      start();
    } catch (const std::exception&) {
      forget(t.name, environment, folder_);
      throw;
    }
  }

  /// Says how many checks the subject's own build fails: they cannot become worse. Returns whether no call crashed.
  bool report_own(const Tested& t, const Measured& own) {
    std::uint64_t checks = 0, right = 0, crashed = 0;
    for (const Measured::Law& law : own.laws)
      for (const Case& c : law.cases)
        for (const Verdict& v : c.verdicts)
          ++checks, right += v.right(), crashed += v.outcome == Outcome::crashed;
    own_.push_back({{"subject", t.name}, {"checks", checks}, {"right", right}});
    if (right < checks)
      lines_.push_back(fmt::format(
          "{}: {} of {} checks fail or have no verdict in its own build; they are not counted as worse",
          t.name, checks - right, checks));
    if (right == 0) complete_ = false;
    return crashed == 0;
  }

  void not_built(const Tested& t, const std::string& environment, std::string why) {
    complete_ = false;
    why = printable(why);
    if (const std::string flag = "--adapter: "; why.starts_with(flag))
      why.erase(0, flag.size());  // a flag that the user did not give
    lines_.push_back(fmt::format("not measured: {} in {}: {}", t.name, environment, why));
    not_built_.push_back({{"subject", t.name}, {"environment", environment}, {"why", why}});
  }

  static void register_as(Tested& t, const std::string& text) {
    if (t.adapter_name.empty())
      t.adapter_name = adapters::register_adapter(text);
    else
      adapters::exchange_adapter(t.adapter_name, text);
  }

  std::optional<Measured> measured(const std::string& subject, const Tested& t, const FloatMode& mode,
                                   const std::string& where) {
    Progress progress("environments");
    MeasureOptions options = flags_.options;
    options.progress = [&](double share) { progress.show(share, t.name + " in " + where); };
    options.hard_cases = !flags_.no_hard_cases;
    return measure(subject, t.profile, mode, options);
  }

  void report(const Tested& t, const Environment& e, const Measured& before,
              const std::optional<Measured>& now) {
    if (!now) return;
    Table table = compared(before, *now, e.promise);
    const std::string other = "." + t.adapter_name + ".", own = "." + t.name + ".";
    for (auto& [key, f] : table)  // the name by which `replay` knows the subject
      if (const std::size_t at = f.worst.find(other);
          t.linked && !t.adapter_name.empty() && at != f.worst.npos)
        f.worst.replace(at, other.size(), own);
    const Figures sum = sum_of(table);
    const bool judged = e.promise != Promise::none;
    ++measured_, broken_ += judged && sum.worse > 0;
    print_row(t.name, e.name, judged ? "all operations" : "all operations; not judged", sum);
    json operations = json::array();
    for (const auto& [key, f] : table) {
      if (flags_.all || f.worse > 0) print_row("", "", fmt::format("{} in {}", key.first, key.second), f);
      operations.push_back({{"operation", key.first}, {"scalar", key.second}, {"figures", json_of(f)}});
    }
    std::fflush(stdout);
    rows_.push_back({{"subject", t.name},
                     {"environment", e.name},
                     {"what", e.what},
                     {"expected", promises[static_cast<int>(e.promise)]},
                     {"sum", json_of(sum)},
                     {"operations", operations}});
  }

  const EnvironmentsFlags& flags_;
  std::vector<Environment> environments_;
  Sources sources_;
  std::string no_sources_, folder_;
  std::vector<Tested> subjects_;
  std::vector<std::string> lines_;
  json own_ = json::array(), rows_ = json::array(), absent_ = json::array(), not_built_ = json::array();
  bool complete_ = true;
  int measured_ = 0, broken_ = 0;
};

int run(const EnvironmentsFlags& f) {
  Run run(f);
  stop_on_signals();
  return run.all();
}

}  // namespace

Command environments_command(CLI::App& program) {
  CommandWith<EnvironmentsFlags> a(
      program, "environments",
      "run the laws and the hard cases in other environments. A subject is called in other rounding modes or "
      "built with other compilers, flags and C libraries, and for other processors. Exit code 0 if no check "
      "is "
      "worse than expected in an environment that is judged; 1 if one is; 2 for bad input; 3 if stopped, not "
      "built, or absent and named by --only");
  a.list("--subject", a->subjects, "NAME",
         "a subject, repeatable; default liecheck. One with an adapter in one source file is built anew; "
         "others are "
         "called in other modes only");
  a.text("--source", a->source, "FILE",
         "your own adapter in C or C++, one source file, under the name of the file");
  a.text("--compile", a->compile, "FLAGS",
         "flags of the compiler for --source, as words of a shell, such as '-I/usr/include/mylib'");
  a.text("--link", a->link, "FLAGS", "libraries for --source, as words of a shell, such as '-lmylib'");
  a.list("--only", a->only, "NAME", "an environment, repeatable; default every one");
  a.number("--cases", a->options.cases, 1, 100'000, "cases of each law and scalar");
  a.toggle("--no-hard-cases", a->no_hard_cases, "leave out the hard cases");
  a.seed(a->options.seed, "seed of the cases");
  a.toggle("--all", a->all, "show every operation, not only those that are worse");
  a.text("--dir", a->folder, "DIR", "folder of the builds, which are kept; default: that of the build tree");
  a.jobs(a->options.jobs);
  a.json(a->json, "write the matrix to FILE");
  return a.runs(run);
}

}  // namespace liecheck::properties
