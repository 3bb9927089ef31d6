#pragma once
// Files as a program must treat them that runs as root too: read once, replaced whole, devices left in place.

#include <filesystem>
#include <string>
#include <string_view>

namespace liecheck::reports {

/// The bytes of a regular file, or of a pipe that somebody writes to, opened and read once; at most 1 GiB.
/// Throws std::runtime_error naming it.
std::string read_whole(const std::filesystem::path& file);

/// Writes beside the target and renames: a reader sees the old file or the new one, never half of one. A link
/// is followed; what exists and is not a regular file (a device, a pipe) is written in place.
/// Throws std::runtime_error naming it; nothing is left behind then.
void write_whole(const std::filesystem::path& file, std::string_view text);

/// Could write_whole write there? Asked before the hours, not after them; changes nothing. Throws as it does.
void check_writable(const std::filesystem::path& file);

/// A field of a CSV (RFC 4180): quoted where needed, quotes doubled.
std::string quoted(const std::string& text);

}  // namespace liecheck::reports
