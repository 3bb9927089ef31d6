#include <fmt/format.h>
#include <store/store.hpp>
#include <charconv>
#include <sstream>

namespace liecheck::properties {

namespace {

/// False where the text is not a histogram.
bool parse(const std::string& text, Histogram& h) {
  const char *p = text.data(), *end = p + text.size();
  while (p != end) {
    int bin = 0;
    std::uint64_t n = 0;
    const auto b = std::from_chars(p, end, bin);
    if (b.ec != std::errc() || b.ptr == end || *b.ptr != ':') return false;
    const auto c = std::from_chars(b.ptr + 1, end, n);
    if (c.ec != std::errc() || (c.ptr != end && *c.ptr != ' ')) return false;
    h.add_bin(bin, n);
    p = c.ptr == end ? end : c.ptr + 1;
  }
  return true;
}

bool parse(const std::string& text, SetDigest& digest) {
  Sha256 sum{};
  if (text.size() != 64) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    const char* p = text.data() + 16 * i;
    const auto r = std::from_chars(p, p + 16, sum[i], 16);
    if (r.ec != std::errc() || r.ptr != p + 16) return false;
  }
  digest.merge(sum);
  return true;
}

}  // namespace

StoredCampaign Store::load(int number) {
  StoredCampaign c;
  const auto n = std::int64_t(number);
  const auto check = [this](bool good, const char* what) {
    if (!good) database_.fail(fmt::format("corrupt: {}", what));
  };
  const auto intact = [&](const Statement& row) { check(row.intact(), "a row was changed"); };
  Statement head(database_, "SELECT * FROM campaigns WHERE id = ?");
  if (!head.with(n).step())
    database_.fail(campaigns() == 0 ? "holds no campaign"
                                    : fmt::format("holds {} campaigns, there is no {}", campaigns(), number));
  intact(head);
  CampaignSpec& spec = c.spec;
  spec.seed = head.count(1), spec.cases = head.count(2), spec.first = head.count(3),
  spec.last = head.count(4);
  spec.generator = static_cast<int>(head.integer(5)), spec.program = head.text(6),
  spec.budgets = head.text(7);
  spec.robot.name = head.text(8), spec.robot.hash = head.text(9), spec.robot.urdf = head.text(10);
  spec.environment = head.text(11);

  std::vector<std::uint64_t> cells_of;
  Statement series(database_, "SELECT * FROM series WHERE campaign = ? ORDER BY series");
  for (series.with(n); series.step();) {
    intact(series);
    check(series.count(1) == c.series.size(), "a series is missing");
    StoredSeries s;
    s.property = series.text(2), s.subject = series.text(3), s.subject_version = series.text(4);
    s.scalar = series.text(5), s.robot = series.text(6);
    check(parse(series.text(8), s.tally.inputs) && parse(series.text(9), s.tally.results),
          "a digest is not one");
    s.tally.cases = series.count(7);
    cells_of.push_back(series.count(10));
    s.tally.fast = series.count(11), s.tally.checked = series.count(12);
    std::istringstream disagreed(series.text(13));
    for (std::uint64_t index = 0; disagreed >> index;) s.tally.disagreed.push_back(index);
    check(s.tally.coverage.parse(series.text(14)), "a coverage is not one");
    spec.series.push_back(s.text());
    c.series.push_back(std::move(s));
  }
  check(!c.series.empty(), "a campaign without a series");
  const auto at = [&](std::int64_t i) -> StoredSeries& {
    check(i >= 0 && i < std::int64_t(c.series.size()), "a row of no series");
    return c.series[static_cast<std::size_t>(i)];
  };
  Statement done(database_, "SELECT * FROM done WHERE campaign = ?");
  for (done.with(n); done.step();) {
    const std::uint64_t first = done.count(2), last = done.count(3);
    check(first < last && first >= spec.first && last <= spec.last &&
              at(done.integer(1)).tally.done.add(first, last),
          "a range of cases overlaps or lies outside the campaign");
  }
  Statement cells(database_, "SELECT * FROM cells WHERE campaign = ?");
  for (cells.with(n); cells.step();) {
    intact(cells);
    StoredSeries& s = at(cells.integer(1));
    const Cell cell{static_cast<int>(cells.integer(2)), static_cast<int>(cells.integer(3))};
    s.labels[cell] = {cells.text(4), cells.text(5), cells.text(6)};
    Row& r = s.tally.rows[cell];
    r.count = cells.count(7), r.ill_posed = cells.count(8), r.unresolved = cells.count(9);
    r.not_finite = cells.count(10), r.wrong_branch = cells.count(11), r.refused = cells.count(12);
    r.failed = cells.count(13), r.max_error = cells.real(14), r.max_excess = cells.real(15);
    r.worst_score = cells.real(16), r.worst_index = cells.count(17), r.worst_kappa = cells.real(18);
    check(parse(cells.text(19), r.errors), "a histogram is not one");
  }
  Statement failures(database_, "SELECT * FROM failures WHERE campaign = ?");
  for (failures.with(n); failures.step();) {
    intact(failures);
    at(failures.integer(1))
        .failures[{static_cast<int>(failures.integer(2)), static_cast<int>(failures.integer(3))}] = {
        failures.count(4), failures.text(5)};
  }
  for (std::size_t i = 0; i < c.series.size(); ++i) {
    const StoredSeries& s = c.series[i];
    check(s.tally.done.count() == s.tally.cases, "the cases do not add up");
    check(s.tally.rows.size() == cells_of[i], "a cell is missing");
    for (const auto& [cell, row] : s.tally.rows)
      check((row.failed > 0) == s.failures.contains(cell), "a failure is missing");
  }
  return c;
}

std::vector<Counterexample> Store::counterexamples() {
  std::vector<Counterexample> all;
  Statement rows(
      database_,
      "SELECT s.property, s.subject, s.scalar, s.robot, c.operation, c.block, f.input FROM failures f "
      "JOIN series s USING(campaign, series) JOIN cells c USING(campaign, series, output, band) "
      "UNION SELECT property, subject, scalar, robot, operation, block, input FROM counterexamples "
      "ORDER BY 1, 2, 3, 4, 5, 6, 7");
  while (rows.step())
    all.push_back(
        {rows.text(0), rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.text(5), rows.text(6)});
  return all;
}

}  // namespace liecheck::properties
