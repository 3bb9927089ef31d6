// The client of the process protocol: docs/adapters.md.

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <adapters/adapter.hpp>
#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <support/json.hpp>
#include <support/text.hpp>

namespace liecheck::properties::adapters {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers of the protocol are little-endian");

struct TimedOut : AdapterFailed {
  using AdapterFailed::AdapterFailed;
};

constexpr std::size_t longest_line = 1 << 16;
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

/// At most 60 printable characters of what an adapter wrote.
std::string quoted(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return text.size() > 60 ? "'" + text.substr(0, 60) + "'..." : "'" + text + "'";
}

/// A running child in a process group of its own, so that Ctrl-C on the terminal does not reach it.
class Child {
 public:
  Child(const std::string& command, double timeout_s) {
    set_timeout(timeout_s);
    std::array<int, 2> in{}, out{};
    if (pipe2(in.data(), O_CLOEXEC)) fail("cannot be started: no pipe");
    if (pipe2(out.data(), O_CLOEXEC)) close(in[0]), close(in[1]), fail("cannot be started: no pipe");
    to_ = in[1], from_ = out[0];
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
      if (dup2(in[0], 0) == 0 && dup2(out[1], 1) == 1)
        execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    close(in[0]), close(out[1]);
    if (pid_ < 0) close(to_), close(from_), fail("cannot be started: no process");
    for (int fd : {to_, from_}) fcntl(fd, F_SETFL, O_NONBLOCK);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    close(to_), close(from_);
    if (ended_) return;
    kill(-pid_, SIGKILL), kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  void set_timeout(double timeout_s) {
    timeout_ = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_s));
  }
  /// The next exchange may take the whole timeout.
  void begin() { end_ = Clock::now() + timeout_; }
  void write(const void* bytes, std::size_t size) {
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
  /// The next line, without its end. `due` names what is expected.
  std::string line(const std::string& due) {
    for (std::size_t end = 0;;) {
      if (end = buffer_.find('\n'); end != std::string::npos) {
        std::string text = buffer_.substr(0, end);
        buffer_.erase(0, end + 1);
        return text;
      }
      if (buffer_.size() > longest_line) fail(fmt::format("wrote {} where {} is due", quoted(buffer_), due));
      read_some(fmt::format("wrote {} in {:g} s where {} is due",
                            buffer_.empty() ? "nothing" : quoted(buffer_), seconds(), due));
    }
  }
  void read(std::span<std::byte> to) {
    while (buffer_.size() < to.size())
      read_some(fmt::format("wrote {} of {} bytes of its results, and then nothing for {:g} s",
                            buffer_.size(), to.size(), seconds()));
    std::memcpy(to.data(), buffer_.data(), to.size());
    buffer_.erase(0, to.size());
  }
  std::size_t left_over() const { return buffer_.size(); }
  [[noreturn]] static void fail(const std::string& what) { throw AdapterFailed("the adapter " + what); }

 private:
  using Clock = std::chrono::steady_clock;
  double seconds() const { return std::chrono::duration<double>(timeout_).count(); }
  void wait(int fd, short events, const std::string& late) {
    pollfd p{fd, events, 0};
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now()).count();
    const int ready = left > 0 ? poll(&p, 1, static_cast<int>(left)) : 0;
    if (ready == 0) throw TimedOut("the adapter " + late);
    if (ready < 0 && errno != EINTR) fail("cannot be waited for");
  }
  void read_some(const std::string& late) {
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
  std::string how_it_ended() {
    int status = 0;
    for (int i = 0; i < 50; ++i) {
      if (waitpid(pid_, &status, WNOHANG) == pid_) {
        ended_ = true;
        kill(-pid_, SIGKILL);  // what it started
        return ending(status);
      }
      usleep(2000);
    }
    return "closed its output";
  }

  Clock::duration timeout_{};
  Clock::time_point end_;
  int to_ = -1, from_ = -1;
  pid_t pid_ = -1;
  bool ended_ = false;
  std::string buffer_;
};

Description described(const std::string& line) {
  const auto wrong = [&](const std::string& what) -> AdapterFailed {
    return AdapterFailed(fmt::format(
        "the adapter's description {} {}: it must be one line of JSON, such as {{\"protocol\": 1, \"name\": "
        "\"mylib\", \"version\": \"2.1\", \"operations\": {{\"exp6\": [\"double\"]}}}}",
        quoted(line), what));
  };
  nlohmann::json j;
  try {
    j = parsed(line);
  } catch (const nlohmann::json::exception&) {
    throw wrong("is no JSON");
  }
  if (!j.is_object() || !j.contains("protocol")) throw wrong("has no member 'protocol'");
  if (j["protocol"] != 1)
    throw AdapterFailed(fmt::format(
        "the adapter speaks version {} of the protocol, and this program version 1", j["protocol"].dump()));
  Description d;
  for (const auto& [member, to] : {std::pair{"name", &d.name}, {"version", &d.version}}) {
    if (!j.contains(member) || !j[member].is_string()) throw wrong(fmt::format("has no text '{}'", member));
    *to = j[member];
  }
  if (!j.contains("operations") || !j["operations"].is_object()) throw wrong("has no object 'operations'");
  for (const auto& [operation, scalars] : j["operations"].items()) {
    if (!scalars.is_array()) throw wrong(fmt::format("has no list of scalars for {}", operation));
    for (const auto& scalar : scalars) {
      if (scalar != "float" && scalar != "double")
        throw wrong(fmt::format("offers {} in {}, which is neither \"float\" nor \"double\"", operation,
                                scalar.dump()));
      d.offered.emplace(operation, scalar);
    }
  }
  const nlohmann::json conventions = j.value("conventions", nlohmann::json::object());
  if (!conventions.is_object()) throw wrong("has no object 'conventions'");
  for (const auto& [name, value] : conventions.items()) {
    if (!value.is_string()) throw wrong(fmt::format("has no text for the convention '{}'", name));
    d.conventions[name] = value;
  }
  return d;
}

class Process final : public Adapter {
 public:
  Process(std::string command, double timeout_s) : command_(std::move(command)), timeout_s_(timeout_s) {
    start();
  }
  const Description& description() const override { return description_; }
  std::string call(const Batch& b) override try {
    if (!child_) start();
    child_->begin();
    const std::string head = fmt::format("call {} {} {}\n", b.operation, b.scalar, b.n);
    child_->write(head.data(), head.size());
    child_->write(b.inputs.data(), b.inputs.size());
    const std::string due = fmt::format("the line 'done {}'", b.n), answer = child_->line(due);
    const std::string expected = fmt::format("done {}", b.n);
    if (!answer.starts_with(expected) || (answer.size() > expected.size() && answer[expected.size()] != ' '))
      Child::fail(fmt::format("wrote {} where {} is due{}", quoted(answer), due,
                              answer.starts_with("done ") ? "" : ": does it print to standard output?"));
    child_->read(std::as_writable_bytes(b.status));
    child_->read(b.results);
    if (child_->left_over() > 0)
      Child::fail(fmt::format("wrote {} bytes more than its answer has", child_->left_over()));
    return answer.size() > expected.size() ? answer.substr(expected.size() + 1) : "";
  } catch (const TimedOut&) {  // so that a campaign does not wait long for each of many endless loops
    timeout_s_ = std::max(timeout_s_ / 2, std::min(timeout_s_, 0.5));
    child_.reset();
    throw;
  } catch (const AdapterFailed&) {
    child_.reset();
    throw;
  }

 private:
  void start() {
    child_ = std::make_unique<Child>(command_, timeout_s_ + start_s);
    child_->begin();
    const std::string hello = std::string(greeting) + "\n";
    child_->write(hello.data(), hello.size());
    description_ = described(child_->line("its description"));
    child_->set_timeout(timeout_s_);
  }
  static constexpr double start_s = 10;  ///< more for the start: an interpreter loads its packages
  std::string command_;
  double timeout_s_;
  Description description_;
  std::unique_ptr<Child> child_;
};

}  // namespace

std::unique_ptr<Adapter> start_process(const std::string& command, double timeout_s) {
  return std::make_unique<Process>(command, timeout_s);
}

std::string serving_command(const std::string& file) {
  return fmt::format("exec {} adapter serve {}",
                     shell_quoted(std::filesystem::read_symlink("/proc/self/exe")), shell_quoted(file));
}

}  // namespace liecheck::properties::adapters
