#pragma once
// A function of a subject as numbers in and numbers out, as the C interface has it, and how the harness calls it: the
// arguments are rounded to the scalar of the subject, the call is checked if the thread has a log (call_log.hpp), and the
// result is exactly what the subject returned. Calls of the program's own subjects that are not checked take a shorter
// way (rounded_calls.hpp), which is up to a fifth faster for the cheapest laws.

#include <functional>
#include <operations/numbers.hpp>
#include <operations/operations.hpp>
#include <oracles/scalar.hpp>

namespace liecheck::properties {

struct NumberFunction {
  const Operation* operation = nullptr;
  const oracles::Scalar* scalar = nullptr;
  ModelSize model = {};
  int tree = 0;  ///< which of the trees that the case builds it belongs to, from 1; 0 if to none
  /// Computes the results from the arguments, in the order of operations/numbers.hpp and in the scalar. Throws what the
  /// subject throws. Null if the subject does not offer the operation.
  std::function<void(void* arguments, void* results)> compute = nullptr;
  bool quaternion_poses = false;  ///< the library is given its poses as (p, Q)
};

/// Calls a function with numbers that are rounded to its scalar, and checks the call if the thread has a log. The conversions
/// stand outside the call, which may flush subnormal numbers.
void call_in_scalar(const NumberFunction& f, std::span<double> arguments, std::span<double> results);

/// Room for some numbers or bytes, which lies on the stack if they are few. They are not set.
template <class T, std::size_t few = 64>
class Room {
 public:
  explicit Room(std::size_t n) : more_(n > few ? n : 0), n_(n) {}
  T* data() { return more_.empty() ? few_ : more_.data(); }
  std::span<T> all() { return {data(), n_}; }

 private:
  T few_[few];
  std::vector<T> more_;
  std::size_t n_;
};

/// The result of a function for arguments with `n` numbers, if it has `m`.
template <class R, class... A>
R by_numbers(const NumberFunction& f, std::size_t n, std::size_t m, const A&... arguments) {
  Room<double> in(n), out(m);
  double* to = in.data();
  (put_numbers(arguments, to), ...);
  call_in_scalar(f, in.all(), out.all());
  const double* from = out.data();
  return take_numbers<R>(from, *f.operation->results[0], f.model);
}

/// The function of an operation; one whose `compute` is null if there is none.
using FindFunction = std::function<NumberFunction(const Operation&)>;

// Fill each slot whose operation has a function.
void fill_slots(SpatialSlots<Doubles>& slots, const FindFunction& find);
void fill_slots(RobotOperations<double>& slots, const FindFunction& find);
void fill_slots(TreeOperations<double>& slots, const FindFunction& find);

/// The number of the tree that the case builds now, from 1; 0 if the thread has no log.
int next_tree();

/// What runs in the place of each `compute` on a thread that has one, in checked and other calls: to plant faults.
using CallHook = std::function<void(const NumberFunction& function, void* arguments, void* results)>;
/// The hook of this thread, or null.
CallHook*& call_hook();

}  // namespace liecheck::properties
