#include <league/findings.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <league/explanations.hpp>
#include <league/programs.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <support/files.hpp>
#include <support/folder.hpp>
#include <support/markdown.hpp>
#include <support/own_process.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties::league {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// The program in the text of a failure, without its heading; empty if there is none. What `replay` prints has a
/// program for each block of each operation: then it is one of the operation.
std::string program_in(const std::string& text, const std::string& operation = "") {
  static const std::string heading = "'s own program:\n\n";
  const auto block = operation.empty() ? 0 : text.find("\n" + operation + ", block ");
  const auto at = block == text.npos ? text.npos : text.find(heading, block);
  if (at == text.npos) return "";
  auto end = text.find(operation.empty() ? "\n\n  replay " : "\n\n\n", at + heading.size());
  const auto heads_a_block = [&] {
    const auto line = text.find_first_not_of('\n', end);
    return line == text.npos || text.substr(line, text.find('\n', line) - line).find(", block ") != text.npos;
  };
  while (!operation.empty() && end != text.npos && !heads_a_block()) end = text.find("\n\n\n", end + 3);
  std::string program =
      text.substr(at + heading.size(), end == text.npos ? end : end + 1 - at - heading.size());
  while (program.ends_with("\n\n")) program.pop_back();
  return program;
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
  return from == text.npos ? "" : text.substr(from, text.find('\n', from) - from);
}

/// What `liecheck replay` prints for the same input with another subject, which an adapter offers; "" if it cannot.
std::string replay_of(const std::string& replay, const std::string& subject, const std::string& adapter) try {
  const auto at = replay.find("replay ");
  if (at == replay.npos) return "";
  std::string id = replay.substr(at + 7);
  id = id.substr(0, id.find(' '));
  std::vector<std::string> parts;
  std::istringstream in(id);
  for (std::string p; parts.size() < 3 && std::getline(in, p, '.');) parts.push_back(p);
  const std::string head = fmt::format("{}.{}.{}.", parts.at(0), parts.at(1), parts.at(2));
  if (!id.starts_with(head) || id.starts_with('-')) return "";  // an option is no case
  const std::string own = fmt::format("{}.{}.{}.{}", parts[0], parts[1], subject, id.substr(head.size()));
  constexpr int fails = 1;  // the exit code of a replayed failure
  return output_of_own_process({"replay", own, "--adapter", adapter}, stop_requested,
                               std::numeric_limits<double>::infinity(), fails)
      .value_or("");
} catch (const std::exception&) {
  return "";
}

/// The row of the list with both commands of the library of a record; null if there is none.
const Entry* listed(const json& library, const Trust& trust) {
  const auto at = std::ranges::find_if(trust.adapters, [&](const Entry& e) {
    return !e.adapter.empty() && library["adapter"] == e.adapter && library["run"] == e.run;
  });
  return at == trust.adapters.end() ? nullptr : &*at;
}

/// Refuses a record that would start other commands than those of the list.
void check_commands(const json& record, const Trust& trust) {
  if (trust.recorded) return;
  for (const json& library : record["libraries"]) {
    if (listed(library, trust)) continue;
    throw std::invalid_argument(fmt::format(
        "{}: the library '{}' has commands that the list of adapters does not have: adapter '{}', run '{}'. "
        "Nothing was run. --adapters FILE gives another list; --run-recorded runs what the record says",
        trust.file, library["name"].get<std::string>(), library["adapter"].get<std::string>(),
        library["run"].get<std::string>()));
  }
}

/// Whether the listed adapter prints this program for the same case, so that it is not only the record that says it.
bool is_printed(const json& library, const json& cell, const std::string& program, const Trust& trust) {
  if (trust.recorded) return true;
  const Entry& e = *listed(library, trust);
  const std::string text = replay_of(line_of(cell["failure"]["text"], "replay"), library["name"], e.adapter);
  return program_in("\n" + text, cell["operation"]) == program;
}

const json* cell_in(const json& library, const std::string& operation, const std::string& scalar) {
  for (const json& c : library["cells"])
    if (c["operation"] == operation && c["scalar"] == scalar) return &c;
  return nullptr;
}

/// "1.93 eps in 2134 cases, 41 ns a call"
std::string figures(const json& cell) {
  const std::string worst = cell["grade"] == "F" ? "NaN, a wrong branch or no result"
                            : cell["worst_eps"].is_number()
                                ? fmt::format("{:.3g} eps", cell["worst_eps"].get<double>())
                                : "more than any number";
  const double ns = cell["ns"];
  return fmt::format("at worst {} in {} cases{}", worst, cell["cases"].get<std::uint64_t>(),
                     ns > 0 ? fmt::format(", {:.3g} ns a call", ns) : "");
}

/// The section on a form without the defect: that of the same language, or else in C++, run on the same input.
std::string repaired(const json& record, const json& library, const json& cell, const fs::path& stem) {
  const std::string operation = cell["operation"], scalar = cell["scalar"], language = library["language"];
  std::string all = fmt::format("## A repaired form\n\n{}.\n", repair_of(operation));
  const json* form = nullptr;
  for (const json& l : record["libraries"])
    if (l.value("repaired", false) && cell_in(l, operation, scalar) &&
        (!form || l["language"] == language || ((*form)["language"] != language && l["language"] == "C++")))
      form = &l;
  if (!form) return all;
  const std::string text =
      replay_of(line_of(cell["failure"]["text"], "replay"), (*form)["name"], (*form)["adapter"]);
  const std::string program = program_in("\n" + text, operation);
  if (program.empty()) return all;
  const fs::path file =
      file_in(stem.parent_path(), stem.filename().string() + "_repaired" + suffix((*form)["language"]));
  const Output out = run_program((*form)["run"], file, program);
  if (out.code != 0) return all;
  return all + fmt::format(
                   "\n{}\nRun as `{}`, on the same input:\n\n{}\nOn the cases of this "
                   "league, in "
                   "{}, it errs {}; {} itself {}. Both times are those of calls through an adapter.\n",
                   markdown_block(program), commands((*form)["run"], file).second, markdown_block(out.text),
                   scalar, figures(*cell_in(*form, operation, scalar)), markdown(library["name"]),
                   figures(cell));
}

/// What the failure of a cell says of its error: the digits that the input shown loses, or the outcome.
std::string shown_error(const json& failure) {
  const std::string error = line_of(failure["text"], "error");
  const auto lost = error.find("; ");
  return lost == error.npos ? failure["what"].get<std::string>() : error.substr(lost + 2);
}
/// "in double, at theta < 1e-8: 3 of 20 cases there fail"
std::string where_it_fails(const json& cell) {
  const json& f = cell["failure"];
  const std::string where = f["where"];
  return fmt::format("in {}{}: {} of {} cases {}fail", markdown(cell["scalar"]),
                     where == "everywhere" ? "" : ", at " + markdown(where), f["failed"].get<std::uint64_t>(),
                     f["cases"].get<std::uint64_t>(), where == "everywhere" ? "" : "there ");
}
/// The text of a failure up to its program, without the inputs of the law that the function does not take, and with the
/// name of the order of Euler angles.
std::string shown_case(const std::string& failure) {
  const std::string call = line_of(failure, "call");
  std::set<std::string> taken;
  for (auto at = call.find('('); at != call.npos && at + 1 < call.size(); at = call.find(',', at + 1)) {
    const auto from = call.find_first_not_of(", (", at), to = call.find_first_of(",)", from);
    if (to == call.npos) break;
    taken.insert(call.substr(from, to - from));
  }
  static constexpr const char* orders[] = {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX",
                                           "XYX", "XZX", "YXY", "YZY", "ZXZ", "ZYZ"};
  std::istringstream lines(failure.substr(0, failure.find("  as ")));
  std::string all;
  bool inputs = false, first = true;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  input ")) inputs = true;
    if (inputs && !line.starts_with("  input ") && !line.starts_with("        ")) inputs = false;
    if (inputs) {
      const auto from = line.find_first_not_of(' ', 12), equal = line.find(" = ");
      const std::string name = equal == line.npos ? "" : line.substr(from, equal - from);
      if (!taken.empty() && !name.empty() && !taken.contains(name)) continue;
      if (first && from != line.npos) line = "  input     " + line.substr(from);
      if (name == "order")
        if (const auto order = std::strtoul(line.c_str() + line.find('=') + 1, nullptr, 10); order < 24)
          line += fmt::format(": {}, {} axes", orders[order / 2], order % 2 ? "rotating" : "static");
      first = false;
    }
    all += line + "\n";
  }
  return all;
}

/// The whole Markdown file of a finding.
std::string finding(const json& record, const json& library, const json& cell, const std::string& program,
                    const std::string& output, const fs::path& file) {
  const json& f = cell["failure"];
  const std::string text = f["text"], operation = cell["operation"], guess = f["guess"];
  std::string all = fmt::format("# {} {}: {}, {}\n\n", markdown(library["name"]),
                                markdown(library["version"]), markdown(operation), markdown(shown_error(f)));
  all += "This fails " + where_it_fails(cell) + ".";
  std::set<std::string> others;
  for (const json& c : library["cells"])
    if (c["failure"].is_object() && c["failure"].value("because", "") == operation)
      others.insert(c["operation"]);
  if (!others.empty())
    all +=
        fmt::format(" In the same way {}: {}.", others.size() == 1 ? "another function fails" : "others fail",
                    markdown(fmt::format("{}", fmt::join(others, ", "))));
  if (const json* const other = cell_in(library, operation, "float");
      other && other != &cell && (*other)["failure"].is_object())
    all += " It also fails " + where_it_fails(*other) + ".";
  all += fmt::format("\n\n## Program\n\n{}\nRun as `{}`, it prints what the library does:\n\n{}\n",
                     markdown_block(program), commands(library["run"], file).second, markdown_block(output));
  all += fmt::format("## Input, expected and returned\n\n{}\n",
                     markdown_block(printable_lines(shown_case(text))));
  all += fmt::format(
      "Where the expected numbers come from: {}. A case in which two sources do not agree to 41 digits is "
      "*unresolved* and no finding.\n\n",
      oracles_of(operation));
  if (!guess.empty())
    all += fmt::format("## Why\n\nThe shape of the error over the angle says: {}.\n\n", markdown(guess));
  return all + repaired(record, library, cell, file.parent_path() / file.stem());
}

}  // namespace

Confirmed write_findings(const json& record, const Trust& trust, const std::string& folder) {
  check_commands(record, trust);
  make_folder("--out", folder);
  Confirmed all;
  std::set<std::string> stems;  // of the files that this call writes
  for (const json& library : record["libraries"])
    for (const json& cell : library["cells"]) {
      if (stop_requested) return all;
      const std::string grade = cell["grade"], operation = cell["operation"], scalar = cell["scalar"];
      if (grade == "A" || grade == "B" || !cell["failure"].is_object()) continue;
      const std::string name = fmt::format("{}_{}", library["name"].get<std::string>(), operation);
      if (const json* const other = cell_in(library, operation, "double");
          scalar == "float" && other && (*other)["failure"].is_object())
        continue;  // the same function: the finding in double names it
      const std::string text = cell["failure"]["text"], program = program_in(text);
      const auto left_out = [&](const std::string& why) {
        all.text += fmt::format("no finding: {}: {}\n", name, why);
      };
      if (cell["failure"].contains("because")) {
        left_out(fmt::format("it is wrong since {} is", cell["failure"]["because"].get<std::string>()));
        continue;
      }
      if (program.empty()) {
        left_out("the adapter has no program for it");
        continue;
      }
      if (!is_printed(library, cell, program, trust)) {
        left_out(
            "its adapter prints another program for this case, or none; --run-recorded runs the record's");
        continue;
      }
      std::string stem = file_name(name);  // of two names that differ in other characters, too
      while (!stems.insert(stem).second) stem += "_";
      stems.insert(stem + "_repaired");
      const fs::path file = file_in(folder, stem + suffix(library["language"])),
                     page = file_in(folder, stem + ".md");
      const Output out = run_program(library["run"], file, program);
      if (out.code != 0 || !confirms(out.text, returned_in(text), scalar == "float")) {
        left_out(out.code ? "its program ends with an error"
                          : "its program prints other numbers than the adapter returned");
        continue;
      }
      write_whole(page, finding(record, library, cell, program, out.text, file));
      ++all.written;
      all.text += fmt::format("{}: {}, {}\n", name, shown_error(cell["failure"]), where_it_fails(cell));
    }
  all.text += fmt::format("{} findings in {}\n", all.written, folder);
  return all;
}

}  // namespace liecheck::properties::league
