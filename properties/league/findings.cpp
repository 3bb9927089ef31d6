#include <league/findings.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <support/files.hpp>
#include <support/own_process.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties::league {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// How a program of a language ends its file's name.
std::string suffix(const std::string& language) {
  static const std::map<std::string, std::string> all = {{"C++", ".cpp"},   {"C", ".c"},
                                                         {"Python", ".py"}, {"JavaScript", ".js"},
                                                         {"Octave", ".m"},  {"Perl", ".pl"}};
  const auto at = all.find(language);
  return at == all.end() ? ".txt" : at->second;
}

/// The program in the text of a failure, without its heading; empty if there is none.
std::string program_in(const std::string& text) {
  static const std::string heading = "'s own program:\n\n";
  const auto at = text.find(heading);
  if (at == text.npos) return "";
  const auto end = text.find("\n\n", at + heading.size());
  return text.substr(at + heading.size(), end == text.npos ? end : end + 1 - at - heading.size());
}

/// What follows a word on the lines of the text that have it: the column `got`.
std::vector<double> returned_in(const std::string& text) {
  std::vector<double> all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find("  got  "); at != line.npos) {
      std::istringstream words(line.substr(at + 5));
      std::string first;
      words >> first;
      for (const double x : numbers_in(first)) all.push_back(x);
    }
  return all;
}

/// The value of one line, such as "replay", of the text of a failure.
std::string line_of(const std::string& text, const std::string& name) {
  const auto at = text.find("  " + name + " ");
  if (at == text.npos) return "";
  const auto from = text.find_first_not_of(' ', at + 2 + name.size());
  return text.substr(from, text.find('\n', from) - from);
}

struct Output {
  std::string text;
  int code = 0;
};

/// Runs the shell command for at most a minute, with both streams.
Output output_of(const std::string& command) {
  FILE* const pipe = ::popen(("timeout 60 /bin/sh -c " + shell_quoted(command) + " 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("a shell cannot be started");
  Output out;
  std::array<char, 4096> part;
  for (std::size_t n; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    out.text.append(part.data(), n);
  out.code = ::pclose(pipe);
  return out;
}

/// Whether the output has every number that the adapter returned.
bool confirms(const std::string& output, const std::vector<double>& returned, bool in_float) {
  const auto printed = numbers_in(output);
  const double tolerance = in_float ? 1e-6 : 1e-14;  // of what is printed with too few digits
  return !returned.empty() && std::ranges::all_of(returned, [&](double x) {
    return std::ranges::any_of(printed, [&](double y) {
      return x == y || (std::isnan(x) && std::isnan(y)) || std::fabs(x - y) <= tolerance * std::fabs(x);
    });
  });
}

/// A form that does not have the defect.
std::string repair_of(const std::string& operation) {
  if (operation.starts_with("exp3_quaternion"))
    return "Q = (sin(theta/2)/theta phi, cos(theta/2)), with sin(theta/2)/theta = 1/2 - theta^2/48 where "
           "theta^2 underflows";
  if (operation.starts_with("exp3_matrix"))
    return "R = 1 + c1 [phi] + c2 [phi]^2, with c1 = sin(theta)/theta and c2 = 2 (sin(theta/2)/theta)^2, "
           "never 1 - cos(theta)";
  if (operation == "log3_matrix")
    return "Q of R by its largest pivot, then phi = 2 atan2(|v|, |w|)/|v| v, with the sign of w and 0 for v "
           "= 0; never acos of the trace";
  if (operation.starts_with("log3") || operation == "relative_angle")
    return "phi = 2 atan2(|v|, |w|)/|v| v, with the sign of w and 0 for v = 0; never acos(w), which loses "
           "half of the digits near 1";
  if (operation == "slerp")
    return "the angle by atan2(|Q1 - Q0|, |Q1 + Q0|), and its sines, without a threshold on the cosine";
  if (operation == "normalize") return "Q / |Q|, with Q scaled by its largest component first";
  return "the formula that `liecheck list --operations` gives, as the subject liecheck computes it";
}

/// What `liecheck replay` prints for the same input with another subject; "" if it cannot.
std::string replay_of(const std::string& replay, const std::string& subject) try {
  std::string id = replay.substr(replay.find("replay ") + 7);
  id = id.substr(0, id.find(' '));
  std::vector<std::string> parts;
  std::istringstream in(id);
  for (std::string p; parts.size() < 3 && std::getline(in, p, '.');) parts.push_back(p);
  const std::string head = fmt::format("{}.{}.{}.", parts.at(0), parts.at(1), parts.at(2));
  if (!id.starts_with(head)) return "";
  const std::string own = fmt::format("{}.{}.{}.{}", parts[0], parts[1], subject, id.substr(head.size()));
  return output_of_own_process({"replay", own}, stop_requested).value_or("");
} catch (const std::exception&) {
  return "";
}

/// The whole Markdown file of a finding.
std::string finding(const json& library, const json& cell, const std::string& program,
                    const std::string& output, const std::string& command) {
  const json& f = cell["failure"];
  const std::string text = f["text"], operation = cell["operation"];
  const std::string before = text.substr(0, text.find("  as "));
  const std::string guess = f["guess"], own = replay_of(line_of(text, "replay"), "liecheck");
  std::string all =
      fmt::format("# {} {}: {}, {}\n\n", library["name"].get<std::string>(),
                  library["version"].get<std::string>(), operation, f["what"].get<std::string>());
  all += fmt::format("In {}, at {}: {} of {} cases in these bands fail.\n\n",
                     cell["scalar"].get<std::string>(), f["where"].get<std::string>(),
                     f["failed"].get<std::uint64_t>(), f["cases"].get<std::uint64_t>());
  all += fmt::format(
      "## Program\n\n```\n{}```\n\nRun as `{}`, it prints what the library returns:\n\n```\n{}{}```\n\n",
      program, command, output, output.ends_with('\n') ? "" : "\n");
  all += fmt::format("## Input, expected and returned\n\n```\n{}```\n\n", before);
  all +=
      "The expected numbers come from two oracles: the law's definition at 50 digits, and the same at 100 "
      "digits. "
      "Where the two differ, a case is *unresolved* and does not appear here.\n\n";
  if (!guess.empty())
    all += fmt::format("## Why\n\nThe shape of the error over the angle says: {}.\n\n", guess);
  all += fmt::format("## A repaired form\n\n{}.\n", repair_of(operation));
  if (!own.empty())
    all +=
        fmt::format("\nIt is what the subject liecheck computes. The same input there:\n\n```\n{}```\n", own);
  return all;
}

}  // namespace

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

Confirmed write_findings(const json& record, const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw std::runtime_error(fmt::format("--out {}: cannot be created: {}", folder, error.message()));
  Confirmed all;
  for (const json& library : record["libraries"])
    for (const json& cell : library["cells"]) {
      if (stop_requested) return all;
      const std::string grade = cell["grade"], operation = cell["operation"], scalar = cell["scalar"];
      if (grade == "A" || grade == "B" || !cell["failure"].is_object()) continue;
      const std::string name = fmt::format("{}_{}_{}", library["name"].get<std::string>(), operation, scalar);
      const std::string text = cell["failure"]["text"], program = program_in(text);
      const auto left_out = [&](const char* why) {
        all.text += fmt::format("no finding: {}: {}\n", name, why);
      };
      if (program.empty()) {
        left_out("the adapter has no program for it");
        continue;
      }
      const fs::path file = fs::path(folder) / (name + suffix(library["language"]));
      write_whole(file, program);
      std::string command = library["run"];
      for (const auto& [place, with] :
           {std::pair<std::string, std::string>{"{file}", fs::absolute(file).string()},
            {"{exe}", fs::absolute(file).string() + ".out"}})
        for (auto at = command.find(place); at != command.npos; at = command.find(place, at + with.size()))
          command.replace(at, place.size(), shell_quoted(with));
      const Output out = output_of(command);
      fs::remove(file.string() + ".out", error);
      if (out.code != 0 || !confirms(out.text, returned_in(text), scalar == "float")) {
        left_out(out.code ? "its program ends with an error"
                          : "its program prints other numbers than the adapter returned");
        continue;
      }
      std::string shown = library["run"];
      if (const auto at = shown.find("{file}"); at != shown.npos)
        shown.replace(at, 6, file.filename().string());
      write_whole(fs::path(folder) / (name + ".md"), finding(library, cell, program, out.text, shown));
      ++all.written;
      all.text += fmt::format("{}: {}, {}\n", name, cell["failure"]["what"].get<std::string>(),
                              cell["failure"]["where"].get<std::string>());
    }
  all.text += fmt::format("{} findings in {}\n", all.written, folder);
  return all;
}

}  // namespace liecheck::properties::league
