#include <budgets/limits.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <liecheck/text/from_chars.hpp>
#include <map>
#include <operations/operations.hpp>
#include <sstream>
#include <stdexcept>
#include <support/files.hpp>
#include <support/json.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

constexpr int format_version =
    3;  ///< 2 added `profile` and [expected], 3 lower bounds and reasons in [domain]

std::string trimmed(const std::string& text) {
  const char* const space = " \t\r";
  const auto first = text.find_first_not_of(space);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(space) - first + 1);
}

/// The parts between commas; at most n, of which the last one may contain commas.
std::vector<std::string> parts_of(const std::string& text, std::size_t n = std::string::npos) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t comma = 0; parts.size() + 1 < n && (comma = text.find(',', from)) != text.npos;
       from = comma + 1)
    parts.push_back(trimmed(text.substr(from, comma - from)));
  parts.push_back(trimmed(text.substr(from)));
  return parts;
}

/// Reads the lines of one file.
class Parser {
 public:
  Parser(const std::string& file, const std::string& text) {
    limits_.file = file, limits_.text = text;
    std::istringstream in(text);
    std::string row;
    for (line_ = 1; std::getline(in, row); ++line_) {
      check_text(row);
      row = trimmed(row.substr(0, row.find('#')));
      if (row.empty()) continue;
      if (row[0] == '[')
        enter(row);
      else
        read(row);
    }
    if (version_ == 0) refuse_file(fmt::format("has no line 'version = {}'", format_version));
    if (limits_.subject.empty()) refuse_file("names no subject: it has no line 'subject = NAME'");
  }
  SubjectLimits take() { return std::move(limits_); }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw std::invalid_argument(fmt::format("{}:{}: {}", limits_.file, line_, why));
  }
  [[noreturn]] void refuse_file(const std::string& why) const {
    throw std::invalid_argument(fmt::format("{}: {}", limits_.file, why));
  }
  void check_text(const std::string& row) const {
    const bool control = std::any_of(row.begin(), row.end(), [](unsigned char c) {
      return (c < 0x20 && c != '\t' && c != '\r') || c == 0x7f;
    });
    if (control) refuse(fmt::format("a control character in '{}'", printable(row)));
    if (!is_utf8(row)) refuse("not UTF-8");
  }

  void enter(const std::string& row) {
    check_among("section", row, {"[limits]", "[domain]", "[expected]"});
    if (version_ == 0)
      refuse(fmt::format("before section {} there must be a line 'version = {}'", row, format_version));
    if (row == "[expected]") check_version(row, 2);
    section_ = row;
  }

  void read(const std::string& row) {
    const auto equals = row.find('=');
    if (equals == row.npos) refuse(fmt::format("'{}' is not of the form NAME = VALUE", row));
    const std::string key = trimmed(row.substr(0, equals)), value = trimmed(row.substr(equals + 1));
    if (section_ == "[limits]")
      read_limit(key, value);
    else if (section_ == "[domain]")
      read_bound(key, value);
    else if (section_ == "[expected]")
      read_expected(key, value);
    else
      read_head(key, value);
  }

  void read_head(const std::string& key, const std::string& value) {
    check_among("name", key, {"version", "subject", "profile"});
    if (value.empty()) refuse(fmt::format("{} has no value", key));
    check_new(key);
    if (key == "subject") {
      limits_.subject = value, limits_.subject_line = line_;
    } else if (key == "profile") {
      check_version(key, 2);
      check_among("profile", value, profile_names());
      limits_.profile = profile_named(value);
    } else {
      for (int known = 1; known <= format_version; ++known)
        if (value == std::to_string(known)) version_ = known;
      if (version_ == 0)
        refuse(fmt::format("version '{}': this program reads versions 1 to {}", value, format_version));
    }
  }

  /// operation, block, region, rule = limit, reason
  void read_limit(const std::string& key, const std::string& value) {
    const auto names = parts_of(key);
    if (names.size() != 4) refuse(fmt::format("'{}' is not of the form OPERATION, BLOCK, REGION, RULE", key));
    Budget b;
    b.operation = names[0], b.block = names[1], b.region = names[2];
    check_operation(b.operation);
    check_among("block", b.block, blocks_of(b.operation));
    check_among("region", b.region, {"to_pi", "beyond_pi", "any"});
    check_among("rule", names[3], {"forward", "excess"});
    b.rule = names[3] == "forward" ? Rule::forward : Rule::excess;
    const auto cells = parts_of(value, 2);
    b.limit = positive("limit", cells[0]);
    b.reason = fmt::format("{}: {}", limits_.file, cells.size() > 1 ? cells[1] : "no reason given");
    if (std::none_of(budget_lines().begin(), budget_lines().end(), [&](const Budget& row) {
          return row.subject.empty() && (replaces(b, row, "to_pi") || replaces(b, row, "beyond_pi"));
        }))
      refuse(fmt::format("'{}' names no limit: the budget table has none with this region and rule", key));
    check_new(fmt::format("{}, {}, {}, {}", b.operation, b.block, b.region, names[3]));
    limits_.lines.push_back(b);
  }

  /// operation, quantity = largest, reason; or operation, quantity >= smallest, reason
  void read_bound(std::string key, const std::string& value) {
    const bool lower = key.ends_with('>');
    if (lower) {
      check_version("a lower bound", 3);
      key = trimmed(key.substr(0, key.size() - 1));
    }
    const auto names = parts_of(key), cells = parts_of(value, 2);
    if (names.size() != 2) refuse(fmt::format("'{}' is not of the form OPERATION, QUANTITY", key));
    if (cells.size() > 1) check_version("the reason of a bound", 3);
    check_operation(names[0]);
    check_among("quantity", names[1], quantity_names());
    const auto& known = quantity_names();
    DomainBound b{nullptr,
                  static_cast<Quantity>(std::find(known.begin(), known.end(), names[1]) - known.begin()),
                  positive("bound", cells[0]), lower, cells.size() > 1 ? cells[1] : ""};
    for (const Operation* o : all_operations())
      if (o->name == names[0]) b.operation = o;
    if (b.operation && !takes(*b.operation, b.quantity))
      refuse(fmt::format("'{}' names nothing: {} takes no {}", key, names[0], names[1]));
    check_new(fmt::format("domain {}, {}{}", names[0], names[1], lower ? " >=" : ""));
    limits_.domain.push_back(b);
  }

  /// operation, block, inputs = reason, link
  void read_expected(const std::string& key, const std::string& value) {
    const auto names = parts_of(key);
    if (names.size() != 3) refuse(fmt::format("'{}' is not of the form OPERATION, BLOCK, INPUTS", key));
    if (names[0] == "*" || names[1] == "*")
      refuse(fmt::format("'{}' expects too much: * is not allowed", key));
    check_operation(names[0]);
    std::vector<std::string> blocks;
    for (const Budget& b : budget_lines())
      if (b.operation == names[0] && std::ranges::count(blocks, b.block) == 0) blocks.push_back(b.block);
    if (std::ranges::count(blocks, names[1]) == 0)
      refuse(fmt::format("no law measures the block '{}' of '{}'; those of it: {}", names[1], names[0],
                         fmt::join(blocks, ", ")));
    const auto inputs = parse_input_region(names[2]);
    if (!inputs)
      refuse(fmt::format("no band of inputs is '{}', such as 'theta 1e-9..1e-3', 'pi', 'beyond_pi' or 'any'",
                         names[2]));
    const auto comma = value.rfind(',');
    const std::string reason = trimmed(value.substr(0, comma)),
                      link = comma == value.npos ? "" : trimmed(value.substr(comma + 1));
    if (reason.empty() || link.empty() || link.find_first_of(" \t") != link.npos)
      refuse(fmt::format("'{}' is not of the form REASON, LINK", value));
    check_new(fmt::format("expected {}, {}, {}", names[0], names[1], names[2]));
    limits_.expected.push_back({names[0], names[1], *inputs, reason, link});
  }

  static std::vector<std::string> blocks_of(const std::string& operation) {
    std::vector<std::string> blocks{"*"};
    for (const Budget& b : budget_lines())
      if (b.subject.empty() && (operation == "*" || b.operation == operation) &&
          std::find(blocks.begin(), blocks.end(), b.block) == blocks.end())
        blocks.push_back(b.block);
    return blocks;
  }
  void check_operation(const std::string& name) const {
    if (name != "*" && std::none_of(all_operations().begin(), all_operations().end(),
                                    [&](const Operation* o) { return o->name == name; }))
      refuse(fmt::format("unknown operation '{}'; 'liecheck list --operations' shows them, * means every one",
                         name));
  }
  void check_among(const char* what, const std::string& name, const std::vector<std::string>& known) const {
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse(fmt::format("unknown {} '{}'; known: {}", what, name, fmt::join(known, ", ")));
  }
  void check_version(const std::string& what, int since) const {
    if (version_ < since) refuse(fmt::format("{} needs a line 'version = {}' before it", what, since));
  }
  void check_new(const std::string& what) {
    const auto [first, is_new] = seen_.emplace(what, line_);
    if (!is_new) refuse(fmt::format("'{}' is already in line {}", what, first->second));
  }
  double positive(const char* what, const std::string& text) const {
    double x = 0;
    const auto [end, error] = fromChars(text.data(), text.data() + text.size(), x);
    if (error != std::errc() || end != text.data() + text.size() || !(x > 0) || std::isinf(x))
      refuse(fmt::format("{} '{}' is not a positive and finite number", what, text));
    return x;
  }

  SubjectLimits limits_;
  std::map<std::string, int> seen_;  ///< what a line names, and its line
  std::string section_;
  int version_ = 0;  ///< 0: not read yet
  int line_ = 0;
};

}  // namespace

SubjectLimits parse_limits(const std::string& file, const std::string& text) {
  return Parser(file, text).take();
}

SubjectLimits read_limits(const std::string& path) {
  constexpr std::size_t most_bytes = 4 << 20;  // every limit of every operation takes less than a tenth of it
  return parse_limits(path, without_mark(read_whole(path, most_bytes)));
}

}  // namespace liecheck::properties
