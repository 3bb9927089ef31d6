#include <environments/build.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <support/files.hpp>
#include <support/json.hpp>
#include <support/read_json.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties::environments {

namespace {

namespace fs = std::filesystem;

/// Runs a shell command in a process group of its own. Returns its output, at most a megabyte of it, and whether it
/// succeeded. At stop_requested, or after the time, the group is killed.
std::pair<std::string, bool> ran(const std::string& command) {
  constexpr auto longest = std::chrono::minutes(15);
  const std::string line = "exec 2>&1\n" + command;  // the shell's own errors, too
  std::array<int, 2> out{};
  if (::pipe2(out.data(), O_CLOEXEC) != 0) return {"error: no process can be started", false};
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(s, SIG_DFL);
    if (::dup2(out[1], 1) == 1) ::execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(out[1]);
  std::string text, ended;
  const auto end = std::chrono::steady_clock::now() + longest;
  std::array<char, 1 << 14> part;
  while (pid > 0) {
    pollfd p{out[0], POLLIN, 0};
    const int ready = ::poll(&p, 1, 100);
    if (stop_requested) ended = "error: interrupted";
    if (std::chrono::steady_clock::now() > end) ended = "error: it takes more than 15 minutes";
    if (!ended.empty()) break;
    if (ready <= 0) continue;
    const ssize_t n = ::read(out[0], part.data(), part.size());
    if (n <= 0) break;
    if (text.size() < 1 << 20) text.append(part.data(), static_cast<std::size_t>(n));
  }
  ::close(out[0]);
  int status = -1;
  if (pid > 0) {
    if (!ended.empty()) ::kill(-pid, SIGKILL);
    ::waitpid(pid, &status, 0);
  }
  if (!ended.empty()) return {ended, false};
  return {text, pid > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0};
}

std::string first_error(const std::string& output) {
  std::istringstream lines(output);
  std::string first;
  for (std::string line; std::getline(lines, line);) {
    if (first.empty()) first = line;
    for (const char* sign : {"error", "Error", "undefined reference", "cannot find", "Cannot find"})
      if (line.find(sign) != line.npos) return line;
  }
  return first.empty() ? "the compiler failed" : first;
}

/// At most the first 300 bytes of a line, with whole letters of UTF-8.
std::string short_line(const std::string& line) {
  std::size_t end = 300;
  if (line.size() <= end) return line;
  while ((static_cast<unsigned char>(line[end]) & 0xC0) == 0x80) --end;
  return line.substr(0, end) + "...";
}

/// The files of a rule of make: those after the first colon that a space follows. A backslash precedes a space in a name,
/// and the end of a line that goes on.
std::vector<std::string> sources_in(const std::string& rule) {
  std::vector<std::string> all;
  const std::size_t colon = rule.find(": ");
  std::string word;
  for (std::size_t i = colon == rule.npos ? rule.size() : colon + 2; i <= rule.size(); ++i) {
    const char c = i < rule.size() ? rule[i] : '\n', next = i + 1 < rule.size() ? rule[i + 1] : '\n';
    if (c == '\\' && next == ' ') {
      word += ' ', ++i;
    } else if (c == ' ' || c == '\n' || (c == '\\' && next == '\n')) {
      if (!word.empty()) all.push_back(word);
      word.clear();
    } else {
      word += c;
    }
  }
  return all;
}

/// Whether no file that the compiler's lists (-MD) name is newer than `product`.
bool is_current(const fs::path& product, const std::vector<fs::path>& lists) {
  std::error_code error;
  const auto time = fs::last_write_time(product, error);
  if (error) return false;
  for (const fs::path& list : lists) {
    std::error_code none;
    if (!fs::exists(list, none)) return false;
    for (const std::string& source : sources_in(read_whole(list)))
      if (fs::last_write_time(source, error) > time || error) return false;
  }
  return true;
}

/// Runs the commands if `always`, if one of them is another one than the last time, or if a source is newer than
/// `product`. The names of all files begin with `stem`; `lists` are the endings of the compiler's lists of the sources.
void make(const std::string& stem, const fs::path& product, const std::string& compiler,
          const std::string& commands, const std::vector<std::string>& lists, bool always) {
  const fs::path last = stem + ".command";
  std::vector<fs::path> files;
  for (const std::string& ending : lists) files.emplace_back(stem + ending);
  std::error_code error;
  // Another version of the compiler builds another product.
  const std::string made_by = commands + "\n" + ran(compiler + " --version").first;
  if (!always && fs::exists(last, error) && read_whole(last) == made_by && is_current(product, files)) return;
  fs::remove(last, error), fs::remove(product, error);
  const auto [output, good] = ran(commands);
  if (!good || !fs::exists(product, error)) throw NotBuilt(short_line(printable(first_error(output))));
  write_whole(last, made_by);
}

/// The language, for a C++ compiler.
std::string language_of(const std::string& source) {
  return source.ends_with(".c") ? "-x c -std=gnu11" : "-std=gnu++20";
}

const Sources::Adapter& adapter_of(const Sources& sources, const std::string& subject) {
  return sources.adapters.at(subject);
}

}  // namespace

Sources Sources::of_build_tree() {
  const auto file =
      fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "adapters/environments.json";
  std::error_code error;
  if (!fs::exists(file, error))
    throw std::runtime_error(
        file.string() +
        ": is not there: subjects are built for other environments only by a program in its "
        "build tree");
  Sources s;
  const nlohmann::json all = read_json(file);
  s.process = all.at("process"), s.compiler = all.at("compiler"), s.flags = all.at("flags");
  s.include = all.at("include");
  for (const auto& a : all.at("adapters"))
    s.adapters[a.at("name")] = {a.at("source"), a.at("flags"), a.at("libraries")};
  return s;
}

std::string Sources::add(const std::string& file, const std::string& own_flags,
                         const std::string& own_libraries) {
  constexpr std::array endings{".c", ".cc", ".cpp", ".cxx", ".C"};
  std::error_code error;
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument(fmt::format("{}: {}", file, why));
  };
  if (!fs::is_regular_file(file, error)) refuse("is no file");
  if (!std::ranges::count(endings, fs::path(file).extension().string()))
    refuse(
        fmt::format("is no source in C or C++: its name must end with one of {}", fmt::join(endings, ", ")));
  const std::string name = fs::path(file).stem().string();
  if (!is_utf8(name)) refuse("its name is not UTF-8");
  const Adapter adapter{fs::absolute(file).string(), include + " " + own_flags, own_libraries, true};
  if (!adapters.try_emplace(name, adapter).second)
    refuse(fmt::format("a subject is named '{}' already", name));
  return name;
}

std::string built(const Sources& sources, const std::string& subject, const Environment& e,
                  const std::string& folder) {
  const Sources::Adapter& a = adapter_of(sources, subject);
  fs::create_directories(folder);
  const std::string in = fs::absolute(folder).string(), stem = in + "/" + subject + "-" + e.name;
  const std::string product = stem + e.ending;
  // A compiler for another machine needs the headers of libraries, but its own ones first.
  const std::string headers = e.run.empty() ? "" : " -idirafter /usr/include";
  const std::string flags = fmt::format("-DNDEBUG {} {}{}", a.flags, e.flags, headers);
  std::string commands =
      e.prepare.empty() ? "" : fmt::format("( cd {} && {} ) && ", shell_quoted(in), e.prepare);
  std::string link = e.link;
  if (const std::size_t at = link.find(builds_folder); at != link.npos)
    link.replace(at, std::string_view(builds_folder).size(), shell_quoted(in));
  commands += fmt::format(
      "{0} {4} {5} -MD -MF {1}.d -MT {1} -c {2} -o {1}.adapter.o && {0} {6} {5} -MD -MF {1}.process.d -MT "
      "{1} -c "
      "{3} -o {1}.process.o && ",
      e.compiler, shell_quoted(stem), shell_quoted(a.source), shell_quoted(sources.process),
      language_of(a.source), flags, language_of(sources.process));
  commands += fmt::format("{} {} {}.adapter.o {}.process.o {} {} -o {}", e.compiler, e.flags,
                          shell_quoted(stem), shell_quoted(stem), link, a.libraries, shell_quoted(product));
  make(stem, product, e.compiler, commands, {".d", ".process.d"}, a.always);
  return (e.run.empty() ? "exec " : "exec " + e.run + " ") + shell_quoted(product);
}

void forget(const std::string& subject, const std::string& environment, const std::string& folder) {
  std::error_code error;
  fs::remove(fs::path(folder) / (subject + "-" + environment + ".command"), error);
}

std::string built_for_program(const Sources& sources, const std::string& subject, const std::string& folder) {
  const Sources::Adapter& a = adapter_of(sources, subject);
  fs::create_directories(folder);
  const std::string stem = fs::absolute(folder).string() + "/" + subject + "-" + own_build,
                    product = stem + ".so";
  make(stem, product, sources.compiler,
       fmt::format("{} {} -DNDEBUG {} {} -fPIC -shared -MD -MF {}.d {} -x none {} -o {}", sources.compiler,
                   language_of(a.source), sources.flags, a.flags, shell_quoted(stem), shell_quoted(a.source),
                   a.libraries, shell_quoted(product)),
       {".d"}, a.always);
  return product;
}

}  // namespace liecheck::properties::environments
