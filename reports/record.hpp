#pragma once
// Reads a stored record of a campaign and checks all of it; the other files of this room rely on that.
//
// JSON has no infinity and no NaN: the strings "inf" and "nan" stand for them.

#include <filesystem>
#include <reports/schema.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

/// Campaigns side by side: what each was (`records`, without rows) and the rows of all of them, in order.
struct Merged {
  std::vector<Json> records;
  std::vector<Json> results;
};

/// Refuses a record that does not meet the schema, or whose fields contradict one another.
void check_record(std::string_view file, const Json& record);

/// Reads and checks one record. Throws std::runtime_error naming file, field and value.
Json read_record(const std::filesystem::path& file);

/// Reads and concatenates records; the same row (subject, scalar, property, operation, block, band) twice is
/// an error.
Merged merge_records(const std::vector<std::filesystem::path>& files);

/// Whether a band has a worst case; one without a judged case has none.
bool has_worst(const Json& row);

/// A number, or infinity or NaN for the strings "inf" and "nan".
double figure(const Json& value);

}  // namespace liecheck::reports
