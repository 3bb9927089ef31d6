#include <campaign/budgets.hpp>

#include <fmt/format.h>
#include <campaign/embedded.hpp>
#include <sstream>
#include <stdexcept>

namespace liecheck::properties {

const std::vector<Budget>& budgets() {
  static const std::vector<Budget> table = [] {
    std::vector<Budget> rows;
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
      rows.push_back(std::move(b));
    }
    return rows;
  }();
  return table;
}

const Budget& budget_of(const std::string& operation, const std::string& block, Region region) {
  const char* wanted = region == Region::to_pi ? "to_pi" : "beyond_pi";
  for (const Budget& b : budgets())
    if (b.operation == operation && b.block == block && (b.region == "any" || b.region == wanted)) return b;
  throw std::logic_error(fmt::format("budgets.csv has no line for {}, {}, {}", operation, block, wanted));
}

}  // namespace liecheck::properties
