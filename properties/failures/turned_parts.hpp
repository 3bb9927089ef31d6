#pragma once
// Wrong parts of results as the right ones turned, multiplied or not normalised; each in words, or "".

#include <failures/wrong_parts.hpp>
#include <string>

namespace liecheck::properties {

/// Whether a vector is turned once more, or once too little, by a rotation among the arguments; in words, or "".
std::string of_another_frame(const Operation& operation, const std::vector<PartPlace>& places,
                             const Wrong& wrong);
/// The upper right block of a 6 x 6 Jacobian or adjoint with the diagonal block D, or its inverse, as a factor too many or too few.
std::string of_coupling(const Operation& operation, const Wrong& wrong);
/// Parts of the result that are right but for their lengths, or the lengths of their columns.
std::string length_of(const Wrong& wrong, const std::vector<PartPlace>& places);
/// A factor, the same in all wrong results, of a part of the result or of one of its numbers.
std::string factor_of(const Wrong& wrong);

}  // namespace liecheck::properties
