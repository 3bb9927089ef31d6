// The first screen: what is wrong with each library, and three questions with their pictures.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <reports/html.hpp>
#include <reports/picture.hpp>
#include <reports/summary.hpp>

namespace liecheck::reports {
namespace {

struct Verdict {
  const char *kind, *mark;
  std::string words;  // HTML
};

std::string plural(std::size_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// The worst of what a subject gets wrong: its first finding, or its worst row.
std::string worst_of(const Looks& looks, const std::string& subject,
                     const std::vector<const Json*>& failing) {
  for (const Json& record : looks.merged.records)
    for (const Json& finding : list_in(record, "findings"))
      if (finding["subject"] == subject) {
        const FindingText parts = parts_of(finding["text"]);
        std::string where;
        for (const auto& [name, words] : parts.lines)
          if (name == "where") where = words;
        return fmt::format("{}<span class=\"where\">, where {}</span>", escaped(parts.title), escaped(where));
      }
  const Json& row = **std::ranges::max_element(failing, {}, [](const Json* r) { return severity(*r); });
  return fmt::format("{} ({}): {} in {}, {}", text_of(row, "operation"), text_of(row, "block"),
                     looks.digits.words(row), text_of(row, "scalar"), regions[region_of(row)].name);
}

Verdict verdict_on(const Looks& looks, const std::string& subject, const std::vector<HardCase>& cases) {
  std::vector<const Json*> failing;
  Distinct<std::string> wrong, all;
  bool passed = false, open = false;
  for (const Json& row : looks.merged.results) {
    if (row["subject"] != subject) continue;
    if (row["count"] > 0) all.add(row["operation"]);
    if (row["status"] == "fail") failing.push_back(&row), wrong.add(row["operation"]);
    passed = passed || row["status"] == "pass";
    open = open || row["status"] == "unresolved" || row["status"] == "unmeasured";
  }
  const std::string hard = hard_words(cases, subject);
  const std::string also = hard.empty() ? "." : "; " + hard + ".";
  if (!failing.empty())
    return {"fail", "✗",
            fmt::format("is <b>wrong in {} of {}</b>{} Worst: {}.", wrong.size(),
                        plural(all.size(), "operation"), also, worst_of(looks, subject, failing))};
  if (std::ranges::any_of(cases, [&](const HardCase& c) { return c.subject == subject && c.failed; }))
    return {"fail", "✗", fmt::format("is <b>wrong on hard cases</b>: {}; no band is over its budget.", hard)};
  for (const Json& record : looks.merged.records)
    for (const Json& call : list_in(record, "wrong_calls"))
      if (call["subject"] == subject)
        return {"fail", "✗",
                fmt::format("is <b>wrong where adapters are probed</b>, and no law looks: {}.",
                            text_of(call, "sentence"))};
  for (const Json& record : looks.merged.records)
    for (const Json& entry : list_in(record, "not_measured")) open = open || entry["subject"] == subject;
  if (!passed) return {"open", "?", "is <b>incomplete</b>: nothing was judged."};
  if (open)
    return {"open", "?",
            "is <b>incomplete</b>: what was measured is within budget, but not all was measured" + also};
  return {
      "pass", "✓",
      fmt::format("is <b>within budget</b> in {} and every band{}", plural(all.size(), "operation"), also)};
}

/// The block that tells most: of the operations that everybody uses, the one whose errors near 0 and near pi differ most between
/// the libraries or, of one library, are largest; another one if only others fail.
std::vector<const Json*> telling_rows(const Looks& looks, const std::string& scalar) {
  static const std::vector<std::string> common = {"exp6", "log6", "exp3_quaternion", "log3_quaternion",
                                                  "log3_matrix"};
  std::map<std::vector<std::string>, std::vector<const Json*>> groups;
  for (const Json& row : looks.merged.results)
    if (row["scalar"] == scalar && row["axis"] != "none" && row["count"] > 0)
      groups[{row["operation"], row["block"], row["property"]}].push_back(&row);
  std::vector<const Json*> best;
  double most = -1;
  for (const auto& [name, rows] : groups) {
    double score = std::ranges::find(common, name[0]) != common.end() ? 20 : 0;
    if (std::ranges::any_of(rows, [](const Json* r) { return (*r)["status"] == "fail"; })) score += 40;
    if (std::ranges::any_of(rows, [](const Json* r) { return (*r)["rule"] == "excess"; })) score -= 10;
    for (const char* axis : {"theta", "pi_minus_theta"}) {
      std::map<std::string, double> tops;  // digits lost, by subject
      for (const Json* r : rows)
        if ((*r)["axis"] == axis)
          tops[(*r)["subject"]] = std::max(tops[(*r)["subject"]], looks.digits.lost(*r));
      if (tops.empty()) continue;
      const auto [low, high] = std::ranges::minmax(tops | std::views::values);
      score += 10 + high - (tops.size() > 1 ? low : 0) + static_cast<double>(tops.size()) / 10;
    }
    if (score > most) most = score, best = rows;
  }
  return best;
}

/// What a user of one operation in double can do: "for 15.5 digits take liecheck (130 ns); textbook keeps 5.4 in 129 ns".
std::string price_words(const std::vector<CostPoint>& points, const std::string& operation) {
  std::vector<const CostPoint*> own;
  for (const CostPoint& p : points)
    if (p.operation == operation && p.latency > 0 && p.scalar == "double") own.push_back(&p);
  if (own.empty()) return "timed in other scalars than double.";
  const auto digits = [](const CostPoint* p) { return std::min(16.0, digits_of(*p)); };
  std::ranges::stable_sort(own, {}, [](const CostPoint* p) { return p->latency; });
  const double most = digits(*std::ranges::max_element(own, {}, digits));
  const CostPoint* best =
      *std::ranges::find_if(own, [&](const CostPoint* p) { return digits(p) > most - .5; });
  if (own.size() == 1) return fmt::format("{:.1f} digits in {}.", most, time_text(best->latency));
  Cells others;
  for (const CostPoint* p : own)
    if (p != best && others.size() < 3)
      others.push_back(
          fmt::format("{} keeps {:.1f} in {}", escaped(p->subject), digits(p), time_text(p->latency)));
  return fmt::format("for {:.1f} digits take {} ({}); {}.", digits(best), escaped(best->subject),
                     time_text(best->latency), fmt::join(others, ", "));
}

std::string panel(const std::string& head, const std::string& picture) {
  return picture.empty() ? "" : fmt::format("<figure><figcaption>{}</figcaption>{}</figure>", head, picture);
}

}  // namespace

std::string verdict_lines(const Looks& looks) {
  const auto cases = hard_cases(looks.merged);
  Distinct<std::string> subjects;
  for (const Json& row : looks.merged.results) subjects.add(row["subject"]);
  std::vector<std::pair<std::string, Verdict>> all;
  for (const std::string& subject : subjects) all.emplace_back(subject, verdict_on(looks, subject, cases));
  const auto count = [&](const char* kind) {
    return static_cast<std::size_t>(
        std::ranges::count_if(all, [&](const auto& v) { return std::string_view(v.second.kind) == kind; }));
  };
  const std::size_t wrong = count("fail"), open = count("open");
  const std::string word = verdict(looks.merged);
  std::string title;
  if (all.empty())
    title = "Nothing was measured";
  else if (all.size() == 1)
    title = fmt::format("{} {}", escaped(all[0].first),
                        wrong            ? "is wrong"
                        : word == "pass" ? "is right within its budgets"
                        : word == "fail" ? "fails a measurement below"
                                         : "is not wholly measured");
  else
    title = wrong            ? fmt::format("{} of {} libraries are wrong", wrong, all.size())
            : word == "pass" ? fmt::format("All {} libraries are right within their budgets", all.size())
            : word == "fail" ? "No library is wrong, but a measurement below fails"
                             : fmt::format("{} of {} libraries are not wholly measured", open, all.size());
  std::string out = fmt::format(
      "<h1 class=\"verdict {}\">{}</h1>\n<ul id=\"sentences\" class=\"sentences\" aria-label=\"A verdict for "
      "each library\">\n",
      word, title);
  for (const auto& [subject, v] : all)
    out += fmt::format(
        "<li class=\"{0}\"><span class=\"verdict-mark {0}\" aria-hidden=\"true\">{1}</span>{2}<b>{3}</b>{4} "
        "{5}</li>\n",
        v.kind, v.mark, swatch(looks.of.at(subject)), escaped(subject),
        subject == "textbook" ? " (the control, meant to fail)" : "", v.words);
  return out + "</ul>\n";
}

std::string answers_section(const Looks& looks) {
  Distinct<std::string> scalars;
  for (const Json& row : looks.merged.results) scalars.add(row["scalar"]);
  const std::vector<std::string> known = scalars;
  const std::string scalar =
      std::ranges::find(known, "double") != known.end() || known.empty() ? "double" : known.front();
  const std::vector<const Json*> rows = telling_rows(looks, scalar);
  std::string out;
  const auto question = [&](const char* id, const char* to, const char* words, const std::string& answer,
                            const std::string& pictures) {
    out += fmt::format(
        "<section id=\"{0}\" aria-labelledby=\"{0}-title\"><h2 id=\"{0}-title\"><a "
        "href=\"#{1}\">{2}</a></h2>\n<p>{3}</p>\n"
        "<div class=\"panels\">{4}</div></section>\n",
        id, to, words, answer, pictures);
  };
  if (rows.empty()) {
    question("cover", "digits", "Is it right near 0 and near π?", "These records hold no errors by angle.",
             "");
  } else {
    const Json& first = *rows.front();
    question("cover", "digits", "Is it right near 0 and near π?",
             fmt::format("Digits lost by <b>{} ({})</b> in {}: the line holds for 99 % of the cases, a mark "
                         "is the worst one, filled if it is over budget.",
                         text_of(first, "operation"), text_of(first, "block"), scalar),
             panel("near 0", error_picture(looks, rows, "theta")) +
                 panel("near π", error_picture(looks, rows, "pi_minus_theta")));
  }
  std::vector<CostPoint> points;
  for (const Json& record : looks.merged.records)
    if (record.contains("cost")) points = cost_points(record["cost"]);
  std::string operation = rows.empty() ? "exp6" : (*rows.front())["operation"].get<std::string>();
  const auto timed = [&](const std::string& name) {
    return std::ranges::any_of(points,
                               [&](const CostPoint& p) { return p.operation == name && p.latency > 0; });
  };
  if (!timed(operation)) operation = timed("exp6") || points.empty() ? "exp6" : points.front().operation;
  const std::string cost = cost_picture(looks, points, operation);
  question("price", "cost", "What does a digit cost?",
           cost.empty()
               ? "These records hold no times; <code>liecheck cost</code> measures them."
               : fmt::format("<b>{}</b> in double: {}", escaped(operation), price_words(points, operation)),
           panel("correct digits of the worst input", cost));
  const auto cases = hard_cases(looks.merged);
  const std::string hard = hard_words(cases);
  question("hard", "stability", "Are hard cases stable?",
           hard.empty() ? "These records hold no hard cases."
                        : fmt::format("{}{}: known difficult inputs, each in each scalar.",
                                      hard.starts_with("none") ? "Yes, " : "No, ", hard),
           cases.empty() ? "" : panel("failing cases by class", hard_picture(looks, cases)));
  return out;
}

}  // namespace liecheck::reports
