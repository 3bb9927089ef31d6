#pragma once
// The right result of every operation that an adapter can offer, from the oracles.

#include <conventions/values.hpp>
#include <oracles/real.hpp>

namespace liecheck::properties::conventions {

/// The result in liecheck's conventions, to about 1e-12 at moderate arguments. Throws oracles::Undecided if there is
/// none, for example of a matrix that is no rotation.
Numbers reference(const Operation& operation, const Numbers& arguments);

/// The same to about 50 digits.
std::vector<oracles::Real> exact_result(const Operation& operation,
                                        const std::vector<oracles::Real>& arguments);

}  // namespace liecheck::properties::conventions
