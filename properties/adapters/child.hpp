#pragma once
// A process that is an adapter, with pipes to its standard input and output.

#include <sys/types.h>

#include <adapters/adapter.hpp>
#include <chrono>
#include <functional>

namespace liecheck::properties::adapters {

struct TimedOut : AdapterFailed {
  using AdapterFailed::AdapterFailed;
};

/// Kills every adapter and what it has started. It is safe in the handler of a signal, after which the program ends.
void kill_children();

/// At most 60 printable characters of what an adapter wrote.
std::string quoted(std::string text);

/// A running child in a process group of its own, so that Ctrl-C on the terminal does not reach it. Every
/// function throws AdapterFailed if the child has ended, and TimedOut if an exchange takes longer than the
/// timeout.
class Child {
 public:
  Child(const std::string& command, double timeout_s);
  /// Something that is no process: what it reads is written to one file, and what it says is read from the other. Both are
  /// closed at the end.
  Child(int to, int from, double timeout_s) : to_(to), from_(from) { set_timeout(timeout_s); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child();

  void set_timeout(double timeout_s);
  /// The next exchange may take the whole timeout.
  void begin();
  void write(const void* bytes, std::size_t size);
  /// From now on, a wait of more than a second is said on a terminal, once.
  void tell(const std::string& waiting) { waiting_ = waiting; }
  /// The next line, without its end. `due` names what is expected.
  std::string line(const std::string& due);
  void read(std::span<std::byte> to);
  /// Waits until the child wrote something, and drops it.
  void wait_for_a_byte();
  std::size_t left_over() const { return buffer_.size(); }
  /// What it wrote to its standard error since the last time.
  std::string errors();
  [[noreturn]] static void fail(const std::string& what) { throw AdapterFailed("the adapter " + what); }

 private:
  using Clock = std::chrono::steady_clock;
  double seconds() const { return std::chrono::duration<double>(timeout_).count(); }
  void wait(int fd, short events, const std::string& late);
  void read_some(const std::string& late);
  std::string how_it_ended();

  Clock::duration timeout_{};
  Clock::time_point end_;
  int to_ = -1, from_ = -1;
  int errors_ = -1;  ///< a file in memory: nobody must read it for the child to go on
  pid_t pid_ = -1;
  bool ended_ = false;
  std::string buffer_, waiting_;
};

/// Starts the adapter that a Process speaks with, and starts it again after it failed.
using Opener = std::function<std::unique_ptr<Child>(double timeout_s)>;

/// start_process with another way to start the adapter.
std::unique_ptr<Adapter> start_with(Opener opener, double timeout_s);

}  // namespace liecheck::properties::adapters
