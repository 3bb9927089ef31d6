#pragma once
// What an adapter refuses at every probe of one kind is found by asking it at the start: an order of Euler angles, a t of
// slerp, an axis of a twist, a reference frame. It is outside the domain of the library, which gets cases of the others.

#include <adapters/adapter.hpp>

namespace liecheck::properties::adapters {

/// Fills what `taken` says of the kinds of arguments. It has every kind if all or none are refused, or if a call has no
/// answer.
void ask_for_kinds(Adapter& adapter, Taken& taken);

/// Those of the references that the adapter states, in which it does not refuse every operation on frames.
std::set<std::string> references_taken(Adapter& adapter);

/// Whether an argument of the operation is of kinds of which some are not taken.
bool lacks_kinds(const Operation& operation, const Taken& taken);
/// Throws CallFailed if it is in this call of one of these.
void check_kinds(const Operation& operation, const Taken& taken, std::span<const double> arguments);

/// What the adapter refuses, one sentence for each argument.
std::vector<std::string> refusals(const Description& adapter);

}  // namespace liecheck::properties::adapters
