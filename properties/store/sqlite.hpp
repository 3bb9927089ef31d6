#pragma once
// SQLite with checked return codes. Every failure is one std::runtime_error that names the file and the reason.

#include <bit>
#include <cstdint>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace liecheck::properties {

class Database {
 public:
  /// Opens a file; `create` makes it where there is none.
  Database(const std::string& path, bool create);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  void run(const std::string& sql);
  std::int64_t integer(const std::string& sql);  ///< the one number that a query gives
  const std::string& path() const { return path_; }
  sqlite3* handle() const { return handle_; }
  bool read_only() const;
  [[noreturn]] void fail(const std::string& reason) const;
  void check(int code) const;

 private:
  std::string path_;
  sqlite3* handle_ = nullptr;
};

/// A prepared statement: `with` binds all its parameters, `step` is true while there are rows. `sealed` binds one
/// more, the first 64 bits of the SHA-256 of the others: SQLite notices damage to its pages, not to the numbers.
class Statement {
 public:
  Statement(Database& database, const char* sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  template <class... A>
  Statement& with(const A&... values) {
    reset();
    int at = 0;
    (bind(++at, values), ...);
    return *this;
  }
  template <class... A>
  Statement& sealed(const A&... values) {
    with(values...);
    std::string all;
    (append(all, values), ...);
    bind(int(sizeof...(A)) + 1, seal(all));
    return *this;
  }
  /// Does the last column seal the others?
  bool intact() const;
  bool step();
  void run() {
    while (step()) {
    }
  }
  std::int64_t integer(int column) const;
  std::uint64_t count(int column) const { return static_cast<std::uint64_t>(integer(column)); }
  double real(int column) const;  ///< NULL is NaN
  std::string text(int column) const;

 private:
  void reset();
  void bind(int at, std::int64_t value);
  void bind(int at, std::uint64_t value) { bind(at, std::bit_cast<std::int64_t>(value)); }
  void bind(int at, int value) { bind(at, std::int64_t(value)); }
  void bind(int at, double value);
  void bind(int at, const std::string& value);
  static void append(std::string& all, std::int64_t value);
  static void append(std::string& all, std::uint64_t value) {
    append(all, std::bit_cast<std::int64_t>(value));
  }
  static void append(std::string& all, int value) { append(all, std::int64_t(value)); }
  static void append(std::string& all, double value);
  static void append(std::string& all, const std::string& value);
  static std::int64_t seal(const std::string& all);
  Database& database_;
  sqlite3_stmt* handle_ = nullptr;
};

/// Everything or nothing: rolled back unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) { database_.run("BEGIN IMMEDIATE"); }
  ~Transaction();
  void commit() {
    database_.run("COMMIT");
    done_ = true;
  }

 private:
  Database& database_;
  bool done_ = false;
};

}  // namespace liecheck::properties
