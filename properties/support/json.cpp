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
  const std::string text = value.dump(indent);
  std::string all;  // with DEL and the control characters C1 escaped, which nlohmann-json writes as they are
  std::size_t from = 0;
  for (std::size_t i = text.find_first_of("\x7f\xc2"); i != text.npos;
       i = text.find_first_of("\x7f\xc2", i + 1)) {
    const bool del = text[i] == '\x7f';
    if (!del && static_cast<unsigned char>(text[i + 1]) >= 0xa0) continue;
    all.append(text, from, i - from)
        .append(fmt::format("\\u{:04x}", static_cast<unsigned char>(text[del ? i : i + 1])));
    from = del ? i + 1 : i + 2;
  }
  return from == 0 ? text : all.append(text, from);
}

bool is_utf8(const std::string& text) try {
  return !json(text).dump().empty();
} catch (const json::exception&) {
  return false;
}

}  // namespace liecheck::properties
