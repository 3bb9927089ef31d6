#include <support/folder.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <stdexcept>
#include <support/files.hpp>

namespace liecheck::properties {

namespace fs = std::filesystem;

void make_folder(const std::string& flag, const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw std::runtime_error(fmt::format("{} {}: cannot be created: {}", flag, folder, error.message()));
}

bool is_inside(const fs::path& folder, fs::path file) {
  std::error_code error;
  // weakly_canonical() does not follow a link to what does not exist, which writing would create.
  for (int links = 0; fs::is_symlink(file, error) && links < 40; ++links)
    file = file.parent_path() / fs::read_symlink(file, error);
  const fs::path top = fs::canonical(folder, error);
  if (error || fs::is_symlink(file, error)) return false;
  const fs::path real = fs::weakly_canonical(fs::absolute(file), error);
  return !error && std::ranges::mismatch(top, real).in1 == top.end();
}

fs::path file_in(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name;
  std::error_code error;
  if (fs::is_symlink(file, error) && !is_inside(folder, file))
    throw std::runtime_error(fmt::format("{}: is a link out of the folder: remove it", file.string()));
  check_not_kept(file);
  return file;
}

}  // namespace liecheck::properties
