#pragma once
// A library under test in one scalar, by the functions that it offers in the types of this scalar.
//
// To add a subject, write one file: fill the slots of a TypedOperations<S>, such as o[op::exp6] = ..., and
// register it with a static Registered<S>. A slot that stays null is reported as not offered. The folder
// operations/ defines the arguments and results of each operation. The subject's file converts them to the
// conventions of its library.

#include <subjects/subject.hpp>

namespace liecheck::properties {

/// Short names of types, for the classes that define subjects.
template <class S>
struct Types {
  using V3 = Vec<S, 3>;
  using V4 = Vec<S, 4>;
  using V6 = Vec<S, 6>;
  using V7 = Vec<S, 7>;
  using M3 = Mat<S, 3>;
  using M6 = Mat<S, 6>;
};

/// o[op::exp6] is the subject's function for exp6, or null if it has none.
template <class S>
struct TypedOperations : SpatialSlots<S>, Types<S> {
  // The library's checks of inputs, if it has any. They throw for inputs that its operations do not accept.
  std::function<void(const Vec<S, 4>& Q)> check_quaternion;
  std::function<void(const Mat<S, 3>& R)> check_rotation;

  /// Reads a URDF and returns the operations on configurations of this robot. If `fixed`, the root is welded
  /// to the world; otherwise it is a free-flyer.
  RobotOperations<S> (*robot)(const std::string& urdf_text, bool fixed) = nullptr;

  /// Builds a tree of bodies and returns the algorithms on it.
  std::function<TreeOperations<S>(const Tree<S>& tree)> tree;
};

template <class S>
struct TypedSubject {
  std::string name;
  std::string version;
  TypedOperations<S> operations;
};

/// Every subject of the program in this scalar, in alphabetical order; those of adapters are not among them.
template <class S>
std::vector<const TypedSubject<S>*> typed_subjects();

/// The subject as the harness calls it, in float and double.
template <class S>
Subject erased(const TypedSubject<S>& subject);

/// A static object of this type registers a subject.
template <class S>
struct Registered {
  explicit Registered(TypedSubject<S> subject);
};

}  // namespace liecheck::properties
