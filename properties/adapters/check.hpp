#pragma once
// What the author of an adapter runs first, and what comes before a campaign: each operation is called at moderate
// arguments, and the conventions in which the adapter differs from liecheck are named.

#include <adapters/adapter.hpp>
#include <adapters/checked.hpp>

namespace liecheck::properties::adapters {

/// Calls each offered operation at six inputs: in one batch, and one by one. Both must give the same bits, and
/// results that agree with the oracles to a thousandth.
Checked check(Adapter& adapter);

}  // namespace liecheck::properties::adapters
