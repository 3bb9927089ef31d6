#include <support/read_json.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <optional>
#include <set>
#include <support/files.hpp>
#include <support/json.hpp>
#include <support/progress.hpp>
#include <support/text.hpp>
#include <vector>

namespace liecheck::properties {

using nlohmann::json;

namespace {

/// "line 3, column 14" of the byte at index `at`; both count from 1, columns in bytes.
std::string line_and_column(std::string_view bytes, std::size_t at) {
  const std::string_view before = bytes.substr(0, at);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto newline = before.rfind('\n');
  return fmt::format("line {}, column {}", line, newline == before.npos ? at + 1 : at - newline);
}

/// Reads JSON. Throws the first error of a text that is not JSON, with its line and column.
class Reader final : public nlohmann::detail::json_sax_dom_parser<json> {
 public:
  Reader(json& value, const std::string& file, std::string_view bytes)
      : json_sax_dom_parser(value), file_(file), bytes_(bytes) {
    if (bytes.size() > 1'000'000) shown_.emplace("reading " + file);
  }
  bool start_object(std::size_t elements) {
    deeper();
    names_.emplace_back();
    return json_sax_dom_parser::start_object(elements);
  }
  bool key(std::string& name) {
    if (!names_.back().insert(name).second)
      throw std::runtime_error(fmt::format("{}: the member '{}' is given twice", file_, printable(name)));
    // A signal does not end it: a report reads the record of what was done until then.
    if (++members_ % 4096 == 0 && shown_) shown_->show(-1, fmt::format("{} members", members_));
    return json_sax_dom_parser::key(name);
  }
  bool end_object() { return --depth_, names_.pop_back(), json_sax_dom_parser::end_object(); }
  bool start_array(std::size_t elements) {
    deeper();
    return json_sax_dom_parser::start_array(elements);
  }
  bool end_array() { return --depth_, json_sax_dom_parser::end_array(); }
  bool parse_error(std::size_t byte, const std::string& token, const nlohmann::detail::exception& e) {
    constexpr int out_of_range = 406;  // a number beyond the range of double
    if (e.id == out_of_range)
      throw std::runtime_error(fmt::format("{}: {}: a number beyond double: {}", file_,
                                           line_and_column(bytes_, byte - std::min(byte, token.size())),
                                           token));
    const std::size_t at = byte > 0 ? byte - 1 : 0;
    throw std::runtime_error(
        fmt::format("{}: not JSON: {}: unexpected {}", file_, line_and_column(bytes_, at),
                    at < bytes_.size() ? fmt::format("\"{:#04x}\"", static_cast<unsigned char>(bytes_[at]))
                                       : "end of the file"));
  }

 private:
  void deeper() {
    if (++depth_ > deepest_json)
      throw std::runtime_error(fmt::format("{}: nested more deeply than {} levels", file_, deepest_json));
  }
  const std::string& file_;
  std::string_view bytes_;
  std::vector<std::set<std::string>> names_;  ///< of the open objects
  int depth_ = 0;
  std::size_t members_ = 0;
  std::optional<Progress> shown_;
};

}  // namespace

json json_of(const std::string& file, std::string_view text) {
  json value;
  Reader reader(value, file, text);
  json::sax_parse(text, &reader);
  return value;
}

json read_json(const std::string& file) {
  // Four times a record of every law, subject and hard case: 17 MB with 23 bytes for each value.
  constexpr std::size_t most_bytes = std::size_t(1) << 26, most_values = 3'000'000;
  const std::string text = read_whole(file, most_bytes);
  if (std::size_t(std::ranges::count_if(text, [](char c) { return c == ',' || c == '[' || c == '{'; })) >
      most_values)
    throw std::runtime_error(fmt::format("{}: more than {} values", file, most_values));
  return json_of(file, text);
}

}  // namespace liecheck::properties
