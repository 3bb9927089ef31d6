#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <support/files.hpp>
#include <utility>

namespace liecheck::properties {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_bytes = std::size_t(1) << 30;

[[noreturn]] void refuse(const fs::path& file, const char* what, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}: {}", file.string(), what, why));
}

/// An open file, closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }
  /// Some file systems report a failed write only here.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(descriptor, text.data(), text.size());
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) text.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

/// The file that a path names once its symbolic links are resolved.
struct Target {
  fs::path file;
  bool in_place = false;
  mode_t mode = 0;  ///< of the file to be replaced; 0 if there is none
};

Target target_of(fs::path file) {
  constexpr const char* what = "cannot be written";
  std::error_code error;
  const fs::path given = file;
  for (int links = 0; fs::is_symlink(file, error); ++links) {
    // A link in /proc refers to an open file, which may have no path (a pipe).
    const bool open_file = fs::weakly_canonical(file.parent_path(), error).string().starts_with("/proc/");
    if (open_file && fs::is_regular_file(file, error)) refuse(given, what, "a file that is already open");
    if (open_file) break;
    if (links == 40) refuse(given, what, std::strerror(ELOOP));
    const fs::path to = fs::read_symlink(file, error);
    if (error) refuse(given, what, error.message());
    file = file.parent_path() / to;
  }
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    if (errno != ENOENT || !file.has_filename()) refuse(given, what, std::strerror(errno));
    return {file};
  }
  if (S_ISDIR(status.st_mode)) refuse(given, what, "a directory");
  return {file, !S_ISREG(status.st_mode), status.st_mode & 07777};
}

/// A temporary file in the folder of the target. It is removed unless it replaces the target.
class Temporary {
 public:
  explicit Temporary(const Target& target)
      : name_(target.file.string() + ".XXXXXX"), descriptor_(::mkostemp(name_.data(), O_CLOEXEC)) {
    if (descriptor_ < 0) refuse(target.file, "cannot be written", std::strerror(errno));
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(descriptor_, target.mode ? target.mode : 0666 & ~mask);
  }
  ~Temporary() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  bool replace(const fs::path& file, std::string_view text) {
    if (!write_all(descriptor_, text) || !descriptor_.close() || ::rename(name_.c_str(), file.c_str()) != 0)
      return false;
    name_.clear();
    return true;
  }

 private:
  std::string name_;
  Descriptor descriptor_;
};

}  // namespace

std::string read_whole(const fs::path& file) {
  constexpr const char* what = "cannot be read";
  // Without O_NONBLOCK, open would wait for a writer of a FIFO.
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) refuse(file, what, std::strerror(errno));
  const bool pipe = S_ISFIFO(status.st_mode);
  if (S_ISDIR(status.st_mode)) refuse(file, what, "a directory");
  if (!pipe && !S_ISREG(status.st_mode)) refuse(file, what, "neither a regular file nor a pipe");
  ::fcntl(descriptor, F_SETFL, O_RDONLY);
  std::string bytes;
  char part[1 << 16];
  while (const ssize_t n = ::read(descriptor, part, sizeof part)) {
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse(file, what, std::strerror(errno));
    bytes.append(part, static_cast<std::size_t>(n));
    if (bytes.size() > max_bytes) refuse(file, what, fmt::format("longer than {} bytes", max_bytes));
  }
  if (pipe && bytes.empty()) refuse(file, what, "a pipe without a writer");
  return bytes;
}

void write_whole(const fs::path& file, std::string_view text) {
  const Target target = target_of(file);
  bool written = false;
  if (target.in_place) {
    Descriptor descriptor(::open(target.file.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
    if (descriptor >= 0) ::fcntl(descriptor, F_SETFL, O_WRONLY);
    written = descriptor >= 0 && write_all(descriptor, text) && descriptor.close();
  } else {
    written = Temporary(target).replace(target.file, text);
  }
  if (!written) refuse(file, "cannot be written", std::strerror(errno));
}

void check_writable(const fs::path& file) {
  const Target target = target_of(file);
  if (!target.in_place)
    Temporary{target};
  else if (::access(target.file.c_str(), W_OK) != 0)
    refuse(file, "cannot be written", std::strerror(errno));
}

}  // namespace liecheck::properties
