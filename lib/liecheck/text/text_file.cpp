#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <liecheck/text/text_file.hpp>
#include <memory>

namespace liecheck {

std::string readTextFile(const std::string& path, std::size_t max_bytes) {
  // O_NONBLOCK: opening a FIFO without a writer would block.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) throw FileError("cannot be opened", std::strerror(errno));
  const auto refuse = [](const std::string& why) { throw FileError("cannot be read", why); };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(::fdopen(descriptor, "rb"), std::fclose);
  struct stat status {};
  if (!file || ::fstat(descriptor, &status) != 0) refuse(std::strerror(errno));
  const bool pipe = S_ISFIFO(status.st_mode);
  if (S_ISDIR(status.st_mode)) refuse("a directory");
  if (!pipe && !S_ISREG(status.st_mode)) refuse("neither a regular file nor a pipe");
  ::fcntl(descriptor, F_SETFL, O_RDONLY);
  std::string text(std::min(std::size_t(1) << 16, max_bytes + 1), 0);
  std::size_t size = 0;
  while (const std::size_t n = std::fread(&text[size], 1, text.size() - size, file.get())) {
    size += n;
    if (size == text.size()) text.resize(std::min(2 * size, max_bytes + 1));
  }
  if (std::ferror(file.get())) refuse(std::strerror(errno));
  if (pipe && size == 0) refuse("a pipe without a writer");
  text.resize(size);
  return text;
}

}  // namespace liecheck
