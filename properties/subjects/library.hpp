#pragma once
// The library's operations in scalars that no law of the campaign runs in.

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <subjects/subject.hpp>

namespace liecheck::properties {

/// 168 and 334 bits, without allocations.
using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Digits100 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

/// Everything but robots. In float128, Digits50 and Digits100.
template <class S>
Operations<S> library_operations();

const char* library_version();

}  // namespace liecheck::properties
