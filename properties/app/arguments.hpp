#pragma once
// The arguments of a command, parsed by CLI11. Numbers are checked here, because CLI11 also reads octal and
// hexadecimal, "" as 0, and -1 as 2^64-1. This header hides CLI11, which takes five seconds to compile.

#include <app/command.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class Option;
}

namespace liecheck::properties {

/// A flag or a positional argument of a command.
class Flag {
 public:
  explicit Flag(CLI::Option* option = nullptr) : option_(option) {}
  Flag required() const;
  Flag needs(Flag other) const;
  Flag excludes(Flag other) const;
  Flag with_default_in_help() const;
  Flag without_default_in_help() const;
  Flag once_for_each_value() const;  ///< for lists: "--steps 4 --steps 8", not "--steps 4 8"
  bool given() const;                ///< whether the parsed command line has it

 private:
  CLI::Option* option_;
};

/// Adds a command to a program and flags to the command. A target is filled when the command line is parsed,
/// and must live until then. `value` names the value in the help; if it is "", an empty value is accepted.
class Arguments {
 public:
  Arguments(CLI::App& parent, const std::string& name, const std::string& help);

  Flag text(const std::string& names, std::string& target, const std::string& value, const std::string& help);
  /// A value that must be one of `words`.
  Flag choice(const std::string& names, std::string& target, const std::vector<std::string>& words,
              const std::string& value, const std::string& help);
  /// A flag that may be repeated.
  Flag list(const std::string& names, std::vector<std::string>& target, const std::string& value,
            const std::string& help);
  Flag toggle(const std::string& names, bool& target, const std::string& help);

  /// A whole number in decimal digits, from low to high, with its default in the help.
  template <class T>
  Flag number(const std::string& names, T& target, std::uint64_t low, std::uint64_t high,
              const std::string& help) {
    return add_number(names, std::to_string(target), low, high, help,
                      [&target](std::uint64_t n) { target = static_cast<T>(n); });
  }
  /// Like number(), but the flag may be repeated.
  Flag numbers(const std::string& names, std::vector<long>& target, std::uint64_t low, std::uint64_t high,
               const std::string& help);

  /// "30s", "5m", "1h" or plain seconds, up to 10^7 s. T is double or std::optional<double>.
  template <class T>
  Flag duration(const std::string& names, T& seconds, const std::string& help) {
    return add_duration(names, help, [&seconds](double s) { seconds = s; });
  }

  /// Returns the command, after its flags were added.
  Command command(std::function<int()> run) const { return {&command_, std::move(run)}; }

 private:
  Flag add_number(const std::string& names, const std::string& shown, std::uint64_t low, std::uint64_t high,
                  const std::string& help, const std::function<void(std::uint64_t)>& set);
  Flag add_duration(const std::string& names, const std::string& help,
                    const std::function<void(double)>& set);

  CLI::App& command_;
};

}  // namespace liecheck::properties
