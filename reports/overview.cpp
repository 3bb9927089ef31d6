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
#include <reports/verdicts.hpp>
#include <tuple>

namespace liecheck::reports {
namespace {

/// The block that tells most on one side of the angle: of the operations that everybody uses, the one whose errors there
/// differ most between the libraries or, of one library, are largest; another one if only others fail there.
std::vector<const Json*> telling_rows(const Looks& looks, const std::string& scalar, const char* axis) {
  static const std::vector<std::string> common = {"exp6", "log6", "exp3_quaternion", "log3_quaternion",
                                                  "log3_matrix"};
  std::map<std::vector<std::string>, std::vector<const Json*>> groups;
  std::map<std::vector<std::string>, double> moderate;  // digits lost at moderate angles
  for (const Json& row : looks.merged.results) {
    if (row["scalar"] != scalar || row["count"] == 0) continue;
    const std::vector<std::string> name = {row["operation"], row["block"], row["property"]};
    if (row["axis"] == axis)
      groups[name].push_back(&row);
    else if (row["axis"] == "none")
      moderate[name] = std::max(moderate[name], region_of(row) == 2 ? looks.digits.lost(row) : 0);
  }
  std::vector<const Json*> best;
  double most = -1;
  for (const auto& [name, rows] : groups) {
    const auto any_fails = [&](bool ordinary) {
      return std::ranges::any_of(
          rows, [&](const Json* r) { return is_over_budget(*r) && is_ordinary(*r) >= ordinary; });
    };
    double score = 20;
    if (std::ranges::find(common, name[0]) != common.end()) score += 20;
    score += any_fails(true) ? 60 : any_fails(false) ? 40 : 0;
    score -= 2 * moderate[name];  // an error at every angle tells nothing of this side
    if (std::ranges::any_of(rows, [](const Json* r) { return (*r)["rule"] == "excess"; })) score -= 10;
    if (name[1].ends_with("defect") || name[1] == "jump") score -= 5;
    std::map<std::string, double> tops;  // digits lost, by subject
    for (const Json* r : rows) tops[(*r)["subject"]] = std::max(tops[(*r)["subject"]], looks.digits.lost(*r));
    const auto [low, high] = std::ranges::minmax(tops | std::views::values);
    score += high - (tops.size() > 1 ? low : 0) + static_cast<double>(tops.size()) / 10;
    if (score > most) most = score, best = rows;
  }
  return best;
}

FirstScreen::Question near_question(const Looks& looks, const std::string& scalar,
                                    const std::vector<const Json*>& zero,
                                    const std::vector<const Json*>& pi) {
  FirstScreen::Question all{"cover", "digits", "Is it right near 0 and near π?", "", {}};
  if (zero.empty() && pi.empty()) {
    all.answer = "These records hold no errors by angle.";
    return all;
  }
  all.answer = fmt::format(
      "<b>{}</b>. Shown: digits lost in {}. The line holds for 99 % of the cases; a mark is the worst one, "
      "filled if it is over budget.",
      near_words(looks), escaped(scalar));
  for (const auto& [where, axis, rows] :
       {std::tuple("near 0", "theta", &zero), {"near π", "pi_minus_theta", &pi}})
    if (!rows->empty())
      all.pictures.emplace_back(fmt::format("{}: {} ({})", where, text_of(*rows->front(), "operation"),
                                            text_of(*rows->front(), "block")),
                                error_picture(looks, *rows, axis));
  return all;
}

/// Of the first of these operations that was timed.
FirstScreen::Question price_question(const Looks& looks, std::vector<std::string> wanted) {
  FirstScreen::Question all{
      "price",
      "cost",
      "What does a digit cost?",
      "These records hold no times; <code>liecheck cost</code> measures them, of a program that is an "
      "adapter only if it times itself (<code>timed</code>).",
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
  wanted.push_back("exp6");
  const std::string own =
      only_library(looks.merged);  // what loses over two digits on the timed inputs is first
  std::ranges::stable_partition(wanted, [&](const std::string& name) {
    return std::ranges::any_of(points, [&](const CostPoint& p) {
      return p.subject == own && p.operation == name && p.latency > 0 &&
             shown_digits(p) < -std::log10(p.eps) - 2;
    });
  });
  const auto first = std::ranges::find_if(wanted, timed);
  const std::string operation = first != wanted.end() ? *first
                                : points.empty()      ? "exp6"
                                                      : points.front().operation;
  all.pictures.front().second = cost_picture(looks, points, operation);
  if (!all.pictures.front().second.empty())
    all.answer = fmt::format("<b>{}</b>. {}", escaped(operation),
                             cost_sentence(region_points(*cost, operation, every_angle()),
                                           only_library(looks.merged), JudgedIn(looks, operation)));
  return all;
}

}  // namespace

FirstScreen first_screen(const Looks& looks) {
  FirstScreen all;
  const auto cases = hard_cases(looks.merged);
  Distinct<std::string> known;
  for (const Json& row : looks.merged.results) known.add(row["scalar"]);
  all.lines = verdicts_of(looks, cases);
  all.kind = verdict(looks.merged);
  all.title = title_of(all.lines, all.kind);
  const auto any = [&](const char* kind) {
    return std::ranges::count(all.lines, kind, &FirstScreen::Line::kind) > 0;
  };
  if (any("edge") && !any("fail")) all.kind = "edge";
  const bool has_double = known.empty() || std::ranges::count(known, "double");
  const std::string scalar = has_double ? "double" : *known.begin();
  const auto zero = telling_rows(looks, scalar, "theta"), pi = telling_rows(looks, scalar, "pi_minus_theta");
  all.questions.push_back(near_question(looks, scalar, zero, pi));
  std::vector<std::string> shown;
  if (!only_library(looks.merged).empty())  // a repair of what is wrong is what its maintainer asks for
    for (const Json& record : looks.merged.records)
      if (record.contains("findings"))
        for (const Json& finding : record["findings"]) shown.push_back(finding["operation"]);
  for (const auto* rows : {&zero, &pi})
    if (!rows->empty()) shown.push_back((*rows->front())["operation"]);
  all.questions.push_back(price_question(looks, shown));
  const std::string hard = hard_words(cases);
  all.questions.push_back(
      {"hard",
       "stability",
       "Are hard cases stable?",
       hard.empty() ? "These records hold no hard cases."
                    : fmt::format("{}{}: {}.",
                                  !hard.starts_with("none") ? "No, "
                                  : std::ranges::any_of(cases, is_wrong_verdict, &HardCase::verdict)
                                      ? "As its limits say: "
                                      : "Yes, ",
                                  hard, hard_counts(cases)),
       {{"failing cases by class", cases.empty() ? "" : hard_picture(looks, cases)}}});
  return all;
}

std::string verdict_lines(const Looks& looks, const FirstScreen& screen) {
  std::string out = fmt::format(
      "<h1 class=\"verdict {}\">{}</h1>\n<ul id=\"sentences\" class=\"sentences{}\" aria-label=\"A verdict "
      "for "
      "each library\">\n",
      screen.kind, screen.title, screen.lines.size() > 5 ? " many" : "");
  for (const auto& [subject, kind, mark, words, headline] : screen.lines)
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
