#include <hard_cases/hard_cases.hpp>
#include <record/record.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {

using nlohmann::json;

namespace {

json cell_record(const HardCell& c) {
  json cell = {{"subject", c.subject},
               {"scalar", c.scalar},
               {"verdict", name_of(c.verdict)},
               {"failed", c.failed},
               {"open", c.open},
               {"error", number(c.error)},
               {"kappa", number(c.kappa)},
               {"budget", c.budget},
               {"rule", c.excess ? "excess" : "forward"},
               {"operation", c.operation},
               {"block", c.block},
               {"band", c.band},
               {"replay", "liecheck replay " + c.id.text() + c.flags}};
  if (!c.refusal.empty()) cell["refusal"] = c.refusal;
  return cell;
}

json hard_row_record(const HardRow& row) {
  const HardCase& e = *row.entry;
  return {{"name", e.name},        {"class", e.hard_class}, {"reason", e.reason},
          {"origin", e.origin},    {"place", e.place()},    {"property", row.property},
          {"expression", e.input}, {"input", row.input},    {"cells", list_of(row.cells, cell_record)}};
}

}  // namespace

json record_of(const std::vector<HardRow>& rows) {
  return list_of(rows, hard_row_record);
}

void add_hard_cases(json& record, const std::vector<HardRow>& rows, bool interrupted) {
  record["hard_cases"] = record_of(rows);
  if (interrupted) return;
  if (any_failed(rows))
    record["verdict"] = "fail";
  else if (any_open(rows) && record["verdict"] == "pass")
    record["verdict"] = "incomplete";
}

}  // namespace liecheck::properties
