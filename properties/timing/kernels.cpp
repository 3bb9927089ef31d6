#include <timing/kernels.hpp>

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace liecheck::properties {

std::filesystem::path kernels_folder() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "kernels";
}

namespace {

std::vector<std::filesystem::path> modules_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> modules;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".so") modules.push_back(entry.path());
  return modules;
}

}  // namespace

bool has_kernels(const std::filesystem::path& folder) {
  return !modules_of(folder).empty();
}

std::vector<TypedSubject<double>> load_kernels(const std::filesystem::path& folder) {
  auto modules = modules_of(folder);
  if (modules.empty())
    throw std::runtime_error(
        fmt::format("--flags: {} has no modules: build the target kernels", folder.string()));
  std::sort(modules.begin(), modules.end());
  std::vector<TypedSubject<double>> all;
  for (const auto& path : modules) {
    void* const module = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) throw std::runtime_error(::dlerror());  // names the file
    const auto get = reinterpret_cast<const Kernels* (*)()>(::dlsym(module, "liecheck_kernels"));
    if (!get) throw std::runtime_error(fmt::format("{}: not a kernel module of liecheck", path.string()));
    const Kernels& k = *get();
    if (k.layout != kernels_layout())
      throw std::runtime_error(
          fmt::format("{}: built with other type layouts than this program: rebuild both", path.string()));
    all.push_back({"liecheck@" + path.stem().string(), k.flags, *k.operations});
  }
  return all;
}

}  // namespace liecheck::properties
