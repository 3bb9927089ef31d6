#include <app/lab.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <app/command.hpp>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <support/read_json.hpp>
#include <support/stop.hpp>
#include <system_error>

namespace liecheck::properties {

namespace {

namespace fs = std::filesystem;

constexpr std::array lab_subjects{"bug:", "alike:", "history:", "correct:"};

/// The commands that are in both programs.
constexpr std::array shared_commands{"campaign", "replay", "hard-cases", "hunt", "promise"};

/// Whether the arguments of such a command name a subject of the laboratory.
bool has_lab_subject(const std::vector<std::string>& arguments) {
  return std::ranges::any_of(arguments, [](const std::string& argument) {
    return std::ranges::any_of(lab_subjects, [&](const std::string& kind) {
      const auto at = argument.find(kind);
      return at == 0 || (at != argument.npos && std::strchr("=.", argument[at - 1]));
    });
  });
}

/// Whether a command computes in scalars wider than double, with which only the laboratory is compiled: a comparison of
/// integrators, or times in such a scalar.
bool is_wide(const std::vector<std::string>& words) {
  if (words[0] == "scene") return words.size() > 1 && words[1] == "sweep";
  constexpr std::array wide{"float128", "double-double", "digits50", "digits100"};
  return words[0] == "cost" && std::ranges::any_of(words, [&](const std::string& word) {
           return std::ranges::any_of(wide, [&](const char* scalar) { return word.ends_with(scalar); });
         });
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  return argv;
}

}  // namespace

std::string lab_program() {
  std::error_code error;
  const fs::path own = fs::read_symlink("/proc/self/exe", error);
  const fs::path lab = own.parent_path() / "liecheck-lab";
  return !error && ::access(lab.c_str(), X_OK) == 0 ? lab.string() : "";
}

std::optional<int> run_in_lab(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty()) return std::nullopt;
  const std::string command = words.front();
  if (command == "lab")
    words.erase(words.begin());
  else if (!is_wide(words) && (!std::ranges::count(shared_commands, command) || !has_lab_subject(words)))
    return std::nullopt;
  const std::string lab = lab_program();
  if (!lab.empty()) {
    words.insert(words.begin(), lab);
    ::execv(lab.c_str(), pointers(words).data());
  }
  std::fprintf(
      stderr,
      "liecheck: the laboratory, liecheck-lab, is not beside this program: in the repository, 'cmake "
      "--build build/release --target liecheck-lab' builds it\n");
  return bad_input;
}

nlohmann::json record_of_lab(std::vector<std::string> words, const std::string& file) {
  words.insert(words.begin(), lab_program());
  words.insert(words.end(), {"--json", file});
  const std::vector<char*> argv = pointers(words);
  const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  const pid_t parent = ::getpid(), id = ::fork();
  if (id < 0) throw std::system_error(errno, std::generic_category(), words.front());
  if (id == 0) {  // only calls that are allowed between fork and exec
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent || ::dup2(nothing, STDOUT_FILENO) < 0) ::_exit(126);
    ::execv(argv.front(), argv.data());
    ::_exit(126);
  }
  ::close(nothing);
  int status = 0;
  constexpr int patience = 40;  // looks, after which the laboratory is ended, which may be within a long step
  int told = 0;
  for (pid_t ended = 0; ended != id;) {
    ended = ::waitpid(id, &status, WNOHANG);
    if (ended < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), words.front());
    if (ended == id) break;
    if (stop_requested && told <= patience)
      if (const int before = told++; before == 0 || before == patience)
        ::kill(id, before == 0 ? SIGTERM : SIGKILL);
    ::usleep(20'000);
  }
  nlohmann::json record;
  if (fs::exists(file)) {
    record = read_json(file);
    fs::remove(file);
  }
  return record;
}

namespace {

/// A command that run_in_lab() runs: named here for the list of commands.
Command passed_on(CLI::App& program, const char* name, const char* help) {
  struct Flags {};
  return CommandWith<Flags>(program, name, help).runs(+[](const Flags&) -> int {
    throw std::logic_error("the laboratory runs this command");
  });
}

}  // namespace

Command lab_command(CLI::App& program) {
  return passed_on(program, "lab",
                   "what measures liecheck itself: 'liecheck lab --help'. Exit code of liecheck-lab; 2 if "
                   "it is not built");
}

Command lab_scene_sweep_command(CLI::App& scene) {
  return passed_on(
      scene, "sweep",
      "compare integrators with exact motions, in the laboratory. Exit code of liecheck-lab; 2 if it "
      "is not built");
}

}  // namespace liecheck::properties
