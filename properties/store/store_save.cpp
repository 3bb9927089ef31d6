// Writes the progress of a running campaign, or a whole campaign, to a store.

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <store/beside_cases.hpp>
#include <store/looking.hpp>
#include <store/row_seal.hpp>
#include <store/store.hpp>
#include <support/progress.hpp>

namespace liecheck::properties {

namespace {

SQLite::Transaction begin_transaction(SQLite::Database& database) {
  return SQLite::Transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
}

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

void Store::insert(const CampaignSpec& s) {
  SQLite::Statement row(database_, "INSERT INTO campaigns VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  bind_sealed_row(row, campaign_, s.seed, s.cases, s.first, s.last, s.generator, s.program, s.budgets,
                  s.robot.name, s.robot.hash, s.robot.urdf, with_beside_cases(s.environment, s.beside))
      .exec();
  insert_limits(s);
}

void Store::insert_limits(const CampaignSpec& s) {
  SQLite::Statement row(database_, "INSERT INTO limits VALUES(?, ?, ?, ?, ?)");
  for (const auto& limits : s.limits)
    bind_sealed_row(row, campaign_, limits->subject, limits->file, limits->text).exec();
}

void Store::write_series(std::size_t series, const SeriesName& s, const Tally& tally) {
  std::vector<std::uint64_t> disagreed = tally.disagreed;
  std::sort(disagreed.begin(), disagreed.end());
  SQLite::Statement row(database_,
                        "REPLACE INTO series VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  bind_sealed_row(row, campaign_, series, s.property, s.subject, s.subject_version, s.scalar, s.robot,
                  tally.cases, hexadecimal(tally.inputs.sum()), hexadecimal(tally.results.sum()),
                  tally.rows.size(), tally.fast, tally.checked, fmt::format("{}", fmt::join(disagreed, " ")),
                  tally.coverage.text(), s.profile)
      .exec();
  SQLite::Statement erase(database_, "DELETE FROM done WHERE campaign = ? AND series = ?");
  bind_row(erase, campaign_, series).exec();
  SQLite::Statement range(database_, "INSERT INTO done VALUES(?, ?, ?, ?, ?)");
  for (const auto& [first, last] : tally.done) bind_sealed_row(range, campaign_, series, first, last).exec();
}

void Store::write_cell(std::size_t series, Cell cell, const Label& l, const Row& r) {
  if (!cells_)
    cells_ = std::make_unique<SQLite::Statement>(
        database_, "REPLACE INTO cells VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  bind_sealed_row(*cells_, campaign_, series, cell.first, cell.second, l.operation, l.block, l.band, r.count,
                  r.ill_posed, r.unresolved, r.not_finite, r.wrong_branch, r.refused, r.failed, r.max_error,
                  r.max_excess, r.worst_score, r.worst_index, r.worst_kappa, text_of(r.errors), r.unmeasured,
                  r.not_repeatable, r.argument_written, r.output_unwritten, r.outside_domain, r.crashed,
                  r.environment_changed, r.printed)
      .exec();
}

void Store::write_failure(std::size_t series, Cell cell, const Failure& f) {
  SQLite::Statement row(database_, "REPLACE INTO failures VALUES(?, ?, ?, ?, ?, ?, ?)");
  bind_sealed_row(row, campaign_, series, cell.first, cell.second, f.index, f.input).exec();
}

void Store::check_no_other_writer() {
  const std::int64_t now = integer("PRAGMA data_version");
  if (data_version_ && now != data_version_) fail("was changed by another process while this one ran");
  data_version_ = now;
}

void Store::begin(const CampaignSpec& spec, std::vector<SeriesResult>& series, bool resume) try {
  auto transaction = begin_transaction(database_);
  check_no_other_writer();
  seed_ = spec.seed;
  campaign_ = campaigns();
  if (campaign_ > 0) {
    const StoredCampaign last = load(campaign_);
    const std::string differs = last.spec.differences(spec);
    const char* state = last.complete() ? "complete" : "unfinished";
    if (resume && !differs.empty())
      throw std::invalid_argument(fmt::format("{}: holds a different campaign: {}", path_, differs));
    if (!resume && differs.empty())
      throw std::invalid_argument(
          fmt::format("{}: holds this campaign already ({}): continue it with --resume{}", path_, state,
                      last.complete() ? "" : ", unless another process runs it"));
    if (!last.complete() && !resume && last.spec.cases > 0)
      throw std::invalid_argument(
          fmt::format("{}: holds a different, unfinished campaign: {}; finish that one with --resume, "
                      "or use another file",
                      path_, differs));
    if (differs.empty()) {
      for (std::size_t i = 0; i < series.size(); ++i) series[i].tally = last.series[i].tally;
      return;
    }
  }
  ++campaign_;
  insert(spec);
  for (std::size_t i = 0; i < series.size(); ++i)
    write_series(i, name_of(*series[i].series), series[i].tally);
  transaction.commit();
} catch (const SQLite::Exception& e) {
  fail(e);
}

void Store::commit(const std::vector<SeriesResult>& series, const Checkpoint::ChangedRows& changed) try {
  auto transaction = begin_transaction(database_);
  check_no_other_writer();
  SQLite::Statement known(
      database_,
      "SELECT 1 FROM failures WHERE campaign = ? AND series = ? AND output = ? AND band = ? "
      "AND case_index = ?");
  for (const auto& [i, cells] : changed) {
    const Series& s = *series[i].series;
    for (const Cell& cell : cells) {
      const Row& row = series[i].tally.rows.at(cell);
      const Output& o = s.outputs.at(static_cast<std::size_t>(cell.first));
      write_cell(i, cell,
                 {std::string(o.operation), std::string(o.block),
                  s.bands()[static_cast<std::size_t>(cell.second)].name},
                 row);
      if (row.failed &&
          !bind_row(known, campaign_, i, cell.first, cell.second, row.worst_index).executeStep())
        write_failure(
            i, cell,
            {row.worst_index, fmt::format("{}", fmt::join(s.input(s.id(seed_, row.worst_index)), ","))});
    }
    write_series(i, name_of(s), series[i].tally);
  }
  known.reset();
  transaction.commit();
} catch (const SQLite::Exception& e) {
  fail(e);
}

void Store::write(const StoredCampaign& c, bool replace_last, const std::vector<Counterexample>& others) try {
  Counted rows("writing " + path_);
  const Looking looking(database_, rows);
  auto transaction = begin_transaction(database_);
  campaign_ = campaigns() + (replace_last ? 0 : 1);
  for (const char* table : {"campaigns WHERE id", "series WHERE campaign", "done WHERE campaign",
                            "cells WHERE campaign", "limits WHERE campaign", "failures WHERE campaign"})
    database_.exec(fmt::format("DELETE FROM {} = {}", table, campaign_));
  insert(c.spec);
  for (std::size_t i = 0; i < c.series.size(); ++i) {
    const StoredSeries& s = c.series[i];
    write_series(i, s, s.tally);
    for (const auto& [cell, r] : s.tally.rows) rows.next(), write_cell(i, cell, s.labels.at(cell), r);
    for (const auto& [cell, failure] : s.failures) write_failure(i, cell, failure);
  }
  insert(others);
  transaction.commit();
} catch (const SQLite::Exception& e) {
  fail(e);
}

void Store::adopt(const std::vector<Counterexample>& others) try {
  auto transaction = begin_transaction(database_);
  insert(others);
  transaction.commit();
} catch (const SQLite::Exception& e) {
  fail(e);
}

void Store::insert(const std::vector<Counterexample>& others) {
  SQLite::Statement row(database_, "REPLACE INTO counterexamples VALUES(?, ?, ?, ?, ?, ?, ?, ?)");
  Counted rows("writing " + path_);
  for (const Counterexample& x : others)
    rows.next(),
        bind_sealed_row(row, x.property, x.subject, x.scalar, x.robot, x.operation, x.block, x.input).exec();
}

}  // namespace liecheck::properties
