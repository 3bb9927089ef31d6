#pragma once
// A field of a record that is being checked: every complaint names its file, its place and its value.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <reports/record.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace liecheck::reports {

/// A value in an error line: short, and on one line.
inline std::string shown(const Json& value) {
  std::string text = value.dump(-1, ' ', true);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

/// A JSON value with the way to it, so that every complaint can name its field.
class Field {
 public:
  Field(const std::string& file, std::string path, const Json& value)
      : file_(file), path_(std::move(path)), value_(value) {}

  [[noreturn]] void refuse(std::string_view expected) const {
    throw std::runtime_error(fmt::format("{}: field {}: expected {}, found {}", file_,
                                         path_.empty() ? "(top level)" : path_, expected, shown(value_)));
  }

  Field operator[](const char* name) const {
    if (!value_.is_object()) refuse("an object");
    const auto it = value_.find(name);
    if (it == value_.end())
      throw std::runtime_error(
          fmt::format("{}: field {}{}{} is missing", file_, path_, path_.empty() ? "" : ".", name));
    return {file_, path_.empty() ? name : path_ + "." + name, *it};
  }

  template <class Check>
  void each(Check check) const {
    if (!value_.is_array()) refuse("an array");
    for (std::size_t i = 0; i < value_.size(); ++i)
      check(Field(file_, fmt::format("{}[{}]", path_, i), value_[i]));
  }

  void not_empty() const {
    if (value_.empty()) refuse("at least one entry");
  }

  void text() const {
    if (!value_.is_string()) refuse("a string");
  }
  void one_of(std::initializer_list<std::string_view> words) const {
    const bool known =
        value_.is_string() && std::any_of(words.begin(), words.end(), [this](std::string_view w) {
          return value_.get_ref<const std::string&>() == w;
        });
    if (!known) refuse(fmt::format("one of {}", fmt::join(words, ", ")));
  }
  void boolean() const {
    if (!value_.is_boolean()) refuse("true or false");
  }
  /// The text of a field that has been checked to be one.
  std::string string(const char* name) const { return value_.at(name).get<std::string>(); }
  /// Finite (JSON knows no other) and not negative.
  double number() const {
    if (!value_.is_number() || !(value_.get<double>() >= 0)) refuse("a number >= 0");
    return value_.get<double>();
  }
  /// Finite, of any sign.
  void real() const {
    if (!value_.is_number()) refuse("a number");
  }
  void length(std::size_t count) const {
    if (!value_.is_array() || value_.size() != count) refuse(fmt::format("{} entries", count));
  }
  /// A count that a double holds, at least `low` and at most `high`.
  std::uint64_t count(std::uint64_t low = 0, std::uint64_t high = std::uint64_t(1) << 53) const {
    if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() < low ||
        value_.get<std::uint64_t>() > high)
      refuse(fmt::format("a count from {} to {}", low, high));
    return value_.get<std::uint64_t>();
  }
  void seed() const {
    if (!value_.is_number_unsigned()) refuse("a seed, 0 to 2^64 - 1");
  }
  void measured() const {
    const bool word = value_.is_string() && (value_ == "inf" || value_ == "nan");
    const bool error = value_.is_number() && value_.get<double>() >= 0;
    if (!word && !error) refuse("a number >= 0, \"inf\" or \"nan\"");
  }
  bool is(std::string_view word) const { return value_.is_string() && value_ == word; }
  bool null() const { return value_.is_null(); }
  bool has(const char* name) const { return value_.is_object() && value_.contains(name); }
  void texts(std::initializer_list<const char*> names) const {
    for (const char* name : names) (*this)[name].text();
  }

 private:
  const std::string& file_;
  std::string path_;
  const Json& value_;
};

}  // namespace liecheck::reports
