// The first screen: what is wrong with each library, and three questions with their pictures.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ranges>
#include <reports/cost_advice.hpp>
#include <reports/html.hpp>
#include <reports/picture.hpp>
#include <reports/summary.hpp>
#include <set>

namespace liecheck::reports {
namespace {

using Verdict = FirstScreen::Line;

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
    return {subject, "fail", "✗",
            fmt::format("is <b>wrong in {} of {}</b>{} Worst: {}.", wrong.size(),
                        plural(all.size(), "operation"), also, worst_of(looks, subject, failing))};
  if (std::ranges::any_of(cases, [&](const HardCase& c) { return c.subject == subject && c.failed; }))
    return {subject, "fail", "✗",
            fmt::format("is <b>wrong on hard cases</b>: {}; no band is over its budget.", hard)};
  for (const Json& record : looks.merged.records)
    for (const Json& call : list_in(record, "wrong_calls"))
      if (call["subject"] == subject)
        return {subject, "fail", "✗",
                fmt::format("is <b>wrong where adapters are probed</b>, and no law looks: {}.",
                            text_of(call, "sentence"))};
  for (const Json& record : looks.merged.records)
    for (const Json& entry : list_in(record, "not_measured")) open = open || entry["subject"] == subject;
  if (!passed) return {subject, "open", "?", "is <b>incomplete</b>: nothing was judged."};
  if (open)
    return {subject, "open", "?",
            "is <b>incomplete</b>: what was measured is within budget, but not all was measured" + also};
  return {
      subject, "pass", "✓",
      fmt::format("is <b>within budget</b> in {} and every band{}", plural(all.size(), "operation"), also)};
}

/// The block that tells most: of the operations that everybody uses, the one whose errors near 0 and near pi
/// differ most between the libraries or, of one library, are largest; another one if only others fail.
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
    if (name[1].ends_with("defect")) score -= 5;
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

/// Which libraries fail near 0 and near pi, and in how many operations.
std::string near_words(const Looks& looks) {
  std::map<std::string, std::set<std::string>> zero, pi;  // the operations of a subject
  for (const Json& row : looks.merged.results) {
    if (row["status"] != "fail") continue;
    const std::size_t region = region_of(row);
    if (region < 2) zero[row["subject"]].insert(row["operation"]);
    if (region == 3 || region == 4) pi[row["subject"]].insert(row["operation"]);
  }
  const auto names = [](const char* where, const std::map<std::string, std::set<std::string>>& of) {
    if (of.empty()) return fmt::format("Right {}", where);
    Cells words;
    for (const auto& [subject, operations] : of)
      words.push_back(fmt::format("{} ({})", escaped(subject), plural(operations.size(), "operation")));
    return fmt::format("Not {}: {}", where, fmt::join(words, ", "));
  };
  return zero.empty() && pi.empty() ? "Yes, every operation"
                                    : names("near 0", zero) + ". " + names("near π", pi);
}

std::string title_of(const std::vector<Verdict>& all, const std::string& word) {
  const auto count = [&](const char* kind) { return std::ranges::count(all, kind, &Verdict::kind); };
  const auto wrong = count("fail");
  if (all.empty()) return "Nothing was measured";
  if (all.size() == 1)
    return fmt::format("{} {}", escaped(all[0].subject),
                       wrong            ? "is wrong"
                       : word == "pass" ? "is right within its budgets"
                       : word == "fail" ? "fails a measurement below"
                                        : "is not wholly measured");
  if (wrong) return fmt::format("{} of {} libraries {} wrong", wrong, all.size(), wrong == 1 ? "is" : "are");
  if (word == "pass") return fmt::format("All {} libraries are right within their budgets", all.size());
  return word == "fail"
             ? "No library is wrong, but a measurement below fails"
             : fmt::format("Not all was measured of {} of {} libraries", count("open"), all.size());
}

FirstScreen::Question near_question(const Looks& looks, const std::vector<const Json*>& rows) {
  FirstScreen::Question all{"cover", "digits", "Is it right near 0 and near π?", "", {}};
  if (rows.empty()) {
    all.answer = "These records hold no errors by angle.";
    return all;
  }
  const Json& first = *rows.front();
  all.answer = fmt::format(
      "{}. Shown: <b>{} ({})</b> in {}. The line holds for 99 % of the cases; a mark is the worst one, "
      "filled if it is "
      "over budget.",
      near_words(looks), text_of(first, "operation"), text_of(first, "block"), text_of(first, "scalar"));
  all.pictures = {{"near 0: digits lost", error_picture(looks, rows, "theta")},
                  {"near π: digits lost", error_picture(looks, rows, "pi_minus_theta")}};
  return all;
}

/// Of the operation that the first question shows, if it was timed.
FirstScreen::Question price_question(const Looks& looks, std::string operation) {
  FirstScreen::Question all{"price",
                            "cost",
                            "What does a digit cost?",
                            "These records hold no times; <code>liecheck cost</code> measures them.",
                            {{"correct digits of the worst input", ""}}};
  const Json* cost = nullptr;
  for (const Json& record : looks.merged.records)
    if (record.contains("cost")) cost = &record["cost"];
  if (!cost) return all;
  const std::vector<CostPoint> points = cost_points(*cost);
  const auto timed = [&](const std::string& name) {
    return std::ranges::any_of(points,
                               [&](const CostPoint& p) { return p.operation == name && p.latency > 0; });
  };
  if (!timed(operation)) operation = timed("exp6") || points.empty() ? "exp6" : points.front().operation;
  all.pictures.front().second = cost_picture(looks, points, operation);
  if (!all.pictures.front().second.empty())
    all.answer = fmt::format(
        "<b>{}</b>. {}", escaped(operation),
        cost_sentence(region_points(*cost, operation, every_angle()), only_library(looks.merged)));
  return all;
}

}  // namespace

FirstScreen first_screen(const Looks& looks) {
  FirstScreen all;
  const auto cases = hard_cases(looks.merged);
  Distinct<std::string> subjects, scalars;
  for (const Json& row : looks.merged.results) subjects.add(row["subject"]), scalars.add(row["scalar"]);
  for (const std::string& subject : subjects) all.lines.push_back(verdict_on(looks, subject, cases));
  all.verdict = verdict(looks.merged);
  all.title = title_of(all.lines, all.verdict);
  const std::vector<std::string> known = scalars;
  const bool has_double = std::ranges::find(known, "double") != known.end();
  const std::vector<const Json*> rows =
      telling_rows(looks, has_double || known.empty() ? "double" : known.front());
  all.questions.push_back(near_question(looks, rows));
  all.questions.push_back(
      price_question(looks, rows.empty() ? "exp6" : (*rows.front())["operation"].get<std::string>()));
  const std::string hard = hard_words(cases);
  all.questions.push_back(
      {"hard",
       "stability",
       "Are hard cases stable?",
       hard.empty()
           ? "These records hold no hard cases."
           : fmt::format("{}{}: {}.", hard.starts_with("none") ? "Yes, " : "No, ", hard, hard_counts(cases)),
       {{"failing cases by class", cases.empty() ? "" : hard_picture(looks, cases)}}});
  return all;
}

std::string verdict_lines(const Looks& looks, const FirstScreen& screen) {
  std::string out = fmt::format(
      "<h1 class=\"verdict {}\">{}</h1>\n<ul id=\"sentences\" class=\"sentences{}\" aria-label=\"A verdict "
      "for "
      "each library\">\n",
      screen.verdict, screen.title, screen.lines.size() > 5 ? " many" : "");
  for (const auto& [subject, kind, mark, words] : screen.lines)
    out += fmt::format(
        "<li class=\"{0}\"><span class=\"verdict-mark {0}\" aria-hidden=\"true\">{1}</span>{2}<b>{3}</b>{4} "
        "{5}</li>\n",
        kind, mark, swatch(looks.of.at(subject)), escaped(subject),
        subject == "textbook" ? " (the control, meant to fail)" : "", words);
  return out + "</ul>\n";
}

std::string answers_section(const FirstScreen& screen) {
  std::string out;
  for (const auto& [id, to, words, answer, pictures] : screen.questions) {
    out += fmt::format(
        "<section id=\"{0}\" aria-labelledby=\"{0}-title\"><h2 id=\"{0}-title\"><a "
        "href=\"#{1}\">{2}</a></h2>\n<p>{3}</p>\n<div class=\"panels\">",
        id, to, words, answer);
    for (const auto& [head, picture] : pictures)
      if (!picture.empty())
        out += fmt::format("<figure><figcaption>{}</figcaption>{}</figure>", head, picture);
    out += "</div></section>\n";
  }
  return out;
}

}  // namespace liecheck::reports
