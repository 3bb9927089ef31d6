#pragma once
// Reads a file that holds text.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace liecheck {

/// A file that cannot be read. what() says why, for example `cannot be opened (No such file or directory)`.
struct FileError : std::runtime_error {
  std::string problem, value;
  FileError(const std::string& what_failed, const std::string& reason)
      : std::runtime_error(what_failed + " (" + reason + ")"), problem(what_failed), value(reason) {}
};

/// The bytes of a regular file, or of a pipe with a writer. The file is opened and read once. If it is longer
/// than max_bytes, the first max_bytes + 1 bytes are returned. Throws FileError.
std::string readTextFile(const std::string& path, std::size_t max_bytes);

}  // namespace liecheck
