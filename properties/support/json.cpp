#include <support/json.hpp>

#include <nlohmann/json.hpp>

namespace liecheck::properties {

using nlohmann::json;

json parsed(std::string_view text) {
  return json::parse(text);
}

std::string dumped(const json& value, int indent) {
  return value.dump(indent);
}

bool is_utf8(const std::string& text) try {
  return !json(text).dump().empty();
} catch (const json::exception&) {
  return false;
}

}  // namespace liecheck::properties
