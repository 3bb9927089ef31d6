// Cost against error: the statistics, the Pareto front and the timed loops.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <ctime>
#include <fstream>
#include <random>
#include <subjects/typed.hpp>
#include <timing/benchmarks.hpp>
#include <timing/kernels.hpp>
#include <timing/rows.hpp>
#include <timing/score.hpp>

#include "../refusal.hpp"
#include "../scratch.hpp"

namespace {

using namespace liecheck::properties;

TEST(Spread, ContainsTheMedianWithAProbabilityOf95Percent) {
  // The ranks are those of tables of the sign test: the number of values below the median is Bin(n, 1/2).
  for (const auto& [n, rank] : {std::pair<int, double>{6, 1}, {9, 2}, {15, 4}, {25, 8}}) {
    std::vector<double> x;
    for (int i = n; i >= 1; --i) x.push_back(i);
    const Spread s = spread_of(x);
    EXPECT_EQ(s.low, rank) << n;
    EXPECT_EQ(s.high, n + 1 - rank) << n;
    EXPECT_EQ(s.median, (n + 1) / 2.0) << n;
  }
  std::vector<double> few = {3, 1, 2};
  EXPECT_EQ(spread_of(few).low, 1);
  std::vector<double> none;
  EXPECT_EQ(spread_of(none).repetitions, 0U);
}

CostRow row(const char* subject, double error_eps, double low, double median, double high) {
  CostRow r{subject, "", "double", "exp6", 0x1p-52, {}};
  const Ratio s{median, low, high, 20};
  r.sets.push_back({"mixed", 1, s, s, 0, {{"translation", {error_eps}}, {"norm defect", {1e9}}}});
  return r;
}

TEST(Front, HoldsTheRowsThatNoOtherRowBeats) {
  const std::vector<CostRow> rows = {
      row("accurate", 1, 99, 100, 101), row("fast", 16, 49, 50, 51), row("slow", 1, 110, 111, 112),
      row("as fast within its spread", 1, 95, 102, 105), row("worse", 17, 49, 50, 51)};
  EXPECT_EQ(dominators(rows, &CostSet::latency), (std::vector<int>{-1, -1, 0, -1, 1}));
  EXPECT_EQ(error_of(rows[0]), 0x1p-52);  // a defect of the norm does not count
  EXPECT_EQ(worst_block(rows[0]), "translation");
}

TEST(Front, ACaseWithoutAResultHasAnInfiniteError) {
  std::vector<CostRow> rows = {row("accurate", 1, 99, 100, 101), row("breaks", 0, 99, 100, 101)};
  rows[1].sets.back().blocks[0].not_finite = 1;
  EXPECT_TRUE(std::isinf(error_of(rows[1])));
  EXPECT_EQ(dominators(rows, &CostSet::throughput), (std::vector<int>{-1, 0}));
}

TEST(Front, ARowWithoutAMeasurementDominatesNothingAndIsNotDominated) {
  std::vector<CostRow> rows = {row("accurate", 1, 99, 100, 101), row("unmeasured", 0, 9, 10, 11)};
  rows[1].sets.back().blocks[0].errors.clear();
  EXPECT_TRUE(std::isinf(error_of(rows[1])));
  EXPECT_EQ(dominators(rows, &CostSet::latency), (std::vector<int>{-1, -1}));
  rows[1].sets.back().blocks.push_back({"rotation", {1}});  // another block has an error
  EXPECT_EQ(dominators(rows, &CostSet::latency), (std::vector<int>{-1, -1}));
}

TEST(CostInputs, AreTheSameForASeedAndLieInTheirBands) {
  const std::vector<Field> fields = {{"rho", Kind::vector, 3, "m"}, {"phi", Kind::rotation_vector, 3, "rad"}};
  CostOptions seven, eight;
  seven.seed = 7, eight.seed = 8;
  const auto a = cost_inputs<double>(fields, seven, 50), b = cost_inputs<double>(fields, seven, 50);
  EXPECT_EQ(a, b);
  EXPECT_NE(a, cost_inputs<double>(fields, eight, 50));
  for (std::size_t i = 0; i < a.size(); ++i) {
    const CostBand& band = cost_bands[i / 50];
    const double theta = std::hypot(a[i][3], a[i][4], a[i][5]);
    const double x = band.from_pi ? M_PI - theta : theta;
    EXPECT_GE(x, band.low * (1 - 1e-9)) << band.name;
    EXPECT_LE(x, band.high * (1 + 1e-9)) << band.name;
  }
}

/// Multiplications that each need the result before. The processor can overlap those of independent calls.
Vec<double, 3> chain(const Vec<double, 3>& phi) {
  double x = phi[0];
  for (int i = 0; i < 16; ++i) x = x * 1.0000001 + 1e-9;
  return {x, x, x};
}

/// The processor time of this thread [ns], in which another program has no part.
double processor_time() {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

double nanoseconds(const std::function<void()>& pass, std::size_t calls) {
  double best = 1e9;
  for (int round = 0; round < 20; ++round) {
    const double start = processor_time();
    for (int i = 0; i < 20; ++i) pass();
    best = std::min(best, processor_time() - start);
  }
  return best / 20 / static_cast<double>(calls);
}

TEST(Curve, EachTermOfASeriesWinsDigitsAndATextbookLosesThemOnBothSidesOfItsCutoff) {
  CostOptions o;
  o.curve = true, o.processes = 0, o.inputs_per_band = 32;  // errors alone
  o.operations = {"left_jacobian3", "left_jacobian6", "log3_quaternion"}, o.scalars = {"double"};
  std::map<std::pair<std::string, std::string>, std::vector<double>>
      digits;  // by operation, subject and band
  for (const CostRow& r : measure_cost(o).rows)
    for (std::size_t b = 0; b < curve_bands.size(); ++b)
      digits[{r.operation, r.subject}].push_back(-std::log10(error_of(r, r.sets[b])));
  constexpr std::size_t near_1e_5 = 3, near_1e_3 = 5, below_1 = 8;
  for (const std::string& operation : o.operations) {
    for (int n = 2; n <= 12; ++n) {  // term n + 1 is below x/8 of term n where x < 1
      const auto shorter = digits.at({operation, fmt::format("series:{}", n - 1)}),
                 longer = digits.at({operation, fmt::format("series:{}", n)});
      EXPECT_GT(longer.at(below_1), std::min(14.5, shorter.at(below_1) + 0.5)) << operation << n;
    }
    EXPECT_GT(digits.at({operation, "liecheck"}).at(below_1), 15.3);
    const auto book = digits.at({operation, "textbook:1e-4"});
    EXPECT_LT(book.at(near_1e_5), 14) << operation;  // the leading term alone
    EXPECT_LT(book.at(near_1e_3), 14) << operation;  // 1 - cos theta cancels
  }
  for (const char* operation : {"left_jacobian3", "log3_quaternion"}) {  // in half angles nothing cancels
    const auto half = digits.at({operation, "textbook:half_angles"});
    EXPECT_GT(*std::ranges::min_element(half), 14.5) << operation;
  }
}

TEST(Loops, LatencyWaitsForTheLastResultAndThroughputDoesNot) {
  const Signature s = signature_of<double>(&chain);
  const std::size_t n = 640;
  const auto arguments = s.arguments(std::vector<std::vector<double>>(n, {1, 2, 3}));
  const auto time = [&](auto pass) {
    return nanoseconds([&] { pass(reinterpret_cast<AnyFunction>(&chain), arguments.get(), n); }, n);
  };
  EXPECT_GT(time(s.latency), 1.5 * time(s.throughput));
}

TEST(Benchmarks, EveryRowIsRepeatedAndAStopKeepsTheTimesSoFar) {
  std::vector<Timed> all(3);
  std::atomic<bool> stop{false};
  int passes = 0;
  for (Timed& t : all) t.pass = [&] { ++passes; };
  for (const auto& row : run_interleaved(all, {0.01, 7, &stop, [](double) {}})) EXPECT_EQ(row.size(), 7U);
  std::size_t kept = 0;
  for (const auto& row : run_interleaved(all, {0.01, 7, &stop, [&](double share) { stop = share > 0.4; }}))
    kept += row.size();
  EXPECT_EQ(kept, 9U);
}

/// A repetition of process p that takes `ratio` times the reference, on a machine whose clock is slower by `slow`.
Repetition repetition(std::size_t p, double ratio, double slow = 1) {
  return {p, 25 * ratio * slow, 25 * slow, 25 * slow, 0};
}

TEST(Ratios, DoNotDependOnTheSpeedOfTheMachineAndOneProcessDoesNotWidenTheirSpread) {
  std::vector<Repetition> row;
  for (std::size_t p = 0; p < 20; ++p)
    for (double slow : {1.0, 1.05}) row.push_back(repetition(p, p == 4 ? 9 : p < 9 ? 2 : 2.1, slow));
  const Ratio r = ratio_of(row);
  EXPECT_EQ(r.processes, 20U);
  EXPECT_NEAR(r.median, 2.1, 1e-12);  // of 16 times 2, 22 times 2.1 and 2 times 9
  const double g = std::pow(2.1 / 2, std::sqrt(2.0) * 2.58 / 1.96) * between_runs;
  EXPECT_NEAR(r.high, 2.1 * g, 1e-12);
  EXPECT_NEAR(r.low, 2.1 / g, 1e-12);
  EXPECT_EQ(ratio_of({}).processes, 0U);
}

TEST(Ratios, TheMedianOfAnotherRunIsInTheSpreadOf99Of100) {
  // Of log-normal repetitions, a tenth of them slower by a half because another program ran beside them unnoticed.
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 0.08);
  const auto run = [&] {
    std::vector<Repetition> row;
    for (std::size_t i = 0; i < 20; ++i)
      row.push_back(repetition(i, std::exp(noise(random)) * (random() % 10 == 0 ? 1.5 : 1)));
    return ratio_of(row);
  };
  int inside = 0;
  double spreads = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ratio one = run(), other = run();
    inside += one.low <= other.median && other.median <= one.high;
    spreads += one.spread() / 2000;
  }
  EXPECT_GE(inside, 1980);
  EXPECT_LT(spreads, 0.2);
}

/// 20 rows of 20 repetitions; the machine is slower by a half in the first `disturbed` of each row.
std::vector<std::vector<Repetition>> rows_of(std::size_t disturbed) {
  std::vector<std::vector<Repetition>> rows(20);
  for (auto& row : rows)
    for (std::size_t p = 0; p < 20; ++p) row.push_back(repetition(p, 2, p < disturbed ? 1.5 : 1));
  return rows;
}

TEST(Ratios, LeaveOutDisturbedRepetitions) {
  auto rows = rows_of(4);
  const Machine quiet = keep_undisturbed(rows);
  for (const auto& row : rows) EXPECT_EQ(row.size(), 16U);
  EXPECT_NEAR(quiet.disturbed, 0.2, 1e-12);
  EXPECT_EQ(quiet.reference_ns, 25);
  rows = rows_of(19);
  const Machine loud = keep_undisturbed(rows);
  for (const auto& row : rows) EXPECT_EQ(row.size(), 8U);  // so that every row has a ratio
  EXPECT_EQ(loud.reference_ns, 25);
}

TEST(Ratios, OfAMachineAreUnsteadyIfTheyMayDifferBy15Percent) {
  EXPECT_TRUE((Machine{25, 0.9, 0.14}).steady());  // however many repetitions were left out
  EXPECT_FALSE((Machine{25, 0, 0.16}).steady());
}

TEST(Benchmarks, WhatIsTimedElsewhereHasItsOwnTimeAndNothingHasNone) {
  std::vector<Timed> all(2);
  all[1].calls = 4, all[1].elsewhere = [](std::size_t passes) { return 100.0 * static_cast<double>(passes); };
  const auto rows = run_interleaved(all, {0.01, 3, nullptr, [](double) {}});
  EXPECT_TRUE(rows[0].empty());
  ASSERT_EQ(rows[1].size(), 3U);
  for (const Repetition& r : rows[1]) EXPECT_EQ(r.ns, 25);
}

TEST(Ratios, AreReadAsAnotherProcessWroteThem) {
  const auto written_rows = rows_of(3);
  std::vector<std::vector<Repetition>> rows(20);
  append_written(rows, written(written_rows), 7);
  append_written(rows, written(written_rows), 8);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 40U);
    for (std::size_t k = 0; k < 40; ++k) {
      EXPECT_EQ(rows[i][k].process, k < 20 ? 7U : 8U);
      EXPECT_EQ(rows[i][k].ns, written_rows[i][k % 20].ns);
      EXPECT_EQ(rows[i][k].slowest_ns, written_rows[i][k % 20].slowest_ns);
    }
  }
  const std::string text = written(written_rows);
  EXPECT_THROW(append_written(rows, text.substr(0, text.size() / 2), 9), std::runtime_error);
}

TEST(Kernels, AFolderWithoutKernelsAndAFileThatIsNoKernelAreErrors) {
  const std::filesystem::path folder = liecheck::own_folder();
  EXPECT_FALSE(has_kernels(folder));
  EXPECT_THROW(load_kernels(folder), std::runtime_error);
  std::ofstream(folder / "gcc.so") << "no module";
  EXPECT_TRUE(liecheck::test::has(liecheck::test::refusal<std::runtime_error>([&] { load_kernels(folder); }),
                                  "gcc.so"));
}

}  // namespace
