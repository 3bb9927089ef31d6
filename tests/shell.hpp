#pragma once
// Lines of the shell that a test runs.

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace liecheck {

/// The exit code of a line (-1 if a signal ended it), and what it writes to both streams.
struct Answer {
  int code;
  std::string text;
};
inline Answer shell(const std::string& line) {
  std::FILE* const out = ::popen(("{ " + line + "\n} 2>&1").c_str(), "r");
  std::string text;
  for (int c = 0; (c = std::fgetc(out)) != EOF;) text += static_cast<char>(c);
  const int status = ::pclose(out);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

}  // namespace liecheck
