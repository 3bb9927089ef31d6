#include <budgets/budgets.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <stdexcept>
#include <support/embedded.hpp>
#include <tuple>
#include <utility>

namespace liecheck::properties {

namespace {

Basis basis_of(const std::string& name, const std::string& line) {
  static const std::map<std::string, Basis> known{
      {"hunted", Basis::hunted}, {"derived", Basis::derived}, {"row", Basis::row}, {"exact", Basis::exact}};
  const auto found = known.find(name);
  if (found == known.end()) throw std::logic_error("budgets.csv: unknown basis in: " + line);
  return found->second;
}

/// Reads a cell: "exp6", or "liecheck inverse" (SUBJECT OPERATION) and "liecheck *" (every operation).
void set_operation(Budget& b, const std::string& cell) {
  const std::size_t space = cell.find(' ');
  b.operation = space == std::string::npos ? cell : cell.substr(space + 1);
  if (space != std::string::npos) b.subject = cell.substr(0, space);
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
  for (const auto& [subject, lines] : own)
    tables[subject] = subject.empty() ? lines : with_own_limits(own.at(""), lines);
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

bool replaces(const Budget& own, const Budget& line, const std::string& region) {
  const auto names = [](const std::string& name, const std::string& of_line) {
    return name == "*" || name == of_line;
  };
  return names(own.operation, line.operation) && names(own.block, line.block) &&
         (own.region == "any" || own.region == region) && own.rule == line.rule &&
         (line.region == "any" || line.region == region);
}

std::vector<Budget> with_own_limits(const std::vector<Budget>& table, const std::vector<Budget>& own) {
  const auto named = [](const Budget& b) {
    return std::tuple(b.operation != "*", b.block != "*", b.region != "any");
  };
  const auto own_of = [&](const Budget& line, const std::string& region) {
    const Budget* best = nullptr;
    for (const Budget& b : own)
      if (replaces(b, line, region) && (!best || named(b) > named(*best))) best = &b;
    return best;
  };
  std::vector<Budget> all;
  const auto add = [&](Budget line, const Budget* limit) {
    if (limit) line.limit = limit->limit, line.reason = limit->reason;
    all.push_back(std::move(line));
  };
  for (const Budget& line : table) {
    const Budget *to_pi = own_of(line, "to_pi"), *beyond = own_of(line, "beyond_pi");
    if (line.region != "any") {
      add(line, line.region == "to_pi" ? to_pi : beyond);
    } else if (to_pi == beyond) {
      add(line, to_pi);
    } else {  // one line for each region
      for (const auto& [region, limit] : {std::pair("to_pi", to_pi), std::pair("beyond_pi", beyond)}) {
        Budget half = line;
        half.region = region;
        add(half, limit);
      }
    }
  }
  return all;
}

const Budget& budget_in(const std::vector<Budget>& table, std::string_view operation, std::string_view block,
                        Region region) {
  const char* wanted = region == Region::to_pi ? "to_pi" : "beyond_pi";
  for (const Budget& b : table)
    if (b.operation == operation && b.block == block && (b.region == "any" || b.region == wanted)) return b;
  throw std::logic_error(fmt::format("budgets.csv has no line for {}, {}, {}", operation, block, wanted));
}

const Budget& budget_of(const std::string& subject, std::string_view operation, std::string_view block,
                        Region region) {
  return budget_in(budgets(subject), operation, block, region);
}

}  // namespace liecheck::properties
