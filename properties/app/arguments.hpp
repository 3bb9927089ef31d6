#pragma once
// What a command line may hold, stricter than CLI11's own conversions (octal, hexadecimal, "" as 0, -1 as 2^64-1).

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace liecheck::properties {

/// A whole number written with decimal digits alone, from low to high. Throws CLI::ValidationError naming
/// `what`.
std::uint64_t decimal(const std::string& what, const std::string& text, std::uint64_t low,
                      std::uint64_t high);

/// "30s", "5m", "1h" or plain seconds, up to 10^7 s. Throws std::invalid_argument.
double parse_duration(const std::string& text);

/// A number option with its default in the help.
template <class T>
CLI::Option* add_number(CLI::App& command, const std::string& names, T& target, std::uint64_t low,
                        std::uint64_t high, const std::string& help) {
  const std::string flag = names.substr(names.rfind("--"));
  return command
      .add_option_function<std::string>(
          names,
          [&target, flag, low, high](const std::string& s) {
            target = static_cast<T>(decimal(flag, s, low, high));
          },
          help)
      ->type_name("N")
      ->default_str(std::to_string(target));
}

/// Gives an option's value a name in the help, and refuses an empty one.
CLI::Option* filled(CLI::Option* option, const std::string& value_name);

/// What CLI11 says, but a word that is no command is named.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace liecheck::properties
