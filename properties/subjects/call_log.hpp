#pragma once
// Checks of a subject's calls that need no oracle. Each call is made twice, with copies of its arguments: both results
// must have the same bits, except that one NaN is as good as another, and the copies must keep theirs. The memory of a
// result is filled with another pattern before each call. A number that keeps both patterns was not written. Between the two
// calls of a function of a tree are some with neighbours of its input, in one checked case of eight. All checked
// calls run in the rounding mode and with the treatment of subnormals that mode_of_calls says
// (support/float_environment.hpp).
//
// A function that returns its result constructs it in that memory if it has a fixed size (rounded_calls.hpp). The last check
// cannot see the memory that a vector or matrix of dynamic size allocates, a single number, which is returned in a
// register, or a result that the subject copies from a variable of its own.

#include <operations/description.hpp>
#include <string>
#include <subjects/outcome.hpp>
#include <vector>

namespace liecheck::properties {

/// The checked calls of one case. If the log keeps results, a call with arguments that it knows gives the
/// noted result: then a case that two oracles measure is measured on the same results.
class CallLog {
 public:
  struct Finding {
    const Operation* operation;
    Outcome outcome;
  };
  struct Noted {
    const Operation* operation;
    int tree;                       ///< which of the trees that the case builds, from 1; 0 if none
    std::string arguments, result;  ///< their bits
  };
  std::vector<Finding> findings;
  std::vector<Noted> results;
  bool keeps_results = false;
  bool calls_neighbours = true;  ///< functions of trees are called with other inputs before the second time
  int trees = 0;                 ///< built since the case was last measured from its beginning

  /// The log of this thread, or null if its calls are not checked.
  static CallLog*& current();
};

}  // namespace liecheck::properties
