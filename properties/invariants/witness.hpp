#pragma once
// What a law on trees compares, for the description of a failure: campaigns do not note it.

#include <oracles/real.hpp>
#include <string_view>
#include <vector>

namespace liecheck::properties {

struct Witness {
  struct Compared {
    std::vector<oracles::Real> computed, exact;
    std::string_view operation, block;
  };
  std::string_view operation, block;  ///< of the output to note
  bool every =
      false;  ///< whether to note all outputs in its place, also what balls compare, by their centres
  std::vector<Compared> all;  ///< in the order of the measurements: one for each reference frame
  bool notes(std::string_view of, std::string_view part) const {
    return every || (operation == of && block == part);
  }

  /// The one of this thread, or null.
  static Witness*& current() {
    thread_local Witness* witness = nullptr;
    return witness;
  }
};

}  // namespace liecheck::properties
