// Reads campaigns from a store, and checks that nothing is missing or damaged.

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <store/beside_cases.hpp>
#include <store/looking.hpp>
#include <store/row_seal.hpp>
#include <store/store.hpp>
#include <support/json.hpp>
#include <support/progress.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

/// Returns false if the text is not a histogram.
bool parse(const std::string& text, Histogram& h) {
  const char *p = text.data(), *end = p + text.size();
  constexpr int zero = -1000000, first = -8000, last = 40000;  // Histogram has no other bins
  int bin = zero - 1;
  while (p != end) {
    const int before = bin;
    std::uint64_t n = 0;
    const auto b = std::from_chars(p, end, bin);
    if (b.ec != std::errc() || b.ptr == end || *b.ptr != ':') return false;
    const auto c = std::from_chars(b.ptr + 1, end, n);
    if (c.ec != std::errc() || (c.ptr != end && *c.ptr != ' ')) return false;
    if (bin <= before || (bin != zero && (bin < first || bin > last))) return false;
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

std::uint64_t count(const SQLite::Statement& row, int column) {
  return std::bit_cast<std::uint64_t>(row.getColumn(column).getInt64());
}

int number(const SQLite::Statement& row, int column) {
  return row.getColumn(column).getInt();
}

double real(const SQLite::Statement& row, int column) {
  const SQLite::Column value = row.getColumn(column);
  return value.isNull() ? std::numeric_limits<double>::quiet_NaN() : value.getDouble();
}

std::string text(const SQLite::Statement& row, int column) {
  std::string text = row.getColumn(column).getString();
  if (!is_utf8(text)) throw SQLite::Exception("a text is not UTF-8", SQLITE_CORRUPT);
  return text;
}

bool is_word(const std::string& name) {
  const std::string marks = "_-+:";
  return !name.empty() && std::ranges::all_of(name, [&](unsigned char c) {
    return std::isalnum(c) || marks.find(static_cast<char>(c)) != marks.npos;
  });
}

std::string changed_row(const char* table) {
  return fmt::format("a row of its table {} was changed", table);
}

/// "" or what is wrong with a row: SQLite keeps any value in any column. NaN is stored as null.
std::string wrong_value(const SQLite::Statement& row, const char* table) {
  for (int i = 0; i < row.getColumnCount(); ++i) {
    const SQLite::Column value = row.getColumn(i);
    const char kind = row.getColumnDeclaredType(i)[0];
    const bool right = kind == 'I'   ? value.isInteger()
                       : kind == 'R' ? value.isFloat() || value.isNull()
                                     : value.isText();
    if (!right)
      return fmt::format("the column {} of its table {} holds a value of another type than {}",
                         value.getName(), table, row.getColumnDeclaredType(i));
    // liecheck's own words, which have no letter that cannot be seen.
    if (const std::string name = value.getName(),
        words = " operation block band_name program budgets robot_hash ";
        words.find(" " + name + " ") != words.npos && printable(value.getString()) != value.getString())
      return fmt::format("the column {} of its table {} has a letter that cannot be seen", name, table);
  }
  return "";
}

/// Reads one campaign.
class Loader {
 public:
  Loader(const SQLite::Database& database, const std::string& path, int number)
      : database_(database), path_(path), number_(number), rows_("reading " + path) {}

  /// Returns nothing if the store has no campaign with this number.
  std::optional<StoredCampaign> load() {
    if (!load_spec()) return std::nullopt;
    load_limits();
    load_series();
    load_done();
    load_cells();
    load_failures();
    check_totals();
    return std::move(campaign_);
  }

 private:
  void check(bool good, const char* what) const {
    if (!good) throw std::runtime_error(fmt::format("{}: corrupt: {}", path_, what));
  }
  /// The rows of a table that belong to the campaign, `key` in the table. next() goes to the next one.
  SQLite::Statement select(const char* table, const char* key = "campaign", const char* order = "") {
    table_ = table;
    SQLite::Statement rows(database_, fmt::format("SELECT * FROM {} WHERE {} = ? {}", table, key, order));
    rows.bind(1, number_);
    return rows;
  }
  bool next(SQLite::Statement& row) {
    if (!row.executeStep()) return false;
    rows_.next();
    if (!has_true_seal(row)) check(false, changed_row(table_).c_str());
    if (const std::string wrong = wrong_value(row, table_); !wrong.empty()) check(false, wrong.c_str());
    return true;
  }
  StoredSeries& series_at(const SQLite::Statement& row) {
    const std::uint64_t i = count(row, 1);
    check(i < campaign_.series.size(), "a row belongs to no series");
    return campaign_.series[i];
  }

  bool load_spec() {
    auto row = select("campaigns", "id");
    if (!next(row)) return false;
    CampaignSpec& spec = campaign_.spec;
    spec.seed = count(row, 1), spec.cases = count(row, 2);
    spec.first = count(row, 3), spec.last = count(row, 4);
    spec.generator = number(row, 5), spec.program = text(row, 6), spec.budgets = text(row, 7);
    spec.robot.name = text(row, 8), spec.robot.hash = text(row, 9), spec.robot.urdf = text(row, 10);
    spec.environment = text(row, 11);
    check(take_beside_cases(spec.environment, spec.beside), "its environment");
    return true;
  }

  void load_limits() {
    auto row = select("limits", "campaign", "ORDER BY subject");
    while (next(row)) {
      try {
        auto limits = std::make_shared<const SubjectLimits>(parse_limits(text(row, 2), text(row, 3)));
        check(limits->subject == text(row, 1), "limits of another subject");
        campaign_.spec.limits.push_back(std::move(limits));
      } catch (const std::invalid_argument& e) {  // written by a program that knew more
        throw std::runtime_error(fmt::format("{}: its limits: {}", path_, e.what()));
      }
    }
  }

  void load_series() {
    auto row = select("series", "campaign", "ORDER BY series");
    while (next(row)) {
      check(count(row, 1) == campaign_.series.size(), "a series is missing");
      StoredSeries s;
      s.property = text(row, 2), s.subject = text(row, 3), s.subject_version = text(row, 4);
      s.scalar = text(row, 5), s.robot = text(row, 6);
      for (const std::string* name : {&s.property, &s.subject, &s.scalar, &s.robot})
        check(is_word(*name), "a name is no word");  // it becomes a part of commands
      s.tally.cases = count(row, 7);
      check(parse(text(row, 8), s.tally.inputs) && parse(text(row, 9), s.tally.results),
            "a digest is malformed");
      cells_.push_back(count(row, 10));
      s.tally.fast = count(row, 11), s.tally.checked = count(row, 12);
      std::istringstream disagreed(text(row, 13));
      for (std::uint64_t index = 0; disagreed >> index;) s.tally.disagreed.push_back(index);
      check(disagreed.eof(), "a list of cases is malformed");
      check(s.tally.coverage.parse(text(row, 14)), "a coverage is malformed");
      s.profile = text(row, 15);
      check(profile_named(s.profile).has_value(), "an unknown profile");
      campaign_.spec.series.push_back(s.text());
      campaign_.series.push_back(std::move(s));
    }
    check(!campaign_.series.empty(), "a campaign without a series");
  }

  void load_done() {
    auto row = select("done");
    while (next(row)) {
      const std::uint64_t first = count(row, 2), last = count(row, 3);
      check(first < last && first >= campaign_.spec.first && last <= campaign_.spec.last &&
                series_at(row).tally.done.add(first, last),
            "a range of cases overlaps or lies outside the campaign");
    }
  }

  void load_cells() {
    auto row = select("cells");
    while (next(row)) {
      StoredSeries& s = series_at(row);
      const Cell cell{number(row, 2), number(row, 3)};
      s.labels[cell] = {text(row, 4), text(row, 5), text(row, 6)};
      check(is_word(s.labels[cell].operation), "a name is no word");
      Row& r = s.tally.rows[cell];
      r.count = count(row, 7), r.ill_posed = count(row, 8), r.unresolved = count(row, 9);
      r.not_finite = count(row, 10), r.wrong_branch = count(row, 11), r.refused = count(row, 12);
      r.failed = count(row, 13), r.max_error = real(row, 14), r.max_excess = real(row, 15);
      r.worst_score = real(row, 16), r.worst_index = count(row, 17), r.worst_kappa = real(row, 18);
      check(parse(text(row, 19), r.errors), "a histogram is malformed");
      r.unmeasured = count(row, 20), r.not_repeatable = count(row, 21), r.argument_written = count(row, 22);
      r.output_unwritten = count(row, 23), r.outside_domain = count(row, 24), r.crashed = count(row, 25);
      r.environment_changed = count(row, 26), r.printed = count(row, 27);
    }
  }

  void load_failures() {
    auto row = select("failures");
    while (next(row)) {
      series_at(row).failures[{number(row, 2), number(row, 3)}] = {count(row, 4), text(row, 5)};
    }
  }

  void check_totals() const {
    for (std::size_t i = 0; i < campaign_.series.size(); ++i) {
      const StoredSeries& s = campaign_.series[i];
      check(s.tally.done.count() == s.tally.cases, "the cases do not add up");
      check(s.tally.rows.size() == cells_[i], "a cell is missing");
      for (const auto& [cell, row] : s.tally.rows)
        check((row.failed > 0) == s.failures.contains(cell), "a failure is missing");
    }
  }

  const SQLite::Database& database_;
  const std::string& path_;
  int number_;
  Counted rows_;
  const char* table_ = "";  ///< which is read
  StoredCampaign campaign_;
  std::vector<std::uint64_t> cells_;  ///< the number of cells that each series must have
};

}  // namespace

StoredCampaign Store::load(int number) try {
  if (auto campaign = Loader(database_, path_, number).load()) return std::move(*campaign);
  const int held = campaigns();
  fail(held == 0 ? "holds no campaign" : fmt::format("holds {} campaigns, but not number {}", held, number));
} catch (const SQLite::Exception& e) {
  fail(e);
}

std::vector<Counterexample> Store::counterexamples() try {
  std::vector<Counterexample> all;
  Counted rows("reading " + path_);
  for (const char* table : {"series", "cells", "failures", "counterexamples"}) {
    SQLite::Statement sealed(database_, fmt::format("SELECT * FROM {}", table));
    while (sealed.executeStep()) {
      rows.next();
      if (!has_true_seal(sealed)) fail("corrupt: " + changed_row(table));
      if (const std::string wrong = wrong_value(sealed, table); !wrong.empty()) fail("corrupt: " + wrong);
    }
  }
  if (integer("SELECT count(*) FROM (SELECT 1 FROM cells c LEFT JOIN failures f USING(campaign, series, "
              "output, band) "
              "WHERE c.failed > 0 AND f.input IS NULL LIMIT 1)") > 0)
    fail("corrupt: a failure is missing");
  // Before the first row, all are sorted.
  const Looking looking(database_, rows);
  SQLite::Statement row(
      database_,
      "SELECT s.property, s.subject, s.scalar, s.robot, c.operation, c.block, f.input FROM failures f "
      "JOIN series s USING(campaign, series) JOIN cells c USING(campaign, series, output, band) "
      "UNION SELECT property, subject, scalar, robot, operation, block, input FROM counterexamples "
      "ORDER BY 1, 2, 3, 4, 5, 6, 7");
  for (; row.executeStep(); rows.next())
    all.push_back(
        {text(row, 0), text(row, 1), text(row, 2), text(row, 3), text(row, 4), text(row, 5), text(row, 6)});
  return all;
} catch (const SQLite::Exception& e) {
  fail(e);
}

}  // namespace liecheck::properties
