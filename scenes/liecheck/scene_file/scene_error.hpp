#pragma once
// The error of a scene file.

#include <stdexcept>
#include <string>

namespace liecheck {

/// A scene that cannot be read or is inconsistent. what() is one line: `FILE:LINE: what is wrong, and what to
/// write instead`. If no line is at fault, what() is `FILE: ...` and line() is 0.
class SceneError : public std::runtime_error {
 public:
  SceneError(const std::string& file, int line, const std::string& what)
      : std::runtime_error(file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what),
        file_(file),
        line_(line) {}
  const std::string& file() const { return file_; }
  int line() const { return line_; }

 private:
  std::string file_;
  int line_;
};

}  // namespace liecheck
