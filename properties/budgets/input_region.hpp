#pragma once
// A region of inputs that a limits file names, made of whole angle bands.

#include <generators/angle_bands.hpp>
#include <optional>
#include <string>

namespace liecheck::properties {

struct InputRegion {
  std::string text;
  Axis axis = Axis::none;    ///< of an interval
  double low = 0, high = 0;  ///< of theta or pi - theta [rad]
  bool has(const Band& band) const;
};

/// Reads "theta A..B" or "pi-theta A..B" (every band inside this interval), the name of a band, "to_pi",
/// "beyond_pi" or "any". Nothing if the text is none of these, or if no scalar has such a band.
std::optional<InputRegion> parse_input_region(const std::string& text);

/// A failure that a limits file expects.
struct ExpectedFailure {
  std::string operation, block;
  InputRegion inputs;
  std::string reason, link;
};

}  // namespace liecheck::properties
