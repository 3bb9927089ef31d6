// The programs in the terms of each subject's own library: they compile, and print what the subject returns.

#include <gtest/gtest.h>

#include <algorithm>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <cmath>
#include <conventions/probe.hpp>
#include <cstdlib>
#include <failures/calls.hpp>
#include <failures/program.hpp>
#include <fstream>
#include <set>
#include <sstream>
#include <subjects/own_programs.hpp>

#include "../scratch.hpp"

namespace liecheck::properties {
namespace {

/// The programs of several calls as one, which prints a line "case" before the output of each.
class Programs {
 public:
  void add(const std::string& program, const std::vector<double>& result) {
    const std::string main = "int main() {\n";
    const auto at = program.find(main);
    ASSERT_NE(at, program.npos) << program;
    std::istringstream head(program.substr(0, at));
    for (std::string line; std::getline(head, line);)
      if (heads_.insert(line).second) begin_ += line + "\n";
    const std::string name = "case_" + std::to_string(results_.size());
    functions_ += "void " + name + "() {\n" + program.substr(at + main.size());
    calls_ += "  std::cout << \"case\\n\";\n  " + name + "();\n";
    results_.push_back(result);
  }
  const std::vector<std::vector<double>>& results() const { return results_; }

  /// The numbers that each program prints.
  std::vector<std::vector<double>> printed() const {
    const std::string file = liecheck::scratch() + "liecheck_own_programs";
    std::ofstream(file + ".cpp") << begin_ << functions_ << "int main() {\n" << calls_ << "}\n";
    std::string compiler = LIECHECK_SYNTAX_CHECK;
    compiler.erase(compiler.find(" -fsyntax-only"), std::string(" -fsyntax-only").size());
    EXPECT_EQ(std::system((compiler + " " LIECHECK_OWN_PROGRAMS_FLAGS " " + file +
                           ".cpp " LIECHECK_OWN_PROGRAMS_LIBRARIES " -o " + file + ".exe && " + file +
                           ".exe >" + file + ".txt")
                              .c_str()),
              0);
    std::ifstream out(file + ".txt");
    std::vector<std::vector<double>> all;
    for (std::string word; out >> word;)
      if (word == "case")
        all.emplace_back();
      else
        all.back().push_back(std::stod(word));
    return all;
  }

 private:
  std::set<std::string> heads_;
  std::string begin_, functions_, calls_;
  std::vector<std::vector<double>> results_;
};

/// Whether each number of the result is printed: libraries differ in the order, and print poses as 4 x 4 matrices.
bool prints(const std::vector<double>& printed, const std::vector<double>& result) {
  return std::ranges::all_of(result, [&](double x) {
    return std::ranges::any_of(
        printed, [&](double y) { return std::abs(x - y) <= 1e-13 * std::max(1.0, std::abs(x)); });
  });
}

TEST(OwnPrograms, PrintWhatTheSubjectReturns) {
  Programs programs;
  std::set<std::string> subjects;
  for (const std::string& subject : subject_names()) {
    const OwnPrograms* const own = own_programs(subject);
    if (!own || subject.starts_with("textbook:")) continue;
    const auto all = select({{subject}, {}, {"double"}}, built_in_robot());
    ASSERT_FALSE(all.empty()) << subject;
    for (const auto& [operation, statements] : own->statements) {
      if (subject == "eigen" && (operation->name == "exp6" || operation->name == "log6"))
        continue;  // 10 s to compile
      std::vector<double> arguments = conventions::probe_arguments<double>(*operation).at(0);
      if (subject == "textbook" && operation->name == "exp6")
        arguments = {1, 0, 0, 0, 1e-8, 0};  // its error shows
      const std::vector<double> result = result_of(*all.front(), *operation, arguments);
      ASSERT_FALSE(result.empty()) << subject << " does not offer " << operation->name;
      programs.add(own_program(*all.front(), {operation, {arguments.begin(), arguments.end()}, {}, ""}),
                   result);
      subjects.insert(subject);
    }
  }
  EXPECT_TRUE(subjects.contains("textbook") && subjects.contains("eigen") &&
              subjects.contains("liecheck:batch"));
  const auto printed = programs.printed();
  ASSERT_EQ(printed.size(), programs.results().size());
  for (std::size_t i = 0; i < printed.size(); ++i)
    EXPECT_TRUE(prints(printed[i], programs.results()[i]))
        << testing::PrintToString(printed[i]) << " lacks some of "
        << testing::PrintToString(programs.results()[i]);
}

TEST(OwnPrograms, ThatPrintAnotherResultAreFound) {
  EXPECT_TRUE(prints({0, 1, -5e-9, 2}, {2, -5e-9}));
  EXPECT_FALSE(prints({0, 1, 2}, {2, -5e-9}));
}

}  // namespace
}  // namespace liecheck::properties
