#pragma once
#include <string>

namespace liecheck::properties {

/// A checksum of text (XXH3), which shows an accidental change, but not that of somebody who computes it again.
std::string checksum(const std::string& text);

}  // namespace liecheck::properties
