#pragma once
// A function of a subject as numbers in and numbers out, as the C interface has it, and how the harness calls it: the
// arguments are rounded to the scalar of the subject, the call is checked if the thread has a log (call_log.hpp), and the
// result is exactly what the subject returned. Calls of the program's own subjects that are not checked take a shorter
// way (rounded_calls.cpp), which is up to a fifth faster for the cheapest laws.

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
};

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
