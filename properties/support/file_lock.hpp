#pragma once
// One program at a time works on a file.

#include <filesystem>

namespace liecheck::properties {

/// While it exists, no other program has a lock of the same file. "" is no file. The lock is an empty file beside it,
/// FILE.liecheck-lock, which ends with the program.
class FileLock {
 public:
  /// Throws std::invalid_argument that names the file if another program has it, or a file with the lock's name is no
  /// lock, and std::runtime_error if the lock cannot be written.
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::filesystem::path name_;
  int descriptor_ = -1;
};

}  // namespace liecheck::properties
