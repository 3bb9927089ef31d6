#pragma once
// A table in a CSV file: one row a line, numbers separated by commas. The first line may name the columns, each with its
// unit as `name [unit]`, as in the files that `liecheck scene run --csv` writes.

#include <optional>
#include <string>
#include <vector>

namespace liecheck::scene_file_detail {

/// Which columns to read, by name or by number from 1. `time` defaults to the first one, `columns` to all others.
struct CsvChoice {
  std::string time = "1";
  std::optional<std::vector<std::string>> columns;
};

struct CsvTable {
  std::vector<double> numbers;  ///< rows of `width`: the time [s], then the columns
  std::size_t width = 0;
};

/// Throws std::invalid_argument with FILE:LINE and the value at fault. `unit` is that of the columns in SI.
CsvTable readCsvTable(const std::string& path, const CsvChoice& choice, const std::string& unit);

}  // namespace liecheck::scene_file_detail
