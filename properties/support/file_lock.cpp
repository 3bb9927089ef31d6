#include <support/file_lock.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace liecheck::properties {

namespace {

struct stat status_of(int descriptor) {
  struct stat s {};
  ::fstat(descriptor, &s);
  return s;
}

/// Whether the name belongs to this open file.
bool is_at(const std::filesystem::path& name, int descriptor) {
  struct stat there {};
  const struct stat mine = status_of(descriptor);
  return ::lstat(name.c_str(), &there) == 0 && mine.st_ino == there.st_ino && mine.st_dev == there.st_dev;
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& file) {
  if (file.empty()) return;
  // Two names of one file have one lock.
  std::error_code error;
  const std::filesystem::path real = std::filesystem::weakly_canonical(file, error);
  name_ = (error ? file : real).string() + ".liecheck-lock";
  for (;;) {
    descriptor_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (descriptor_ < 0)
      throw std::runtime_error(
          fmt::format("{}: cannot be written: {}", name_.string(), std::strerror(errno)));
    const struct stat mine = status_of(descriptor_);
    std::string why;
    if (!S_ISREG(mine.st_mode) || mine.st_size > 0)
      why = fmt::format("{}: is no lock of this program, which would delete it", name_.string());
    else if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      why = fmt::format("{}: another program is writing it", file.string());
    if (why.empty() && is_at(name_, descriptor_)) return;
    ::close(descriptor_);
    // Otherwise the program that had the lock before has removed this file meanwhile.
    if (!why.empty()) throw std::invalid_argument(why);
  }
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  if (is_at(name_, descriptor_)) ::unlink(name_.c_str());
  ::close(descriptor_);
}

}  // namespace liecheck::properties
