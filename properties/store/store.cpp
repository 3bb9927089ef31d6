#include <store/store.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace liecheck::properties {

namespace {

constexpr std::int64_t application_id = 0x6c696563;  // "liec"
constexpr std::int64_t schema_version = 1;

const char* const schema = R"(
CREATE TABLE campaigns(id INTEGER PRIMARY KEY, seed INTEGER, cases INTEGER, first INTEGER, last INTEGER,
  generator INTEGER, program TEXT, budgets TEXT, robot TEXT, robot_hash TEXT, urdf TEXT, environment TEXT,
  seal INTEGER);
CREATE TABLE series(campaign INTEGER, series INTEGER, property TEXT, subject TEXT, subject_version TEXT,
  scalar TEXT, robot TEXT, cases INTEGER, inputs TEXT, results TEXT, cells INTEGER, fast INTEGER,
  checked INTEGER, disagreed TEXT, coverage TEXT, seal INTEGER,
  PRIMARY KEY(campaign, series)) WITHOUT ROWID;
CREATE TABLE done(campaign INTEGER, series INTEGER, first INTEGER, last INTEGER,
  PRIMARY KEY(campaign, series, first)) WITHOUT ROWID;
CREATE TABLE cells(campaign INTEGER, series INTEGER, output INTEGER, band INTEGER, operation TEXT, block TEXT,
  band_name TEXT, count INTEGER, ill_posed INTEGER, unresolved INTEGER, not_finite INTEGER,
  wrong_branch INTEGER, refused INTEGER, failed INTEGER, max_error REAL, max_excess REAL, worst_score REAL,
  worst_index INTEGER, worst_kappa REAL, histogram TEXT, seal INTEGER,
  PRIMARY KEY(campaign, series, output, band)) WITHOUT ROWID;
CREATE TABLE failures(campaign INTEGER, series INTEGER, output INTEGER, band INTEGER, case_index INTEGER,
  input TEXT, seal INTEGER, PRIMARY KEY(campaign, series, output, band)) WITHOUT ROWID;
CREATE TABLE counterexamples(property TEXT, subject TEXT, scalar TEXT, robot TEXT, operation TEXT, block TEXT,
  input TEXT, PRIMARY KEY(property, subject, scalar, robot, operation, block, input)) WITHOUT ROWID;
)";

std::string text_of(const Histogram& h) {
  std::string text;
  char word[40];  // two numbers of at most 20 digits
  for (const auto& [bin, n] : h.bins()) {
    char* at = std::to_chars(word, word + 20, bin).ptr;
    *at++ = ':';
    at = std::to_chars(at, word + sizeof word, n).ptr;
    if (!text.empty()) text += ' ';
    text.append(word, at);
  }
  return text;
}

}  // namespace

Store::Store(const std::string& path, Open how) : database_(path, how == Open::create) {
  // FULL: a transaction that was committed survives the loss of power, too.
  database_.run("PRAGMA synchronous = FULL");
  const bool fresh = database_.integer("SELECT count(*) FROM sqlite_master") == 0 &&
                     database_.integer("PRAGMA application_id") == 0;
  if (fresh && how == Open::create) {
    create();
    return;
  }
  if (database_.integer("PRAGMA application_id") != application_id)
    database_.fail(fresh ? "not a store: an empty file" : "not a store: a database of another program");
  if (const auto v = database_.integer("PRAGMA user_version"); v != schema_version)
    database_.fail(fmt::format("a store of version {}, this program reads version {}", v, schema_version));
  Statement check(database_, "PRAGMA quick_check(1)");
  if (!check.step() || check.text(0) != "ok") database_.fail("corrupt: the database is damaged");
  if (how == Open::create && database_.read_only()) database_.fail("read-only: it cannot be written");
}

void Store::create() {
  Transaction t(database_);
  database_.run(
      fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", application_id, schema_version));
  database_.run(schema);
  t.commit();
}

int Store::campaigns() {
  return static_cast<int>(database_.integer("SELECT count(*) FROM campaigns"));
}

void Store::insert(const CampaignSpec& s) {
  Statement(database_, "INSERT INTO campaigns VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .sealed(campaign_, s.seed, s.cases, s.first, s.last, s.generator, s.program, s.budgets, s.robot.name,
              s.robot.hash, s.robot.urdf, s.environment)
      .run();
}

void Store::write_series(std::size_t series, const SeriesName& s, const Tally& tally) {
  const auto i = static_cast<std::int64_t>(series);
  std::vector<std::uint64_t> disagreed = tally.disagreed;
  std::sort(disagreed.begin(), disagreed.end());
  Statement(database_, "REPLACE INTO series VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .sealed(campaign_, i, s.property, s.subject, s.subject_version, s.scalar, s.robot, tally.cases,
              hexadecimal(tally.inputs.sum()), hexadecimal(tally.results.sum()),
              std::uint64_t(tally.rows.size()), tally.fast, tally.checked,
              fmt::format("{}", fmt::join(disagreed, " ")), tally.coverage.text())
      .run();
  Statement(database_, "DELETE FROM done WHERE campaign = ? AND series = ?").with(campaign_, i).run();
  Statement insert(database_, "INSERT INTO done VALUES(?, ?, ?, ?)");
  for (const auto& [first, last] : tally.done) insert.with(campaign_, i, first, last).run();
}

void Store::write_cell(std::size_t series, Cell cell, const Label& l, const Row& r) {
  if (!cells_)
    cells_ = std::make_unique<Statement>(
        database_, "REPLACE INTO cells VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  cells_
      ->sealed(campaign_, std::uint64_t(series), cell.first, cell.second, l.operation, l.block, l.band,
               r.count, r.ill_posed, r.unresolved, r.not_finite, r.wrong_branch, r.refused, r.failed,
               r.max_error, r.max_excess, r.worst_score, r.worst_index, r.worst_kappa, text_of(r.errors))
      .run();
}

void Store::write_failure(std::size_t series, Cell cell, const Failure& f) {
  Statement(database_, "REPLACE INTO failures VALUES(?, ?, ?, ?, ?, ?, ?)")
      .sealed(campaign_, std::uint64_t(series), cell.first, cell.second, f.index, f.input)
      .run();
}

void Store::check_alone() {
  const std::int64_t now = database_.integer("PRAGMA data_version");
  if (data_version_ && now != data_version_)
    database_.fail("was changed by another process while this one ran");
  data_version_ = now;
}

void Store::begin(const CampaignSpec& spec, std::vector<SeriesResult>& series, bool resume) {
  const std::string& file = database_.path();
  Transaction t(database_);
  check_alone();
  seed_ = spec.seed;
  campaign_ = campaigns();
  if (campaign_ > 0) {
    const StoredCampaign last = load(campaign_);
    const std::string differs = last.spec.differences(spec);
    const char* state = last.complete() ? "complete" : "unfinished";
    if (resume && !differs.empty())
      throw std::invalid_argument(
          fmt::format("{}: holds another campaign than asked for: {}", file, differs));
    if (!resume && differs.empty())
      throw std::invalid_argument(
          fmt::format("{}: holds this campaign already, {}: --resume goes on with it", file, state));
    if (!last.complete() && !resume && last.spec.cases > 0)
      throw std::invalid_argument(
          fmt::format("{}: holds another campaign than asked for, unfinished: {}; finish that with --resume, "
                      "or take another file",
                      file, differs));
    if (differs.empty()) {
      for (std::size_t i = 0; i < series.size(); ++i) series[i].tally = last.series[i].tally;
      return;
    }
  }
  ++campaign_;
  insert(spec);
  for (std::size_t i = 0; i < series.size(); ++i)
    write_series(i, name_of(*series[i].series), series[i].tally);
  t.commit();
}

void Store::commit(const std::vector<SeriesResult>& series, const Checkpoint::ChangedRows& changed) {
  Transaction t(database_);
  check_alone();
  Statement known(database_,
                  "SELECT 1 FROM failures WHERE campaign = ? AND series = ? AND output = ? AND band = ? "
                  "AND case_index = ?");
  for (const auto& [i, cells] : changed) {
    const Series& s = *series[i].series;
    for (const Cell& cell : cells) {
      const Row& row = series[i].tally.rows.at(cell);
      const Output& o = s.outputs.at(static_cast<std::size_t>(cell.first));
      write_cell(i, cell, {o.operation, o.block, s.bands()[static_cast<std::size_t>(cell.second)].name}, row);
      if (row.failed &&
          !known.with(campaign_, std::uint64_t(i), cell.first, cell.second, row.worst_index).step())
        write_failure(
            i, cell,
            {row.worst_index, fmt::format("{}", fmt::join(s.input(s.id(seed_, row.worst_index)), ","))});
    }
    write_series(i, name_of(s), series[i].tally);
  }
  t.commit();
}

void Store::copy_to(const std::string& path) {
  Statement(database_, "VACUUM INTO ?").with(path[0] == '/' ? path : "./" + path).run();
}

void Store::write(const StoredCampaign& c, bool replace_last, const std::vector<Counterexample>& others) {
  Transaction t(database_);
  campaign_ = campaigns() + (replace_last ? 0 : 1);
  for (const char* table : {"campaigns WHERE id", "series WHERE campaign", "done WHERE campaign",
                            "cells WHERE campaign", "failures WHERE campaign"})
    database_.run(fmt::format("DELETE FROM {} = {}", table, campaign_));
  insert(c.spec);
  for (std::size_t i = 0; i < c.series.size(); ++i) {
    const StoredSeries& s = c.series[i];
    write_series(i, s, s.tally);
    for (const auto& [cell, r] : s.tally.rows) write_cell(i, cell, s.labels.at(cell), r);
    for (const auto& [cell, failure] : s.failures) write_failure(i, cell, failure);
  }
  keep(others);
  t.commit();
}

void Store::adopt(const std::vector<Counterexample>& others) {
  Transaction t(database_);
  keep(others);
  t.commit();
}

void Store::keep(const std::vector<Counterexample>& others) {
  Statement other(database_, "REPLACE INTO counterexamples VALUES(?, ?, ?, ?, ?, ?, ?)");
  for (const Counterexample& x : others)
    other.with(x.property, x.subject, x.scalar, x.robot, x.operation, x.block, x.input).run();
}

}  // namespace liecheck::properties
