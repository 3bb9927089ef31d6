#include <liecheck/scene_file/units.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <liecheck/multibody/nearest_names.hpp>
#include <liecheck/text/from_chars.hpp>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace liecheck {
namespace {

/// Twice the powers of m, kg, s, rad. The factor 2 is for sqrt(Hz), which is s^(-1/2).
using Dimension = std::array<int, 4>;
struct Unit {
  double factor = 1;
  Dimension dimension{};
};
struct Symbol {
  const char* name;
  Unit unit;
};

const std::vector<Symbol>& symbols() {
  constexpr double degree = std::numbers::pi / 180, turn = 2 * std::numbers::pi;
  constexpr Dimension none{}, m{2}, kg{0, 2}, s{0, 0, 2}, rad{0, 0, 0, 2}, N{2, 2, -4}, Hz{0, 0, -2};
  static const std::vector<Symbol> all = {{"m", 1, m},         {"km", 1e3, m},
                                          {"cm", 1e-2, m},     {"mm", 1e-3, m},
                                          {"um", 1e-6, m},     {"kg", 1, kg},
                                          {"g", 1e-3, kg},     {"t", 1e3, kg},
                                          {"s", 1, s},         {"ms", 1e-3, s},
                                          {"us", 1e-6, s},     {"min", 60, s},
                                          {"h", 3600, s},      {"rad", 1, rad},
                                          {"mrad", 1e-3, rad}, {"deg", degree, rad},
                                          {"turn", turn, rad}, {"rpm", turn / 60, {0, 0, -2, 2}},
                                          {"N", 1, N},         {"kN", 1e3, N},
                                          {"mN", 1e-3, N},     {"Pa", 1, {-2, 2, -4}},
                                          {"Hz", 1, Hz},       {"sqrt(Hz)", 1, {0, 0, -1}},
                                          {"l", 1e-3, {6}},    {"%", 1e-2, none},
                                          {"1", 1, none}};
  return all;
}

/// The symbol in `text`. If there is none, names the nearest: of those of one of the dimensions, if there are any.
Unit symbolNamed(const std::string& name, const std::string& text, const std::vector<Dimension>& wanted) {
  std::vector<std::string> names, fitting;
  for (const Symbol& s : symbols()) {
    if (name == s.name) return s.unit;
    names.emplace_back(s.name);
    if (std::ranges::find(wanted, s.unit.dimension) != wanted.end()) fitting.emplace_back(s.name);
  }
  throw std::invalid_argument("unknown unit '" + name + "' in '" + text + "'" +
                              multibody_detail::nearestNames(name, fitting.empty() ? names : fitting));
}

Unit parseUnit(const std::string& text, const std::vector<Dimension>& wanted = {}) {
  Unit unit;
  int sign = 1;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ' ' || text[i] == '/') {
      if (text[i++] == '/') sign = -1;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" /^", i), text.size());
    const std::string name = text.substr(i, end - i);
    const Unit symbol = symbolNamed(name, text, name == text ? wanted : std::vector<Dimension>());
    int power = 1;
    i = end;
    if (i < text.size() && text[i] == '^') {
      const auto [after, error] = std::from_chars(text.data() + i + 1, text.data() + text.size(), power);
      if (error != std::errc() || power < -9 || power > 9 || power == 0)
        throw std::invalid_argument("the power of '" + name + "' in unit '" + text +
                                    "' is not a number from -9 to 9");
      i = std::size_t(after - text.data());
      if (i < text.size() && text[i] != ' ' && text[i] != '/')
        throw std::invalid_argument("unit '" + text + "' cannot be read after '" + text.substr(0, i) + "'");
    }
    unit.factor *= std::pow(symbol.factor, sign * power);
    for (std::size_t k = 0; k < 4; ++k) unit.dimension[k] += sign * power * symbol.dimension[k];
  }
  return unit;
}

}  // namespace

std::vector<std::string> alternatives(const std::string& joined) {
  std::vector<std::string> all;
  for (std::size_t at = 0; at <= joined.size();) {
    const std::size_t bar = std::min(joined.find('|', at), joined.size());
    all.push_back(joined.substr(at, bar - at));
    at = bar + 1;
  }
  return all;
}

double parseQuantity(const std::string& text, const std::string& unit) {
  double value = 0;
  const char* begin = text.data();
  const char* last = text.data() + text.size();
  if (text.starts_with('+') && !text.starts_with("+-")) ++begin;
  const auto [end, error] = fromChars(begin, last, value);
  const std::string wanted = unit == "1" ? "a number" : "a number in " + unit;
  if (error == std::errc::result_out_of_range)
    throw std::invalid_argument("'" + text + "' is outside the range of double");
  if (error != std::errc()) throw std::invalid_argument("'" + text + "' is not " + wanted);
  std::string rest(end, last);
  rest.erase(0, std::min(rest.find_first_not_of(' '), rest.size()));
  if (!std::isfinite(value)) throw std::invalid_argument("'" + text + "' is not finite: write " + wanted);
  if (rest.empty()) return value;
  std::vector<Dimension> dimensions;
  for (const std::string& expected : alternatives(unit)) dimensions.push_back(parseUnit(expected).dimension);
  const Unit given = parseUnit(rest, dimensions);
  for (const Dimension& expected : dimensions) {
    if (given.dimension != expected) continue;
    const double scaled = value * given.factor;
    if (!std::isfinite(scaled) || (scaled == 0 && value != 0))
      throw std::invalid_argument("'" + text + "' is outside the range of double");
    return scaled;
  }
  throw std::invalid_argument("'" + rest + "' is not a unit of this quantity: write " + wanted);
}

}  // namespace liecheck
