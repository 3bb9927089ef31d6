#pragma once
// A folder into which a command writes files, whose names the command chooses.

#include <filesystem>
#include <string>

namespace liecheck::properties {

/// Creates the folder. Throws std::runtime_error that names the flag and the folder.
void make_folder(const std::string& flag, const std::string& folder);

/// Whether the file, with its links resolved, is in the folder or below it. It need not exist.
bool is_inside(const std::filesystem::path& folder, std::filesystem::path file);

/// The path of the file in the folder. Throws std::runtime_error if a link of that name leads out of the folder.
std::filesystem::path file_in(const std::filesystem::path& folder, const std::string& name);

}  // namespace liecheck::properties
