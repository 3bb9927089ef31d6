#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <reports/cost_advice.hpp>
#include <reports/html.hpp>
#include <reports/picture.hpp>
#include <set>
#include <tuple>

namespace liecheck::reports {
namespace {

/// The name of an operation, as a link to its row of the table of digits.
std::string linked(const std::string& operation) {
  return fmt::format("<a href=\"#op-{0}\">{0}</a>", escaped(operation));
}

/// The names in a list, "log6, exp6".
std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> all;
  for (std::size_t from = 0; from < list.size();) {
    const auto to = std::min(list.find(", ", from), list.size());
    all.push_back(list.substr(from, to - from));
    from = to + 2;
  }
  return all;
}

/// A finding of a record and what its text names.
struct Told {
  const Json* finding;
  FindingText text;
  std::vector<std::string> blocks, others;  ///< blocks of its operation; operations that fail in the same way

  explicit Told(const Json& f) : finding(&f), text(parts_of(f["text"])) {
    const auto open = text.title.find(" ("), close = text.title.find(')');
    if (open != std::string::npos && close != std::string::npos && open < close)
      blocks = names_in(text.title.substr(open + 2, close - open - 2));
    for (const auto& [name, words] : text.lines)
      if (name == "so") others = names_in(words.substr(0, words.find(" fail")));
  }
  std::string subject() const { return (*finding)["subject"]; }
  std::string operation() const { return (*finding)["operation"]; }
};

/// The largest loss of digits of rows, of ordinary inputs or of all.
const Json* worst_of(const Looks& looks, const std::vector<const Json*>& rows, bool ordinary) {
  const Json* worst = nullptr;
  const auto loss = [&](const Json& row) {
    return std::pair(!outcome_of(row).empty(), looks.digits.lost(row));
  };
  for (const Json* r : rows)
    if ((!ordinary || is_ordinary(*r)) && (!worst || loss(*r) > loss(*worst))) worst = r;
  return worst;
}

/// The pictures near 0 and near pi of the block of a finding that fails most for ordinary inputs, in double if that fails.
std::string bands_of(const Looks& looks, const Told& told) {
  const auto rank = [&](const Json& row) {
    const auto place = std::ranges::find(told.blocks, row["block"].get<std::string>()) - told.blocks.begin();
    return std::tuple(place < std::ssize(told.blocks), row["status"] == "fail", row["scalar"] == "double",
                      is_ordinary(row), looks.digits.lost(row), -place);
  };
  const Json* first = nullptr;
  for (const Json& row : looks.merged.results)
    if (row["subject"] == told.subject() && row["operation"] == told.operation() && row["axis"] != "none" &&
        row["count"] > 0 && (!first || rank(row) > rank(*first)))
      first = &row;
  if (!first || (*first)["status"] != "fail" || (*first)["block"] == "sign" || told.text.is_refusal())
    return "";
  std::vector<const Json*> rows;
  for (const Json& row : looks.merged.results)
    if (std::ranges::all_of(std::array{"subject", "operation", "block", "property", "scalar"},
                            [&](const char* name) { return row[name] == (*first)[name]; }))
      rows.push_back(&row);
  std::string out;
  for (const auto& [head, axis] : {std::pair("near 0", "theta"), {"near π", "pi_minus_theta"}})
    if (const std::string picture = error_picture(looks, rows, axis); !picture.empty())
      out += fmt::format("<figure><figcaption>{}: {} in {}</figcaption>{}</figure>", head,
                         text_of(*first, "block"), text_of(*first, "scalar"), picture);
  const Json *worst = worst_of(looks, rows, false), *ordinary = worst_of(looks, rows, true);
  const bool differ = ordinary && (*ordinary)["status"] == "fail" &&
                      looks.digits.words(*worst) != looks.digits.words(*ordinary);
  return "<div><div class=\"panels\">" + out + "</div>" +
         (differ ? fmt::format("<p class=\"note\">Marks below 10⁻⁸ and closer to π than 10⁻⁸ are extreme "
                               "angles, which the heading does not count: {} there.</p>",
                               looks.digits.words(*worst))
                 : std::string()) +
         "</div>";
}

/// The operations that fail and that no finding names, of each library.
std::string further_operations(const Looks& looks, const std::vector<Told>& told) {
  std::map<std::pair<std::string, std::string>, bool> failing;  // whether for ordinary inputs
  for (const Json& row : looks.merged.results)
    if (row["status"] == "fail") failing[{row["subject"], row["operation"]}] |= is_ordinary(row);
  std::map<std::string, std::array<Cells, 2>> further;  // by library, the second at extreme angles alone
  for (const auto& [key, ordinary] : failing) {
    const auto& [subject, operation] = key;
    if (std::ranges::none_of(told, [&, &s = subject, &o = operation](const Told& t) {
          return t.subject() == s && (t.operation() == o || std::ranges::count(t.others, o));
        }))
      further[subject][!ordinary].push_back(linked(operation));
  }
  std::string out;
  for (const auto& [subject, operations] : further) {
    Cells parts;
    for (const bool extreme : {false, true})
      if (const Cells& own = operations[extreme]; !own.empty())
        parts.push_back(fmt::format("{}{} further operation{}: {}",
                                    extreme ? "at extreme angles alone in " : "in ", own.size(),
                                    own.size() == 1 ? "" : "s", fmt::join(own, ", ")));
    out += fmt::format("<p>{}<b>{}</b> fails {}.</p>\n", swatch(looks.of.at(subject)), escaped(subject),
                       fmt::join(parts, "; "));
  }
  return out;
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
    const std::string price =
        cost_sentence(region_points(*cost, operation, every_angle()), subject, JudgedIn(looks, operation));
    return price.empty() ? "" : timed_inputs(*cost) + ": " + price;
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
  return words(*own) + " " + timed_inputs(*cost) +
         (better && better->error < .1 * own->error
              ? fmt::format("; {}, which is within budget, has {}", escaped(better->subject), words(*better))
              : std::string());
}

/// The lines of an example: those of an error message one after another, and of which numbers the digits are.
std::string example_words(std::string words) {
  for (auto at = words.find("\\n"); at != words.npos; at = words.find("\\n")) words.replace(at, 2, " ");
  static const std::string counted = " is right: ", lost = " digits lost";
  if (words.find(counted) == words.npos || !words.ends_with(lost)) return words;
  return words + ", of the whole result by its norm; the heading is of other inputs";
}

/// The article of a finding.
std::string article(const Looks& looks, const Told& told, bool one_library) {
  std::vector<std::pair<std::string, std::string>> lines;  // HTML
  for (const auto& [name, words] : told.text.lines)
    if (name == "replay" || name == "program")
      lines.emplace_back(name, fmt::format("<code class=\"{}\">{}</code>", name, escaped(words)));
    else if (name == "hard")
      lines.emplace_back(name, "<a href=\"#stability\">" + escaped(words) + "</a>");
    else
      lines.emplace_back(escaped(name), escaped(name == "example" ? example_words(words) : words));
  if (const std::string price = price_of(looks, *told.finding); !price.empty())
    lines.emplace_back("time", price);
  std::string list;
  for (const auto& [name, words] : lines) list += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, words);
  const std::string& title = told.text.title;
  const auto colon = title.find(": "), operation = told.operation().size();
  const std::string what = title.substr(0, colon);
  return fmt::format(
      "<article class=\"finding\"><div><h3>{}<span class=\"of\">{}</span> {}{}<b>{}</b></h3>\n"
      "<dl>{}</dl></div>{}</article>\n",
      swatch(looks.of.at(told.subject())), one_library ? "" : escaped(told.subject()),
      what.starts_with(told.operation()) ? linked(told.operation()) : "",
      escaped(what.starts_with(told.operation()) ? what.substr(operation) : what),
      colon == std::string::npos ? "" : escaped(title.substr(colon + 2)), list, bands_of(looks, told));
}

}  // namespace

std::string findings_section(const Looks& looks) {
  const bool one = !only_library(looks.merged).empty();
  std::vector<Told> all;
  for (const Json& record : looks.merged.records)
    for (const Json& finding : list_in(record, "findings")) all.emplace_back(finding);
  std::size_t in_all = all.size();
  for (const Json& record : looks.merged.records) in_all += record.value("further_findings", std::size_t(0));
  std::ranges::stable_partition(all, [](const Told& t) { return !t.text.is_refusal(); });
  std::string out;
  for (const Told& told : all) out += article(looks, told, one);
  const std::string further = further_operations(looks, all);
  if (out.empty() && further.empty()) return "";
  return fmt::format(
      "<section id=\"findings\" aria-labelledby=\"findings-title\"><h2 id=\"findings-title\">What is "
      "wrong{}</h2>\n{}{}{}</section>\n",
      all.empty()
          ? std::string()
          : fmt::format(": {}{} finding{}{}", in_all > all.size() ? fmt::format("{} of ", all.size()) : "",
                        in_all, in_all == 1 ? "" : "s, first what costs most",
                        in_all > all.size() ? "; the terminal prints the others with --all" : ""),
      all.empty()
          ? ""
          : "<p class=\"note\">The cases that a finding counts are those of its bands of angles or, with "
            "“elsewhere”, inputs that are probed for it.</p>\n",
      out, further);
}

}  // namespace liecheck::reports
