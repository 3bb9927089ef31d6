#pragma once
// What happens if code of an adapter ends the program in whose process it runs.

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <string_view>
#include <support/stop.hpp>

namespace liecheck::properties::adapters {

/// The function that runs.
struct WhereInside {
  const char* library = nullptr;
  std::string_view operation;
};

/// While one exists, foreign code runs. If it ends this process by exit() or by a crash, the program says so and is
/// incomplete, instead of ending with the code of a pass or without a word.
class Inside {
 public:
  /// The name of the operation is a literal.
  Inside(const char* library, std::string_view operation) : before_(now) {
    now = {library, operation};
    last_library = library, last_operation = operation.data(), ++inside;
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  ~Inside() { now = before_, --inside; }
  static void watch() {
    static const int registered = std::atexit([] {
      if (now.library) end("exit()");
    });
    (void)registered;
    for (const int crash : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL})
      if (const auto earlier = std::signal(crash, on_crash); earlier != SIG_DFL) std::signal(crash, earlier);
    std::signal(SIGALRM, [](int) {
      if (inside == 0) return;
      static std::atomic<bool> said = false;
      if (said.exchange(true)) {
        say({last_library.load(), ": ", last_operation.load(), " did not return: its results are lost\n"});
        ::_exit(3);
      }
      say({last_library.load(), ": ", last_operation.load(),
           " runs in this process and has not returned since the signal: a second signal ends the "
           "program, and so do ten seconds\n"});
      ::alarm(9);
    });
    tells_what_it_waits_for = true;
  }

 private:
  /// A thread that is in no Inside, while others are, has been started to call a library twice at a time.
  static void on_crash(int number) {
    if (!now.library && inside > 0) now = {last_library, last_operation.load()};
    if (now.library) end("the signal SIG", ::sigabbrev_np(number));
    std::signal(number, SIG_DFL), std::raise(number);
  }
  /// Only functions that are safe in the handler of a signal.
  [[noreturn]] static void end(std::string_view how, std::string_view signal = "") {
    while (ending.exchange(true)) ::pause();  // another thread writes, and then ends the program
    say({now.library, ": ", now.operation, " ended the program, in whose process it runs, by ", how, signal,
         "\n"});
    ::_exit(3);
  }
  static void say(std::initializer_list<std::string_view> parts) {
    constexpr std::string_view program = "liecheck: ";
    if (::write(2, program.data(), program.size()) < 0) return;
    for (const std::string_view part : parts)
      if (::write(2, part.data(), part.size()) < 0) break;
  }
  static inline thread_local WhereInside now;
  static inline std::atomic<const char*> last_library = nullptr, last_operation = nullptr;
  static inline std::atomic<int> inside = 0;
  static inline std::atomic<bool> ending = false;
  WhereInside before_;
};

}  // namespace liecheck::properties::adapters
