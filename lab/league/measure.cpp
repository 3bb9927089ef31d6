#include <league/measure.hpp>

#include <adapters/adapter.hpp>
#include <adapters/subjects.hpp>

namespace liecheck::properties::league {

using nlohmann::json;

json measure(const std::string& adapter, const MeasureOptions& options) {
  const std::string name = adapters::register_adapter(adapter);
  const adapters::Description& d = *adapters::description_of(adapter);
  const Robot robot = options.robot.empty() ? built_in_robot() : load_robot(options.robot, options.fixed);
  const CampaignResult r = run_campaign(options_of(name, options), robot);
  const auto offered = [&](const std::string& operation, const std::string& scalar) {
    const CellKey key{operation, scalar};
    return d.offered.contains(key) ? std::optional(key) : std::nullopt;
  };
  json all = json::array();
  for (json& cell : cells_of(r, offered)) {
    cell["ns"] = time_of_call(adapter, cell["operation"], cell["scalar"]);
    all.push_back(cell);
  }
  if (!options.robot.empty() && d.models.contains("urdf"))
    for (const Told& t : measure_tellings(name, robot, options)) all.push_back(t.cell);
  return {{"name", d.name}, {"version", d.version}, {"complete", !r.incomplete}, {"cells", all}};
}

}  // namespace liecheck::properties::league
