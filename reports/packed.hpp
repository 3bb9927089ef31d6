#pragma once
// A compact form of the JSON inside the page. page.js restores the original; report.json is not packed.

#include <reports/record.hpp>

namespace liecheck::reports {

/// A list of objects with equal keys becomes {"*keys": [...], "*columns": [[...], ...]}. Another list becomes
/// {"*words": [...], "*at": [...]} if that is shorter: its distinct values, and the index of each element.
/// Throws std::invalid_argument if a key begins with a star.
Json packed(const Json& value);

}  // namespace liecheck::reports
