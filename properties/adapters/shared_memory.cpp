#include <adapters/shared_memory.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>

namespace liecheck::properties::adapters {

SharedMemory::SharedMemory() : file_(memfd_create("liecheck", MFD_CLOEXEC | MFD_ALLOW_SEALING)) {
  // Sealed, because a library that cuts it off would end both processes by SIGBUS.
  if (file_ >= 0 && (ftruncate(file_, sizeof(Exchange)) ||
                     fcntl(file_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL)))
    close(file_), file_ = -1;
  map("new shared memory");
  new (exchange_) Exchange;
}

SharedMemory::SharedMemory(const std::string& file) : file_(open(file.c_str(), O_RDWR | O_CLOEXEC)) {
  if (file_ >= 0 && lseek(file_, 0, SEEK_END) != sizeof(Exchange)) {
    close(file_);
    throw AdapterFailed(file + " is no shared memory of this version");
  }
  map(file.c_str());
}

SharedMemory::~SharedMemory() {
  munmap(exchange_, sizeof(Exchange));
  close(file_);
}

std::string SharedMemory::path() const {
  return fmt::format("/proc/{}/fd/{}", getpid(), file_);
}

void SharedMemory::map(const char* what) {
  void* const at =
      file_ < 0 ? MAP_FAILED : mmap(nullptr, sizeof(Exchange), PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (at == MAP_FAILED) {
    const int error = errno;
    if (file_ >= 0) close(file_);
    throw AdapterFailed(fmt::format("{} cannot be used ({})", what, std::strerror(error)));
  }
  exchange_ = static_cast<Exchange*>(at);
}

}  // namespace liecheck::properties::adapters
