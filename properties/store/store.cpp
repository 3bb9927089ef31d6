// The file of a store: how it is opened, its tables and its errors.

#include <store/store.hpp>

#include <sqlite3.h>
#include <unistd.h>

#include <fmt/format.h>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <store/looking.hpp>
#include <store/row_seal.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

constexpr std::int64_t application_id = 0x6c696563;  // "liec"
constexpr std::int64_t schema_version = 5;           // which sealed done and counterexamples
constexpr int most_bytes = 65 << 20;                 // of a row: its URDF has at most 64 MB

const char* const schema = R"(
CREATE TABLE campaigns(id INTEGER PRIMARY KEY, seed INTEGER, cases INTEGER, first INTEGER, last INTEGER,
  generator INTEGER, program TEXT, budgets TEXT, robot TEXT, robot_hash TEXT, urdf TEXT, environment TEXT,
  seal INTEGER);
CREATE TABLE series(campaign INTEGER, series INTEGER, property TEXT, subject TEXT, subject_version TEXT,
  scalar TEXT, robot TEXT, cases INTEGER, inputs TEXT, results TEXT, cells INTEGER, fast INTEGER,
  checked INTEGER, disagreed TEXT, coverage TEXT, profile TEXT, seal INTEGER,
  PRIMARY KEY(campaign, series)) WITHOUT ROWID;
CREATE TABLE done(campaign INTEGER, series INTEGER, first INTEGER, last INTEGER, seal INTEGER,
  PRIMARY KEY(campaign, series, first)) WITHOUT ROWID;
CREATE TABLE cells(campaign INTEGER, series INTEGER, output INTEGER, band INTEGER, operation TEXT, block TEXT,
  band_name TEXT, count INTEGER, ill_posed INTEGER, unresolved INTEGER, not_finite INTEGER,
  wrong_branch INTEGER, refused INTEGER, failed INTEGER, max_error REAL, max_excess REAL, worst_score REAL,
  worst_index INTEGER, worst_kappa REAL, histogram TEXT, unmeasured INTEGER, not_repeatable INTEGER,
  argument_written INTEGER, output_unwritten INTEGER, outside_domain INTEGER, crashed INTEGER,
  environment_changed INTEGER, printed INTEGER, seal INTEGER,
  PRIMARY KEY(campaign, series, output, band)) WITHOUT ROWID;
CREATE TABLE limits(campaign INTEGER, subject TEXT, file TEXT, text TEXT, seal INTEGER,
  PRIMARY KEY(campaign, subject)) WITHOUT ROWID;
CREATE TABLE failures(campaign INTEGER, series INTEGER, output INTEGER, band INTEGER, case_index INTEGER,
  input TEXT, seal INTEGER, PRIMARY KEY(campaign, series, output, band)) WITHOUT ROWID;
CREATE TABLE counterexamples(property TEXT, subject TEXT, scalar TEXT, robot TEXT, operation TEXT, block TEXT,
  input TEXT, seal INTEGER,
  PRIMARY KEY(property, subject, scalar, robot, operation, block, input)) WITHOUT ROWID;
)";

constexpr const char* replaced = "was removed or replaced by another process while this one ran";

std::runtime_error error_of(const std::string& path, const std::string& reason) {
  return std::runtime_error(fmt::format("{}: {}", path, reason));
}

/// `system` is the error number of the operating system, or 0.
std::string reason_of(const SQLite::Exception& error, int system) {
  const std::string why = system ? fmt::format(": {}", std::strerror(system)) : "";
  if (error.getExtendedErrorCode() == SQLITE_READONLY_DBMOVED) return replaced;
  switch (error.getErrorCode()) {
    case SQLITE_FULL:
      return "the disk is full";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "read-only: it cannot be written";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "in use by another process";
    case SQLITE_NOTADB:
      return "not a store: the file is not an SQLite database";
    case SQLITE_CORRUPT:
    case -1:  // from SQLiteCpp: a query gave fewer columns or rows than the schema has
      return "corrupt: the database is damaged";
    case SQLITE_TOOBIG:
      return fmt::format("corrupt: a value is longer than {} bytes", most_bytes);
    case SQLITE_CANTOPEN:
      return "cannot be opened" + why;
    case SQLITE_IOERR:
      return "cannot be read or written" + why;
    default:
      return fmt::format("an error of SQLite: {}", error.what());
  }
}

/// The definitions of all tables, views, triggers and indices.
std::set<std::string> structure_of(const SQLite::Database& database) {
  SQLite::Statement row(database,
                        "SELECT type || ' ' || name || ': ' || sql FROM sqlite_master WHERE sql NOT NULL");
  std::set<std::string> all;
  while (row.executeStep()) all.insert(row.getColumn(0).getString());
  return all;
}

/// Refuses files beside a store through which SQLite would wait, or write or delete another file: links, pipes, and a
/// journal that names a second one, which SQLite deletes after the rollback. liecheck writes no such journal.
void check_files_beside(const std::string& path) {
  std::error_code error;
  for (const char* ending : {"-journal", "-wal", "-shm"})
    if (const auto file = std::filesystem::symlink_status(path + ending, error);
        std::filesystem::exists(file) && !std::filesystem::is_regular_file(file))
      throw error_of(path + ending, "is a link, a pipe or a folder beside a store: remove it");
  constexpr std::string_view magic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  std::ifstream journal(path + "-journal", std::ios::binary);
  std::string end(magic.size(), '\0');
  if (journal.seekg(-static_cast<std::streamoff>(magic.size()), std::ios::end) &&
      journal.read(end.data(), static_cast<std::streamsize>(end.size())) && end == magic)
    throw error_of(path + "-journal", "names another file, as no journal of a store does: remove it");
}

SQLite::Database open(const std::string& path, bool create) {
  namespace fs = std::filesystem;
  if (path.empty()) throw std::runtime_error("a store needs a file name");
  std::error_code error;
  const bool exists = fs::exists(path, error);
  if (exists && !fs::is_regular_file(path, error)) throw error_of(path, "not a store: not a regular file");
  if (!exists && !create) throw error_of(path, "no such store");
  if (const auto at = path.rfind('@');
      !exists && at != path.npos && path.find_first_not_of("0123456789", at + 1) == path.npos)
    throw error_of(path, "FILE@N is a campaign of an existing store: a new one needs another name");
  const auto folder = fs::path(path).parent_path();
  if (!exists && ::access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
    throw error_of(path, fmt::format("cannot be created: {}", std::strerror(errno)));
  // A link is resolved first, since SQLite's other files lie beside the file that it leads to. SQLite opens a
  // write-protected file read-only. A file with a hot journal must be opened for writing, even if it is only read.
  constexpr int busy_timeout = 10000;  // [ms]
  try {
    const std::string file = fs::weakly_canonical(fs::absolute(path), error).string();
    if (error) throw error_of(path, error.message());
    check_files_beside(file);
    return {file, SQLite::OPEN_READWRITE | (create ? SQLite::OPEN_CREATE : 0), busy_timeout};
  } catch (const SQLite::Exception& e) {
    throw error_of(path, reason_of(e, ::access(path.c_str(), R_OK) == 0 ? 0 : errno));
  }
}

}  // namespace

Store::Store(const std::string& path, Open how)
    : path_(path), is_new_(::access(path.c_str(), F_OK) != 0), database_(open(path, how == Open::create)) {
  try {
    check_format(how);
  } catch (...) {
    std::error_code error;
    if (is_new_ && std::filesystem::file_size(path, error) == 0) std::filesystem::remove(path, error);
    throw;
  }
}

void Store::check_format(Open how) try {
  for (const int part : {SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW})
    sqlite3_db_config(database_.getHandle(), part, 0, nullptr);
  sqlite3_limit(database_.getHandle(), SQLITE_LIMIT_LENGTH, most_bytes);
  database_.exec("PRAGMA trusted_schema = OFF");
  database_.exec("PRAGMA synchronous = FULL");  // a committed transaction survives the loss of power, too
  if (how == Open::create && empty()) create_tables();
  if (integer("PRAGMA application_id") != application_id)
    fail(empty() ? "not a store: an empty file" : "not a store: a database of another program");
  if (const auto version = integer("PRAGMA user_version"); version != schema_version)
    fail(fmt::format("a store of version {}{}, this program reads version {}", version,
                     version == 1 ? ", which counts inputs and not what was measured of them" : "",
                     schema_version));
  check_structure();
  check_campaigns();
  Counted checked("checking " + path_, "");
  const Looking looking(database_, checked);
  if (database_.execAndGet("PRAGMA quick_check(1)").getString() != "ok")
    fail("corrupt: the database is damaged");
  if (how == Open::create && sqlite3_db_readonly(database_.getHandle(), "main") == 1)
    fail("read-only: it cannot be written");
} catch (const SQLite::Exception& e) {
  fail(e);
}

void Store::check_structure() {
  SQLite::Database right(":memory:", SQLite::OPEN_READWRITE);
  right.exec(schema);
  const auto due = structure_of(right), found = structure_of(database_);
  const auto name = [](const std::string& definition) { return definition.substr(0, definition.find(": ")); };
  for (const std::string& one : found)
    if (!due.contains(one)) fail(fmt::format("corrupt: its {} is none of a store", name(one)));
  for (const std::string& one : due)
    if (!found.contains(one)) fail(fmt::format("corrupt: its {} is missing", name(one)));
}

void Store::check_campaigns() {
  // All counts are of one state: another process may commit a campaign between two of them.
  const SQLite::Transaction reading(database_);
  const std::int64_t n = integer("SELECT count(*) FROM campaigns");
  if (n > 0 &&
      (integer("SELECT min(id) FROM campaigns") != 1 || integer("SELECT max(id) FROM campaigns") != n))
    fail("corrupt: a campaign is missing");
  for (const char* table : {"series", "done", "cells", "limits", "failures"})
    if (integer(
            fmt::format("SELECT count(*) FROM (SELECT 1 FROM {} WHERE campaign < 1 OR campaign > {} LIMIT 1)",
                        table, n)) > 0)
      fail(fmt::format("corrupt: its table {} has rows of a campaign that is missing", table));
}

bool Store::empty() {
  return integer("PRAGMA application_id") == 0 && integer("SELECT count(*) FROM sqlite_master") == 0;
}

void Store::create_tables() {
  SQLite::Transaction transaction(database_, SQLite::TransactionBehavior::IMMEDIATE);
  if (!empty()) return;  // another process was faster
  database_.exec(
      fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", application_id, schema_version));
  database_.exec(schema);
  transaction.commit();
}

void Store::fail(const std::string& reason) const {
  throw error_of(path_, reason);
}

void Store::fail(const SQLite::Exception& error) const {
  if (error.getErrorCode() == SQLITE_INTERRUPT) throw GivenUp{};
  fail(reason_of(error, sqlite3_system_errno(database_.getHandle())));
}

std::int64_t Store::integer(const std::string& query) {
  return database_.execAndGet(query).getInt64();
}

int Store::campaigns() try {
  return static_cast<int>(integer("SELECT count(*) FROM campaigns"));
} catch (const SQLite::Exception& e) {
  fail(e);
}

void Store::reserve() try {
  reserved_ = std::make_unique<SQLite::Database>(open(path_, false));
  reserved_->exec("BEGIN IMMEDIATE");
  int moved = 0;
  sqlite3_file_control(database_.getHandle(), "main", SQLITE_FCNTL_HAS_MOVED, &moved);
  if (moved) fail(replaced);
} catch (const SQLite::Exception& e) {
  fail(e);
}

void Store::copy_to(const std::string& path) try {
  Counted copied("copying " + path_, "");
  const Looking looking(database_, copied);
  SQLite::Statement copy(database_, "VACUUM INTO ?");
  bind_row(copy, path[0] == '/' ? path : "./" + path).exec();
} catch (const SQLite::Exception& e) {
  fail(e);
}

}  // namespace liecheck::properties
