#include <app/hard_cases_table.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <map>

namespace liecheck::properties {

namespace {

using Column = std::pair<std::string, std::string>;  // subject, scalar

std::vector<Column> columns_of(const std::vector<HardRow>& rows) {
  std::vector<Column> all;
  for (const HardRow& r : rows)
    for (const HardCell& c : r.cells)
      if (std::find(all.begin(), all.end(), Column(c.subject, c.scalar)) == all.end())
        all.emplace_back(c.subject, c.scalar);
  const auto rank = [](const Column& c) {  // subjects by name, scalars by width
    return std::tuple(c.first, c.second == "float" ? 0 : c.second == "double" ? 1 : 2);
  };
  std::sort(all.begin(), all.end(), [&](const Column& a, const Column& b) { return rank(a) < rank(b); });
  return all;
}

constexpr Verdict verdicts[] = {Verdict::stable,     Verdict::refused,    Verdict::ill_posed,
                                Verdict::unresolved, Verdict::inaccurate, Verdict::wrong_branch,
                                Verdict::not_finite};

void print_failure(const HardRow& r, const HardCell& c) {
  const HardCase& e = *r.entry;
  fmt::print("\nFAILED  hard case {} ({}): {}\n", e.name, e.hard_class, e.reason);
  fmt::print("  subject   {} in {}: {}\n", c.subject, c.scalar, name_of(c.verdict));
  fmt::print("  where     {}: {}, block {}, band {}\n", r.property, c.operation, c.block, c.band);
  fmt::print("  error     {:.4g} eps, kappa {:.3g}, budget {:g} {}{}\n", c.error, c.kappa, c.budget,
             c.excess ? "eps kappa" : "eps", c.refusal.empty() ? "" : "; " + c.refusal);
  fmt::print("  input     {}\n  origin    {} ({})\n", e.input, e.origin, e.place());
  fmt::print("  replay    liecheck replay {}\n", c.id.text());
}

}  // namespace

void print_hard_case_summary(const std::vector<HardRow>& rows, std::size_t shown_failures) {
  if (rows.empty()) {
    fmt::print("hard cases: the selected properties have none\n");
    return;
  }
  fmt::print("{:<24}{:<10}{:>6}", "hard cases", "scalar", "cells");
  for (const Verdict v : verdicts) fmt::print("  {:>12}", name_of(v));
  fmt::print("\n");
  std::size_t failures = 0;
  for (const auto& [subject, scalar] : columns_of(rows)) {
    std::map<Verdict, int> counts;
    int cells = 0;
    for (const HardRow& r : rows)
      for (const HardCell& c : r.cells)
        if (c.subject == subject && c.scalar == scalar) ++counts[c.verdict], ++cells, failures += c.failed;
    fmt::print("{:<24}{:<10}{:>6}", subject, scalar, cells);
    for (const Verdict v : verdicts) fmt::print("  {:>12}", counts[v]);
    fmt::print("\n");
  }
  std::size_t shown = 0;
  for (const HardRow& r : rows)
    for (const HardCell& c : r.cells)
      if (c.failed && shown++ < shown_failures) print_failure(r, c);
  if (failures > shown_failures)
    fmt::print(
        "\n{} more cells failed: liecheck hard-cases with the same --subject and --scalar shows them all\n",
        failures - shown_failures);
}

void print_hard_case_table(const std::vector<HardRow>& rows) {
  const auto columns = columns_of(rows);
  std::size_t width = 0, law = 0;
  std::vector<std::string> classes;  // in the order of the corpus
  for (const HardRow& r : rows) {
    width = std::max(width, r.entry->name.size() + 3);
    law = std::max(law, r.property.size() + 1);
    if (std::find(classes.begin(), classes.end(), r.entry->hard_class) == classes.end())
      classes.push_back(r.entry->hard_class);
  }
  for (std::size_t i = 0; i < columns.size(); ++i)
    fmt::print("{:>{}} {} in {}\n", i + 1, width + law + 2 * i + 1, columns[i].first, columns[i].second);
  for (const std::string& hard_class : classes) {
    fmt::print("{}\n", hard_class);
    for (const HardRow& r : rows) {
      if (r.entry->hard_class != hard_class) continue;
      fmt::print("{:<{}}{:<{}}", "  " + r.entry->name, width, r.property, law);
      for (const auto& [subject, scalar] : columns) {
        const auto cell = std::find_if(r.cells.begin(), r.cells.end(), [&](const HardCell& c) {
          return c.subject == subject && c.scalar == scalar;
        });
        fmt::print("{} ", cell == r.cells.end() ? '-' : letter_of(cell->verdict));
      }
      fmt::print("\n");
    }
  }
  for (const Verdict v : verdicts) fmt::print("{} {}   ", letter_of(v), name_of(v));
  fmt::print("- not offered, or not for this scalar\n\n");
}

}  // namespace liecheck::properties
