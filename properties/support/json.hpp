#pragma once
// JSON as text: nlohmann-json's parser and writer, compiled once.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace liecheck::properties {

/// Throws nlohmann::json::exception if the text is not JSON or has a number beyond double.
nlohmann::json parsed(std::string_view text);

/// The value as text; `indent` is that of json::dump().
std::string dumped(const nlohmann::json& value, int indent = -1);

bool is_utf8(const std::string& text);

}  // namespace liecheck::properties
