#include <store/sqlite.hpp>

#include <sqlite3.h>
#include <unistd.h>
#include <campaign/digest.hpp>

#include <fmt/format.h>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>

namespace liecheck::properties {

namespace {

std::string reason_of(sqlite3* handle, int code) {
  const int system = sqlite3_system_errno(handle);
  const std::string why = system ? fmt::format(": {}", std::strerror(system)) : "";
  switch (code & 0xff) {
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
      return "corrupt: the database is damaged";
    case SQLITE_CANTOPEN:
      return "cannot be opened" + why;
    case SQLITE_IOERR:
      return "cannot be read or written" + why;
    default:
      return sqlite3_errmsg(handle);
  }
}

}  // namespace

Database::Database(const std::string& path, bool create) : path_(path) {
  if (path.empty()) throw std::runtime_error("a store needs a file name");
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw std::runtime_error(fmt::format("{}: not a store: not a regular file", path));
  if (!std::filesystem::exists(path, error)) {
    if (!create) throw std::runtime_error(fmt::format("{}: no such store", path));
    const auto folder = std::filesystem::path(path).parent_path();
    if (access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
      throw std::runtime_error(fmt::format("{}: cannot be created: {}", path, std::strerror(errno)));
  }
  // "./": names such as ":memory:" and "file:" mean a file here. A file that cannot be written is opened for
  // reading; one with a hot journal must be opened for writing even to be read.
  const std::string name = path[0] == '/' ? path : "./" + path;
  const int code = sqlite3_open_v2(name.c_str(), &handle_,
                                   SQLITE_OPEN_READWRITE | (create ? SQLITE_OPEN_CREATE : 0), nullptr);
  if (code != SQLITE_OK) {
    const std::string reason = reason_of(handle_, code);
    sqlite3_close(handle_);
    throw std::runtime_error(fmt::format("{}: {}", path, reason));
  }
  sqlite3_extended_result_codes(handle_, 1);
  sqlite3_busy_timeout(handle_, 10000);
}

Database::~Database() {
  sqlite3_close(handle_);
}

bool Database::read_only() const {
  return sqlite3_db_readonly(handle_, "main") == 1;
}

void Database::fail(const std::string& reason) const {
  throw std::runtime_error(fmt::format("{}: {}", path_, reason));
}

void Database::check(int code) const {
  if (code != SQLITE_OK && code != SQLITE_ROW && code != SQLITE_DONE) fail(reason_of(handle_, code));
}

void Database::run(const std::string& sql) {
  check(sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr));
}

std::int64_t Database::integer(const std::string& sql) {
  Statement s(*this, sql.c_str());
  if (!s.step()) fail("corrupt: no answer to " + sql);
  return s.integer(0);
}

Statement::Statement(Database& database, const char* sql) : database_(database) {
  database_.check(sqlite3_prepare_v2(database_.handle(), sql, -1, &handle_, nullptr));
}

Statement::~Statement() {
  sqlite3_finalize(handle_);
}

void Statement::reset() {
  sqlite3_reset(handle_);
}

bool Statement::step() {
  const int code = sqlite3_step(handle_);
  if (code != SQLITE_ROW) {
    if (code != SQLITE_DONE) database_.check(code);
    sqlite3_reset(handle_);
  }
  return code == SQLITE_ROW;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(handle_, column);
}

double Statement::real(int column) const {
  return sqlite3_column_type(handle_, column) == SQLITE_NULL ? std::numeric_limits<double>::quiet_NaN()
                                                             : sqlite3_column_double(handle_, column);
}

std::string Statement::text(int column) const {
  const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return data ? std::string(data, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column)))
              : std::string();
}

void Statement::bind(int at, std::int64_t value) {
  database_.check(sqlite3_bind_int64(handle_, at, value));
}

void Statement::bind(int at, double value) {
  database_.check(std::isnan(value) ? sqlite3_bind_null(handle_, at)
                                    : sqlite3_bind_double(handle_, at, value));
}

void Statement::bind(int at, const std::string& value) {
  database_.check(
      sqlite3_bind_text(handle_, at, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT));
}

void Statement::append(std::string& all, std::int64_t value) {
  all += fmt::format("{};", value);
}

void Statement::append(std::string& all, double value) {
  // SQLite keeps no NaN (NULL stands for it) and no sign of zero.
  all += std::isnan(value) ? ";" : fmt::format("{:a};", value + 0.0);
}

void Statement::append(std::string& all, const std::string& value) {
  all += fmt::format("{}:{};", value.size(), value);
}

std::int64_t Statement::seal(const std::string& all) {
  return std::bit_cast<std::int64_t>(sha256(all)[0]);
}

bool Statement::intact() const {
  std::string all;
  const int last = sqlite3_column_count(handle_) - 1;
  for (int i = 0; i < last; ++i) switch (sqlite3_column_type(handle_, i)) {
      case SQLITE_INTEGER:
        append(all, integer(i));
        break;
      case SQLITE_TEXT:
        append(all, text(i));
        break;
      default:
        append(all, real(i));
    }
  return sqlite3_column_type(handle_, last) == SQLITE_INTEGER && seal(all) == integer(last);
}

Transaction::~Transaction() {
  if (!done_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

}  // namespace liecheck::properties
