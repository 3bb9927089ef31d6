#include <app/campaign_run.hpp>
#include <nlohmann/json.hpp>
#include <record/record.hpp>
#include <reports/summary.hpp>

namespace liecheck::properties {

template <class... Results>
void write_record_of(const std::string& file, const Results&... results) {
  if (!file.empty()) write_record(file, record_of(results...));
}

template void write_record_of(const std::string&, const CostResult&);
template void write_record_of(const std::string&, const scene::Scene&, const scene::Run&);

nlohmann::json full_record_of(const StoredRun& run) {
  nlohmann::json record = record_of(run);
  add_compared_numbers(record, run.result, reports::worst_rows(record["results"]));
  add_maps(record, run.result);
  return record;
}

void add_findings(nlohmann::json& record, const ToldFindings& findings) {
  for (std::size_t i = 0; i < findings.texts.size(); ++i)
    record["findings"].push_back({{"subject", findings.findings[i].subject},
                                  {"operation", findings.findings[i].operation},
                                  {"text", findings.texts[i]}});
  if (findings.texts.size() < findings.findings.size())
    record["further_findings"] = findings.findings.size() - findings.texts.size();
}

void write_campaign_record(const std::string& file, const StoredRun& run,
                           const std::vector<HardRow>& hard_cases, const ToldFindings& findings) {
  if (file.empty()) return;
  nlohmann::json record = full_record_of(run);
  add_findings(record, findings);
  add_hard_cases(record, hard_cases, run.result.incomplete);
  write_record(file, record);
}

}  // namespace liecheck::properties
