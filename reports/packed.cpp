#include <algorithm>
#include <reports/html.hpp>
#include <stdexcept>
#include <unordered_map>

namespace liecheck::reports {
namespace {

/// Returns the key; throws if it could be mistaken for a key that packed() adds.
const std::string& plain(const std::string& key) {
  if (key.starts_with('*')) throw std::invalid_argument("a key may not begin with a star: " + key);
  return key;
}

bool are_rows(const Json& list) {
  if (list.size() < 2 || !list[0].is_object() || list[0].empty()) return false;
  return std::all_of(list.begin(), list.end(), [&](const Json& row) {
    return row.is_object() && row.size() == list[0].size() &&
           std::all_of(list[0].items().begin(), list[0].items().end(),
                       [&](const auto& entry) { return row.contains(entry.key()); });
  });
}

Json packed_rows(const Json& list) {
  Json keys = Json::array(), columns = Json::array();
  for (const auto& entry : list[0].items()) {
    Json column = Json::array();
    for (const Json& row : list) column.push_back(row[entry.key()]);
    keys.push_back(plain(entry.key()));
    columns.push_back(packed(column));
  }
  return {{"*keys", std::move(keys)}, {"*columns", std::move(columns)}};
}

}  // namespace

Json packed(const Json& value) {
  if (value.is_object()) {
    Json all = Json::object();
    for (const auto& entry : value.items()) all[plain(entry.key())] = packed(entry.value());
    return all;
  }
  if (!value.is_array()) return value;
  if (are_rows(value)) return packed_rows(value);
  // The distinct values and for each element the index of its value, if that is shorter than the elements.
  Json all = Json::array(), words = Json::array(), at = Json::array();
  std::unordered_map<std::string, std::size_t> places;
  std::size_t size = 0, size_of_words = std::string_view(R"({"*at":,"*words":[]})").size();
  for (const Json& part : value) {
    const std::string text = dumped(part);
    all.push_back(packed(part));
    size += (part.is_structured() ? dumped(all.back()) : text).size() + 1;
    const auto [place, is_new] = places.emplace(text, words.size());
    if (is_new) words.push_back(part), size_of_words += text.size() + 1;
    at.push_back(place->second);
    size_of_words += std::to_string(place->second).size() + 1;
  }
  return size_of_words <= size ? Json{{"*words", std::move(words)}, {"*at", std::move(at)}} : all;
}

}  // namespace liecheck::reports
