#include <league/programs.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <support/files.hpp>
#include <support/text.hpp>
#include <tuple>

namespace liecheck::properties::league {

namespace fs = std::filesystem;

namespace {

/// Runs the shell command for at most a minute. The text is what it writes to standard output.
Output output_of(const std::string& command) {
  FILE* const pipe =
      ::popen(("timeout 60 /bin/sh -c " + shell_quoted(command) + " 2>/dev/null").c_str(), "r");
  if (!pipe) throw std::runtime_error("a shell cannot be started");
  Output out;
  std::array<char, 4096> part;
  for (std::size_t n; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    out.text.append(part.data(), n);
  out.code = ::pclose(pipe);
  return out;
}

}  // namespace

std::string suffix(const std::string& language) {
  static const std::map<std::string, std::string> all = {{"C++", ".cpp"},   {"C", ".c"},
                                                         {"Python", ".py"}, {"JavaScript", ".js"},
                                                         {"Octave", ".m"},  {"Perl", ".pl"}};
  const auto at = all.find(language);
  return at == all.end() ? ".txt" : at->second;
}

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> all;
  std::string word;
  const auto end_word = [&] {
    char* end = nullptr;
    const double x = std::strtod(word.c_str(), &end);
    if (!word.empty() && *end == '\0') all.push_back(x);
    word.clear();
  };
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+')
      word += c;
    else
      end_word();
  end_word();
  return all;
}

bool confirms(const std::string& output, const std::vector<double>& returned, bool in_float) {
  const auto printed = numbers_in(output);
  const double tolerance = in_float ? 1e-6 : 1e-14;  // of what is printed with too few digits
  return !returned.empty() && std::ranges::all_of(returned, [&](double x) {
    return std::ranges::any_of(printed, [&](double y) {
      return x == y || (std::isnan(x) && std::isnan(y)) || std::fabs(x - y) <= tolerance * std::fabs(x);
    });
  });
}

std::pair<std::string, std::string> commands(const std::string& run, const fs::path& file) {
  std::string command = run, shown = run;
  for (const auto& [place, with, name] :
       {std::tuple<std::string, std::string, std::string>{"{file}", fs::absolute(file).string(),
                                                          file.filename().string()},
        {"{exe}", fs::absolute(file).string() + ".out", "./a.out"}}) {
    for (auto at = command.find(place); at != command.npos; at = command.find(place, at + with.size() + 2))
      command.replace(at, place.size(), shell_quoted(with));
    for (auto at = shown.find(place); at != shown.npos; at = shown.find(place, at + name.size()))
      shown.replace(at, place.size(), name);
  }
  return {command, shown};
}

Output run_program(const std::string& run, const fs::path& file, const std::string& program) {
  write_whole(file, program);
  std::string folder = (fs::temp_directory_path() / "liecheck-XXXXXX").string();
  if (!::mkdtemp(folder.data())) throw std::runtime_error(folder + ": cannot be created");
  write_whole(folder / file.filename(), program);
  Output out = output_of(commands(run, folder / file.filename()).first);
  std::error_code error;
  fs::remove_all(folder, error);
  return out;
}

}  // namespace liecheck::properties::league
