#include <budgets/input_region.hpp>

#include <algorithm>
#include <liecheck/text/from_chars.hpp>

namespace liecheck::properties {

bool InputRegion::has(const Band& band) const {
  if (axis != Axis::none) {
    constexpr double rounding = 1e-9;  // the borders of bands are rounded powers of ten
    return band.axis == axis && low <= band.low * (1 + rounding) && band.high <= high * (1 + rounding);
  }
  return text == "any" || text == band.name || text == (band.region == Region::to_pi ? "to_pi" : "beyond_pi");
}

std::optional<InputRegion> parse_input_region(const std::string& text) {
  InputRegion region{text};
  for (const auto& [prefix, axis] : {std::pair(std::string("theta "), Axis::theta),
                                     std::pair(std::string("pi-theta "), Axis::pi_minus_theta)})
    if (text.starts_with(prefix)) {
      const auto dots = text.find("..");
      if (dots == text.npos) continue;
      const char *dot = text.data() + dots, *end = text.data() + text.size();
      const auto low = fromChars(text.data() + prefix.size(), dot, region.low);
      const auto high = fromChars(dot + 2, end, region.high);
      if (low.ec == std::errc() && low.ptr == dot && high.ec == std::errc() && high.ptr == end)
        region.axis = axis;
    }
  const auto in = [&](const Bands& bands) {
    return std::ranges::any_of(bands.all(), [&](const Band& b) { return region.has(b); });
  };
  if (!in(Bands::of(oracles::scalar_of<float>)) && !in(Bands::of(oracles::scalar_of<double>)))
    return std::nullopt;
  return region;
}

}  // namespace liecheck::properties
