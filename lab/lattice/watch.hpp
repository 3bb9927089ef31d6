#pragma once
// A subject whose calls are watched, and in which one fault can be planted at a time.

#include <lattice/perturbation.hpp>
#include <lattice/trigger.hpp>
#include <map>
#include <memory>
#include <search/features.hpp>
#include <subjects/number_function.hpp>
#include <thread>

namespace liecheck::properties {

/// A fault: when the trigger fires in a call of the operation, the perturbation changes its result.
struct Fault {
  const Operation* operation = nullptr;
  std::size_t trigger = 0;  ///< its number in the table of triggers
  Perturbation perturbation;
};

/// The state of a watched subject. It serves one case at a time, on any thread.
class Watch {
 public:
  using Calls = std::map<const Operation*, std::uint64_t>;
  explicit Watch(const std::vector<Trigger>& table) : triggers(table) {}

  /// The subject, whose functions of trees and robots tell the watch what they belong to. The watch must outlive it.
  Subject watched(const Subject& subject);
  /// While it exists, the calls of this thread are watched.
  class Active {
   public:
    explicit Active(Watch& watch)
        : hook_([&watch](const NumberFunction& f, void* in, void* out) { watch.call(f, in, out); }),
          before_(std::exchange(call_hook(), &hook_)) {}
    Active(const Active&) = delete;
    Active& operator=(const Active&) = delete;
    ~Active() { call_hook() = before_; }

   private:
    CallHook hook_, *before_;
  };

  const std::vector<Trigger>& triggers;
  /// Receives the features of each call. If it is null, only calls of the fault's operation are looked at.
  std::function<void(const Operation&, const Features&)> seen;
  const Fault* fault = nullptr;
  bool planted = false;  ///< the fault acts; otherwise calls are only remembered
  double moved = 0;      ///< the largest change since this was set to 0, in eps of the block's largest number
  Calls calls;           ///< how many calls of each operation there were

  /// Forgets the calls before, apart from their numbers.
  void forget() { remembered_.clear(), last_ = nullptr; }

 private:
  struct Remembered {
    std::vector<double> arguments, result;
  };

  void call(const NumberFunction& f, void* arguments, void* results);
  /// The result of f with the fault.
  std::vector<double> faulty(const NumberFunction& f, const std::vector<double>& computed,
                             const std::vector<double>& before);
  /// Adds 2^k eps to a number of the first argument, as code does that ignores const.
  void write_to_argument(const NumberFunction& f, void* arguments, std::vector<double> numbers);

  std::thread::id first_thread_ = std::this_thread::get_id();
  std::map<const Operation*, Remembered> remembered_;
  const Operation* last_ = nullptr;
  std::shared_ptr<const Context> context_;  ///< of a call of a tree's or robot's function
};

}  // namespace liecheck::properties
