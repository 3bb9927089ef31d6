#pragma once
// A subject is a library under test in one scalar, given by the functions that it offers. The harness calls them with
// doubles, whatever the scalar is: typed.hpp says how a library's own functions are registered.

#include <functional>
#include <operations/operations.hpp>
#include <oracles/scalar.hpp>
#include <string>
#include <subjects/taken.hpp>
#include <vector>

namespace liecheck::properties {

using oracles::Scalar;

template <class S>
struct Tree;  // tree.hpp

/// o[op::exp6] is the subject's function for exp6, or null if it has none. An argument is rounded to the scalar, and a
/// result is exactly what the library returned.
struct Operations : SpatialSlots<Doubles> {
  // They visit a hundred functions, and are compiled once: registry.cpp.
  Operations();
  Operations(const Operations&);
  Operations(Operations&&) noexcept;
  Operations& operator=(const Operations&);
  Operations& operator=(Operations&&) noexcept;
  ~Operations();
  /// Copies one operation's function.
  void take(const Operation& operation, const Operations& from);
  /// Whether the operation has a slot here and a function in it.
  bool has(const Operation& operation) const;

  // The library's checks of inputs, if it has any. They throw for inputs that its operations do not accept.
  std::function<void(const Vec<double, 4>& Q)> check_quaternion;
  std::function<void(const Mat<double, 3>& R)> check_rotation;

  /// Reads a URDF and returns the operations on configurations of this robot. If `fixed`, the root is welded
  /// to the world; otherwise it is a free-flyer.
  std::function<RobotOperations<double>(const std::string& urdf_text, bool fixed)> robot;

  /// Builds a tree of bodies and returns the algorithms on it.
  std::function<TreeOperations<double>(const Tree<double>& tree)> tree;
};

struct Subject {
  std::string name;
  std::string version;
  std::string adapter = {};  ///< how the user gave it with --adapter, or "" for one of the program
  const Scalar* scalar = nullptr;
  Operations operations = {};
  Taken takes = {};
};

/// Every subject in this scalar, in alphabetical order.
std::vector<const Subject*> subjects(const Scalar& scalar);

/// Adds a subject, such as that of an adapter.
void register_subject(Subject subject);
/// Takes the subjects of this name away. No pointer to any of the registered ones may be in use.
void forget_subject(const std::string& name);

}  // namespace liecheck::properties
