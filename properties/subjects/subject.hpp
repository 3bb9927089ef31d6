#pragma once
// A subject: a library under test in one scalar, as the functions that it offers.
//
// Adding one touches one file: fill the slots of an Operations<S> (o[op::exp6] = ...), leave null what the library lacks
// (it is reported as not offered), and register it with a static Registered<S>. What each operation takes and returns is
// in its record (operations/); adapters do the reordering.

#include <operations/operations.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

template <class S>
struct Tree;  // tree.hpp

/// o[op::exp6] is the function of an operation; a null one is not offered.
template <class S>
struct Operations : SpatialSlots<S> {
  using V3 = Vec<S, 3>;
  using V4 = Vec<S, 4>;
  using V6 = Vec<S, 6>;
  using V7 = Vec<S, 7>;
  using M3 = Mat<S, 3>;
  using M6 = Mat<S, 6>;

  // The checked entrance, where the library has one: throws for numbers that its operations do not take.
  void (*check_quaternion)(const V4& Q) = nullptr;
  void (*check_rotation)(const M3& R) = nullptr;

  /// Reads a URDF and binds the operations on whole configurations to it; fixed: its root is welded to the world,
  /// otherwise it is a free-flyer.
  RobotOperations<S> (*robot)(const std::string& urdf_text, bool fixed) = nullptr;

  /// Builds a tree of bodies and binds its algorithms.
  TreeOperations<S> (*tree)(const Tree<S>& tree) = nullptr;
};

template <class S>
struct Subject {
  std::string name;
  std::string version;
  Operations<S> operations;
  /// Angles [rad] at which the subject is known to change formula; others are hunted by the common ones.
  std::vector<double> cutoffs;
};

/// Every subject of the scalar, in registration-independent (alphabetical) order.
template <class S>
std::vector<const Subject<S>*> subjects();

/// A static of this type in a subject's file makes it known.
template <class S>
struct Registered {
  explicit Registered(Subject<S> subject);
};

/// Peers that the build did not find: their files register a name here instead.
const std::vector<std::string>& absent_subjects();
struct RegisteredAbsent {
  explicit RegisteredAbsent(std::string name);
};

}  // namespace liecheck::properties
