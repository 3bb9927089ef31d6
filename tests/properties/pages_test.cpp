// The commands and programs on the pages: their flags exist, and they print what the pages show.

#include <cstdio>
#include <map>
#include <memory>
#include <regex>

#include "../scratch.hpp"
#include "../shell.hpp"
#include "pages.hpp"

namespace liecheck::properties {
namespace {

/// What the program prints on its standard output. `arguments` are the rest of a line of a shell in the clone.
std::string output_of(const std::string& arguments) {
  return shell("cd '" + root + "'; PATH=/usr/bin:$PATH; '" LIECHECK_PROGRAM "' " + arguments + " 2>/dev/null")
      .text;
}

const std::string& help_of(const std::string& command) {
  static std::map<std::string, std::string> all;
  const auto [at, is_new] = all.try_emplace(command);
  if (is_new) at->second = output_of(command + " --help");
  return at->second;
}

/// "campaign --rules" for each flag of each call of liecheck that its command does not have. In a table, the
/// alternatives are separated by "\\|".
std::vector<std::string> unknown_flags(const std::string& text) {
  static const std::regex call(
      "liecheck ((?:lab )?(?:(?:adapter|scene|league(?= [a-z])) )?[a-z-]+)([^\n;|`)]*)"),
      flag("[ \\[](--[a-z-]+)");
  const std::string calls = replaced(replaced(text, "\\\n", " "), "\\|", " ");
  std::vector<std::string> unknown;
  for (std::sregex_iterator c(calls.begin(), calls.end(), call), end; c != end; ++c) {
    const std::string command = (*c)[1], arguments = (*c)[2];
    for (std::sregex_iterator f(arguments.begin(), arguments.end(), flag); f != end; ++f)
      if (!std::regex_search(help_of(command), std::regex((*f)[1].str() + "(?![a-z-])")))
        unknown.push_back(command + " " + (*f)[1].str());
  }
  return unknown;
}

TEST(Pages, UseFlagsThatExist) {
  std::vector<std::string> all = pages();
  EXPECT_GT(all.size(), 12u);
  for (const char* file : {"install/ci/Containerfile", "install/ci/workflow.yml", "install/ci/github.yml",
                           "install/ci/gitlab.yml"})
    all.emplace_back(file);
  for (const std::string& page : all)
    for (const std::string& flag : unknown_flags(read(page))) ADD_FAILURE() << page << ": liecheck " << flag;
}

TEST(Pages, ThatUseUnknownFlagsAreFound) {
  EXPECT_EQ(
      unknown_flags("x\nliecheck campaign --seed 1 --no-such-flag \\\n  --cases 3 --or-this | tee --that\n"),
      (std::vector<std::string>{"campaign --no-such-flag", "campaign --or-this"}));
  EXPECT_EQ(
      unknown_flags("| `liecheck lab speed [--for 1s \\| --for-each 1s] [--seed N]` | `--not-a-flag` |"),
      std::vector<std::string>{"lab speed --for"});
}

/// The text with each number of three decimals, a time in s, as "#.###".
std::string without_times(const std::string& text) {
  static const std::regex time("\\b[0-9]+[.][0-9]{3}\\b");
  return std::regex_replace(text, time, "#.###");
}

/// The first line of `shown` that is not printed, or not in this order; "" if every line is.
std::string first_missing(const std::string& shown, const std::string& printed) {
  std::istringstream lines(without_times(shown));
  const std::string text = "\n" + without_times(printed);
  std::size_t from = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto found = text.find("\n" + line + "\n", from);
    if (found == text.npos) return line;
    from = found + 1;
  }
  return "";
}

/// The first line that a command prints no more, for each text of a page that begins with "$ …/liecheck".
std::vector<std::string> wrong_outputs(const std::string& page, int* commands = nullptr) {
  const std::string begin = "$ build/release/bin/liecheck ";
  std::vector<std::string> wrong;
  for (const CodeBlock& b : blocks_of(page)) {
    if (b.language != "text" || !b.text.starts_with(begin)) continue;
    const auto end = b.text.find('\n');
    const std::string arguments = b.text.substr(begin.size(), end - begin.size());
    static const std::regex adapter("build/release/adapters/[a-z.]+");
    std::smatch library;  // of Debian; without it no adapter is built
    if (std::regex_search(arguments, library, adapter) && !std::filesystem::exists(root + library.str()))
      continue;
    if (const std::string line = first_missing(b.text.substr(end + 1), output_of(arguments)); !line.empty())
      wrong.push_back(arguments + ": " + line);
    if (commands) ++*commands;
  }
  return wrong;
}

TEST(Pages, ShowOutputsAsTheProgramPrintsThem) {
  int commands = 0;
  for (const std::string& page : pages())
    for (const std::string& wrong : wrong_outputs(read(page), &commands))
      ADD_FAILURE() << page << ": " << wrong;
  EXPECT_GE(commands, 2);
}

TEST(Pages, WhoseOutputsChangedAreFound) {
  const std::string page =
      "x\n```text\n$ build/release/bin/liecheck list --laws\nexp_oracle\nlog_oracle\n```\n";
  EXPECT_EQ(wrong_outputs(page), std::vector<std::string>());
  EXPECT_EQ(wrong_outputs(replaced(page, "log_oracle", "log_oracel")),
            std::vector<std::string>{"list --laws: log_oracel"});
}

/// The C++ programs of the pages as one program, which prints a line "--- PAGE" before the output of each; and that
/// output as the pages show it, in the next block "text".
std::pair<std::string, std::string> programs_and_outputs(const std::vector<std::string>& names) {
  std::string programs, calls, outputs;
  int n = 0;
  for (const std::string& name : names) {
    bool shown = true;
    for (const CodeBlock& b : blocks_of(read(name)))
      if (b.language == "cpp" && b.text.find("int main()") != b.text.npos) {
        const std::string function = "program_" + std::to_string(++n);
        programs += replaced(b.text, "int main()", "void " + function + "()");
        calls += "std::cout << \"--- " + name + "\\n\" << std::setprecision(6);\n" + function + "();\n";
        shown = false;
      } else if (b.language == "text" && !shown) {
        outputs += "--- " + name + "\n" + b.text;
        shown = true;
      }
  }
  return {"#include <iomanip>\n" + programs + "int main() {\n" + calls + "}\n", outputs};
}

/// The program of the README is compiled by the README's own line (page_commands_test.cpp).
TEST(Pages, HaveProgramsThatPrintWhatThePagesShow) {
  const auto [programs, outputs] = programs_and_outputs({"docs/tutorial.md"});
  const std::string file = liecheck::scratch() + "liecheck_pages";
  std::ofstream(file + ".cpp") << programs;
  const std::string flags = replaced(LIECHECK_SYNTAX_CHECK, " -fsyntax-only", "") + " " LIECHECK_LINK " ";
  ASSERT_EQ(std::system((flags + file + ".cpp " LIECHECK_LIBRARY " -o " + file + ".exe").c_str()), 0);
  ASSERT_EQ(std::system(("cd '" + root + "' && " + file + ".exe >" + file + ".txt").c_str()), 0);
  std::ifstream printed(file + ".txt");
  EXPECT_EQ((std::string{std::istreambuf_iterator<char>(printed), {}}), outputs);
  EXPECT_EQ(replaced(programs, "void program_4()", "").size() + 16, programs.size());  // four programs
}

}  // namespace
}  // namespace liecheck::properties
