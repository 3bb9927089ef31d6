#pragma once
// Reads a file once, or replaces it as a whole. Devices and pipes are never replaced, because a program that
// runs as root could destroy them.

#include <filesystem>
#include <string>
#include <string_view>
#include <support/stop.hpp>
#include <vector>

namespace liecheck::properties {

/// Returns the bytes of a regular file, or of a pipe that has a writer; by default at most 1 GiB. The file is opened
/// once. Throws std::runtime_error naming the file.
std::string read_whole(const std::filesystem::path& file, std::size_t most_bytes = std::size_t(1) << 30);

/// A new, empty file in the folder of `file`. It takes the place of `file`, with its mode, or the destructor
/// removes it. As long as it exists, a signal does not end the program.
class Replacement {
 public:
  enum class Place { any, empty };
  /// Throws std::runtime_error naming the file. Symbolic links are followed.
  explicit Replacement(const std::filesystem::path& file);
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  const std::string& name() const { return name_; }
  /// Throws std::runtime_error naming the file; with Place::empty also if another process has created it.
  void take_place(Place place = Place::any);

 private:
  const Unfinished guard_;
  std::filesystem::path file_;
  std::string name_;
  unsigned mode_ = 0;
};

/// Writes a temporary file and renames it, so that a reader sees the old file or the new one, never a part.
/// Symbolic links are followed. A device or a pipe is written in place. On failure removes the temporary file
/// and throws std::runtime_error naming the file.
void write_whole(const std::filesystem::path& file, std::string_view text);

/// Whether both names mean one file that can be replaced, or will once it exists. "" names no file.
bool same_file(const std::string& a, const std::string& b);

/// The files that an argument may name: its text or, if there is no such file, the store of FILE@N and each word of an
/// adapter's command.
std::vector<std::string> files_named(const std::string& argument);

/// From now on, write_whole(), check_writable() and file_in() refuse to replace the files that this argument names. `what`
/// stands for them in the message, as in "the file of --limits".
void keep_files(const std::string& argument, const std::string& what);

/// Throws std::invalid_argument if a file of keep_files() has this name or a link to it.
void check_not_kept(const std::filesystem::path& file);

/// Throws what write_whole would throw, without writing. Called before long work, whose result would be lost.
void check_writable(const std::filesystem::path& file);

}  // namespace liecheck::properties
