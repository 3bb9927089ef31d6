#pragma once
// Sealed rows. SQLite notices damage to the structure of its pages, but not to the numbers in them. So the
// last column of a row, its seal, holds the first 64 bits of the SHA-256 of the other columns.

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>

#include <cstdint>
#include <string>
#include <type_traits>

namespace liecheck::properties {

/// The value that SQLite stores. Its integers have 64 bits and a sign.
template <class T>
decltype(auto) stored(const T& value) {
  if constexpr (std::is_integral_v<T>)
    return static_cast<std::int64_t>(value);
  else
    return (value);
}

/// The text of a stored value that is hashed for the seal.
std::string sealed_text(std::int64_t value);
std::string sealed_text(double value);
std::string sealed_text(const std::string& value);
std::int64_t seal_of(const std::string& texts);

/// Resets a statement and binds all its parameters.
template <class... A>
SQLite::Statement& bind_row(SQLite::Statement& statement, const A&... values) {
  statement.tryReset();
  SQLite::bind(statement, stored(values)...);
  return statement;
}

/// Like bind_row, with the seal of the values as an additional last parameter.
template <class... A>
SQLite::Statement& bind_sealed_row(SQLite::Statement& statement, const A&... values) {
  return bind_row(statement, values..., seal_of((sealed_text(stored(values)) + ...)));
}

/// Whether the last column of the statement's row is the seal of the other columns.
bool has_true_seal(const SQLite::Statement& row);

}  // namespace liecheck::properties
