#pragma once
// Files that a test writes. ctest runs tests at the same time, each in a process of its own.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace liecheck {

/// The folder of this process for temporary files, with a "/" at its end. It is removed when the process ends.
inline std::string scratch() {
  struct Folder {
    const pid_t owner = ::getpid();
    const std::string name = testing::TempDir() + "liecheck_" + std::to_string(owner) + "/";
    Folder() { std::filesystem::create_directories(name); }
    ~Folder() {
      std::error_code ignored;
      if (::getpid() == owner)
        std::filesystem::remove_all(name, ignored);  // a child of this process does not
    }
  };
  static const Folder folder;
  return folder.name;
}

/// The folder of the running test in scratch(), with a "/" at its end; empty at first.
inline std::string own_folder() {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = scratch() + test.test_suite_name() + "." + test.name() + "/";
  std::filesystem::remove_all(name);
  std::filesystem::create_directories(name);
  return name;
}

}  // namespace liecheck
