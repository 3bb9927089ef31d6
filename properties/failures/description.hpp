#pragma once
// The printed description of a failure.

#include <campaign/series.hpp>

namespace liecheck::properties {

/// The law, subject, block, error, kappa, shrunk input, replay command and C++ program of the worst case.
std::string describe_failure(const Series& series, std::uint64_t seed, int output, int band, const Row& row,
                             const Robot& robot);

}  // namespace liecheck::properties
