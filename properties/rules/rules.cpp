#include <rules/rules.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <budgets/profile.hpp>
#include <campaign/case_id.hpp>
#include <campaign/digest.hpp>
#include <campaign/robots.hpp>
#include <invariants/property.hpp>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <support/embedded.hpp>

namespace liecheck::properties {
namespace {

std::string digest(const std::string& text) {
  return hexadecimal(sha256(text)).substr(0, 16);
}

/// The bits of the first inputs of the law.
std::string inputs_of(const Property& law) {
  constexpr std::uint64_t seed = 42, cases = 64;
  CaseId id;
  id.seed = seed, id.property = law.name(), id.scalar = law.scalar().name, id.robot = "none";
  std::string bits;
  for (std::uint64_t i = 0; i < cases; ++i) {
    Source stream(CaseId::key_of(id.series_key(), i));
    const std::vector<double> x = law.generate(stream);
    law.scalar().with([&]<class S>() {
      const std::vector<S> own = oracles::numbers_in<S>(x);
      bits.append(reinterpret_cast<const char*>(own.data()), own.size() * sizeof(S));
    });
  }
  return bits;
}

void add_laws(const oracles::Scalar& scalar, std::map<std::string, std::string>& inputs) {
  for (const auto& law : make_properties(scalar)) {
    law->prepare(built_in_robot());
    inputs["law " + law->name()] += inputs_of(*law);
  }
}

void add_limits(const oracles::Scalar& scalar, std::map<std::string, std::string>& parts) {
  for (const std::string& name : profile_names()) {
    std::string text;
    for (const Budget& b : budgets("", *profile_named(name), scalar.epsilon))
      text +=
          fmt::format("{},{},{},{},{:a}\n", b.operation, b.block, b.region, b.rule == Rule::forward, b.limit);
    parts[fmt::format("limits {} {}", name, scalar.name)] = digest(text);
  }
}

Rules of_this_program() {
  Rules rules{"present", {}};
  std::map<std::string, std::string> inputs;
  for (const oracles::Scalar* s : {&oracles::scalar_of<float>, &oracles::scalar_of<double>})
    add_laws(*s, inputs);
  for (const auto& [law, bits] : inputs) rules.parts[law] = digest(bits);
  for (const oracles::Scalar* s : {&oracles::scalar_of<float>, &oracles::scalar_of<double>})
    add_limits(*s, rules.parts);
  for (const HardCase& c : built_in_corpus())
    rules.parts["hard case " + c.name] = digest(fmt::format(
        "{}|{}|{}|{}", c.input, c.hard_class, fmt::join(c.properties, " "), fmt::join(c.scalars, " ")));
  return rules;
}

/// "law x: changed, hard case y: gone" for the parts that `of` lacks.
std::vector<std::string> missing(const Rules& rules, const Rules& of) {
  std::vector<std::string> all;
  for (const auto& [part, its] : rules.parts) {
    const auto found = of.parts.find(part);
    if (found == of.parts.end())
      all.push_back(fmt::format("{}: only in {}", part, rules.version));
    else if (found->second != its)
      all.push_back(part + ": changed");
  }
  return all;
}

}  // namespace

std::string Rules::text() const {
  std::string all = fmt::format("# Rules {}, by properties/rules\n", version);
  for (const auto& [part, its] : parts) all += fmt::format("{} {}\n", its, part);
  return all;
}

std::vector<std::string> Rules::names(const std::string& kind) const {
  std::vector<std::string> all;
  for (const auto& [part, its] : parts)
    if (part.starts_with(kind + " ")) all.push_back(part.substr(kind.size() + 1));
  return all;
}

const Rules& present_rules() {
  static const Rules present = of_this_program();
  return present;
}

Rules parse_rules(const std::string& file, const std::string& text) {
  Rules rules{file.substr(0, file.find('.')), {}};
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    const auto space = line.find(' ');
    if (space != 16 || line.find_first_not_of("0123456789abcdef") != space)
      throw std::invalid_argument(
          fmt::format("{}:{}: '{}' is not 16 hexadecimal digits and a part", file, number, line));
    rules.parts[line.substr(space + 1)] = line.substr(0, space);
  }
  return rules;
}

const std::vector<Rules>& known_rules() {
  static const std::vector<Rules> known = [] {
    std::vector<Rules> all;
    for (const EmbeddedFile* f = rules_files; f->name; ++f) all.push_back(parse_rules(f->name, f->text));
    std::ranges::sort(all, {}, [](const Rules& r) { return std::stoi(r.version); });
    return all;
  }();
  return known;
}

const Rules& rules_named(const std::string& version) {
  if (version == "present") return present_rules();
  std::vector<std::string> names;
  for (const Rules& r : known_rules()) {
    if (r.version == version) return r;
    names.push_back(r.version);
  }
  throw std::invalid_argument(fmt::format(
      "--rules: unknown version '{}'; known: {}; CHANGELOG.md names the liecheck that runs an older one",
      version, fmt::join(names, ", ")));
}

std::vector<std::string> differences(const Rules& a, const Rules& b) {
  std::vector<std::string> all = missing(a, b);
  for (const auto& [part, its] : b.parts)
    if (!a.parts.contains(part)) all.push_back(fmt::format("{}: only in {}", part, b.version));
  return all;
}

void check_runs(const Rules& rules, const Rules& program) {
  const auto lost = missing(rules, program);
  if (!lost.empty())
    throw std::invalid_argument(fmt::format(
        "--rules: this liecheck cannot judge by rules {} any more ({}{}); CHANGELOG.md names the last "
        "version that can",
        rules.version, lost.front(), lost.size() > 1 ? fmt::format(" and {} more", lost.size() - 1) : ""));
}

std::vector<std::string> laws_of(const Rules& rules, const std::vector<std::string>& selected) {
  const auto laws = rules.names("law");
  for (const std::string& law : selected)
    if (!std::ranges::binary_search(laws, law))
      throw std::invalid_argument(fmt::format("--property: rules {} have no law '{}'", rules.version, law));
  return selected.empty() ? laws : selected;
}

std::vector<HardCase> hard_cases_of(const Rules& rules) {
  const auto names = rules.names("hard case");
  std::vector<HardCase> all = built_in_corpus();
  std::erase_if(all, [&](const HardCase& c) { return !std::ranges::binary_search(names, c.name); });
  return all;
}

}  // namespace liecheck::properties
