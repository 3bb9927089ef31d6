#pragma once
// A wrapped subject whose calls are watched, and in which one fault can be planted at a time.

#include <lattice/features.hpp>
#include <lattice/flat.hpp>
#include <lattice/perturbation.hpp>
#include <map>
#include <memory>
#include <subjects/wrapped.hpp>
#include <thread>

namespace liecheck::properties {

/// A fault: when the trigger fires in a call of the operation, the perturbation changes its result.
struct Fault {
  const Operation* operation = nullptr;
  std::size_t trigger = 0;  ///< its number in the table of triggers
  Perturbation perturbation;
};

/// The state of a watched subject. It serves one case at a time, on any thread.
template <class S>
class Watch {
 public:
  using Calls = std::map<const Operation*, std::uint64_t>;
  explicit Watch(const std::vector<Trigger>& table) : triggers(table) {}

  const std::vector<Trigger>& triggers;
  /// Receives the features of each call. If it is null, only calls of the fault's operation are looked at.
  std::function<void(const Operation&, const Features&)> seen;
  const Fault* fault = nullptr;
  bool planted = false;  ///< the fault acts; otherwise calls are only remembered
  double moved = 0;      ///< the largest change since this was set to 0, in eps of the block's largest number
  Calls calls;           ///< how many calls of each operation there were

  /// Forgets the calls before, apart from their numbers.
  void forget() { remembered_.clear(), last_ = nullptr; }

  template <class O, class F, class... A>
  auto call(const Context& context, const O& operation, const F& function, const A&... arguments) {
    auto result = function(arguments...);
    const std::uint64_t number = ++calls[&operation];
    const bool again = last_ == &operation;
    last_ = &operation;
    if (!seen && (!fault || fault->operation != &operation)) return result;
    numbers_.clear();
    ((append_numbers(numbers_.all, arguments), numbers_.ends.push_back(numbers_.all.size())), ...);
    const Features features = features_of_call(operation, context, number, again);
    if (seen) seen(operation, features);
    Remembered& before = remembered_[&operation];
    before.arguments = numbers_.all;
    if (fault && fault->operation == &operation) {
      result_.clear();
      append_numbers(result_, result);
      std::vector<S> computed = result_;
      if (planted && triggers[fault->trigger].fires(features)) {
        const auto blocks = blocks_of(operation, result_.size());
        fault->perturbation.apply(result_, blocks, before.result);
        for (const ResultBlock& b : blocks) moved = std::max(moved, movement(b, computed, result_));
        if (differ(computed, result_)) set(result, result_);
        if (fault->perturbation.change == PlantedChange::argument) write_to(arguments...);
      }
      before.result = std::move(computed);
    }
    return result;
  }

 private:
  struct Remembered {
    std::vector<S> arguments, result;
  };

  Features features_of_call(const Operation& operation, const Context& context, std::uint64_t number,
                            bool again) {
    Features f = features_of(operation, numbers_, context);
    f[Feature::call] = static_cast<double>(number);
    f[Feature::call_mod_1000] = static_cast<double>(number % 1000);
    f[Feature::call_mod_2] = static_cast<double>(number % 2);
    f[Feature::after_itself] = again;
    f[Feature::same_arguments] = !differ(remembered_[&operation].arguments, numbers_.all);
    f[Feature::second_thread] = std::this_thread::get_id() != first_thread_;
    return f;
  }
  /// Whether two lists differ in a number. NaN equals NaN, and 0 equals -0.
  static bool differ(const std::vector<S>& a, const std::vector<S>& b) {
    return !std::equal(a.begin(), a.end(), b.begin(), b.end(),
                       [](S x, S y) { return x == y || (x != x && y != y); });
  }
  /// The largest change of a number of the block, in eps of the block's largest number; NaN is infinite.
  static double movement(const ResultBlock& block, const std::vector<S>& from, const std::vector<S>& to) {
    double largest = 0, change = 0;
    for (const std::size_t i : block.numbers) {
      const auto a = static_cast<double>(from[i]), b = static_cast<double>(to[i]);
      largest = std::fmax(largest, std::fmax(std::fabs(a), std::fabs(b)));
      if (a == b || (a != a && b != b)) continue;
      if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
      change = std::fmax(change, std::fabs(a - b));
    }
    return change > 0 ? change / largest / std::numeric_limits<S>::epsilon() : 0;
  }
  template <class R>
  static void set(R& result, const std::vector<S>& numbers) {
    if constexpr (std::is_same_v<R, bool>)
      result = !result;  // every change of yes is no
    else
      set_numbers(result, numbers);
  }
  /// Adds 2^k eps to a number of the first argument, as code does that ignores const.
  template <class First, class... A>
  void write_to(const First& first, const A&...) {
    std::vector<S> x;
    append_numbers(x, first);
    if (x.empty()) return;
    const Perturbation& p = fault->perturbation;
    S& number = x[p.component % x.size()];
    if (number == S(0)) return;
    number += number * std::ldexp(std::numeric_limits<S>::epsilon(), p.k);
    set_numbers(const_cast<First&>(first), x);
    moved = std::numeric_limits<double>::infinity();
  }

  std::thread::id first_thread_ = std::this_thread::get_id();
  std::map<const Operation*, Remembered> remembered_;
  const Operation* last_ = nullptr;
  CallNumbers<S> numbers_;
  std::vector<S> result_;
};

/// The hook of a watched subject.
template <class S>
struct Watcher {
  Watch<S>* watch;
  std::shared_ptr<const Context> context = std::make_shared<const Context>();

  template <class O, class F, class... A>
  auto operator()(const O& operation, const F& function, const A&... arguments) const {
    return watch->call(*context, operation, function, arguments...);
  }
  Watcher on(const Tree<S>& tree) const { return {watch, std::make_shared<const Context>(context_of(tree))}; }
  Watcher on(const std::string&, bool fixed) const {
    Context robot;
    robot.floating = !fixed;
    return {watch, std::make_shared<const Context>(robot)};
  }
};

}  // namespace liecheck::properties
