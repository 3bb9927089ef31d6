#pragma once
// JSON as text: nlohmann-json's parser and writer, compiled once.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace liecheck::properties {

/// The most levels of lists and objects in each other.
inline constexpr int deepest_json = 100;

/// Throws nlohmann::json::exception if the text is not JSON, has a number beyond double, or is nested too deeply.
nlohmann::json parsed(std::string_view text);

/// The value as text; `indent` is that of json::dump().
std::string dumped(const nlohmann::json& value, int indent = -1);

bool is_utf8(const std::string& text);

}  // namespace liecheck::properties
