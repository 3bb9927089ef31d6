#include <store/beside_cases.hpp>

#include <nlohmann/json.hpp>
#include <support/json.hpp>

namespace liecheck::properties {

namespace {

using nlohmann::json;

constexpr const char* key = "beside_cases";

}  // namespace

std::string with_beside_cases(const std::string& environment, const BesideCases& beside) {
  json probed = json::array(), failed = json::array();
  for (const ProbedOperation& o : beside.probed)
    probed.push_back({o.subject, o.operation, o.sentence, o.wrong});
  for (const FailedHardCase& f : beside.failed)
    failed.push_back({f.subject, f.scalar, f.name, f.operation, f.block, f.verdict});
  json all = parsed(environment);
  all[key] = {{"probed", probed}, {"corpus", beside.corpus}, {"failed", failed}};
  return dumped(all);
}

bool take_beside_cases(std::string& environment, BesideCases& beside) try {
  json all = parsed(environment);
  if (!all.is_object()) return false;
  if (!all.contains(key)) return true;  // a store of an earlier program
  const json& found = all[key];
  const auto text = [](const json& row, std::size_t i) { return row.at(i).get<std::string>(); };
  for (const json& o : found.at("probed"))
    beside.probed.push_back({text(o, 0), text(o, 1), text(o, 2), o.at(3).get<bool>()});
  beside.corpus = found.at("corpus").get<std::string>();
  for (const json& f : found.at("failed"))
    beside.failed.push_back({text(f, 0), text(f, 1), text(f, 2), text(f, 3), text(f, 4), text(f, 5)});
  all.erase(key);
  environment = dumped(all);
  return true;
} catch (const json::exception&) {
  return false;
}

}  // namespace liecheck::properties
