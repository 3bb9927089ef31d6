#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <reports/html.hpp>
#include <reports/picture.hpp>
#include <reports/summary.hpp>
#include <stdexcept>
#include <support/text.hpp>

namespace liecheck::reports {

namespace {

/// "2.31e+03 eps", or "NaN or Inf", or "wrong branch".
std::string judged_text(const Json& row) {
  if (row["not_finite"] > 0 || !std::isfinite(judged(row))) return "<b>NaN or Inf</b>";
  if (row["wrong_branch"] > 0) return "<b>wrong branch</b>";
  return eps_text(judged(row)) + (row["rule"] == "excess" ? " excess" : " eps");
}

std::string place(const Json& row) {
  return fmt::format("{} {}, {}", text_of(row, "operation"), text_of(row, "block"), text_of(row, "band"));
}

/// Only the total if `total_cases` equals `cases`, as after a campaign with a time limit.
std::string cases_text(const Json& record) {
  const Json total = record.value("total_cases", Json());
  if (total == record["cases"]) return fmt::format("{} cases in all", dumped(total));
  return fmt::format("{} cases for each property × subject × scalar{}", dumped(record["cases"]),
                     total.is_number() ? fmt::format(", {} in all", dumped(total)) : "");
}

/// The campaigns in figures.
std::string campaign_section(const Merged& merged) {
  const auto all = standings(merged);
  std::string out = "<dl class=\"summary\">\n";
  const auto item = [&out](std::string_view name, const std::string& value) {
    out += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, value);
  };
  for (const auto& [standing, name] : {std::pair("pass", "within budget"),
                                       {"fail", "over budget"},
                                       {"incomplete", "incomplete"},
                                       {"no verdict", "no verdict"}}) {
    Distinct<std::string> subjects;
    std::map<std::string, Cells> scalars;
    for (const Standing& s : all)
      if (word(s) == standing)
        subjects.add(s.subject),
            scalars[s.subject].push_back(escaped(s.scalar) +
                                         (s.expected ? ", but for what its limits file expects" : ""));
    Cells texts;
    for (const std::string& subject : subjects)
      texts.push_back(fmt::format("<b>{}</b> in {}", escaped(subject), fmt::join(scalars[subject], " and ")));
    if (!texts.empty()) item(name, fmt::format("{}", fmt::join(texts, "; ")));
  }
  for (const Json& r : merged.records) {
    const std::string robot =
        r["robot"].is_null() ? "" : fmt::format("; robot {}", text_of(r["robot"], "name"));
    item("campaign", fmt::format("seed {}, {}{}", dumped(r["seed"]), cases_text(r), robot));
  }
  item("rows",
       fmt::format("{}, one for each subject × scalar × property × operation × block × band; {} failed",
                   merged.results.size(),
                   std::count_if(merged.results.begin(), merged.results.end(),
                                 [](const Json& row) { return row["status"] == "fail"; })));
  if (const std::string hard = hard_words(hard_cases(merged)); !hard.empty())
    item("hard cases", hard + ", each counted once for each subject and scalar");
  std::map<std::string, Distinct<std::string>> cliffs;  // by subject
  for (const Json& r : merged.records)
    for (const Json& c : list_in(r, "cliffs"))
      if (!c["expected"].get<bool>())
        cliffs[c["subject"]].add(fmt::format("{} {} at {} in {}", text_of(c, "operation"),
                                             text_of(c, "block"), text_of(c, "band"), text_of(c, "scalar")));
  for (const auto& [subject, where] : cliffs)
    item("cliffs", fmt::format("<b>{}</b>: {}", escaped(subject), fmt::join(where, ", ")));
  return out + "</dl>\n";
}

/// What the reader must know before the verdicts.
std::string warnings(const Merged& merged) {
  std::string out;
  int control_rows = 0, control_failed = 0;
  for (const Standing& s : standings(merged))
    if (s.subject == "textbook") control_failed += s.failed, control_rows += s.passed + s.expected + s.failed;
  if (control_rows > 0 && control_failed == 0)
    out +=
        "<p class=\"verdict fail\"><strong>CONTROL PASSED</strong> The positive control textbook is "
        "expected to fail and did not: do not trust this report.</p>\n";
  if (verdict(merged) == "incomplete")
    out +=
        "<p class=\"verdict incomplete\"><strong>INCOMPLETE</strong> A run was interrupted, or not all was "
        "measured "
        "that must be: see <a href=\"#coverage\">Not measured</a>, and the sections of what was "
        "measured.</p>\n";
  if (merged.results.empty()) out += "<p class=\"verdict incomplete\">The records hold no results.</p>\n";
  return out;
}

/// "liecheck 0.4.0, seed 42, 500 cases for each property × subject × scalar" of the first record.
std::string masthead(const Merged& merged) {
  const Json& r = merged.records.front();
  return fmt::format(
      "liecheck {} accuracy report · seed {} · {}{}", text_of(r, "version"), dumped(r["seed"]), cases_text(r),
      merged.records.size() > 1 ? fmt::format(" · and {} further campaigns", merged.records.size() - 1) : "");
}

std::string standings_section(const Merged& merged) {
  std::vector<Cells> rows;
  for (const Standing& s : standings(merged)) {
    Cells row = {escaped(s.subject), escaped(s.version), escaped(s.scalar), status_text(word(s))};
    for (const int bands : {s.passed, s.failed, s.expected, s.open, s.ill_posed, s.empty})
      row.push_back(std::to_string(bands));
    for (const auto cases : {s.not_finite, s.wrong_branch}) row.push_back(std::to_string(cases));
    row.push_back(s.worst ? fmt::format("{} (budget {}): {}", judged_text(*s.worst),
                                        eps_text((*s.worst)["budget"]), place(*s.worst))
                          : "—");
    rows.push_back(row);
  }
  return table("Subjects",
               {"subject", "version", "scalar", "standing", "bands passed", "failed", "as expected",
                "without a verdict", "ill-posed", "empty", "cases NaN or Inf", "wrong branch",
                "worst against its budget"},
               rows, true);
}

/// The line that replays the worst case of a row.
std::string replay_of(const Merged& merged, const Json& row) {
  std::string flags;
  for (const Json& record : merged.records)
    for (const Json& s : record["subjects"])
      if (s["name"] == row["subject"] && s["scalar"] == row["scalar"]) flags = s.value("flags", flags);
  return properties::replay_words(row["worst"]["id"], flags);
}

std::string offenders_section(const Merged& merged) {
  std::vector<Cells> rows;
  for (const Json* row : worst_offenders(merged, 12)) {
    const Json& r = *row;
    rows.push_back(
        {text_of(r, "subject"), text_of(r, "scalar"), text_of(r, "operation"), text_of(r, "block"),
         text_of(r, "band"), judged_text(r), eps_text(r["budget"]),
         !has_worst(r) ? "—" : "<code class=\"replay\">" + escaped(replay_of(merged, r)) + "</code>"});
  }
  if (rows.empty()) return "<p>No row is over its budget.</p>\n";
  return table("Worst offenders: each subject’s worst band of an operation and block, at most 12",
               {"subject", "scalar", "operation", "block", "band", "largest found (a lower bound)", "budget",
                "replay"},
               rows, true);
}

/// The hard cases of each subject and scalar by verdict.
std::string stability_counts(const Merged& merged) {
  std::map<std::pair<std::string, std::string>, std::vector<HardCase>> columns;
  for (const HardCase& c : hard_cases(merged)) columns[{c.subject, c.scalar}].push_back(c);
  if (columns.empty()) return "";
  std::vector<Cells> rows;
  for (const auto& [column, own] : columns) {
    Cells row = {escaped(column.first + " in " + column.second), std::to_string(own.size())};
    for (std::size_t v = 0; v < hard_verdicts.size(); ++v)
      row.push_back(std::to_string(std::ranges::count(own, v, &HardCase::verdict)));
    row.push_back(std::to_string(std::ranges::count(own, true, &HardCase::failed)));
    rows.push_back(row);
  }
  Cells heads = {"subject", "cases"};
  heads.insert(heads.end(), hard_verdicts.begin(), hard_verdicts.end()), heads.push_back("failed");
  return table("Hard cases by verdict: the worst of a case’s laws counts", heads, rows, true);
}

/// "delta: 6 [m, rad], body axes", one line for each part of an operation's arguments or results.
std::string layout_text(const Json& layout) {
  Cells parts;
  for (const Json& part : layout) {
    const Json& size = part["size"];
    parts.push_back(fmt::format("{}: {} [{}], {}", text_of(part, "name"),
                                size.is_string() ? text_of(part, "size") : dumped(size),
                                text_of(part, "unit"), text_of(part, "frame")));
  }
  return fmt::format("{}", fmt::join(parts, "<br>"));
}

/// Table rows of a list ("blocks", "operations" or "properties") of all records, each row once. A missing
/// field gives an empty cell.
std::vector<Cells> listed(const Merged& merged, const char* list, std::initializer_list<const char*> fields) {
  Distinct<Cells> rows;
  for (const Json& record : merged.records)
    for (const Json& entry : record[list]) {
      Cells row;
      for (const char* field : fields) {
        const Json value = entry.value(field, Json(""));
        row.push_back(value.is_array() ? layout_text(value) : escaped(value));
      }
      rows.add(row);
    }
  return rows;
}

/// The definitions of blocks; operations with the same definition share a row.
std::vector<Cells> block_rows(const Merged& merged) {
  std::vector<Cells> rows;
  std::map<Cells, std::size_t> places;
  for (const Cells& row : listed(merged, "blocks", {"operation", "block", "error", "denominator", "unit"})) {
    const auto [same, fresh] = places.emplace(Cells(row.begin() + 1, row.end()), rows.size());
    if (fresh)
      rows.push_back(row);
    else
      rows[same->second].front() += ", " + row.front();
  }
  return rows;
}

std::string definitions_section(const Merged& merged) {
  Distinct<Cells> eps;
  for (const Standing& s : standings(merged)) {
    const Cells row = {escaped(s.scalar), fmt::format("{:.6g}", s.eps),
                       fmt::format("2<sup>{}</sup>", std::ilogb(s.eps))};
    if (s.eps > 0) eps.add(row);
  }
  return table("Error of each block of each operation",
               {"operations", "block", "error", "denominator", "unit"}, block_rows(merged)) +
         table("Unit of error of each scalar", {"scalar", "eps", "power of two"}, eps) +
         table("Operations", {"operation", "definition", "frame and order", "arguments", "results", "source"},
               listed(merged, "operations",
                      {"operation", "definition", "frame", "arguments", "results", "source"})) +
         table("Properties", {"property", "law", "equation", "source"},
               listed(merged, "properties", {"property", "law", "equation", "source"}));
}

std::string coverage_section(const Merged& merged) {
  Distinct<Cells> rows;
  for (const Standing& s : standings(merged)) {
    Cells names;
    for (const std::string& name : s.not_offered) names.push_back(escaped(name));
    if (!names.empty())
      rows.add(
          {escaped(s.subject), escaped(s.scalar), fmt::format("{}", fmt::join(names, ", ")), "not offered"});
  }
  for (const Json& record : merged.records)
    for (const Json& entry : list_in(record, "not_measured"))
      rows.add({text_of(entry, "subject"), text_of(entry, "scalar"), text_of(entry, "property"),
                text_of(entry, "what")});
  for (const Json& record : merged.records)
    for (const std::string name : record["absent"])
      rows.add({escaped(name), "all", "all", "absent from this build"});
  const auto lacks = [&](const char* part) {
    return std::ranges::none_of(merged.records, [&](const Json& r) { return r.contains(part); });
  };
  const bool of_liecheck =
      std::ranges::any_of(merged.results, [](const Json& row) { return row["subject"] == "liecheck"; });
  for (const auto& [part, what] : {std::pair("sweep", "coefficients at every float"),
                                   {"bounds", "proofs of whole operations"},
                                   {"scenes", "simulated scenes"}})
    if (of_liecheck && lacks(part))
      rows.add(
          {"liecheck", "all", what, "not in these records: the laboratory, liecheck-lab, measures them"});
  if (rows.empty()) return "<p>Every subject offers every operation and was measured; none is absent.</p>\n";
  return table("What was not measured", {"subject", "scalar", "operation or law", "why"}, rows);
}

std::string machine_section(const Merged& merged) {
  std::string out;
  for (const Json& r : merged.records) {
    const Json& e = r["environment"];
    std::vector<Cells> rows = {
        {"liecheck", text_of(r, "version") + ", generators " + dumped(r["generator_version"])},
        {"seed", dumped(r["seed"])},
        {"cases", cases_text(r)},
        {"verdict", text_of(r, "verdict")}};
    if (!r["robot"].is_null())
      rows.push_back({"robot", text_of(r["robot"], "name") + " " + code(r["robot"]["hash"])});
    for (const char* name : {"cpu", "os", "compiler"}) rows.push_back({name, text_of(e, name)});
    rows.push_back({"flags", code(e["flags"])});
    rows.push_back({"FMA contraction", text_of(e, "fma_contraction")});
    rows.push_back({"libm", text_of(e, "libm")});
    for (const char* name : {"inputs", "results"})
      rows.push_back({std::string("SHA-256 of ") + name, code(r["digest"][name])});
    out += table("Campaign with seed " + dumped(r["seed"]), {"what", "value"}, rows);
  }
  return out;
}

/// The texts of these embedded files, one after another.
std::string files(std::initializer_list<const char*> names) {
  std::string all;
  for (const char* name : names) all += embedded_file(name);
  return all;
}

/// The comment at the head of a program.
std::string first_comment(const std::string& text) {
  const auto from = text.find("/*!"), to = text.find("*/", from);
  return from == text.npos ? "" : text.substr(from + 3, to - from - 3);
}

}  // namespace

std::string page(const Merged& merged, const Json& numbers) {
  const Looks looks(merged);
  const FirstScreen screen = first_screen(looks);
  const std::string digits = digits_table(looks);
  const std::map<std::string_view, std::string> slots = {
      {"style", files({"picture.css", "page.css", "stability.css", "scenes.css"})},
      {"chart library", compressed(files({"chart.min.js"}))},
      {"chart license", escaped(first_comment(files({"chart.min.js"})))},
      {"scripts",
       files({"axes.js", "charts.js", "figure.js", "tables.js", "state.js", "overview.js", "page.js",
              "digits.js", "map.js", "stability.js", "cost.js", "scenes.js", "films.js", "start.js"})},
      {"numbers", compressed(dumped(packed(page_numbers(numbers, looks))))},
      {"verdict word", verdict(merged)},
      {"masthead", masthead(merged)},
      {"verdict", warnings(merged) + verdict_lines(looks, screen)},
      {"answers", answers_section(screen)},
      {"findings", findings_section(looks)},
      {"digits", digits},
      {"digits note", digits_note(digits)},
      {"stability", stability_counts(merged)},
      {"campaign", campaign_section(merged)},
      {"standings", standings_section(merged)},
      {"offenders", offenders_section(merged)},
      {"sweep", sweep_section(merged)},
      {"bounds", bounds_section(merged)},
      {"measurements", measurement_sections(merged)},
      {"cost", cost_section(looks)},
      {"scenes", scenes_section(merged)},
      {"definitions", definitions_section(merged)},
      {"coverage", coverage_section(merged)},
      {"machine", machine_section(merged)}};
  // One pass over page.html: the text that replaces a slot is not searched for further slots. What stands between {{?slot}}
  // and {{/slot}} is left out if the slot is empty.
  std::string out;
  std::string_view rest = embedded_file("page.html");
  for (;;) {
    const auto open = rest.find("{{");
    out += rest.substr(0, open);
    if (open == rest.npos) return out;
    auto close = rest.find("}}", open);
    std::string_view name = rest.substr(open + 2, close - open - 2);
    const bool is_if = name.starts_with('?'), is_end = name.starts_with('/');
    if (is_if || is_end) name.remove_prefix(1);
    const auto slot = slots.find(name);
    if (slot == slots.end()) throw std::logic_error("page.html: unknown slot " + std::string(name));
    if (is_if && slot->second.empty())
      close = rest.find(fmt::format("{{{{/{}}}}}", name), close) + name.size() + 3;
    if (!is_if && !is_end) out += slot->second;
    rest.remove_prefix(close + 2);
  }
}

}  // namespace liecheck::reports
