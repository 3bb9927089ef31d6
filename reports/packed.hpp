#pragma once
// A shorter form of the JSON in the page. page.js undoes it; report.json is written without it.

#include <reports/record.hpp>

namespace liecheck::reports {

/// The same value with each list of objects of the same keys as {"*keys": [...], "*columns": [[...], ...]}, and each
/// list that gets shorter as {"*words": [...], "*at": [...]}: its distinct values, and for each element their index.
/// Throws std::invalid_argument at a key that begins with a star.
Json packed(const Json& value);

}  // namespace liecheck::reports
