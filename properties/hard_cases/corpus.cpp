#include <hard_cases/corpus.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <support/embedded.hpp>
#include <support/json.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

std::string trimmed(const std::string& text) {
  const char* const space = " \t\r";
  const auto first = text.find_first_not_of(space);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(space) - first + 1);
}

std::vector<std::string> split(const std::string& text, char by) {
  std::vector<std::string> parts;
  std::istringstream in(text + by);
  for (std::string part; std::getline(in, part, by);) parts.push_back(trimmed(part));
  return parts;
}

[[noreturn]] void refuse(const std::string& place, const std::string& why) {
  throw std::invalid_argument(place + ": " + why);
}

/// Refuses text that is unsafe in a terminal or a record: control characters, or text that is not UTF-8.
void check_text(const std::string& place, const std::string& row) {
  const auto control =
      std::find_if(row.begin(), row.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (control != row.end())
    refuse(place, fmt::format("control character {:#04x} in column {}", static_cast<unsigned char>(*control),
                              control - row.begin() + 1));
  if (!is_utf8(row)) refuse(place, "not UTF-8");
}

/// The value of a field that a case leaves out: (1 + k, 2, 3 - 2 k) for the k-th vector, from 0; the
/// identity; a zero rotation vector; the inertia of a unit ball.
std::vector<std::string> default_value(const Field& field, int vectors_before, const Scalar& scalar) {
  static constexpr const char* covariance =
      "1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1";
  static const std::map<Kind, const char*> plain = {{Kind::rotation_vector, "0, 0, 0"},
                                                    {Kind::quaternion, "0, 0, 0, 1"},
                                                    {Kind::any_quaternion, "0, 0, 0, 1"},
                                                    {Kind::rotation_matrix, "1, 0, 0, 0, 1, 0, 0, 0, 1"},
                                                    {Kind::inertia, "1, 0, 1, 0, 0, 1"},
                                                    {Kind::near_rotation, "1, 0, 0, 0, 1, 0, 0, 0, 1"},
                                                    {Kind::covariance, covariance},
                                                    {Kind::direction, "0, 0, 1"},
                                                    {Kind::fraction, "1/2"}};
  if (field.kind == Kind::vector && field.size == 3)
    return evaluate(fmt::format("{}, 2, {}", 1 + vectors_before, 3 - 2 * vectors_before), scalar);
  if (const auto found = plain.find(field.kind); found != plain.end()) return evaluate(found->second, scalar);
  throw std::invalid_argument(fmt::format("field {} must be given", field.name));
}

std::vector<std::string> named_numbers(const HardCase& c, const std::vector<Field>& fields,
                                       const Scalar& scalar) {
  std::map<std::string, std::string> given;
  for (const std::string& part : split(c.input, ';')) {
    const auto equals = part.find('=');
    if (equals == std::string::npos)
      throw std::invalid_argument(fmt::format("'{}' is not of the form field = numbers", part));
    const std::string name = trimmed(part.substr(0, equals));
    if (std::none_of(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; })) {
      std::string known;
      for (const Field& f : fields) known += (known.empty() ? "" : ", ") + f.name;
      throw std::invalid_argument(fmt::format("no field '{}' here; fields: {}", name, known));
    }
    if (!given.emplace(name, part.substr(equals + 1)).second)
      throw std::invalid_argument(fmt::format("field {} is given twice", name));
  }
  std::vector<std::string> all;
  int vectors = 0;
  for (const Field& f : fields) {
    const auto found = given.find(f.name);
    const auto values =
        found == given.end() ? default_value(f, vectors, scalar) : evaluate(trimmed(found->second), scalar);
    if (values.size() != static_cast<std::size_t>(f.size))
      throw std::invalid_argument(fmt::format("field {} takes {} numbers, {} were given: '{}'", f.name,
                                              f.size, values.size(), trimmed(found->second)));
    all.insert(all.end(), values.begin(), values.end());
    vectors += f.kind == Kind::vector;
  }
  return all;
}

}  // namespace

std::string HardCase::place() const {
  return fmt::format("{}:{}", file, line);
}

std::vector<HardCase> parse_corpus(const std::string& file, const std::string& text) {
  std::vector<HardCase> cases;
  std::istringstream in(text);
  std::string row;
  for (int line = 1; std::getline(in, row); ++line) {
    row = trimmed(row);
    if (row.empty() || row[0] == '#') continue;
    HardCase c;
    c.file = file, c.line = line;
    check_text(c.place(), row);
    const auto columns = split(row, '|');
    if (columns.size() != 6) {
      if (row.size() > 80) row.replace(77, row.npos, "...");
      refuse(c.place(),
             fmt::format("{} columns instead of name | property | input | class | reason | origin: '{}'",
                         columns.size(), row));
    }
    static const char* const names[] = {"name", "property", "input", "class", "reason", "origin"};
    for (std::size_t i = 0; i < 6; ++i)
      if (columns[i].empty()) refuse(c.place(), fmt::format("column {} is empty", names[i]));
    c.name = columns[0], c.input = columns[2], c.hard_class = columns[3], c.reason = columns[4],
    c.origin = columns[5];
    if (c.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-+") != std::string::npos)
      refuse(c.place(), fmt::format("name '{}': use only a-z, 0-9, _, - and +", c.name));
    const auto in_scalars = columns[1].find(" in ");
    c.properties = split(columns[1].substr(0, in_scalars), ',');
    if (in_scalars != std::string::npos) c.scalars = split(columns[1].substr(in_scalars + 4), ',');
    for (const std::string& scalar : c.scalars) try {
        oracles::scalar_named(scalar);
      } catch (const std::invalid_argument& e) {
        refuse(c.place(), e.what());
      }
    cases.push_back(std::move(c));
  }
  check_names_differ(cases);
  return cases;
}

std::vector<HardCase> read_corpus(const std::string& path) {
  constexpr std::uintmax_t largest = 16 << 20;  // bytes: a hundred thousand lines
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw std::invalid_argument(fmt::format("{}: not a regular file", path.empty() ? "''" : path));
  if (std::filesystem::file_size(path, error) > largest)
    throw std::invalid_argument(fmt::format("{}: larger than {} bytes", path, largest));
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!(text << file.rdbuf()) || text.str().empty())
    throw std::invalid_argument(path + ": empty or not readable");
  return parse_corpus(path, without_mark(text.str()));
}

const std::vector<HardCase>& built_in_corpus() {
  static const std::vector<HardCase> all = [] {
    std::vector<HardCase> cases;
    for (const EmbeddedFile* f = hard_case_files; f->name; ++f) {
      const auto more = parse_corpus(f->name, f->text);
      cases.insert(cases.end(), more.begin(), more.end());
    }
    check_names_differ(cases);
    return cases;
  }();
  return all;
}

void check_names_differ(const std::vector<HardCase>& cases) {
  std::map<std::string, const HardCase*> seen;
  for (const HardCase& c : cases) {
    const auto [first, fresh] = seen.emplace(c.name, &c);
    if (!fresh)
      refuse(c.place(), fmt::format("name '{}' is already used in {}", c.name, first->second->place()));
  }
}

std::vector<std::string> numbers_of(const HardCase& c, const std::vector<Field>& fields,
                                    const Scalar& scalar) {
  try {
    if (c.input.find('=') != std::string::npos) return named_numbers(c, fields, scalar);
    const auto all = evaluate(c.input, scalar);
    std::size_t expected = 0;
    for (const Field& f : fields) expected += static_cast<std::size_t>(f.size);
    if (all.size() != expected)
      throw std::invalid_argument(
          fmt::format("{} numbers are needed, {} were given: '{}'", expected, all.size(), c.input));
    return all;
  } catch (const std::invalid_argument& e) {
    refuse(c.place(), fmt::format("{} in {}: {}", c.name, scalar.name, e.what()));
  }
}

}  // namespace liecheck::properties
