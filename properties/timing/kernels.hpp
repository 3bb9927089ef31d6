#pragma once
// Loads the library compiled with other compilers and flags. Each combination is a module (a shared library).
//
// In one program, the linker keeps one copy of a template function, whatever its flags. So each set of flags
// has a module, built from timing/module/operations.cpp. It exports one function and is loaded with
// RTLD_LOCAL. Some flags change the layout of types in memory, because Eigen's alignment depends on the
// widest vector instructions. `layout` detects such a difference.

#include <array>
#include <filesystem>
#include <subjects/typed.hpp>

namespace liecheck::properties {

struct Kernels {
  const char* flags;
  std::array<std::size_t, 5> layout;  ///< kernels_layout() of the module
  const TypedOperations<double>* operations;
};

/// Sizes and alignments of the types that program and module share.
constexpr std::array<std::size_t, 5> kernels_layout() {
  return {alignof(Vec<double, 4>), alignof(Mat<double, 6>), alignof(Pose<double>), sizeof(Pose<double>),
          sizeof(TypedOperations<double>)};
}

/// The folder `kernels` next to the folder of the running program.
std::filesystem::path kernels_folder();

/// Whether the folder has a module.
bool has_kernels(const std::filesystem::path& folder = kernels_folder());

/// Loads the modules of the folder. Returns a subject for each, in alphabetical order, with a name such as
/// "liecheck@gcc-O2" and the flags as its version. Throws std::runtime_error naming a folder without modules,
/// or a module that cannot be loaded or was built with other type layouts.
std::vector<TypedSubject<double>> load_kernels(const std::filesystem::path& folder = kernels_folder());

}  // namespace liecheck::properties
