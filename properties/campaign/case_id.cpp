#include <campaign/case_id.hpp>

#include <campaign/digest.hpp>

#include <fmt/format.h>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <stdexcept>

namespace liecheck::properties {

std::string CaseId::text() const {
  if (raw) return fmt::format("raw.{}.{}.{}.{}.{}", property, subject, scalar, robot, fmt::join(input, ","));
  return fmt::format("g{}.{}.{}.{}.{}.{}.{}", generator_version, seed, property, subject, scalar, robot,
                     index);
}

namespace {

std::uint64_t number(const std::string& text, const std::string& what, const std::string& id) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw std::invalid_argument(fmt::format("case ID '{}': {} is not a number: '{}'", id, what, text));
  return value;
}

/// Whether a number that was typed has a digit other than 0 before its exponent.
bool has_digits(const std::string& text) {
  const auto x = text.find_first_of("xX");
  if (x == std::string::npos) return text.find_first_of("123456789") < text.find_first_of("eE");
  return text.find_first_of("123456789abcdefABCDEF", x) < text.find_first_of("pP");
}

/// Throws std::invalid_argument naming the text, if it is no number or one that the scalar cannot hold.
void check_float(const std::string& scalar, const std::string& text) {
  if (!text.empty() && std::isspace(static_cast<unsigned char>(text[0])))
    throw std::invalid_argument(fmt::format("not a number: '{}'", text));
  parse_float(text, oracles::scalar_named(scalar));
}

/// Splits the text at the separator into at most n parts.
std::vector<std::string> parts(const std::string& text, char separator, std::size_t n = std::string::npos) {
  std::vector<std::string> all(1);
  for (const char c : text)
    if (c == separator && all.size() < n)
      all.emplace_back();
    else
      all.back() += c;
  return all;
}

}  // namespace

CaseId CaseId::parse(const std::string& text) {
  CaseId id;
  if (text.rfind("raw.", 0) == 0) {
    const auto p = parts(text, '.', 6);
    if (p.size() != 6)
      throw std::invalid_argument(
          fmt::format("case ID '{}': expected raw.PROPERTY.SUBJECT.SCALAR.ROBOT.NUMBERS", text));
    id.raw = true;
    id.property = p[1], id.subject = p[2], id.scalar = p[3], id.robot = p[4];
    id.input = parts(p[5], ',');
    for (std::size_t i = 0; i < id.input.size(); ++i) try {
        check_float(id.scalar, id.input[i]);
      } catch (const std::invalid_argument& e) {
        throw std::invalid_argument(fmt::format("case ID '{}': number {} is {}", text, i + 1, e.what()));
      }
    return id;
  }
  const auto p = parts(text, '.', 7);
  if (p.size() != 7 || p[0].size() < 2 || p[0][0] != 'g')
    throw std::invalid_argument(
        fmt::format("case ID '{}': expected gVERSION.SEED.PROPERTY.SUBJECT.SCALAR.ROBOT.INDEX", text));
  const std::uint64_t version = number(p[0].substr(1), "the generator version", text);
  if (version != static_cast<std::uint64_t>(generator_version))
    throw std::invalid_argument(fmt::format("case ID '{}' needs generator version {}, this program has {}",
                                            text, version, generator_version));
  id.seed = number(p[1], "the seed", text);
  id.property = p[2], id.subject = p[3], id.scalar = p[4], id.robot = p[5];
  id.index = number(p[6], "the index", text);
  return id;
}

Source::Key CaseId::series_key() const {
  return sha256(fmt::format("g{}.{}.{}.{}.{}", generator_version, seed, property, scalar, robot));
}

std::string hexadecimal_float(double x) {
  char buffer[128];
  std::snprintf(buffer, sizeof buffer, "%a", x);
  return buffer;
}

std::string decimal_float(double x, const oracles::Scalar& scalar) {
  return scalar.is_float() ? fmt::format("{}", static_cast<float>(x)) : fmt::format("{}", x);
}

double parse_float(const std::string& text, const oracles::Scalar& scalar) {
  const char* begin = text.c_str();
  char* end = nullptr;
  const double value = scalar.is_float() ? std::strtof(begin, &end) : std::strtod(begin, &end);
  if (text.empty() || end != begin + text.size())
    throw std::invalid_argument(fmt::format("not a number: '{}'", text));
  if (value == 0 && has_digits(text))
    throw std::invalid_argument(fmt::format("rounded to zero in {}: '{}'", scalar.name, text));
  if (std::isinf(value) && text.find_first_of("nN") == std::string::npos)  // not typed as inf
    throw std::invalid_argument(fmt::format("beyond the range of {}: '{}'", scalar.name, text));
  return value;
}

}  // namespace liecheck::properties
