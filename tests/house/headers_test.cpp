// A program that includes the library and asks for these warnings gets none from the library's headers.

#include <gtest/gtest.h>

#include <cstdlib>

#include "../scratch.hpp"
#include "source_files.hpp"

namespace liecheck::house {
namespace {

TEST(Headers, OfTheLibraryCompileWithoutWarnings) {
  std::string unit;
  for (const auto& [path, text] : sources({"lib", "scenes"}))
    if (path.ends_with(".hpp")) unit += "#include <" + path.substr(path.find('/') + 1) + ">\n";
  ASSERT_NE(unit.find("<liecheck/algorithms/aba.hpp>"), std::string::npos);
  // The compiler reports some warnings only where a template is instantiated.
  unit += "template class liecheck::Data<long double>;\ntemplate class liecheck::SO3<long double>;\n";
  const fs::path file = fs::path(liecheck::scratch()) / "liecheck_headers.cpp";
  std::ofstream(file) << unit;
  const std::string command = LIECHECK_SYNTAX_CHECK " -Wall -Wextra -Wpedantic -Wshadow -Werror '";
  EXPECT_EQ(std::system((command + file.string() + "'").c_str()), 0);
}

TEST(Headers, OfAllThatMostProgramsNeedCompileWithoutWarningsAndSayInOneLineThatTheyNeedCpp20) {
  const fs::path file = fs::path(liecheck::scratch()) / "liecheck_cpp17.cpp", said = file.string() + ".txt";
  std::ofstream(file)
      << "#include <liecheck/liecheck.hpp>\n#if __cplusplus >= 202002L\n"
         "template class liecheck::Data<float>;\ntemplate class liecheck::SE3<float>;\n"
         "auto f(const liecheck::SE3<float>& x) { return liecheck::log6<float>(x); }\n#endif\n";
  const std::string command =
      LIECHECK_SYNTAX_CHECK " -Werror -Wall -Wextra -Wpedantic -Wshadow -Wconversion -std=";
  EXPECT_EQ(std::system((command + "c++20 '" + file.string() + "'").c_str()), 0);
  if (std::system("command -v clang++ >/dev/null") == 0) {  // the same flags by the other compiler
    const std::string flags = command.substr(command.find(' '));
    EXPECT_EQ(std::system(("clang++" + flags + "c++20 '" + file.string() + "'").c_str()), 0);
  }
  EXPECT_NE(std::system((command + "c++17 '" + file.string() + "' 2>'" + said.string() + "'").c_str()), 0);
  std::ifstream in(said);
  std::string errors;
  for (std::string line; std::getline(in, line);)
    if (line.find("error:") != line.npos) errors += line.substr(line.find("error:")) + "\n";
  if (const auto at = errors.find(" due to requirement"); at != errors.npos)  // of clang
    errors.erase(at, errors.find(':', at) - at);
  EXPECT_EQ(errors,
            "error: static assertion failed: liecheck needs C++20: compile with -std=c++20, or link "
            "liecheck::lib by CMake\n");
}

}  // namespace
}  // namespace liecheck::house
