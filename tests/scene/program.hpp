#pragma once
// Calls of the program `liecheck`.

#include <sys/wait.h>

#include <cstdio>
#include <fstream>

#include "../scratch.hpp"
#include "bodies.hpp"

namespace liecheck::test {

/// The exit code of the program, and its output on both streams.
inline std::pair<int, std::string> printed(const std::string& arguments) {
  std::FILE* pipe = ::popen(("(" + std::string(LIECHECK_PROGRAM) + " " + arguments + ") 2>&1").c_str(), "r");
  std::string said;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) said += char(c);
  const int status = ::pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, said};
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
