#pragma once
// A stored campaign record: its schema, checked once at this door; the other files of the room trust it.
//
// Errors that a campaign could not express as a number (JSON has no NaN) are the strings "inf" and "nan".

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

using Json = nlohmann::ordered_json;

/// Campaigns side by side: what each was (`records`, without rows) and the rows of all of them, in order.
struct Merged {
  std::vector<Json> records;
  std::vector<Json> results;
};

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
