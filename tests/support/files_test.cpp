// support/files.hpp: a file is read once. It is replaced whole, written in place, or left as it was.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <support/file_lock.hpp>
#include <support/files.hpp>
#include <support/json.hpp>

#include "../refusal.hpp"
#include "../scratch.hpp"

namespace {

namespace fs = std::filesystem;
using namespace liecheck::properties;

class Files : public testing::Test {
 protected:
  const fs::path dir = liecheck::own_folder();
  static std::string read(const fs::path& file) { return read_whole(file); }
  long entries() const { return std::distance(fs::directory_iterator(dir), {}); }
  static std::string refusal(const auto& f) { return liecheck::test::refusal<std::runtime_error>(f); }
};

TEST_F(Files, AFileIsReplacedWholeAndKeepsItsMode) {
  const fs::path file = dir / "a";
  std::ofstream(dir / "a.part") << "of the user";
  check_writable(file);
  EXPECT_FALSE(fs::exists(file));
  write_whole(file, "old and long");
  ::chmod(file.c_str(), 0640);
  write_whole(file, "new");
  EXPECT_EQ(read(file), "new");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0640));
  EXPECT_EQ(read(dir / "a.part"), "of the user");
  EXPECT_EQ(entries(), 2);
}

TEST_F(Files, SymbolicLinksAreFollowedAndNotReplaced) {
  fs::create_symlink("b", dir / "a");
  fs::create_symlink("c", dir / "b");
  write_whole(dir / "a", "text");
  EXPECT_TRUE(fs::is_symlink(dir / "a") && fs::is_symlink(dir / "b"));
  EXPECT_EQ(read(dir / "c"), "text");
  fs::create_symlink("loop", dir / "loop");
  EXPECT_NE(refusal([&] { write_whole(dir / "loop", "x"); }), "");
}

TEST_F(Files, ADeviceOrPipeIsNeverReplaced) {
  const fs::path pipe = dir / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  check_writable(pipe);
  EXPECT_NE(refusal([&] { write_whole(pipe, "x"); }).find("cannot be written"), std::string::npos);
  EXPECT_NE(refusal([&] { read_whole(pipe); }).find("a pipe without a writer"), std::string::npos);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_NE(refusal([&] { write_whole(dir, "x"); }).find("a directory"), std::string::npos);
  EXPECT_NE(refusal([&] { read_whole(dir); }).find("a directory"), std::string::npos);
  EXPECT_EQ(entries(), 1);
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  write_whole("/proc/self/fd/" + std::to_string(ends[1]), "through");
  ::close(ends[1]);
  EXPECT_EQ(read_whole("/proc/self/fd/" + std::to_string(ends[0])), "through");
  ::close(ends[0]);
}

TEST_F(Files, CheckWritableRefusesBeforeAnythingIsWritten) {
  for (const fs::path& file : {dir / "none" / "a", dir / "", fs::path("")})
    EXPECT_NE(refusal([&] { check_writable(file); }).find("cannot be written"), std::string::npos) << file;
  EXPECT_EQ(entries(), 0);
}

TEST_F(Files, ALockHoldsForEveryNameOfAFileAndDeletesNoFileOfOthers) {
  std::ofstream(dir / "state") << "{}";
  fs::create_symlink("state", dir / "link");
  const fs::path its = dir / "state.liecheck-lock";
  {
    const FileLock lock(dir / "state");
    EXPECT_TRUE(fs::exists(its));
    EXPECT_THROW(FileLock(dir / "state"), std::invalid_argument);
    EXPECT_THROW(FileLock(dir / "link"), std::invalid_argument);
    EXPECT_TRUE(fs::exists(its));
  }
  EXPECT_FALSE(fs::exists(its));
  std::ofstream(its) << "precious";
  EXPECT_THROW(FileLock(dir / "state"), std::invalid_argument);
  EXPECT_EQ(read(its), "precious");
  fs::remove(its);
  ASSERT_EQ(::mkfifo(its.c_str(), 0600), 0);
  EXPECT_THROW(FileLock(dir / "state"), std::invalid_argument);
  fs::remove(its);
  {
    const FileLock lock(dir / "state");
    fs::remove(its);
    std::ofstream(its) << "another file";
  }
  EXPECT_EQ(read(its), "another file");
}

TEST(JsonText, HasNoControlCharacters) {
  const std::string text = "a\x7f\xc2\x9b\xc3\xa9";
  EXPECT_EQ(dumped(text), "\"a\\u007f\\u009b\xc3\xa9\"");
  EXPECT_EQ(parsed(dumped(text)), text);
}

TEST(JsonText, IsRefusedIfItIsNestedTooDeeply) {
  const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  EXPECT_NO_THROW(parsed(nested(100)));
  EXPECT_THROW(parsed(nested(102)), nlohmann::json::exception);
  EXPECT_THROW(parsed(nested(1'000'000)), nlohmann::json::exception);
}

}  // namespace
