#pragma once
// Writes records to files.

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

/// What a campaign's record contains in addition to the campaign; null if nothing.
struct RecordParts {
  const std::vector<HardRow>* hard_cases = nullptr;
  const SweepResult* sweep = nullptr;
  const CostResult* cost = nullptr;
  const SceneSweepResult* scenes = nullptr;
};

/// Writes the record of a campaign, unless `file` is empty. Returns why that failed, or "". The caller prints
/// its table before it throws this error, so that the table is not lost.
std::string try_write_record(const std::filesystem::path& file, const StoredRun& run,
                             const RecordParts& parts);

}  // namespace liecheck::properties
