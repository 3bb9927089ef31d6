#pragma once
// A known bug, bug:NAME, is the subject liecheck with one deliberate fault, modelled on a real report
// (fixtures/known_bugs/README.md). A look-alike, alike:NAME, is a correct variant that no law may refuse.
// `--subject all` selects neither of them; they run only if they are named.

#include <string>
#include <subjects/typed.hpp>
#include <vector>

namespace liecheck::properties {

struct KnownBug {
  std::string name;    ///< bug:… or alike:…
  std::string fault;   ///< one line; for a look-alike, how it differs from liecheck
  std::string origin;  ///< the report that the bug is modelled on; for a look-alike, why it is correct
};

/// All known bugs and look-alikes, made from copies of `good`.
template <class S>
std::vector<TypedSubject<S>> known_bugs(const TypedOperations<S>& good);
const std::vector<KnownBug>& known_bug_table();

}  // namespace liecheck::properties
