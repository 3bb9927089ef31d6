#include <timing/repetitions.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

namespace liecheck::properties {

Spread spread_of(std::vector<double> x) {
  if (x.empty()) return {};
  std::sort(x.begin(), x.end());
  const std::size_t n = x.size();
  // The interval is from the k-th smallest to the k-th largest sample, with the largest k for which
  // P(fewer than k of n samples are below the true median) <= 1/40.
  double probability = std::pow(0.5, static_cast<double>(n)), below = 0;
  std::size_t k = 0;
  while (k < n / 2 && below + probability <= 0.025) {
    below += probability;
    probability *= static_cast<double>(n - k) / static_cast<double>(k + 1);
    ++k;
  }
  const std::size_t edge = k > 0 ? k - 1 : 0;
  return {n % 2 ? x[n / 2] : (x[n / 2 - 1] + x[n / 2]) / 2, x[edge], x[n - 1 - edge], n};
}

Machine keep_undisturbed(std::vector<std::vector<Repetition>>& rows) {
  std::vector<double> slowest;
  for (const auto& row : rows)
    for (const Repetition& r : row) slowest.push_back(r.slowest_ns);
  if (slowest.empty()) return {};
  const auto fast = slowest.begin() + static_cast<std::ptrdiff_t>(slowest.size() / 100);
  std::nth_element(slowest.begin(), fast, slowest.end());
  const double limit = *fast * 1.1;
  std::vector<double> references;
  for (auto& row : rows) {
    std::sort(row.begin(), row.end(),
              [](const Repetition& a, const Repetition& b) { return a.slowest_ns < b.slowest_ns; });
    std::size_t kept = 0;
    while (kept < row.size() && row[kept].slowest_ns <= limit) references.push_back(row[kept++].reference_ns);
    row.resize(std::max(kept, std::min<std::size_t>(row.size(), 8)));
  }
  const double all = static_cast<double>(slowest.size());
  return {spread_of(references).median, 1 - static_cast<double>(references.size()) / all, 0};
}

Ratio ratio_of(const std::vector<Repetition>& row) {
  std::set<std::size_t> processes;
  std::vector<double> ratios;
  for (const Repetition& r : row) processes.insert(r.process), ratios.push_back(r.ns / r.reference_ns);
  if (row.empty()) return {};
  const Spread all = spread_of(ratios);
  const double f = std::max(all.median / all.low, all.high / all.median),
               g = std::pow(f, std::sqrt(2.0) * 2.58 / 1.96) * between_runs;
  return {all.median, all.median / g, all.median * g, processes.size()};
}

double counted(const std::vector<Repetition>& row, double Repetition::*counts) {
  std::vector<double> all;
  for (const Repetition& r : row)
    if (r.*counts > 0) all.push_back(r.*counts);
  return spread_of(std::move(all)).median;
}

std::string written(const std::vector<std::vector<Repetition>>& rows) {
  std::string text;
  for (const auto& row : rows) {
    for (const Repetition& r : row)
      text += fmt::format("{} {} {} {} {} ", r.ns, r.reference_ns, r.slowest_ns, r.instructions, r.cycles);
    text += '\n';
  }
  return text;
}

void append_written(std::vector<std::vector<Repetition>>& rows, const std::string& text,
                    std::size_t process) {
  if (static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) != rows.size())
    throw std::runtime_error("a process that measures times ended before it wrote them");
  std::istringstream lines(text);
  std::string line;
  for (auto& row : rows) {
    std::getline(lines, line);
    std::istringstream numbers(line);
    Repetition r{process};
    while (numbers >> r.ns >> r.reference_ns >> r.slowest_ns >> r.instructions >> r.cycles) row.push_back(r);
  }
}

}  // namespace liecheck::properties
