#include <store/row_seal.hpp>

#include <fmt/format.h>
#include <campaign/digest.hpp>
#include <cmath>

namespace liecheck::properties {

std::string sealed_text(std::int64_t value) {
  return fmt::format("{};", value);
}

std::string sealed_text(double value) {
  // SQLite stores NULL for NaN, and 0 for -0.
  return std::isnan(value) ? ";" : fmt::format("{:a};", value + 0.0);
}

std::string sealed_text(const std::string& value) {
  return fmt::format("{}:{};", value.size(), value);
}

std::int64_t seal_of(const std::string& texts) {
  return std::bit_cast<std::int64_t>(sha256(texts)[0]);
}

bool has_true_seal(const SQLite::Statement& row) {
  std::string texts;
  const int last = row.getColumnCount() - 1;
  for (int i = 0; i < last; ++i) {
    const SQLite::Column column = row.getColumn(i);
    if (column.isInteger()) {
      texts += sealed_text(column.getInt64());
    } else if (column.isText()) {
      texts += sealed_text(column.getString());
    } else {
      texts += column.isNull() ? sealed_text(std::nan("")) : sealed_text(column.getDouble());
    }
  }
  const SQLite::Column seal = row.getColumn(last);
  return seal.isInteger() && seal.getInt64() == seal_of(texts);
}

}  // namespace liecheck::properties
