#pragma once
// Known bugs: liecheck's own subject with one deliberate fault each, modelled on real reports
// (fixtures/known_bugs/README.md). They are named bug:NAME; correct look-alikes, which no law may refuse, are named
// alike:NAME. Neither belongs to "all": they run where they are named.

#include <string>
#include <subjects/subject.hpp>
#include <vector>

namespace liecheck::properties {

struct KnownBug {
  std::string name;    ///< bug:… or alike:…
  std::string fault;   ///< in a line
  std::string origin;  ///< the report that it is modelled on; of a look-alike, why it is right
};

/// All of them, with `good` as what each is a copy of.
template <class S>
std::vector<Subject<S>> known_bugs(const Operations<S>& good);
const std::vector<KnownBug>& known_bug_table();

}  // namespace liecheck::properties
