#include <app/arguments.hpp>

#include <fmt/format.h>
#include <charconv>
#include <stdexcept>
#include <vector>

namespace liecheck::properties {

std::uint64_t decimal(const std::string& what, const std::string& text, std::uint64_t low,
                      std::uint64_t high) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool plain =
      error == std::errc() && end == text.data() + text.size() && std::to_string(value) == text;
  if (!plain || value < low || value > high)
    throw CLI::ValidationError(what,
                               fmt::format("'{}' is not a decimal number from {} to {}", text, low, high));
  return value;
}

double parse_duration(const std::string& text) {
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  const std::string unit(end, text.data() + text.size());
  const double factor = unit.empty() || unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
  if (error != std::errc() || factor == 0 || !(value > 0) || !(value * factor <= 1e7))
    throw std::invalid_argument(fmt::format("not a duration up to 1e7 s: '{}' (write 30s, 5m or 1h)", text));
  return value * factor;
}

CLI::Option* filled(CLI::Option* option, const std::string& value_name) {
  return option->type_name(value_name)
      ->check([](const std::string& value) { return std::string(value.empty() ? "may not be empty" : ""); },
              "");
}

std::string usage_error(const CLI::App& app, const CLI::ParseError& e) {
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  const auto commands = at->get_subcommands([](const CLI::App*) { return true; });
  const auto rest = at->remaining();
  if (commands.empty() || (rest.empty() && at == &app)) return e.what();
  std::vector<std::string> known;
  for (const CLI::App* command : commands) known.push_back(command->get_name());
  if (rest.empty()) return fmt::format("{}: which one? {}", at->get_name(), fmt::join(known, ", "));
  return fmt::format("unknown {} '{}'; commands{}: {}", rest[0].rfind('-', 0) == 0 ? "option" : "command",
                     rest[0], at == &app ? "" : " of " + at->get_name(), fmt::join(known, ", "));
}

}  // namespace liecheck::properties
