// Sections of records that other commands than a campaign write. A page without such a record lacks them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <reports/html.hpp>

namespace liecheck::reports {

namespace {

/// 99.9 % is never shown as 100 %.
std::string share(const Json& part, const Json& whole) {
  const double n = whole.get<double>();
  return n == 0 ? "—" : fmt::format("{:g} %", std::floor(1000 * part.get<double>() / n) / 10);
}

std::string status_of(const Json& row) {
  if (row["expected"] == "none") return "not judged";
  return status_text(row["sum"]["worse"] == 0 ? "pass" : "fail");
}

/// What an environment does to an operation: "=" for the same bits, or the digits that it loses.
std::string figures_cell_of(const Json& figures) {
  if (figures["worse"] > 0)
    return fmt::format("<b class=\"status fail\">{} worse</b>", dumped(figures["worse"]));
  if (figures["calls"] > 0 && figures["same_calls"] == figures["calls"]) return "=";
  return fmt::format("{:.1f}", std::ceil(10 * figure(figures["digits_lost"])) / 10);
}

/// Operations of one subject by environments.
std::string matrix(const Json& record, const std::string& subject) {
  Cells heads{"operation"};
  Distinct<std::string> names;
  std::vector<std::map<std::string, std::string>> columns;
  for (const Json& row : record["rows"]) {
    if (row["subject"] != subject) continue;
    heads.push_back(text_of(row, "environment"));
    std::map<std::string, std::string>& column = columns.emplace_back();
    for (const Json& o : row["operations"]) {
      const std::string name = fmt::format("{} {}", text_of(o, "operation"), text_of(o, "scalar"));
      names.add(name);
      column[name] = figures_cell_of(o["figures"]);
    }
  }
  std::vector<Cells> rows;
  for (const std::string& name : names) {
    Cells& row = rows.emplace_back(Cells{name});
    for (auto& column : columns) row.push_back(column.contains(name) ? column[name] : "—");
  }
  return table(fmt::format("{} by operation. “=”: the same bits in all generated cases; a number: the most "
                           "digits that a check loses; —: not measured",
                           subject),
               heads, rows, true);
}

std::string of_environments(const Json& record) {
  std::vector<Cells> rows;
  Distinct<std::string> subjects;
  for (const Json& row : record["rows"]) {
    const Json& f = row["sum"];
    subjects.add(row["subject"].get<std::string>());
    rows.push_back({text_of(row, "subject"), text_of(row, "environment"), status_of(row), dumped(f["checks"]),
                    share(f["same_calls"], f["calls"]), share(f["same_verdicts"], f["checks"]),
                    dumped(f["worse"]), eps_text(figure(f["of_limit"])),
                    fmt::format("{:.1f}", figure(f["digits_lost"])), text_of(row, "what")});
  }
  std::string out = table(fmt::format("Seed {}, {} cases of each law and scalar", dumped(record["seed"]),
                                      dumped(record["cases"])),
                          {"subject", "environment", "status", "checks", "same bits", "same verdicts",
                           "worse", "largest error / limit", "digits lost", "what"},
                          rows, true);
  for (const std::string& subject : subjects) out += matrix(record, subject);
  for (const Json& own : record["own"])
    if (own["right"] < own["checks"])
      out += fmt::format(
          "<p>{}: {} of {} checks pass in the program's own build; only these can become worse.</p>\n",
          text_of(own, "subject"), dumped(own["right"]), dumped(own["checks"]));
  for (const auto& [list, what] : {std::pair("absent", "not installed"), {"not_built", "not measured"}})
    for (const Json& row : record[list])
      out += fmt::format("<p>{}{}: {}: {}</p>\n",
                         row.contains("subject") ? text_of(row, "subject") + " in " : "",
                         text_of(row, "environment"), what, text_of(row, "why"));
  return out;
}

std::string growth(const Json& row) {
  const double low = figure(row["low"]);
  if (!std::isfinite(low)) return "—";
  return fmt::format("{:.2f} ({:.2f} … {:.2f})", figure(row["exponent"]), low, figure(row["high"]));
}

std::string of_horizons(const Json& record) {
  std::vector<Cells> rows;
  for (const Json& row : record["rows"]) {
    if (row["points"].empty()) continue;
    const Json& last = row["points"].back();
    const double angle = figure(last["attitude_eps"]), n = last["n"].get<double>();
    rows.push_back(
        {text_of(row, "subject"), text_of(row, "scalar"), text_of(row, "walk"),
         status_text(text_of(row, "status")) + (row["why"] == "" ? "" : ": " + text_of(row, "why")),
         fmt::format("{:.3g}", n), eps_text(figure(last["norm_eps"])), eps_text(angle),
         eps_text(angle / std::sqrt(n)), growth(row)});
  }
  return table(fmt::format("{} paths, seed {}", dumped(record["paths"]), dumped(record["seed"])),
               {"subject", "scalar", "walk", "status", "calls", "norm [eps]", "angle [eps]",
                "angle / √n [eps]", "exponent a of angle ∝ nᵃ, with its 95 % interval"},
               rows, true);
}

std::string digits(const Json& value) {
  return std::isfinite(figure(value)) ? fmt::format("{:.1f}", figure(value)) : "—";
}

std::string of_rounding(const Json& record) {
  Distinct<std::string> subjects;
  for (const Json& row : record["rows"]) subjects.add(row["subject"].get<std::string>());
  std::string out;
  std::vector<Cells> lines;
  for (const Json& line : list_in(record, "lines"))
    lines.push_back({text_of(line, "line"), fmt::format("{:.1f} %", 100 * line["share"].get<double>()),
                     code(line["function"])});
  if (!lines.empty())
    out +=
        table("Lines of the source by their share of the spread", {"line", "share", "function"}, lines, true);
  for (const std::string& subject : subjects) {
    std::size_t n = 0;
    std::vector<Cells> rows;
    for (const Json& row : record["rows"]) {
      if (row["subject"] != subject) continue;
      ++n;
      if (row["deceives"].get<bool>())
        rows.push_back({text_of(row, "operation"), text_of(row, "part"), text_of(row, "band"),
                        digits(row["actual_digits"]), digits(row["estimated_digits"]),
                        digits(row["digits_all_at_random"])});
    }
    out += fmt::format("<p><b>{}</b>: random rounding deceives in {} of {} parts of results and bands.</p>\n",
                       escaped(subject), rows.size(), n);
    if (!rows.empty())
      out += table(fmt::format("{}: where random rounding deceives", subject),
                   {"operation", "part", "band", "digits by the oracle", "digits estimated",
                    "with all steps at random"},
                   rows, true);
  }
  return out;
}

struct Kind {
  const char *name, *title, *note;
  std::string (*of)(const Json&);
};
constexpr Kind kinds[] = {
    {"environments", "Other environments",
     "The same inputs on a subject that is called in other rounding modes, or built with other compilers, "
     "flags and C libraries or for other processors, beside the program's own build. A check is worse if it "
     "passes in the program's own build but does not meet what is expected of the environment. Largest "
     "errors are lower bounds; their cases are in <a href=\"report.json\">report.json</a>.",
     of_environments},
    {"horizons", "Long horizons",
     "The error of the attitude after many calls: the largest defect of the norm, and the root mean square "
     "over the paths of the angle to the exact attitude. A sum of n independent rounding errors grows with "
     "√n.",
     of_horizons},
    {"rounding", "Random rounding",
     "Each inexact arithmetic operation rounds up or down by chance, and the spread of the results estimates "
     "their digits. It deceives where it promises more than one digit that the result does not have, as with "
     "a series that is cut off too early. All rows are in <a href=\"report.json\">report.json</a>.",
     of_rounding}};

}  // namespace

std::string measurement_sections(const Merged& merged) {
  std::string out;
  for (const Kind& kind : kinds) {
    const auto all = merged.measurements.find(kind.name);
    if (all == merged.measurements.end()) continue;
    out += fmt::format(
        "<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<details{3}><summary><h2 "
        "id=\"{0}-title\">{1}</h2>"
        "</summary>\n<p class=\"note\">{2}</p>\n",
        kind.name, kind.title, kind.note,
        std::ranges::any_of(all->second, [](const Json& r) { return r["verdict"] == "fail"; }) ? " open"
                                                                                               : "");
    for (const Json& record : all->second) {
      if (record["verdict"] == "incomplete") out += "<p><b>This measurement is incomplete.</b></p>\n";
      out += kind.of(record);
    }
    out += "</details>\n</section>\n";
  }
  return out;
}

}  // namespace liecheck::reports
