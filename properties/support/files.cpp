#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <support/files.hpp>
#include <utility>

namespace liecheck::properties {

namespace {

namespace fs = std::filesystem;

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

}  // namespace

std::string read_whole(const fs::path& file, std::size_t most_bytes) {
  constexpr const char* what = "cannot be read";
  // Without O_NONBLOCK, open would wait for a writer of a FIFO.
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) refuse(file, what, std::strerror(errno));
  const bool pipe = S_ISFIFO(status.st_mode);
  if (S_ISDIR(status.st_mode)) refuse(file, what, "a directory");
  if (!pipe && !S_ISREG(status.st_mode)) refuse(file, what, "neither a regular file nor a pipe");
  const auto refuse_long = [&] { refuse(file, what, fmt::format("longer than {} bytes", most_bytes)); };
  if (!pipe && static_cast<std::uintmax_t>(status.st_size) > most_bytes) refuse_long();
  ::fcntl(descriptor, F_SETFL, O_RDONLY);
  std::string bytes;
  char part[1 << 16];
  while (const ssize_t n = ::read(descriptor, part, sizeof part)) {
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse(file, what, std::strerror(errno));
    bytes.append(part, static_cast<std::size_t>(n));
    if (bytes.size() > most_bytes) refuse_long();
  }
  if (pipe && bytes.empty()) refuse(file, what, "a pipe without a writer");
  return bytes;
}

Replacement::Replacement(const fs::path& file) {
  const Target target = target_of(file);
  if (target.in_place) refuse(file, "cannot be replaced", "not a regular file");
  file_ = target.file;
  std::string name = file_.string() + ".XXXXXX";
  const Descriptor descriptor(::mkostemp(name.data(), O_CLOEXEC));
  if (descriptor < 0) refuse(file_, "cannot be written", std::strerror(errno));
  name_ = name;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  mode_ = target.mode ? target.mode : 0666 & ~mask;
}

Replacement::~Replacement() {
  if (!name_.empty()) ::unlink(name_.c_str());
}

void Replacement::take_place(Place place) {
  const auto rename = [&](unsigned flags) {
    return ::renameat2(AT_FDCWD, name_.c_str(), AT_FDCWD, file_.c_str(), flags) == 0;
  };
  ::chmod(name_.c_str(), mode_);
  bool done = rename(place == Place::empty ? RENAME_NOREPLACE : 0);
  if (!done && errno == EEXIST) refuse(file_, "was created by another process", "it was left as it is");
  if (!done && errno == EINVAL) done = rename(0);  // some file systems do not know the flag
  if (!done) refuse(file_, "cannot be written", std::strerror(errno));
  name_.clear();
}

void write_whole(const fs::path& file, std::string_view text) {
  check_not_kept(file);
  const Target target = target_of(file);
  std::optional<Replacement> whole;
  if (!target.in_place) whole.emplace(file);
  Descriptor descriptor(
      ::open(whole ? whole->name().c_str() : target.file.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
  if (descriptor >= 0) ::fcntl(descriptor, F_SETFL, O_WRONLY);
  if (descriptor < 0 || !write_all(descriptor, text) || !descriptor.close())
    refuse(file, "cannot be written", std::strerror(errno));
  if (whole) whole->take_place();
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (a.empty() || b.empty() || (fs::exists(a, error) && !fs::is_regular_file(a, error))) return false;
  const fs::path first = fs::weakly_canonical(a, error);
  return !error && first == fs::weakly_canonical(b, error) && !error;
}

std::vector<std::string> files_named(const std::string& argument) {
  std::vector<std::string> all{argument};
  if (std::error_code error; fs::exists(argument, error)) return all;
  all.push_back(argument.substr(0, argument.rfind('@')));
  constexpr const char* between = " \t'\"";
  for (std::size_t at = 0; (at = argument.find_first_not_of(between, at)) != argument.npos;) {
    const std::size_t end = std::min(argument.find_first_of(between, at), argument.size());
    all.push_back(argument.substr(at, end - at));
    at = end;
  }
  return all;
}

namespace {
std::vector<std::pair<std::string, std::string>> kept;  // files, and what stands for them
}

void keep_files(const std::string& argument, const std::string& what) {
  for (const std::string& file : files_named(argument)) kept.emplace_back(file, what);
}

void check_not_kept(const fs::path& file) {
  for (const auto& [other, what] : kept)
    if (same_file(other, file.string()))
      throw std::invalid_argument(
          fmt::format("{}: would replace {}: give it another name", file.string(), what));
}

void check_writable(const fs::path& file) {
  check_not_kept(file);
  const Target target = target_of(file);
  if (!target.in_place)
    Replacement{file};
  else if (::access(target.file.c_str(), W_OK) != 0)
    refuse(file, "cannot be written", std::strerror(errno));
}

}  // namespace liecheck::properties
