#pragma once
// Reads a file once, or replaces it as a whole. Devices and pipes are never replaced, because a program that
// runs as root could destroy them.

#include <filesystem>
#include <string>
#include <string_view>

namespace liecheck::properties {

/// Returns the bytes of a regular file, or of a pipe that has a writer; at most 1 GiB. The file is opened
/// once. Throws std::runtime_error naming the file.
std::string read_whole(const std::filesystem::path& file);

/// Writes a temporary file and renames it, so that a reader sees the old file or the new one, never a part.
/// Symbolic links are followed. A device or a pipe is written in place. On failure removes the temporary file
/// and throws std::runtime_error naming the file.
void write_whole(const std::filesystem::path& file, std::string_view text);

/// Throws what write_whole would throw, without writing. Called before long work, whose result would be lost.
void check_writable(const std::filesystem::path& file);

}  // namespace liecheck::properties
