#include <store/times.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <support/progress.hpp>
#include <support/read_json.hpp>

namespace liecheck::properties {

namespace {

using nlohmann::json;
using Name = std::array<std::string, 3>;  // subject, scalar, operation

struct Time {
  double ns, ratio, low, high;
};
using Times = std::map<Name, std::map<std::string, Time>>;  // by band

Times times_in(const std::string& file) {
  Times all;
  const json record = read_json(file);
  Counted rows("times of " + file);
  members_of(file, "record of 'liecheck cost --json'", [&] {
    const json& cost =
        record.contains("cost") ? record.at("cost") : record;  // of a report, or of 'cost --json'
    for (const json& row : cost.at("rows")) {
      rows.next();
      for (const json& set : row.at("sets"))
        if (const json& t = set.at("latency"); !t.is_null())
          all[{row.at("subject"), row.at("scalar"), row.at("operation")}].emplace(
              set.at("set"), Time{t.at("ns"), t.at("ratio"), t.at("low"), t.at("high")});
    }
  });
  return all;
}

}  // namespace

TimeChanges time_changes(const std::string& before, const std::string& after) {
  const Times a = times_in(before), b = times_in(after);
  TimeChanges all;
  for (const auto& [name, bands] : b) {
    const auto old = a.find(name);
    if (old == a.end()) continue;
    ++all.compared;
    const auto size = [](const TimeChange& c) { return std::fabs(std::log(c.factor)); };
    TimeChange most{name[0], name[1], name[2], "", 0, 0, 1};
    for (const auto& [band, now] : bands)
      if (const auto was = old->second.find(band);
          was != old->second.end() && (now.low > was->second.high || now.high < was->second.low))
        if (const TimeChange c{name[0], name[1], name[2], band, was->second.ns, now.ns,
                               now.ratio / was->second.ratio};
            size(c) > size(most))
          most = c;
    if (!most.band.empty()) all.some.push_back(most);
  }
  std::ranges::stable_sort(all.some, std::greater(), &TimeChange::factor);
  return all;
}

std::string text_of(const TimeChanges& times) {
  std::string text;
  for (const TimeChange& c : times.some)
    text += fmt::format("{} {}: {} takes {:.2g} times as long, {:.3g} ns and then {:.3g} ns, {}\n", c.subject,
                        c.scalar, c.operation, c.factor, c.before_ns, c.after_ns, c.band);
  return text +
         fmt::format("{} of {} times changed by more than their spread\n", times.some.size(), times.compared);
}

std::string in_markdown(const TimeChanges& times) {
  std::string text = fmt::format("Times of {} operations compared", times.compared);
  if (times.some.empty()) return text + ": none changed by more than its spread.\n";
  text +=
      ". Beyond their spread changed:\n\n| time of a call | band | before | after | factor "
      "|\n|---|---|---|---|---|\n";
  for (const TimeChange& c : times.some)
    text += fmt::format("| `{}` {} `{}` | {} | {:.3g} ns | {:.3g} ns | {:.2g} |\n", c.subject, c.scalar,
                        c.operation, c.band, c.before_ns, c.after_ns, c.factor);
  return text;
}

}  // namespace liecheck::properties
