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

FileLock::FileLock(const std::filesystem::path& file) {
  if (file.empty()) return;
  name_ = file.string() + ".lock";
  for (;;) {
    descriptor_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
      throw std::runtime_error(
          fmt::format("{}: cannot be written: {}", name_.string(), std::strerror(errno)));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw std::invalid_argument(fmt::format("{}: another program is writing it", file.string()));
    }
    // The program that had the lock before may have removed this file meanwhile.
    struct stat mine {
    }, there{};
    if (::fstat(descriptor_, &mine) == 0 && ::stat(name_.c_str(), &there) == 0 && mine.st_ino == there.st_ino)
      return;
    ::close(descriptor_);
  }
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  ::unlink(name_.c_str());
  ::close(descriptor_);
}

}  // namespace liecheck::properties
