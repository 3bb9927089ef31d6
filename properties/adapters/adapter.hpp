#pragma once
// A library from outside the program: a shared library with the C interface (liecheck_adapter.h), or a
// process that speaks the protocol of docs/adapters.md.

#include <adapters/sizes.hpp>
#include <conventions/stated.hpp>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <subjects/outcome.hpp>
#include <subjects/taken.hpp>
#include <utility>

struct liecheck_adapter;  // liecheck_adapter.h
struct liecheck_loops;

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
  std::map<std::string, std::string> source = {};         ///< programs by operation: docs/findings.md
  std::set<std::string> models{"joints"};  ///< of trees: "joints", "urdf", and "mimics", which it couples
  std::set<std::string> joints = {};       ///< kinds of joints; empty for all
  std::set<std::string> references{"world", "local", "aligned"};  ///< in which it sees frames
  Taken taken = {};  ///< what its arguments may be, found by asking; its joints are above
  std::set<std::string> refused_references = {};  ///< found by asking; they are not among its references
  /// How its calls of an operation are timed by loops of its own: "own types" or "numbers" (liecheck_loops) of a library;
  /// "one" or "one, many" at once, of a program.
  std::map<std::string, std::string> timed = {};
};

/// How an adapter that was started again describes itself otherwise, in a sentence; or "". Operations may have been withheld from
/// the earlier description.
std::string changed(const Description& earlier, const Description& now);

/// What became of one input. An adapter gives the first two. The others are found where a function of a shared
/// library is called, and hold for all inputs of the call; `not_repeatable` for its first, in place of an earlier one.
enum class Status : unsigned char {
  done,
  refused,
  argument_written,
  output_unwritten,
  environment_changed,
  printed,
  not_repeatable,
  other_choice,  ///< of one input: its result breaks a choice that the adapter states
  failed         ///< what call() returns says how
};

/// What a status that is not `done` says; `why` is what the call returned.
std::string in_words(Status status, const std::string& why);
/// The outcome of such a call.
Outcome outcome_of(Status status);

/// n calls of one operation in one scalar. The numbers are consecutive; see operations/numbers.hpp.
struct Batch {
  const OperationSizes& operation;  ///< of all_sizes() or quaternion_sizes(), or an operation on `model`
  bool is_double;
  std::size_t n;
  std::span<const std::byte> inputs;
  std::span<std::byte> results;
  std::span<Status> status;
  std::string_view model = {};  ///< of trees.hpp, or empty
  bool of_many = false;         ///< the calls of many cases: if it fails, each is made alone

  const char* scalar() const { return is_double ? "double" : "float"; }
};

class Adapter {
 public:
  virtual ~Adapter() = default;
  virtual const Description& description() const = 0;
  /// Computes the results and the status of each input. Returns why inputs were refused or how the call
  /// failed, or "". Throws AdapterFailed; a later call starts the adapter again.
  virtual std::string call(const Batch& batch) = 0;
  /// Repeats some earlier calls like `batch`, in another order and from two threads. Returns in words which result
  /// was another one, or "". call() does this where it can.
  virtual std::string repeated(const Batch&) { return ""; }
  /// The processor time [ns] of so many passes over the calls of `batch`, measured where the adapter runs. `how` is "one" or
  /// "many", as it states, or "nothing" in place of its function. 0 if it states neither. Throws AdapterFailed.
  virtual double timed(std::string_view, const Batch&, std::size_t) { return 0; }
};

/// Starts the command by /bin/sh. Throws AdapterFailed if its description is not as docs/adapters.md says.
std::unique_ptr<Adapter> start_process(const std::string& command, double timeout_s);

/// Loads a shared library into this process. Throws AdapterFailed. call() repeats earlier calls only if `repeats`.
std::unique_ptr<Adapter> load_library(const std::string& file, bool repeats = true);

/// A function of the C interface (liecheck_adapter.h), of version 1 or 2.
struct CFunction {
  void (*alone)(std::size_t n, const void* inputs, void* results, unsigned char* status) = nullptr;
  void (*with)(void* context, std::size_t n, const void* inputs, void* results,
               unsigned char* status) = nullptr;
  void* context = nullptr;

  explicit operator bool() const { return alone || with; }
  void operator()(std::size_t n, const void* inputs, void* results, unsigned char* status) const {
    with ? with(context, n, inputs, results, status) : alone(n, inputs, results, status);
  }
};

/// The function of a shared library, loaded into this process, without any check of its calls; null if it is not
/// offered. Throws AdapterFailed.
CFunction function_of_library(const std::string& file, const std::string& operation,
                              const std::string& scalar);
/// Its loops over calls of the operation; null if it has none.
const liecheck_loops* loops_of_library(const std::string& file, const std::string& operation,
                                       const std::string& scalar);

/// An adapter that is linked into this program. Throws AdapterFailed.
std::unique_ptr<Adapter> linked_library(const liecheck_adapter& adapter);

/// Loads a shared library into a process of its own, which takes calls from memory that both share. Throws
/// AdapterFailed.
std::unique_ptr<Adapter> start_library(const std::string& file, double timeout_s);

/// Answers calls of `adapter` in the memory of a file (shared_memory.hpp) until standard input ends. What the
/// library prints on standard output goes to standard error.
void serve(Adapter& adapter, const std::string& memory);

/// The version of the process protocol, and the line that begins a conversation.
inline constexpr int protocol_version = 1;
inline const std::string greeting = "liecheck " + std::to_string(protocol_version);

/// Whether the adapter offers an operation on trees.
bool offers_trees(const Description& adapter, const std::string& scalar);

}  // namespace liecheck::properties::adapters
