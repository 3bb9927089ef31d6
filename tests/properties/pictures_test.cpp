// The pictures for a pull request and a README: what they say, and that no two labels overlap.

#include <gtest/gtest.h>

#include <record/badge.hpp>
#include <regex>
#include <store/picture.hpp>
#include <support/svg.hpp>

#include "../campaigns.hpp"
#include "../stored.hpp"

namespace liecheck::properties {
namespace {

CampaignResult campaign_of(const std::vector<std::string>& subjects) {
  return run_quietly({subjects, {"exp_oracle"}, {"double"}}, 300);
}

StoredCampaign stored() {
  return stored_from(campaign_of({"liecheck"}));
}

std::string changed(const StoredCampaign& a, const StoredCampaign& b) {
  return picture_of(compared(a, b), a, b);
}

struct Label {
  double x, y, width;
};

/// The texts of a picture, by where they are drawn.
std::vector<Label> labels_of(const std::string& picture) {
  static const std::regex text(
      "<text x=\"([0-9.]+)\" y=\"([0-9.]+)\" class=\"[^\"]*\" text-anchor=\"(start|middle|end)\"(?: "
      "textLength=\"([0-9]+)\"[^>]*)?>([^<]*)<");
  std::vector<Label> all;
  for (std::sregex_iterator m(picture.begin(), picture.end(), text), end; m != end; ++m) {
    const double width = (*m)[4].matched ? std::stod((*m)[4]) : svg_width((*m)[5]);
    const double before = (*m)[3] == "start" ? 0 : (*m)[3] == "end" ? width : width / 2;
    all.push_back({std::stod((*m)[1]) - before, std::stod((*m)[2]), width});
  }
  return all;
}

int overlaps(const std::vector<Label>& all) {
  int n = 0;
  for (auto a = all.begin(); a != all.end(); ++a)
    for (auto b = a + 1; b != all.end(); ++b)
      n += std::abs(a->y - b->y) < 14 && a->x < b->x + b->width && b->x < a->x + a->width;
  return n;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(Pictures, ShowEachCellBeforeAndAfterWithoutOverlaps) {
  const StoredCampaign a = stored();
  StoredCampaign b = a;
  int i = 0;
  for (auto& [cell, row] : b.series.at(0).tally.rows) {
    ++i;
    if (i == 1) row.failed += 7;
    if (i == 2) row.max_error = row.max_excess = std::numeric_limits<double>::infinity();
    if (i > 2 && i < 6) row.max_error = row.max_excess = 1e12;
  }
  const std::string picture = changed(a, b), back = changed(b, a);
  EXPECT_NE(picture.find("liecheck: 5 cells worse, 0 better, of "), picture.npos) << picture;
  EXPECT_NE(back.find("liecheck: 0 cells worse, 5 better, of "), back.npos) << back;
  EXPECT_NE(picture.find("0 → 7 fail"), picture.npos) << picture;
  EXPECT_NE(picture.find("→ inf"), picture.npos) << picture;
  EXPECT_EQ(count(picture, "<circle class=\"worse hollow\""), 5u);
  EXPECT_EQ(count(picture, "<circle"), 10u);
  EXPECT_GT(labels_of(picture).size(), 12u);
  EXPECT_EQ(overlaps(labels_of(picture)), 0) << picture;
  EXPECT_EQ(overlaps({{10, 20, 50}, {59, 25, 10}, {70, 20, 5}}), 1);
  EXPECT_NE(changed(a, a).find("liecheck: 0 cells worse, 0 better"), std::string::npos);
}

TEST(Pictures, SayHowMuchTheyLeaveOut) {
  const StoredCampaign a = stored();
  StoredCampaign b = a;
  for (auto& [cell, row] : b.series.at(0).tally.rows) row.failed += 1;
  const std::size_t cells = b.series.at(0).tally.rows.size();
  ASSERT_GT(cells, 30u);
  const std::string picture = changed(a, b);
  EXPECT_NE(picture.find("and " + std::to_string(cells - 30) + " more worse"), picture.npos);
  EXPECT_EQ(overlaps(labels_of(picture)), 0);
}

TEST(Pictures, EscapeTheirText) {
  EXPECT_NE(svg_text(0, 0, "a<b & \"c\"").find(">a&lt;b &amp; &quot;c&quot;<"), std::string::npos);
  EXPECT_EQ(svg_width("θ→"), 2 * svg_width("x"));
}

TEST(Badges, GiveTheVerdictOnEachSubject) {
  CampaignResult r = campaign_of({"liecheck", "textbook"});
  using Verdicts = std::map<std::string, std::string>;
  EXPECT_EQ(verdicts_by_subject(r, {}), (Verdicts{{"liecheck", "pass"}, {"textbook", "fail"}}));
  HardRow row;
  row.cells.emplace_back().subject = "liecheck";
  row.cells[0].open = true;
  EXPECT_EQ(verdicts_by_subject(r, {row}), (Verdicts{{"liecheck", "incomplete"}, {"textbook", "fail"}}));
  row.cells[0].failed = true;
  EXPECT_EQ(verdicts_by_subject(r, {row}), (Verdicts{{"liecheck", "fail"}, {"textbook", "fail"}}));
  r.incomplete = true;
  EXPECT_EQ(verdicts_by_subject(r, {}), (Verdicts{{"liecheck", "incomplete"}, {"textbook", "fail"}}));
  EXPECT_EQ(verdicts_by_subject({}, {}), (Verdicts{{"nothing", "incomplete"}}));
  const std::string badge = badge_of({{"liecheck", "pass"}, {"textbook", "fail"}});
  EXPECT_NE(badge.find("<title>liecheck liecheck pass textbook fail</title>"), badge.npos) << badge;
}

}  // namespace
}  // namespace liecheck::properties
