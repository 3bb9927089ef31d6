#pragma once
// Registers a correct implementation of the algorithms on trees.

#include <correct/correct_tree_parts.hpp>

namespace liecheck::properties::correct {

/// Of<S> is the implementation in the scalar S.
template <template <class> class Of>
struct RegisteredTree {
  RegisteredTree(const char* name, const char* version) {
    add<float>(name, version), add<double>(name, version);
  }

 private:
  template <class S>
  static void add(const char* name, const char* version) {
    TypedSubject<S> s{name, version, {}};
    s.operations.tree = bind<Of<S>, S>;
    Registered<S>(std::move(s));
  }
};

}  // namespace liecheck::properties::correct
