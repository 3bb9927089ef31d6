#pragma once
// Files: read once, replaced whole, and never a device or pipe replaced, since the program may run as root.

#include <filesystem>
#include <string>
#include <string_view>

namespace liecheck::properties {

/// Returns the bytes of a regular file, or of a pipe that has a writer, opened and read once; at most 1 GiB.
/// Throws std::runtime_error naming the file.
std::string read_whole(const std::filesystem::path& file);

/// Writes a temporary file beside the target and renames it: a reader sees the old file or the new one, never half of
/// one. Links are followed; a target that is a device or a pipe is written in place.
/// Throws std::runtime_error naming the file, and then leaves nothing behind.
void write_whole(const std::filesystem::path& file, std::string_view text);

/// Throws what write_whole would throw, and changes nothing: so that long work does not fail at its end.
void check_writable(const std::filesystem::path& file);

}  // namespace liecheck::properties
