#include <failures/shapes.hpp>

#include <fmt/format.h>
#include <cmath>

namespace liecheck::properties {

std::string short_angle(double theta) {
  if (std::fabs(std::log10(theta) - std::round(std::log10(theta))) < 0.02) return power_of_ten(theta);
  std::string text = fmt::format("{:.2g}", theta);
  if (const auto zero = text.find("e-0"); zero != text.npos) text.erase(zero + 2, 1);
  return text;
}
std::string power_of_ten(double theta) {
  return fmt::format("1e{}", static_cast<int>(std::lround(std::log10(theta))));
}

std::string_view operation_of(const FailedBlock& f) {
  return f.worst->series->outputs.at(f.worst->output).operation;
}
bool has_angle(const FailedBlock& f) {
  return f.block == "rotation vector" || operation_of(f) == "relative_angle" ||
         operation_of(f) == "angle_between";
}

}  // namespace liecheck::properties
