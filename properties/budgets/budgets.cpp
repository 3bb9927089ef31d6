#include <budgets/budgets.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <stdexcept>
#include <support/embedded.hpp>

namespace liecheck::properties {

namespace {

Basis basis_of(const std::string& name, const std::string& line) {
  static const std::map<std::string, Basis> known{
      {"hunted", Basis::hunted}, {"derived", Basis::derived}, {"row", Basis::row}, {"exact", Basis::exact}};
  const auto found = known.find(name);
  if (found == known.end()) throw std::logic_error("budgets.csv: unknown basis in: " + line);
  return found->second;
}

/// Reads a cell: "exp6", "liecheck inverse" (SUBJECT OPERATION) or "liecheck:fast" (every operation).
void set_operation(Budget& b, const std::string& cell) {
  const std::size_t space = cell.find(' ');
  if (space != std::string::npos)
    b.subject = cell.substr(0, space), b.operation = cell.substr(space + 1);
  else
    (cell.find(':') == std::string::npos ? b.operation : b.subject) = cell;
}

Budget parsed(const std::string& line) {
  std::istringstream in(line);
  std::array<std::string, 8> cells;
  for (std::string& cell : cells) std::getline(in, cell, ',');
  Budget b;
  std::getline(in, b.reason);
  const auto& [operation, block, region, rule, limit, basis, value, hard_case] = cells;
  if (rule != "forward" && rule != "excess") throw std::logic_error("budgets.csv: unknown rule in: " + line);
  if (b.reason.empty()) throw std::logic_error("budgets.csv: no reason given in: " + line);
  set_operation(b, operation);
  b.block = block, b.region = region;
  b.rule = rule == "forward" ? Rule::forward : Rule::excess;
  b.limit = std::stod(limit);
  b.basis = basis_of(basis, line);
  b.value = std::stod(value);
  b.fma = hard_case.ends_with(" fma");
  b.hard_case = b.fma ? hard_case.substr(0, hard_case.size() - 4) : hard_case;
  if (b.basis == Basis::hunted)
    b.reason += fmt::format("; hunted: {} by {}{}", value, b.hard_case, b.fma ? ", with FMA" : "");
  return b;
}

std::vector<Budget> read() {
  std::vector<Budget> lines;
  std::istringstream text(budgets_csv);
  std::string line;
  while (std::getline(text, line) && line[0] == '#') {
  }  // comments, then the header
  while (std::getline(text, line))
    if (!line.empty() && line[0] != '#') lines.push_back(parsed(line));
  return lines;
}

/// The lines under "" are for every subject. The lines under a subject's name have its own limits instead.
std::map<std::string, std::vector<Budget>> by_subject() {
  std::map<std::string, std::vector<Budget>> own, tables;
  for (const Budget& b : budget_lines()) own[b.subject].push_back(b);
  for (const auto& [subject, lines] : own) {
    std::vector<Budget> all = own.at("");
    for (Budget& b : all) {
      if (subject.empty() || b.rule == Rule::excess || b.region == "beyond_pi") continue;
      const auto replaces = [&b](const Budget& o) {
        return (o.operation.empty() || o.operation == b.operation) && (o.block == b.block || o.block == "*");
      };
      const auto found = std::find_if(lines.begin(), lines.end(), replaces);
      if (found != lines.end()) b.limit = found->limit, b.reason = found->reason;
    }
    tables[subject] = std::move(all);
  }
  return tables;
}

}  // namespace

const std::vector<Budget>& budget_lines() {
  static const auto lines = read();
  return lines;
}

const std::vector<Budget>& budgets(const std::string& subject) {
  static const auto tables = by_subject();
  const auto own = tables.find(subject);
  return own != tables.end() ? own->second : tables.at("");
}

const Budget& budget_of(const std::string& subject, std::string_view operation, std::string_view block,
                        Region region) {
  const char* wanted = region == Region::to_pi ? "to_pi" : "beyond_pi";
  for (const Budget& b : budgets(subject))
    if (b.operation == operation && b.block == block && (b.region == "any" || b.region == wanted)) return b;
  throw std::logic_error(fmt::format("budgets.csv has no line for {}, {}, {}", operation, block, wanted));
}

}  // namespace liecheck::properties
