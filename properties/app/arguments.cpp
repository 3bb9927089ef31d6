#include <app/arguments.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <charconv>
#include <stdexcept>

namespace liecheck::properties {

namespace {

/// Throws CLI::ValidationError naming the flag.
std::uint64_t decimal(const std::string& flag, const std::string& text, std::uint64_t low,
                      std::uint64_t high) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool plain =
      error == std::errc() && end == text.data() + text.size() && std::to_string(value) == text;
  if (!plain || value < low || value > high)
    throw CLI::ValidationError(flag,
                               fmt::format("'{}' is not a decimal number from {} to {}", text, low, high));
  return value;
}

/// Returns the duration in seconds. Throws std::invalid_argument.
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

/// What is wrong with a duration, or "".
std::string duration_error(const std::string& text) {
  try {
    parse_duration(text);
    return "";
  } catch (const std::exception& e) {
    return e.what();
  }
}

std::string empty_error(const std::string& value) {
  return value.empty() ? "may not be empty" : "";
}

CLI::Option* named(CLI::Option* option, const std::string& value) {
  return value.empty() ? option : option->type_name(value)->check(empty_error, "");
}

std::string long_name(const std::string& names) {
  return names.substr(names.rfind("--"));
}

}  // namespace

Flag Flag::required() const {
  return Flag(option_->required());
}
Flag Flag::needs(Flag other) const {
  return Flag(option_->needs(other.option_));
}
Flag Flag::excludes(Flag other) const {
  return Flag(option_->excludes(other.option_));
}
Flag Flag::with_default_in_help() const {
  return Flag(option_->capture_default_str());
}
Flag Flag::without_default_in_help() const {
  return Flag(option_->default_str(""));
}
Flag Flag::once_for_each_value() const {
  return Flag(option_->allow_extra_args(false));
}
bool Flag::given() const {
  return option_ && option_->count() > 0;
}

Arguments::Arguments(CLI::App& parent, const std::string& name, const std::string& help)
    : command_(*parent.add_subcommand(name, help)) {}

Flag Arguments::text(const std::string& names, std::string& target, const std::string& value,
                     const std::string& help) {
  return Flag(named(command_.add_option(names, target, help), value));
}

Flag Arguments::choice(const std::string& names, std::string& target, const std::vector<std::string>& words,
                       const std::string& value, const std::string& help) {
  return Flag(named(command_.add_option(names, target, help)->check(CLI::IsMember(words)), value));
}

Flag Arguments::list(const std::string& names, std::vector<std::string>& target, const std::string& value,
                     const std::string& help) {
  return Flag(named(command_.add_option(names, target, help), value));
}

Flag Arguments::toggle(const std::string& names, bool& target, const std::string& help) {
  return Flag(command_.add_flag(names, target, help));
}

Flag Arguments::add_number(const std::string& names, const std::string& shown, std::uint64_t low,
                           std::uint64_t high, const std::string& help,
                           const std::function<void(std::uint64_t)>& set) {
  const auto read = [set, flag = long_name(names), low, high](const std::string& text) {
    set(decimal(flag, text, low, high));
  };
  return Flag(
      command_.add_option_function<std::string>(names, read, help)->type_name("N")->default_str(shown));
}

Flag Arguments::numbers(const std::string& names, std::vector<long>& target, std::uint64_t low,
                        std::uint64_t high, const std::string& help) {
  const auto read = [&target, flag = long_name(names), low, high](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) target.push_back(static_cast<long>(decimal(flag, text, low, high)));
  };
  return Flag(command_.add_option_function<std::vector<std::string>>(names, read, help)->type_name("N"));
}

Flag Arguments::add_duration(const std::string& names, const std::string& help,
                             const std::function<void(double)>& set) {
  const auto read = [set](const std::string& text) { set(parse_duration(text)); };
  return Flag(named(command_.add_option_function<std::string>(names, read, help), "DURATION")
                  ->check(duration_error, ""));
}

}  // namespace liecheck::properties
