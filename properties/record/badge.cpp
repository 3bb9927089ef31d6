#include <record/badge.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/cliffs.hpp>
#include <campaign/coverage_report.hpp>
#include <campaign/expected.hpp>
#include <support/svg.hpp>

namespace liecheck::properties {

std::map<std::string, std::string> verdicts_by_subject(const CampaignResult& campaign,
                                                       const std::vector<HardRow>& hard_cases) {
  std::map<std::string, std::string> all;
  const auto add = [&](const std::string& subject, bool fails, bool open) {
    std::string& verdict = all.try_emplace(subject, "pass").first->second;
    if (fails)
      verdict = "fail";
    else if (open && verdict == "pass")
      verdict = "incomplete";
  };
  for (const auto& [series, tally] : campaign.series) {
    const bool failing = std::ranges::any_of(
        tally.rows, [&, &s = *series](const auto& cell) { return fails(s, cell.first, cell.second); });
    add(series->subject, failing || !tally.disagreed.empty() || unexpected(cliffs_of(*series, tally)),
        campaign.incomplete || !not_measured(*series, tally).empty());
  }
  for (const HardRow& r : hard_cases)
    for (const HardCell& c : r.cells) add(c.subject, c.failed, c.open);
  if (all.empty()) all["nothing"] = "incomplete";
  return all;
}

std::string badge_of(const std::map<std::string, std::string>& verdicts) {
  constexpr double padding = 6;
  double x = 0;
  std::string parts, title;
  const auto part = [&](const std::string& text, const char* ground) {
    const double width = svg_width(text) + 2 * padding;
    parts +=
        fmt::format("<rect x=\"{:.1f}\" width=\"{:.1f}\" height=\"20\" fill=\"{}\"/>\n", x, width, ground);
    parts += fmt::format(
        "<text x=\"{:.1f}\" y=\"14\" textLength=\"{:.1f}\" lengthAdjust=\"spacingAndGlyphs\">{}</text>\n",
        x + padding, svg_width(text), text);
    x += width;
    title += (title.empty() ? "" : " ") + text;
  };
  part("liecheck", "#3d444d");
  for (const auto& [subject, verdict] : verdicts)
    part(fmt::format("{} {}", subject, verdict), verdict == "pass"   ? "#1a7f37"
                                                 : verdict == "fail" ? "#c0271d"
                                                                     : "#7d5900");
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"20\" "
      "role=\"img\"><title>{1}</title>\n"
      "<clipPath id=\"r\"><rect width=\"{0:.0f}\" height=\"20\" rx=\"4\"/></clipPath>\n"
      "<g clip-path=\"url(#r)\" fill=\"#fff\" font-family=\"'DejaVu Sans Mono',monospace\" "
      "font-size=\"12\">\n{2}</g></svg>\n",
      x, title, parts);
}

}  // namespace liecheck::properties
