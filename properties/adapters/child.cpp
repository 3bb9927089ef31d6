#include <adapters/child.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <adapters/noise.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <support/stop.hpp>
#include <utility>

namespace liecheck::properties::adapters {
namespace {

/// The process groups of the adapters that run, or 0.
std::array<std::atomic<pid_t>, 256> groups{};

void replace_group(pid_t from, pid_t to) {
  for (auto& group : groups)
    if (pid_t expected = from; group.compare_exchange_strong(expected, to)) return;
}

constexpr std::size_t longest_line = 1 << 16;
constexpr off_t most_errors = 1 << 20;           ///< that are kept [bytes]
constexpr rlim_t most_memory = rlim_t(4) << 30;  ///< of an adapter [bytes]

/// While it exists, writing to a pipe that nobody reads is an error of this thread, and no signal.
class WithoutSigpipe {
 public:
  WithoutSigpipe() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  WithoutSigpipe(const WithoutSigpipe&) = delete;
  WithoutSigpipe& operator=(const WithoutSigpipe&) = delete;
  ~WithoutSigpipe() {
    const timespec now{};
    while (sigtimedwait(&pipe_, nullptr, &now) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t pipe_{}, before_{};
};

/// What became of a process whose status waitpid() returned. A shell reports a signal as 128 + its number.
std::string ending(int status) {
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  const int number = WIFSIGNALED(status) ? WTERMSIG(status) : code > 128 && code < 160 ? code - 128 : 0;
  if (number) return fmt::format("ended by signal {} ({})", number, strsignal(number));
  if (code == 127) return "ended with exit code 127: the shell did not find the command";
  return fmt::format("ended with exit code {}", code);
}

}  // namespace

void kill_children() {
  for (const auto& group : groups)
    if (const pid_t id = group; id > 0) kill(-id, SIGKILL);
}

std::string quoted(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return text.size() > 60 ? "'" + text.substr(0, 60) + "'..." : "'" + text + "'";
}

Child::Child(const std::string& command, double timeout_s) {
  set_timeout(timeout_s);
  std::array<int, 2> in{}, out{};
  if (pipe2(in.data(), O_CLOEXEC)) fail("cannot be started: no pipe");
  if (pipe2(out.data(), O_CLOEXEC)) close(in[0]), close(in[1]), fail("cannot be started: no pipe");
  to_ = in[1], from_ = out[0];
  errors_ = memfd_create("errors", MFD_CLOEXEC);
  pid_ = fork();
  if (pid_ == 0) {  // only functions that are safe in the child of a program with threads
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    sigset_t none;
    sigemptyset(&none);
    pthread_sigmask(SIG_SETMASK, &none, nullptr);
    for (int s : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(s, SIG_DFL);
    const rlimit memory{most_memory, most_memory};
    setrlimit(RLIMIT_DATA, &memory);
    if (errors_ >= 0) dup2(errors_, 2);
    if (dup2(in[0], 0) == 0 && dup2(out[1], 1) == 1)
      execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(in[0]), close(out[1]);
  if (pid_ < 0) close(to_), close(from_), fail("cannot be started: no process");
  replace_group(0, pid_);
  for (int fd : {to_, from_}) fcntl(fd, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
  close(to_), close(from_);
  if (!ended_ && pid_ > 0) {
    kill(-pid_, SIGKILL), kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (pid_ > 0) replace_group(pid_, 0);
  pass_on(errors());
  if (errors_ >= 0) close(errors_);
}

std::string Child::errors() {
  struct stat file {};
  if (fstat(errors_, &file) != 0 || file.st_size == 0) return "";
  std::string text(static_cast<std::size_t>(std::min<off_t>(file.st_size, longest_line)), ' ');
  const ssize_t n = pread(errors_, text.data(), text.size(), file.st_size - static_cast<off_t>(text.size()));
  text.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
  // The child and this process share the position, so that it goes on at the beginning.
  if (ftruncate(errors_, 0) != 0 || lseek(errors_, 0, SEEK_SET) != 0) return text;
  return text;
}

void Child::set_timeout(double timeout_s) {
  timeout_ = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_s));
}

void Child::begin() {
  struct stat file {};
  if (fstat(errors_, &file) == 0 && file.st_size > most_errors) pass_on(errors());
  end_ = Clock::now() + timeout_;
}

void Child::write(const void* bytes, std::size_t size) {
  const WithoutSigpipe guard;
  for (const char* at = static_cast<const char*>(bytes); size > 0;) {
    const ssize_t n = ::write(to_, at, size);
    if (n > 0) {
      at += n, size -= static_cast<std::size_t>(n);
    } else if (n < 0 && errno == EAGAIN) {
      wait(to_, POLLOUT, "did not read its input");
    } else if (n < 0 && errno != EINTR) {
      fail(how_it_ended());
    }
  }
}

std::string Child::line(const std::string& due) {
  for (std::size_t end = 0;;) {
    if (end = buffer_.find('\n'); end != std::string::npos) {
      std::string text = buffer_.substr(0, end);
      buffer_.erase(0, end + 1);
      return text;
    }
    if (buffer_.size() > longest_line)
      fail(fmt::format("wrote {} where {} is due: a line has at most {} bytes", quoted(buffer_), due,
                       longest_line));
    read_some(fmt::format(
        "wrote {} in {:g} s where {} is due{}", buffer_.empty() ? "nothing" : quoted(buffer_), seconds(), due,
        buffer_.empty() && due == "its description"
            ? "; does it flush its output, and read a line without waiting for more than it?"
            : ""));
  }
}

void Child::read(std::span<std::byte> to) {
  while (buffer_.size() < to.size())
    read_some(fmt::format("wrote {} of {} bytes of its results, and then nothing for {:g} s", buffer_.size(),
                          to.size(), seconds()));
  std::memcpy(to.data(), buffer_.data(), to.size());
  buffer_.erase(0, to.size());
}

void Child::wait_for_a_byte() {
  if (buffer_.empty()) read_some(fmt::format("gave no answer in {:g} s", seconds()));
  buffer_.clear();
}

void Child::wait(int fd, short events, const std::string& late) {
  pollfd p{fd, events, 0};
  for (;;) {
    constexpr long look = 100;  // [ms] between two looks at whether the program must end
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now()).count();
    const int ready = left > 0 ? poll(&p, 1, static_cast<int>(std::min<long>(left, look))) : 0;
    if (ready > 0) return;
    if (left <= 0) throw TimedOut("the adapter " + late);
    if (ready < 0 && errno != EINTR) fail("cannot be waited for");
    if (GivesUp::now()) throw GivenUp{};
    if (!waiting_.empty() && Clock::now() > end_ - timeout_ + std::chrono::seconds(1) && isatty(2))
      std::fprintf(stderr, "%s\n", std::exchange(waiting_, "").c_str());
  }
}

void Child::read_some(const std::string& late) {
  std::array<char, 1 << 16> block;
  const ssize_t n = ::read(from_, block.data(), block.size());
  if (n > 0)
    buffer_.append(block.data(), static_cast<std::size_t>(n));
  else if (n == 0)
    fail(how_it_ended());
  else if (errno == EAGAIN)
    wait(from_, POLLIN, late);
  else if (errno != EINTR)
    fail("cannot be read");
}

/// The pipe is closed, so the process has ended or will never answer.
std::string Child::how_it_ended() {
  int status = 0;
  for (int i = 0; i < 50 && pid_ > 0; ++i) {
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      ended_ = true;
      kill(-pid_, SIGKILL);  // what it started
      return ending(status);
    }
    usleep(2000);
  }
  return "closed its output";
}

}  // namespace liecheck::properties::adapters
