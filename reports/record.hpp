#pragma once
// Reads records of campaigns and checks every field; the other files of this folder rely on that.
//
// JSON has no infinity and no NaN: the strings "inf" and "nan" stand for them.

#include <filesystem>
#include <reports/schema.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

/// Several records: `records` has each one without its rows, `results` the rows of all, in order.
struct Merged {
  std::vector<Json> records;
  std::vector<Json> results;
};

/// Refuses a record that does not satisfy the schema, or whose fields contradict one another.
void check_record(std::string_view file, const Json& record);

/// Reads and checks one record. Throws std::runtime_error that names file, field and value.
Json read_record(const std::filesystem::path& file);

/// Reads and concatenates records. Throws if two rows have equal subject, scalar, property, operation, block
/// and band, or if a hard case occurs twice for the same law, subject and scalar.
Merged merge_records(const std::vector<std::filesystem::path>& files);

/// Whether a band has a worst case; a band without a judged case has none.
bool has_worst(const Json& row);

/// The number; infinity or NaN for the strings "inf" and "nan".
double figure(const Json& value);

}  // namespace liecheck::reports
