#include <environments/build.hpp>

#include <fmt/format.h>
#include <sys/wait.h>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <support/files.hpp>
#include <support/json.hpp>
#include <support/text.hpp>

namespace liecheck::properties::environments {

namespace {

namespace fs = std::filesystem;

/// Runs a shell command in a folder. Returns its output and whether it succeeded.
std::pair<std::string, bool> ran(const std::string& folder, const std::string& command) {
  const std::string line = fmt::format("cd {} && {{ {} ; }} 2>&1", shell_quoted(folder), command);
  std::FILE* const pipe = ::popen(line.c_str(), "r");
  if (!pipe) return {"no process can be started", false};
  std::string text;
  char part[4096];
  for (std::size_t n; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, n);
  const int status = ::pclose(pipe);
  return {text, WIFEXITED(status) && WEXITSTATUS(status) == 0};
}

std::string first_error(const std::string& output) {
  std::istringstream lines(output);
  std::string first;
  for (std::string line; std::getline(lines, line);) {
    if (first.empty()) first = line;
    for (const char* sign : {"error", "undefined reference", "cannot find"})
      if (line.find(sign) != line.npos) return line;
  }
  return first.empty() ? "the compiler failed" : first;
}

/// Whether no file that the compiler's lists (-MD) name is newer than `product`.
bool is_current(const fs::path& product, const std::vector<fs::path>& lists) {
  std::error_code error;
  const auto time = fs::last_write_time(product, error);
  if (error) return false;
  for (const fs::path& list : lists) {
    std::ifstream file(list);
    if (!file) return false;
    for (std::string word; file >> word;)
      if (word != "\\" && !word.ends_with(":") && (fs::last_write_time(word, error) > time || error))
        return false;
  }
  return true;
}

/// Runs the commands if one of them is another one than the last time, or a source is newer than `product`. `lists` are
/// the endings of the compiler's lists of the sources.
void make(const fs::path& product, const std::string& commands, const std::vector<std::string>& lists) {
  const std::string stem = (product.parent_path() / product.stem()).string();
  const fs::path last = stem + ".command";
  std::vector<fs::path> files;
  for (const std::string& ending : lists) files.emplace_back(stem + ending);
  std::error_code error;
  if (fs::exists(last, error) && read_whole(last) == commands && is_current(product, files)) return;
  const auto [output, good] = ran(product.parent_path().string(), commands);
  if (!good) throw NotBuilt(printable(first_error(output)));
  write_whole(last, commands);
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
  const nlohmann::json all = parsed(read_whole(file));
  s.process = all.at("process"), s.compiler = all.at("compiler"), s.flags = all.at("flags");
  for (const auto& a : all.at("adapters"))
    s.adapters[a.at("name")] = {a.at("source"), a.at("flags"), a.at("libraries")};
  return s;
}

std::string built(const Sources& sources, const std::string& subject, const Environment& e,
                  const std::string& folder) {
  const Sources::Adapter& a = adapter_of(sources, subject);
  fs::create_directories(folder);
  const fs::path product = fs::absolute(fs::path(folder) / (subject + "-" + e.name + e.ending));
  const std::string stem = (product.parent_path() / product.stem()).string();
  // A compiler for another machine needs the headers of libraries, but its own ones first.
  const std::string headers = e.run.empty() ? "" : " -idirafter /usr/include";
  const std::string compile =
      fmt::format("{} -std=gnu++20 -DNDEBUG {} {}{}", e.compiler, e.flags, a.flags, headers);
  std::string commands = e.prepare.empty() ? "" : "( " + e.prepare + " ) && ";
  commands += fmt::format(
      "{0} -MD -MF {1}.d -MT {1} -c {2} -o {1}.adapter.o && {0} -MD -MF {1}.process.d -MT {1} -c {3} -o "
      "{1}.process.o && ",
      compile, shell_quoted(stem), shell_quoted(a.source), shell_quoted(sources.process));
  commands +=
      fmt::format("{} {} {}.adapter.o {}.process.o {} {} -o {}", e.compiler, e.flags, shell_quoted(stem),
                  shell_quoted(stem), e.link, a.libraries, shell_quoted(product.string()));
  make(product, commands, {".d", ".process.d"});
  return (e.run.empty() ? "exec " : "exec " + e.run + " ") + shell_quoted(product.string());
}

std::string built_for_program(const Sources& sources, const std::string& subject, const std::string& folder) {
  const Sources::Adapter& a = adapter_of(sources, subject);
  fs::create_directories(folder);
  const fs::path product = fs::absolute(fs::path(folder) / (subject + "-program.so"));
  const std::string stem = (product.parent_path() / product.stem()).string();
  make(product,
       fmt::format("{} -std=gnu++20 -DNDEBUG {} {} -fPIC -shared -MD -MF {}.d {} {} -o {}", sources.compiler,
                   sources.flags, a.flags, shell_quoted(stem), shell_quoted(a.source), a.libraries,
                   shell_quoted(product.string())),
       {".d"});
  return "in-process:" + product.string();
}

}  // namespace liecheck::properties::environments
