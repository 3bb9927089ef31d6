#pragma once
// The library compiled with other compilers and flags, one module each beside the program.
//
// A template instantiated twice in one program is one function, whichever flags the linker's choice had. So each set of
// flags is an object of its own, timing/module/operations.cpp: hidden but for one function, and
// loaded with RTLD_LOCAL. Flags that change how types lie in memory (Eigen aligns by the widest vector) are caught by
// `layout`.

#include <array>
#include <filesystem>
#include <subjects/subject.hpp>

namespace liecheck::properties {

struct Kernels {
  const char* flags;
  std::array<std::size_t, 5> layout;  ///< kernels_layout() there
  const Operations<double>* operations;
};

/// Sizes and alignments of what crosses the border.
constexpr std::array<std::size_t, 5> kernels_layout() {
  return {alignof(Vec<double, 4>), alignof(Mat<double, 6>), alignof(Pose<double>), sizeof(Pose<double>),
          sizeof(Operations<double>)};
}

/// Beside the running program: ../kernels.
std::filesystem::path kernels_folder();

/// Is there a module in it?
bool has_kernels(const std::filesystem::path& folder = kernels_folder());

/// A subject for each module of the folder, alphabetical: "liecheck@gcc-O2", with the flags as its version. Loaded for
/// good. Throws std::runtime_error naming the folder that has none, or a module that cannot be loaded or was built for
/// another layout.
std::vector<Subject<double>> load_kernels(const std::filesystem::path& folder = kernels_folder());

}  // namespace liecheck::properties
