#include <fmt/format.h>

#include <algorithm>
#include <reports/cost_advice.hpp>
#include <reports/html.hpp>
#include <reports/picture.hpp>
#include <tuple>

namespace liecheck::reports {
namespace {

/// The pictures near 0 and near pi of the block that a finding names, of its worst one in double if it names
/// several.
std::string bands_of(const Looks& looks, const Json& finding, const std::string& title) {
  const auto rank = [&](const Json& row) {
    const bool named = title.find("(" + row["block"].get<std::string>()) != title.npos;
    return std::tuple(named, row["scalar"] == "double", severity(row));
  };
  const Json* worst = nullptr;
  for (const Json& row : looks.merged.results)
    if (row["subject"] == finding["subject"] && row["operation"] == finding["operation"] &&
        row["axis"] != "none" && row["count"] > 0 && (!worst || rank(row) > rank(*worst)))
      worst = &row;
  if (!worst) return "";
  std::vector<const Json*> rows;
  for (const Json& row : looks.merged.results)
    if (std::ranges::all_of(std::array{"subject", "operation", "block", "property", "scalar"},
                            [&](const char* name) { return row[name] == (*worst)[name]; }))
      rows.push_back(&row);
  std::string out;
  for (const auto& [head, axis] : {std::pair("near 0", "theta"), {"near π", "pi_minus_theta"}})
    if (const std::string picture = error_picture(looks, rows, axis); !picture.empty())
      out += fmt::format("<figure><figcaption>{}</figcaption>{}</figure>", head, picture);
  return "<div class=\"panels\">" + out + "</div>";
}

/// HTML: the digits and the time of the operation on the timed inputs, and what a repaired form of its formula would win or,
/// among libraries, those of the fastest one that is right in it; "" without times.
std::string price_of(const Looks& looks, const Json& finding) {
  const std::string operation = finding["operation"], subject = finding["subject"];
  const Json* cost = nullptr;
  for (const Json& record : looks.merged.records)
    if (record.contains("cost")) cost = &record["cost"];
  if (!cost) return "";
  if (!only_library(looks.merged).empty()) {
    const std::string price = cost_sentence(region_points(*cost, operation, every_angle()), subject);
    return price.empty() ? "" : "on other inputs, which are not chosen to fail: " + price;
  }
  const auto judged = [&](const std::string& name) {
    return !looks.wrong.contains({name, operation}) &&
           std::ranges::any_of(looks.merged.results, [&](const Json& row) {
             return row["subject"] == name && row["operation"] == operation;
           });
  };
  const std::vector<CostPoint> points = cost_points(*cost);
  const CostPoint *own = nullptr, *better = nullptr;
  for (const CostPoint& p : points) {
    if (p.operation != operation || p.scalar != "double" || p.latency <= 0 || p.batch > 1) continue;
    if (p.subject == subject)
      own = &p;
    else if (judged(p.subject) && (!better || p.latency < better->latency))
      better = &p;
  }
  if (!own) return "";
  const auto words = [](const CostPoint& p) {
    return fmt::format("{:.1f} digits in {}", shown_digits(p), time_text(p.latency));
  };
  return words(*own) + " on inputs that are not chosen to fail" +
         (better && better->error < .1 * own->error
              ? fmt::format("; {}, which is within budget, has {}", escaped(better->subject), words(*better))
              : std::string());
}

}  // namespace

std::string findings_section(const Looks& looks) {
  std::string out;
  std::size_t count = 0;
  const bool one = std::ranges::all_of(looks.merged.results, [&](const Json& row) {
    return row["subject"] == looks.merged.results.front()["subject"];
  });
  for (const Json& record : looks.merged.records)
    for (const Json& finding : list_in(record, "findings")) {
      ++count;
      FindingText parts = parts_of(finding["text"]);
      if (const std::string price = price_of(looks, finding); !price.empty())
        parts.lines.emplace_back("time", price);
      const auto colon = parts.title.find(": ");
      std::string lines;
      for (const auto& [name, words] : parts.lines) {
        lines +=
            fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name),
                        name == "replay"    ? fmt::format("<code class=\"replay\">{}</code>", escaped(words))
                        : name == "program" ? fmt::format("<code class=\"program\">{}</code>", escaped(words))
                        : name == "time"    ? words
                                            : escaped(words));
      }
      const std::string subject = finding["subject"];
      out += fmt::format(
          "<article class=\"finding\"><div><h3>{}<span class=\"of\">{}</span> {}<b>{}</b></h3>\n"
          "<dl>{}</dl></div>{}</article>\n",
          swatch(looks.of.at(subject)), one ? "" : escaped(subject), escaped(parts.title.substr(0, colon)),
          colon == std::string::npos ? "" : escaped(parts.title.substr(colon + 2)), lines,
          bands_of(looks, finding, parts.title));
    }
  if (out.empty()) return "";
  return fmt::format(
      "<section id=\"findings\" aria-labelledby=\"findings-title\"><h2 id=\"findings-title\">What is wrong: "
      "{} finding{}</h2>\n"
      "{}</section>\n",
      count, count == 1 ? "" : "s, the worst first", out);
}

}  // namespace liecheck::reports
