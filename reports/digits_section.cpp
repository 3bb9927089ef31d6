#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <reports/html.hpp>
#include <reports/picture.hpp>
#include <reports/summary.hpp>
#include <sstream>
#include <tuple>

namespace liecheck::reports {
namespace {

using Place = std::array<std::string, 3>;  // operation, subject, scalar
using Boxes = std::array<std::vector<const Json*>, regions.size()>;

/// One box: the digits that the worst case keeps, the mark of an outcome without digits, or a dot; a dash, if the input
/// determines no digit; the error, if it is over a budget below one eps.
std::string box(const Looks& looks, const std::vector<const Json*>& rows, bool wide) {
  if (rows.empty()) return "<i>·</i>";
  const Json& worst = **std::ranges::max_element(rows, {}, [](const Json* r) { return severity(*r); });
  const auto any = [&](const char* status) {
    return std::ranges::any_of(rows, [&](const Json* r) { return (*r)["status"] == status; });
  };
  const std::string outcome = outcome_of(worst);
  const double kept = looks.digits.all(worst) - looks.digits.lost(worst);
  const bool mildly = outcome.empty() && looks.digits.lost(worst) < 2,
             tiny = mildly && worst["status"] == "fail" && looks.digits.lost(worst) < .05;
  const char kind = any("fail")                              ? mildly ? 'm' : 'f'
                    : any("expected")                        ? 'e'
                    : any("pass")                            ? 'p'
                    : any("unresolved") || any("unmeasured") ? 'o'
                                                             : 'i';
  const std::string words = !outcome.empty() ? mark_of(outcome)
                            : kind == 'i'    ? "–"
                            : tiny           ? wide ? fmt::format("{:.1g} ε", judged(worst)) : "ε"
                            : wide           ? fmt::format("{:.1f}", kept)
                                             : fmt::format("{}", std::floor(kept + .05));
  return fmt::format("<i class={}>{}</i>", kind, words);
}

/// The operations in the order of docs/operations.md, then all others; those that fail first.
std::vector<std::string> ordered(const Looks& looks, const std::vector<std::string>& operations) {
  Distinct<std::string> documented;
  std::istringstream lines{std::string(embedded_file("operations.md"))};
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("| ")) documented.add(line.substr(2, line.find(' ', 2) - 2));
  std::vector<std::string> order;
  for (const std::string& name : documented)
    if (std::ranges::count(operations, name)) order.push_back(name);
  for (const std::string& name : operations)
    if (!std::ranges::count(order, name)) order.push_back(name);
  std::ranges::stable_partition(order, [&](const std::string& name) { return looks.is_wrong(name); });
  return order;
}

/// The time of a call in a cell, of three digits.
std::string time_box(double ns) {
  return fmt::format("<em>{}</em>", ns <= 0     ? "–"
                                    : ns < 1000 ? fmt::format("{:.3g}", ns)
                                                : fmt::format("{:.0f}", ns));
}

/// What the boxes of a table mean, of those that it has.
std::string key_of(const std::string& table) {
  std::string out;
  const auto has = [&](const std::string& part) { return table.find(part) != table.npos; };
  for (const auto& [kind, mark, words] : {std::tuple('f', "8", "over budget"),
                                          {'m', "14", "over budget by fewer than two digits"},
                                          {'p', "15", "within"},
                                          {'o', "6", "not wholly measured"},
                                          {'e', "6", "fails as its limits file expects"},
                                          {'i', "–", "ill-posed: the input determines no digit"}})
    if (has(fmt::format("<i class={}>", kind)))
      out += fmt::format("{}<span class=\"boxes key\"><i class={}>{}</i></span> {}", out.empty() ? "" : ", ",
                         kind, mark, words);
  for (const auto& [mark, words] : {std::pair("N", "NaN or Inf"),
                                    {"B", "wrong branch"},
                                    {"R", "refused, though it is a valid input"},
                                    {"!", "another fault of the call, which its cell names"},
                                    {"ε", "an error of at most about one eps, over a budget below it"}})
    if (has(fmt::format("{}</i>", mark))) out += fmt::format("; {}: {}", mark, words);
  return out;
}

}  // namespace

std::string digits_note(const std::string& table) {
  const bool timed = table.find("<em>") != table.npos;
  return fmt::format(
      "<p class=\"note\">Digits that the worst case found keeps, in seven regions of the angle: near 0 "
      "(below 10⁻⁸) and near "
      "π (closer than 10⁻⁸), both extreme but for 0 and π themselves; small (to 10⁻²), middle, below π, "
      "beyond π, and "
      "without an angle. A double has 15.7, a float 6.9. {}. Where the problem itself amplifies rounding, "
      "only digits "
      "beyond its condition number count. Sampling finds a <b>lower bound</b> of the worst error. "
      "{}{}Operations that fail "
      "come first, otherwise in the order of the documentation. A cell opens its worst inputs.</p>\n",
      key_of(table), timed ? "ns: the time of a call; – there: not timed. " : "",
      table.find("absent>") != table.npos ? "A lone –: not offered. " : "");
}

std::string digits_table(const Looks& looks) {
  std::map<Place, Boxes> cells;
  Distinct<std::string> operations;
  Distinct<std::pair<std::string, std::string>> columns;
  Distinct<std::string> subjects;
  for (const Json& row : looks.merged.results) {
    if (row["count"] <= row.value("outside_domain", 0)) continue;
    operations.add(row["operation"]), subjects.add(row["subject"]),
        columns.add({row["subject"], row["scalar"]});
    cells[{row["operation"], row["subject"], row["scalar"]}][region_of(row)].push_back(&row);
  }
  std::map<Place, double> times;
  for (const Json& record : looks.merged.records)
    if (record.contains("cost"))
      for (const CostPoint& p : cost_points(record["cost"]))
        if (p.batch == 1) times[{p.operation, p.subject, p.scalar}] = p.latency;
  std::string heads = "<tr><th scope=\"col\" rowspan=\"2\">operation</th>", scalars = "<tr>", names;
  for (const Region& r : regions) names += fmt::format("<i>{}</i>", r.brief);
  if (!times.empty()) names += "<em>ns</em>";
  std::size_t wide_columns = 0;
  for (const std::string& subject : subjects) {
    int span = 0;
    for (const auto& [s, scalar] : columns)
      if (s == subject) {
        ++span, ++wide_columns;
        scalars += fmt::format(
            "<th scope=\"col\" data-subject=\"{}\" data-scalar=\"{}\">{}<span class=\"boxes heads\" "
            "aria-hidden=\"true\">{}</span></th>",
            escaped(s), escaped(scalar), escaped(scalar), names);
      }
    heads += fmt::format("<th scope=\"colgroup\" colspan=\"{}\" data-subject=\"{}\">{}{}</th>", span,
                         escaped(subject), swatch(looks.of.at(subject)), escaped(subject));
  }
  std::string body;
  bool was_wrong = false;
  for (const std::string& operation : ordered(looks, operations)) {
    const bool wrong = looks.is_wrong(operation);
    body += fmt::format("<tr id=\"op-{0}\"{1} data-operation=\"{0}\"><th scope=\"row\">{0}</th>",
                        escaped(operation), was_wrong && !wrong ? " class=\"rest\"" : "");
    was_wrong = wrong;
    for (const std::string& subject : subjects)
      for (const auto& [s, scalar] : columns) {
        if (s != subject) continue;
        const auto cell = cells.find({operation, subject, scalar});
        if (cell == cells.end()) {
          body += "<td class=absent>–</td>";
          continue;
        }
        std::string boxes;
        for (const auto& rows : cell->second) boxes += box(looks, rows, wide_columns <= 2);
        const auto time = times.find({operation, subject, scalar});
        if (!times.empty()) boxes += time_box(time == times.end() ? 0 : time->second);
        body += fmt::format("<td><button class=\"digits boxes\">{}</button></td>", boxes);
      }
    body += "</tr>\n";
  }
  if (body.empty()) return "<p>The records hold no results.</p>\n";
  return fmt::format(
      "<table{}><caption class=\"spoken\">Digits that the worst case found keeps, by operation, library, "
      "scalar and region of the angle</caption>"
      "<thead>{}</tr>{}</tr></thead><tbody>{}</tbody></table>",
      wide_columns <= 2 ? " class=\"wide\"" : "", heads, scalars, body);
}

}  // namespace liecheck::reports
