#pragma once
// Calls of the program `liecheck`.

#include <fstream>

#include "../scratch.hpp"
#include "../shell.hpp"
#include "bodies.hpp"

namespace liecheck::test {

/// The exit code of the program, and its output on both streams.
inline std::pair<int, std::string> printed(const std::string& arguments) {
  const auto [code, said] = shell(LIECHECK_PROGRAM " " + arguments);
  return {code, said};
}
/// Its output, which must have these parts, and its exit code must be that one.
inline std::string expectSaid(const std::string& arguments, int code,
                              const std::vector<std::string>& parts = {}) {
  const auto [found, said] = printed(arguments);
  EXPECT_EQ(found, code) << arguments << "\n" << said;
  for (const std::string& part : parts) EXPECT_TRUE(has(said, part)) << arguments;
  return said;
}
/// Writes a temporary file; returns its path.
inline std::string written(const std::string& name, const std::string& text) {
  const std::string path = scratch() + name;
  std::ofstream(path) << text;
  return path;
}

}  // namespace liecheck::test
