#pragma once
// Records as files.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

struct StoredRun;
struct HardRow;
struct SweepResult;
struct CostResult;
struct SceneSweepResult;

/// Throws std::runtime_error naming the file.
void write_record(const std::filesystem::path& file, const nlohmann::json& record);

/// What a campaign's record holds besides the campaign; null: nothing.
struct RecordParts {
  const std::vector<HardRow>* hard_cases = nullptr;
  const SweepResult* sweep = nullptr;
  const CostResult* cost = nullptr;
  const SceneSweepResult* scenes = nullptr;
};

/// Writes the record of a campaign where a file is named. Returns why it could not, for the caller to throw once its
/// table is printed: neither the table nor the record is lost with the other.
std::string try_write_record(const std::filesystem::path& file, const StoredRun& run,
                             const RecordParts& parts);

}  // namespace liecheck::properties
