#pragma once
// UrdfError and the messages of the URDF reader: `FILE:LINE: what (value)`.

#include <stdexcept>
#include <string>
#include <vector>

namespace liecheck {

/// A robot that cannot be read. what() is one line, `FILE:LINE: what (value)`. If no line is at fault, what()
/// is `FILE: what (value)` and line() is 0. A long value is cut to 80 bytes;
/// `what` loses its middle beyond 400 bytes, which only a long name makes it exceed.
class UrdfError : public std::runtime_error {
 public:
  UrdfError(const std::string& file, int line, const std::string& what, const std::string& value);
  const std::string& file() const { return file_; }
  int line() const { return line_; }

 private:
  std::string file_;
  int line_;
};

namespace urdf_detail {

/// The errors and warnings of one source.
class Messages {
 public:
  /// strict: a warning is an error.
  explicit Messages(std::string file, bool strict = false) : file_(std::move(file)), strict_(strict) {}
  [[noreturn]] void refuse(int line, const std::string& what, const std::string& value) const;
  void warn(int line, const std::string& what, const std::string& value);
  std::vector<std::string> warnings;

 private:
  std::string file_;
  bool strict_;
};

}  // namespace urdf_detail
}  // namespace liecheck
