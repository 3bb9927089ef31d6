#pragma once
// A library from outside the program: a shared library with the C interface (liecheck_adapter.h), or a
// process that speaks the protocol of docs/adapters.md.

#include <conventions/stated.hpp>
#include <cstddef>
#include <memory>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace liecheck::properties::adapters {

/// The adapter crashed, did not answer in time, or broke the protocol. The message says which, in words.
struct AdapterFailed : std::runtime_error {
  using runtime_error::runtime_error;
};

/// What an adapter says of itself.
struct Description {
  std::string name, version;
  std::set<std::pair<std::string, std::string>> offered;  ///< (operation, scalar)
  conventions::Statements conventions;                    ///< those that it states
};

/// n calls of one operation in one scalar. The numbers are consecutive; see shapes.hpp.
struct Batch {
  const char* operation;
  const char* scalar;
  std::size_t n;
  std::span<const std::byte> inputs;
  std::span<std::byte> results;
  std::span<unsigned char> status;  ///< of each input: liecheck_status
};

class Adapter {
 public:
  virtual ~Adapter() = default;
  virtual const Description& description() const = 0;
  /// Computes the results and the status of each input. Returns the reason of a refusal, or "". Throws
  /// AdapterFailed; a later call starts the adapter again.
  virtual std::string call(const Batch& batch) = 0;
};

/// Starts the command by /bin/sh. Throws AdapterFailed if its description is not as docs/adapters.md says.
std::unique_ptr<Adapter> start_process(const std::string& command, double timeout_s);

/// Loads a shared library into this process. Throws AdapterFailed.
std::unique_ptr<Adapter> load_library(const std::string& file);

/// The command that serves a shared library from a process of its own.
std::string serving_command(const std::string& file);

/// Answers calls of `adapter` on standard input and output until the input ends. What the library prints on
/// standard output goes to standard error.
void serve(Adapter& adapter);

/// The name and the version of the protocol, which begin a conversation.
inline constexpr const char* greeting = "liecheck 1";

}  // namespace liecheck::properties::adapters
