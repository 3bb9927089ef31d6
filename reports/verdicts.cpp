#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <reports/drawing.hpp>
#include <reports/html.hpp>
#include <reports/summary.hpp>
#include <reports/verdicts.hpp>

namespace liecheck::reports {
namespace {

using Verdict = FirstScreen::Line;

std::string plural(std::size_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// ", at theta < 1", ", everywhere" or ", only if ..." of the place of a finding, without its counts; "" if it names none.
std::string where_words(const std::string& line) {
  const std::string where = line.substr(0, line.find(": "));
  if (where.empty() || where == "no condition found") return "";
  const bool is_whole = where.starts_with("everywhere") || where.starts_with("only if");
  return fmt::format("<span class=\"where\">, {}{}</span>", is_whole ? "" : "at ", escaped(where));
}

/// The worst of what a subject gets wrong: its first finding, or its worst row.
std::string worst_of(const Looks& looks, const std::string& subject,
                     const std::vector<const Json*>& failing) {
  std::optional<FindingText> first;
  for (const Json& record : looks.merged.records)
    for (const Json& finding : list_in(record, "findings"))
      if (finding["subject"] == subject) {
        const FindingText parts = parts_of(finding["text"]);
        if (!first || (first->is_refusal() && !parts.is_refusal())) first = parts;
      }
  if (first) return escaped(first->title) + where_words(first->line("where"));
  const Json& row = **std::ranges::max_element(failing, {}, [](const Json* r) { return severity(*r); });
  return fmt::format("{} ({}): {} in {}, {}", text_of(row, "operation"), text_of(row, "block"),
                     looks.digits.words(row), text_of(row, "scalar"), regions[region_of(row)].name);
}

/// "10⁻¹⁵⁰ rad in double and 10⁻¹⁸ rad in float", the largest angle of each scalar; "10⁻¹⁵⁰ rad" if all have the same.
std::string angles_text(const std::map<std::string, double>& largest) {
  Distinct<std::string> angles;
  std::vector<std::string> words;
  for (const auto& [scalar, angle] : largest) {
    const int exponent = static_cast<int>(std::lround(std::log10(angle)));
    angles.add(power(exponent) + " rad");
    words.push_back(fmt::format("{} rad in {}", power(exponent), escaped(scalar)));
  }
  return angles.size() == 1 ? *angles.begin() : fmt::format("{}", fmt::join(words, " and "));
}

/// "at angles below 10⁻¹⁵⁰ rad and at huge angles": where these rows, none of which is ordinary, are.
std::string extremes_of(const std::vector<const Json*>& rows) {
  std::map<std::string, double> tiny, from_pi;  // the largest angle, by scalar
  std::set<std::string> others;
  for (const Json* r : rows) {
    const Json& row = *r;
    if (row["axis"] == "none")
      others.insert(row["band"] == "huge" ? "at huge angles" : "near multiples of 2π");
    else {
      double& largest = (row["axis"] == "theta" ? tiny : from_pi)[row["scalar"]];
      largest = std::max(largest, row["high"].get<double>());
    }
  }
  std::vector<std::string> words;
  if (!tiny.empty()) words.push_back("at angles below " + angles_text(tiny));
  if (!from_pi.empty()) words.push_back("closer to π than " + angles_text(from_pi));
  words.insert(words.end(), others.begin(), others.end());
  return fmt::format("{}", fmt::join(words, ", "));
}

/// What the rows of one library say.
struct Judged {
  std::vector<const Json*> failing,
      extreme;  ///< all that fail, and those of extreme angles
  Distinct<std::string> all, wrong,
      at_all;  ///< operations: measured, wrong for ordinary inputs, wrong
  bool passed = false, open = false, ill_posed = false, expected = false;
};

/// The functions from whose results a law forms an operation, by its name. Nobody offers such an operation by itself.
std::map<std::string, std::vector<std::string>> formed_operations(const Looks& looks) {
  std::map<std::string, std::vector<std::string>> all;
  for (const Json& record : looks.merged.records)
    for (const Json& o : list_in(record, "operations"))
      if (o.contains("formed_from")) all[o["operation"]] = o["formed_from"];
  return all;
}

Judged judged_rows(const Looks& looks, const std::string& subject) {
  Judged all;
  const auto formed = formed_operations(looks);
  std::vector<std::pair<const Json*, const std::vector<std::string>*>> formed_failures;
  const auto note = [](Judged& judged, const Json& row, const std::string& function) {
    judged.all.add(function), judged.at_all.add(function);
    if (is_ordinary(row)) judged.wrong.add(function);
  };
  for (const Json& row : looks.merged.results) {
    if (row["subject"] != subject) continue;
    const std::string status = row["status"], operation = row["operation"];
    const auto from = formed.find(operation);
    if (row["count"] > 0 && from == formed.end()) all.all.add(operation);
    if (status == "fail") {
      all.failing.push_back(&row);
      if (!is_ordinary(row)) all.extreme.push_back(&row);
      if (from == formed.end())
        note(all, row, operation);
      else
        formed_failures.emplace_back(&row, &from->second);
    }
    all.passed = all.passed || status == "pass", all.ill_posed = all.ill_posed || status == "ill-posed";
    all.expected = all.expected || status == "expected";
    all.open = all.open || status == "unresolved" || status == "unmeasured";
  }
  // One wrong function explains what a law forms from several.
  for (const auto& [row, from] : formed_failures) {
    const std::vector<std::string>& known = is_ordinary(*row) ? all.wrong : all.at_all;
    if (std::ranges::none_of(*from,
                             [&](const auto& f) { return std::ranges::find(known, f) != known.end(); }))
      note(all, *row, from->front());
  }
  return all;
}

/// The verdict on a library with failures.
Verdict failing_verdict(const Looks& looks, const std::string& subject, const Judged& rows,
                        const std::vector<HardCase>& cases) {
  const std::string hard = hard_words(cases, subject),
                    of = fmt::format(" of {}", plural(rows.all.size(), "operation"));
  const std::string also = hard.empty() ? "." : "; " + hard + ".";
  const bool hard_ordinary = std::ranges::any_of(
      cases, [&](const HardCase& c) { return c.subject == subject && c.failed && c.ordinary; });
  const std::string where =
      rows.extreme.empty() ? "on hard cases of extreme angles" : extremes_of(rows.extreme);
  const std::string worst =
      rows.failing.empty() ? "" : " Costs most: " + worst_of(looks, subject, rows.failing) + ".";
  if (!rows.wrong.empty()) {
    const std::size_t more = rows.at_all.size() - rows.wrong.size();
    return {subject, "fail", "✗",
            fmt::format("is <b>wrong in {}{}</b>{}{}{}", rows.wrong.size(), of,
                        more ? fmt::format(", and at extreme angles in {} more", more) : "", also, worst),
            fmt::format("is wrong in {}{}", rows.wrong.size(), of)};
  }
  if (hard_ordinary)
    return {subject, "fail", "✗",
            fmt::format("is <b>wrong on hard cases</b>: {}; {}.{}", hard,
                        rows.failing.empty() ? "no band is over its budget"
                                             : fmt::format("and {}, in {}{}", where, rows.at_all.size(), of),
                        worst),
            "is wrong on hard cases"};
  const std::vector<std::string>& names = rows.at_all;
  const std::string list = fmt::format("{}", fmt::join(names | std::views::take(3), ", "));
  const std::string which = names.empty() ? ""
                                          : fmt::format(" ({}{}: {}{})", names.size(), of, escaped(list),
                                                        names.size() > 3 ? ", …" : "");
  return {subject, "edge", "!",
          fmt::format("is <b>accurate for ordinary inputs</b>; it is wrong {}{}{}", where, which, also),
          "is accurate for ordinary inputs; it is wrong " + where};
}

Verdict verdict_on(const Looks& looks, const std::string& subject, const std::vector<HardCase>& cases) {
  const Judged rows = judged_rows(looks, subject);
  if (!rows.failing.empty() ||
      std::ranges::any_of(cases, [&](const HardCase& c) { return c.subject == subject && c.failed; }))
    return failing_verdict(looks, subject, rows, cases);
  const std::string hard = hard_words(cases, subject), also = hard.empty() ? "." : "; " + hard + ".";
  bool open = rows.open;
  for (const Json& record : looks.merged.records) {
    for (const Json& call : list_in(record, "wrong_calls"))
      if (call["subject"] == subject)
        return {subject, "fail", "✗",
                fmt::format("is <b>wrong where adapters are probed</b>, and no law looks: {}.",
                            text_of(call, "sentence")),
                "is wrong where adapters are probed"};
    for (const Json& entry : list_in(record, "not_measured")) open = open || entry["subject"] == subject;
  }
  if (!rows.passed || open)
    return {subject, "open", "?",
            rows.passed
                ? "is <b>incomplete</b>: what was measured is within budget, but not all was measured" + also
                : "is <b>incomplete</b>: nothing was judged.",
            "is not wholly measured"};
  const std::string operations = plural(rows.all.size(), "operation");
  return {subject, "pass", "✓",
          fmt::format("is <b>within budget</b> in {}, {}{}{}",
                      rows.all.size() == 1 ? operations : "all " + operations,
                      rows.ill_posed ? "wherever the input determines the result" : "at every angle",
                      rows.expected ? ", but for what its limits file expects" : "", also),
          "is right within its budgets"};
}

}  // namespace

std::vector<Verdict> verdicts_of(const Looks& looks, const std::vector<HardCase>& cases) {
  Distinct<std::string> subjects;
  for (const Json& row : looks.merged.results) subjects.add(row["subject"]);
  std::vector<Verdict> all;
  for (const std::string& subject : subjects) all.push_back(verdict_on(looks, subject, cases));
  return all;
}

std::string near_words(const Looks& looks) {
  struct Wrong {
    std::set<std::string> all, ordinary;  // operations
  };
  std::map<std::string, Wrong> zero, pi;  // by subject
  std::set<std::string> subjects;
  for (const Json& row : looks.merged.results) {
    subjects.insert(row["subject"]);
    const std::size_t region = region_of(row);
    if (!is_over_budget(row) || region == 2 || region > 4) continue;
    Wrong& wrong = (region < 2 ? zero : pi)[row["subject"]];
    wrong.all.insert(row["operation"]);
    if (is_ordinary(row)) wrong.ordinary.insert(row["operation"]);
  }
  const auto names = [&](const char* where, const char* extreme, const std::map<std::string, Wrong>& of) {
    if (of.empty()) return fmt::format("Right {}", where);
    Cells words;
    for (const auto& [subject, wrong] : of) {
      const std::size_t more = wrong.all.size() - wrong.ordinary.size();
      std::string text = plural(wrong.ordinary.empty() ? more : wrong.ordinary.size(), "operation");
      if (wrong.ordinary.empty())
        text += fmt::format(", only {}", extreme);
      else if (more)
        text += fmt::format(", and {} only {}", more, extreme);
      words.push_back(subjects.size() == 1 ? text : fmt::format("{} ({})", escaped(subject), text));
    }
    return fmt::format("Not {}: {}", where, fmt::join(words, ", "));
  };
  Distinct<std::string> elsewhere;
  for (const auto& [subject, operation] : looks.wrong) elsewhere.add(operation);
  const std::vector<std::string>& others = elsewhere;
  return zero.empty() && pi.empty()
             ? others.empty()
                   ? "Yes, every operation"
                   : fmt::format("Yes, every operation; the failures are elsewhere: {}{}",
                                 escaped(fmt::format("{}", fmt::join(others | std::views::take(3), ", "))),
                                 others.size() > 3 ? ", …" : "")
             : names("near 0", "below 10⁻⁸", zero) + ". " + names("near π", "closer than 10⁻⁸", pi);
}

std::string title_of(const std::vector<Verdict>& all, const std::string& word) {
  const auto count = [&](const char* kind) { return std::ranges::count(all, kind, &Verdict::kind); };
  const auto wrong = count("fail"), edge = count("edge");
  if (all.empty()) return "Nothing was measured";
  if (all.size() == 1)
    return escaped(all[0].subject) + " " +
           (all[0].kind == "pass" && word != "pass"
                ? word == "fail" ? "fails a measurement below" : "is not wholly measured"
                : all[0].headline);
  if (wrong)
    return fmt::format("{} of {} libraries {} wrong{}", wrong, all.size(), wrong == 1 ? "is" : "are",
                       edge ? fmt::format(", and {} more only at extreme angles", edge) : "");
  if (edge)
    return fmt::format(
        "No library is wrong for ordinary inputs; {} of {} {} "
        "at extreme angles",
        edge, all.size(), edge == 1 ? "is" : "are");
  if (word == "pass") return fmt::format("All {} libraries are right within their budgets", all.size());
  return word == "fail"
             ? "No library is wrong, but a measurement below fails"
             : fmt::format("Not all was measured of {} of {} libraries", count("open"), all.size());
}

}  // namespace liecheck::reports
