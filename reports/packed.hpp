#pragma once
// The page's numbers, written smaller: the page unpacks them (page.js), report.json has them as they are.

#include <reports/record.hpp>

namespace liecheck::reports {

/// The same value with each list of objects of the same keys as {"*keys": [...], "*columns": [[...], ...]}, and each
/// list that is shorter so as {"*words": [...], "*at": [...]}, its different values and the place of each in them.
/// Throws std::invalid_argument at a key that begins with a star.
Json packed(const Json& value);

}  // namespace liecheck::reports
