#include <app/record_file.hpp>

#include <nlohmann/json.hpp>
#include <record/campaign.hpp>
#include <record/coefficients.hpp>
#include <record/cost.hpp>
#include <record/hard_cases.hpp>
#include <record/scenes.hpp>
#include <store/stored_run.hpp>
#include <support/files.hpp>

namespace liecheck::properties {

void write_record(const std::filesystem::path& file, const nlohmann::json& record) {
  write_whole(file, record.dump(1) + "\n");
}

std::string try_write_record(const std::filesystem::path& file, const StoredRun& run,
                             const RecordParts& parts) try {
  if (file.empty()) return "";
  nlohmann::json record = record_of(run.result, run.counterexamples, run.environment);
  if (parts.hard_cases) add_hard_cases(record, *parts.hard_cases);
  if (parts.sweep) add_sweep(record, *parts.sweep);
  if (parts.cost) add_cost(record, *parts.cost);
  if (parts.scenes) add_scenes(record, *parts.scenes);
  write_record(file, record);
  return "";
} catch (const std::exception& e) {
  return e.what();
}

}  // namespace liecheck::properties
