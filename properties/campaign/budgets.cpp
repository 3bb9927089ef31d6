#include <campaign/budgets.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <support/embedded.hpp>
#include <map>
#include <sstream>
#include <stdexcept>

namespace liecheck::properties {

namespace {

/// The lines of budgets.csv: for every subject under "", and what a subject replaces under its name.
std::map<std::string, std::vector<Budget>> read() {
  std::map<std::string, std::vector<Budget>> tables;
  std::istringstream text(budgets_csv);
  std::string line;
  while (std::getline(text, line) && line[0] == '#') {
  }  // comments, then the header
  while (std::getline(text, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    Budget b;
    std::string rule, limit;
    std::getline(cells, b.operation, ',');
    std::getline(cells, b.block, ',');
    std::getline(cells, b.region, ',');
    std::getline(cells, rule, ',');
    std::getline(cells, limit, ',');
    std::getline(cells, b.reason);
    if (rule != "forward" && rule != "excess")
      throw std::logic_error("budgets.csv: unknown rule in: " + line);
    if (b.reason.empty()) throw std::logic_error("budgets.csv: no reason given in: " + line);
    b.rule = rule == "forward" ? Rule::forward : Rule::excess;
    b.limit = std::stod(limit);
    std::string subject;
    if (b.operation.find(':') != std::string::npos) {
      const std::size_t end = std::min(b.operation.find(' '), b.operation.size());
      subject = b.operation.substr(0, end);
      b.operation = b.operation.substr(std::min(end + 1, b.operation.size()));
    }
    tables[subject].push_back(std::move(b));
  }
  const std::vector<Budget> everyone = tables.at("");
  for (auto& [subject, table] : tables) {
    if (subject.empty()) continue;
    std::vector<Budget> all = everyone;
    for (Budget& b : all) {
      if (b.rule == Rule::excess || b.region == "beyond_pi") continue;
      const auto own = std::find_if(table.begin(), table.end(), [&b](const Budget& o) {
        return (o.operation.empty() || o.operation == b.operation) && (o.block == b.block || o.block == "*");
      });
      if (own != table.end()) b.limit = own->limit, b.reason = own->reason;
    }
    table = std::move(all);
  }
  return tables;
}

}  // namespace

const std::vector<Budget>& budgets(const std::string& subject) {
  static const auto tables = read();
  const auto own = tables.find(subject);
  return own != tables.end() ? own->second : tables.at("");
}

const Budget& budget_of(const std::string& subject, const std::string& operation, const std::string& block,
                        Region region) {
  const char* wanted = region == Region::to_pi ? "to_pi" : "beyond_pi";
  for (const Budget& b : budgets(subject))
    if (b.operation == operation && b.block == block && (b.region == "any" || b.region == wanted)) return b;
  throw std::logic_error(fmt::format("budgets.csv has no line for {}, {}, {}", operation, block, wanted));
}

}  // namespace liecheck::properties
