#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <reports/record.hpp>
#include <set>
#include <stdexcept>
#include <string_view>
#include <support/read_json.hpp>
#include <support/text.hpp>

namespace liecheck::reports {

namespace {

/// Refuses a member whose name the page could mistake for one of its own (packed()).
void check_names(std::string_view file, const Json& value) {
  for (const auto& [name, part] : value.items()) {
    if (value.is_object() && name.starts_with('*'))
      throw std::runtime_error(fmt::format("{}: a member may not begin with a star: {}", file, name));
    if (value.is_object() && properties::printable(name) != name)
      throw std::runtime_error(fmt::format("{}: the name of a member has an invisible character: '{}'", file,
                                           properties::printable(name)));
    if (part.is_structured()) check_names(file, part);
  }
}

/// Refuses a seed below 0: types.json says why the schema does not.
void check_seed(std::string_view file, const char* field, const Json& value) {
  if (!value.is_number_unsigned() && value.get<std::int64_t>() < 0)
    refuse(file, field, "a seed, 0 to 2^64 - 1", value);
}

/// Refuses values that contradict other fields of the record, and seeds below 0.
void check_relations(std::string_view file, const Json& record) {
  const auto at_most = [&](const std::string& field, const Json& row, const char* name, const char* limit) {
    if (row.contains(name) && row[name] > row[limit])
      refuse(file, field + "." + name, fmt::format("a count from 0 to {}", dumped(row[limit])), row[name]);
  };
  const auto each = [](const std::string& field, const Json& list, auto check) {
    for (std::size_t i = 0; i < list.size(); ++i) check(fmt::format("{}[{}]", field, i), list[i]);
  };
  /// Refuses a pass of the record beside a part that failed.
  const auto check_verdict = [&](const std::string& part, bool failed) {
    if (failed && record["verdict"] == "pass")
      refuse(file, "verdict", "fail, as " + part + " failed", record["verdict"]);
  };
  check_seed(file, "seed", record["seed"]);
  std::set<std::pair<std::string, std::string>> subjects;
  each("subjects", record["subjects"], [&](const std::string& field, const Json& s) {
    if (const std::string flags = s.value("flags", ""); !properties::is_replay("liecheck replay ID" + flags))
      refuse(file, field + ".flags", "flags of liecheck replay", flags);
    if (!subjects.emplace(s["name"], s["scalar"]).second)
      refuse(file, field, "each subject and scalar once", s["name"]);
  });
  each("results", record["results"], [&](const std::string& field, const Json& row) {
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.,:+-";
    if (has_worst(row) && row["worst"]["id"].get<std::string>().find_first_not_of(plain) != std::string::npos)
      refuse(file, field + ".worst.id", "the address of a case", row["worst"]["id"]);
    if (row["count"] == 0 && row["status"] != "empty")
      refuse(file, field + ".count", "a count from 1", row["count"]);
    for (const char* name : {"ill_posed", "unresolved", "not_finite", "wrong_branch", "refused", "failed",
                             "unmeasured", "not_repeatable", "argument_written", "output_unwritten",
                             "outside_domain", "crashed", "environment_changed", "printed"})
      at_most(field, row, name, "count");
    const bool fails = row["status"] == "fail" || row["status"] == "expected";
    for (const char* name : {"failed", "not_finite", "wrong_branch"})
      if (!fails && row.value(name, 0) > 0)
        refuse(file, field + ".status", fmt::format("fail, as {} is {}", name, dumped(row[name])),
               row["status"]);
    const char* const error = row["rule"] == "excess" ? "max_excess" : "max_eps";
    if (!fails && !(figure(row[error]) <= row["budget"]))
      refuse(file, field + ".status",
             fmt::format("fail, as {} is {} and the budget {}", error, dumped(row[error]),
                         dumped(row["budget"])),
             row["status"]);
    if (fails && row.value("failed", 1) == 0)
      refuse(file, field + ".status", "another than fail and expected, as failed is 0", row["status"]);
    check_verdict(field, row["status"] == "fail");
  });
  each("hard_cases", list_in(record, "hard_cases"), [&](const std::string& field, const Json& hard) {
    each(field + ".cells", hard["cells"], [&](const std::string& at, const Json& cell) {
      if (!properties::is_replay(cell["replay"]))
        refuse(file, at + ".replay", "a line of liecheck replay", cell["replay"]);
    });
    for (const Json& cell : hard["cells"]) {
      check_verdict(field, cell["failed"]);
      if (const std::string scalar = cell["scalar"]; !hard["input"].contains(scalar))
        throw std::runtime_error(fmt::format("{}: field {}.input.{} is missing", file, field, scalar));
    }
  });
  each("cliffs", list_in(record, "cliffs"), [&](const std::string& field, const Json& cliff) {
    check_verdict(field, cliff["expected"] == false);
  });
  for (const char* part : {"sweep", "bounds"})
    check_verdict(part, record.contains(part) && record[part].value("verdict", "") == "fail");
  if (record.contains("cost")) check_seed(file, "cost.seed", record["cost"]["seed"]);
  if (record.contains("sweep"))
    each("sweep.coefficients", record["sweep"]["coefficients"], [&](const std::string& field, const Json& c) {
      if (record["sweep"]["bound"] == "upper" && c["bound_eps"].is_null())
        refuse(file, field + ".bound_eps", "a number >= 0, \"inf\" or \"nan\"", nullptr);
      at_most(field, c, "constant", "evaluated");
    });
  if (record.contains("scenes"))
    each("scenes.films", list_in(record["scenes"], "films"), [&](const std::string& field, const Json& film) {
      each(field + ".frames", film["frames"], [&](const std::string& frame, const Json& poses) {
        if (poses.size() != film["links"].size())
          refuse(file, frame, fmt::format("{} entries", film["links"].size()), poses);
      });
    });
}

/// Refuses a measurement whose figures or verdict contradict one another, and rows that were read before.
void check_measurement(std::string_view file, const std::string& kind, const Json& record,
                       const std::function<void(const std::vector<std::string>&)>& once) {
  check_seed(file, "seed", record["seed"]);
  bool failed = false;
  for (std::size_t i = 0; i < record["rows"].size(); ++i) {
    const Json& row = record["rows"][i];
    const std::string field = fmt::format("rows[{}]", i);
    std::vector<std::string> key{kind};
    for (const char* name : {"subject", "environment", "scalar", "walk", "operation", "part", "band"})
      if (row.contains(name)) key.push_back(row[name]);
    once(key);
    failed = failed || row.value("status", "") == "fail";
    if (kind != "environments") continue;
    const Json& sum = row["sum"];
    failed = failed || (row["expected"] != "none" && sum["worse"] > 0);
    for (const auto& [part, whole] :
         {std::pair("same_calls", "calls"), {"same_verdicts", "checks"}, {"worse", "checks"}})
      if (sum[part] > sum[whole])
        refuse(file, fmt::format("{}.sum.{}", field, part),
               fmt::format("a count from 0 to {}", dumped(sum[whole])), sum[part]);
  }
  if (failed && record["verdict"] != "fail")
    refuse(file, "verdict", "fail, as a row failed", record["verdict"]);
}

/// Refuses a record of another kind than a campaign's, and says which.
void check_is_of_a_campaign(const std::string& file, const Json& record) {
  if (!record.is_object() || record.contains("results")) return;
  for (const auto& [member, what] : {std::pair("league", "the league"),
                                     {"reference_ns", "times, which `liecheck cost` wrote"},
                                     {"columns", "a run of a scene"},
                                     {"spins", "a comparison of integrators"},
                                     {"coefficients", "a sweep of floats"}})
    if (record.contains(member))
      throw std::runtime_error(
          fmt::format("{}: is a record of {}, where that of a campaign is due", file, what));
}

}  // namespace

const Json& list_in(const Json& object, const char* name) {
  static const Json none = Json::array();
  const auto list = object.find(name);
  return list == object.end() ? none : *list;
}

bool has_worst(const Json& row) {
  return row["worst"].is_object() && row["worst"]["id"] != "";
}

double figure(const Json& value) {
  using Limits = std::numeric_limits<double>;
  if (value.is_number()) return value.get<double>();
  return value == "inf" ? Limits::infinity() : Limits::quiet_NaN();
}

void check_record(std::string_view file, const Json& record) {
  check_schema(file, record);
  check_relations(file, record);
}

void escape_texts(Json& value) {
  if (value.is_string()) {
    auto& text = value.get_ref<std::string&>();
    text = properties::printable_lines(text);
  } else if (value.is_structured()) {
    for (Json& part : value) escape_texts(part);
  }
}

Merged merge_records(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) throw std::runtime_error("no record given: a report needs at least one");
  Merged merged;
  std::map<std::vector<std::string>, std::string> seen;
  for (const auto& file : files) {
    const std::string path = file.string();
    const auto refuse_twice = [&](const char* field, const char* row, std::vector<std::string> key) {
      const auto [first, fresh] = seen.emplace(std::move(key), path);
      if (!fresh)
        throw std::runtime_error(fmt::format("{}: field {}: {}{} is already in {}", path, field, row,
                                             fmt::join(first->first, " / "), first->second));
    };
    Json record = properties::read_json(path);
    check_names(path, record);
    const auto kind = std::ranges::find_if(
        measurement_kinds, [&](const char* name) { return record.is_object() && record.contains(name); });
    if (kind != std::end(measurement_kinds)) {
      check_schema(path, record, *kind);
      prune(record, *kind);
      escape_texts(record);
      check_measurement(path, *kind, record,
                        [&](const std::vector<std::string>& key) { refuse_twice("rows", "row ", key); });
      merged.measurements[*kind].push_back(std::move(record));
      continue;
    }
    check_is_of_a_campaign(path, record);
    check_record(path, record);
    prune(record);
    escape_texts(record);
    for (Json& row : record["results"]) {
      refuse_twice(
          "results", "row ",
          {row["subject"], row["scalar"], row["property"], row["operation"], row["block"], row["band"]});
      merged.results.push_back(std::move(row));
    }
    for (const Json& hard : list_in(record, "hard_cases"))
      for (const Json& cell : hard["cells"])
        refuse_twice("hard_cases", "", {hard["name"], hard["property"], cell["subject"], cell["scalar"]});
    record.erase("results");
    merged.records.push_back(std::move(record));
  }
  if (merged.records.empty())
    throw std::runtime_error(
        fmt::format("{}: no record of a campaign: a report needs at least one", files.front().string()));
  return merged;
}

}  // namespace liecheck::reports
