#include <support/own_process.hpp>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace liecheck::properties {
namespace {

void check(int error, const char* what) {
  if (error) throw std::system_error(error, std::generic_category(), what);
}

/// Starts the program with its standard output in a pipe. Returns its id and the pipe's other end.
std::pair<pid_t, int> start(std::vector<std::string>& arguments) {
  int ends[2];
  check(::pipe2(ends, O_CLOEXEC) ? errno : 0, "pipe");
  std::vector<char*> argv{const_cast<char*>("liecheck")};
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  pid_t id = 0;
  const int error = ::posix_spawn(&id, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error) ::close(ends[0]);
  check(error, "/proc/self/exe");
  return {id, ends[0]};
}

/// Sends SIGTERM, at which the process ends what it has started, and SIGKILL if it still runs half a second later.
void end(pid_t id) {
  ::kill(id, SIGTERM);
  for (int looks = 0; looks < 50; ++looks) {
    siginfo_t ended{};
    if (::waitid(P_PID, static_cast<id_t>(id), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
        ended.si_pid == id)
      return;
    ::usleep(10'000);
  }
  ::kill(id, SIGKILL);
}

}  // namespace

std::optional<std::string> output_of_own_process(std::vector<std::string> arguments,
                                                 const std::atomic<bool>& stop, double longest_s, int most) {
  using Clock = std::chrono::steady_clock;
  const auto [id, from] = start(arguments);
  const auto begin = Clock::now();
  const auto late = [&] { return std::chrono::duration<double>(Clock::now() - begin).count() > longest_s; };
  std::string text;
  char part[65536];
  for (ssize_t n = 1; n != 0 && !stop && !late();) {
    pollfd ready{from, POLLIN, 0};
    if (::poll(&ready, 1, 50) <= 0) continue;
    n = ::read(from, part, sizeof part);
    if (n > 0) text.append(part, static_cast<std::size_t>(n));
  }
  ::close(from);
  const bool too_late = late();
  if (stop || too_late) end(id);
  int status = 0;
  while (::waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
  if (stop) return std::nullopt;
  if (too_late)
    throw std::runtime_error(fmt::format("a process that measures did not end in {:.0f} s", longest_s));
  if (WIFSIGNALED(status))
    throw std::runtime_error(fmt::format("a process that measures was ended by signal {} ({})",
                                         WTERMSIG(status), ::strsignal(WTERMSIG(status))));
  if (WEXITSTATUS(status) > most)
    throw std::runtime_error(
        fmt::format("a process that measures ended with exit code {}", WEXITSTATUS(status)));
  return text;
}

}  // namespace liecheck::properties
