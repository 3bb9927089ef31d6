#include <support/json.hpp>

#include <nlohmann/json.hpp>

namespace liecheck::properties {

using nlohmann::json;

json parsed(std::string_view text) {
  // Copies and texts of a value call themselves for each level: a level needs stack.
  return json::parse(text, [](int depth, json::parse_event_t, const json&) {
    if (depth > deepest_json)
      throw json::other_error::create(599, "nested more deeply than 100 levels", nullptr);
    return true;
  });
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
