#pragma once
// Long statements of SQLite show that they run, and end at a signal.

#include <SQLiteCpp/SQLiteCpp.h>

#include <sqlite3.h>

#include <support/progress.hpp>

namespace liecheck::properties {

/// While one exists, the statements of a database call given_up() again and again. If it is true, they throw an
/// SQLite::Exception with SQLITE_INTERRUPT.
class Looking {
 public:
  Looking(SQLite::Database& database, Counted& shown) : database_(database.getHandle()) {
    constexpr int operations = 100000;  // of SQLite's machine, about 10 ms
    sqlite3_progress_handler(
        database_, operations, [](void* of) -> int { return static_cast<Counted*>(of)->given_up(); }, &shown);
  }
  Looking(const Looking&) = delete;
  Looking& operator=(const Looking&) = delete;
  ~Looking() { sqlite3_progress_handler(database_, 0, nullptr, nullptr); }

 private:
  sqlite3* database_;
};

}  // namespace liecheck::properties
