#pragma once
// `liecheck hunt`: the worst input of an operation, as text.

#include <search/hunt.hpp>
#include <string>

namespace liecheck::properties {

struct HuntFlags {
  HuntOptions options;
  std::string subject, scalar = "double", property, corpus;
  bool versus_random = false;
};

/// Prints what it found. 0 within budget, 1 beyond it, 3 where it was stopped early. Throws
/// std::invalid_argument for a name that is not known and for a corpus file that cannot be written.
int run_hunt(const HuntFlags& flags, const Robot& robot);

}  // namespace liecheck::properties
