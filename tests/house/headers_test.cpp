// A program that includes the library and asks for these warnings gets none from the library's headers.

#include <gtest/gtest.h>

#include <cstdlib>

#include "source_files.hpp"

namespace liecheck::house {
namespace {

TEST(Headers, OfTheLibraryCompileWithoutWarnings) {
  std::string unit;
  for (const auto& [path, text] : sources({"lib"}))
    if (path.ends_with(".hpp")) unit += "#include <" + path.substr(std::string("lib/").size()) + ">\n";
  ASSERT_NE(unit.find("<liecheck/algorithms/aba.hpp>"), std::string::npos);
  // The compiler reports some warnings only where a template is instantiated.
  unit += "template class liecheck::Data<long double>;\ntemplate class liecheck::SO3<long double>;\n";
  const fs::path file = fs::path(testing::TempDir()) / "liecheck_headers.cpp";
  std::ofstream(file) << unit;
  const std::string command = LIECHECK_SYNTAX_CHECK " -Wall -Wextra -Wpedantic -Wshadow -Werror '";
  EXPECT_EQ(std::system((command + file.string() + "'").c_str()), 0);
}

}  // namespace
}  // namespace liecheck::house
