#pragma once
// Faults in liecheck's algorithms on trees, and the findings that they make.

#include <functional>
#include <subjects/tree.hpp>

#include "../own_subject.hpp"
#include "finding_texts.hpp"

namespace liecheck::properties {

using Plant = std::function<void(TreeOperations<double>&, const Tree<double>&)>;

/// The findings of liecheck's functions on trees that `plant` changes, in one law or more.
inline std::vector<std::string> findings_of_tree(const std::vector<std::string>& laws, const Plant& plant,
                                                 std::uint64_t cases = 150) {
  static int number = 0;
  TypedSubject<double> s;
  s.name = "tree_fault_" + std::to_string(++number);
  s.operations.tree = [plant](const Tree<double>& tree) {
    TreeOperations<double> o = own_subject().operations.tree(tree);
    plant(o, tree);
    return o;
  };
  const Registered<double> registered(s);
  return finding_texts(s.name, laws, cases);
}
/// Changes one function of a tree.
template <class O, class F>
void change(TreeOperations<double>& o, const O& operation, const F& f) {
  o[operation] = [right = o[operation], f](const auto&... arguments) {
    auto result = right(arguments...);
    f(result, arguments...);
    return result;
  };
}

}  // namespace liecheck::properties
