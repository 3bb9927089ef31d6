#pragma once
// A case of a robot with thousands of joints takes minutes, in sums of the oracles.

#include <oracles/pause.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

/// While one exists, the oracles' long sums on this thread are given up as slow calls of adapters are (GivesUp).
struct GivesUpLongSums : oracles::Pauses {
  GivesUpLongSums()
      : Pauses([] {
          if (GivesUp::now()) throw GivenUp{};
        }) {}
};

}  // namespace liecheck::properties
