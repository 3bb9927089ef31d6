// The main function of both programs: it runs the command that the command line names.

#include <fcntl.h>
#include <poll.h>
#include <adapters/noise.hpp>
#include <app/command.hpp>
#include <app/command_line.hpp>
#include <app/programs.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iostream>
#include <support/float_environment.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

/// The command line, with each argument quoted if a shell needs it.
std::string command_line(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) line += (i ? " " : "") + shell_quoted(argv[i]);
  return line;
}

/// Whether standard output is a pipe that nobody reads any more, as after `| head`.
bool nobody_reads() {
  pollfd out{1, 0, 0};
  return ::poll(&out, 1, 0) == 1 && (out.revents & POLLERR);
}

/// Flushes standard output. Returns `code`, or bad_input if output was lost. If nobody reads it, says nothing and
/// returns what a shell reports for a program that SIGPIPE ended.
int finish(int code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.flush()) return code;
  if (nobody_reads()) return 128 + SIGPIPE;
  // Not fmt::print, which throws if stderr is lost, too.
  std::fprintf(stderr, "liecheck: standard output: cannot be written%s%s\n", errno ? ": " : "",
               errno ? std::strerror(errno) : "");
  return bad_input;
}

int refuse(const std::string& why) {
  std::fprintf(stderr, "liecheck: %s\n", one_line(why).c_str());
  return finish(bad_input);
}

}  // namespace

int run_main(int argc, char** argv, const Program& program) {
  handle_signals();
  // After this, writing to a closed pipe or beyond a file size limit fails, but does not end the program.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  // Replaces closed standard streams, so that no file that is opened later takes their place.
  for (int fd = 0; fd < 3; ++fd)
    if (::fcntl(fd, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) != fd) return bad_input;
  try {
    require_usual_arithmetic();
    const int code = run_program(program, argc, argv, command_line(argc, argv));
    adapters::say_counts();
    return finish(code);
  } catch (const std::bad_alloc&) {
    return refuse("out of memory");
  } catch (const std::exception& e) {
    return std::ferror(stdout) ? finish(bad_input) : refuse(e.what());
  } catch (const GivenUp&) {  // an adapter gave no answer before the end
    std::fputs("interrupted\n", stderr);
    return finish(incomplete);
  }
}

}  // namespace liecheck::properties
