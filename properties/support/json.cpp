#include <support/json.hpp>

#include <fmt/format.h>
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
  std::string text = value.dump(indent);
  std::string all;  // with DEL and the control characters C1 escaped, which nlohmann-json writes as they are
  std::size_t from = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {  // find_first_of takes three times as long
    const bool del = text[i] == '\x7f';
    if (!del && (text[i] != '\xc2' || static_cast<unsigned char>(text[i + 1]) >= 0xa0)) continue;
    all.append(text, from, i - from)
        .append(fmt::format("\\u{:04x}", static_cast<unsigned char>(text[del ? i : i + 1])));
    from = del ? i + 1 : i + 2;
  }
  if (from == 0) return text;
  return all.append(text, from);
}

bool is_utf8(const std::string& text) try {
  return !json(text).dump().empty();
} catch (const json::exception&) {
  return false;
}

}  // namespace liecheck::properties
