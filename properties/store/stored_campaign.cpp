#include <fmt/format.h>
#include <algorithm>
#include <set>
#include <store/stored_campaign.hpp>
#include <support/embedded.hpp>
#include <support/environment.hpp>
#include <tuple>

namespace liecheck::properties {

std::string CampaignSpec::differences(const CampaignSpec& o, bool with_range) const {
  std::vector<std::string> all;
  const auto compare = [&](const char* what, const auto& a, const auto& b) {
    if (a != b) all.push_back(fmt::format("{} {} against {}", what, a, b));
  };
  compare("seed", seed, o.seed);
  const auto count = [](std::uint64_t n) { return n ? fmt::format("{}", n) : "by time"; };
  compare("cases", count(cases), count(o.cases));
  if (with_range && all.empty() && (first != o.first || last != o.last))
    all.push_back(fmt::format("cases {}..{} against {}..{}", first, last, o.first, o.last));
  compare("robot", robot.hash, o.robot.hash);
  compare("generator version", generator, o.generator);
  compare("program version", program, o.program);
  compare("budget table", budgets, o.budgets);
  if (const std::string text = differences_of_limits(*this, o); !text.empty()) all.push_back(text);
  const auto missing = [&](const CampaignSpec& from, const CampaignSpec& in, const char* who) {
    std::vector<std::string> names;
    for (const auto& s : from.series)
      if (std::find(in.series.begin(), in.series.end(), s) == in.series.end()) names.push_back(s);
    if (!names.empty())
      all.push_back(
          fmt::format("{} has {}{}", who, names.front(),
                      names.size() > 1 ? fmt::format(" and {} more series", names.size() - 1) : ""));
  };
  missing(*this, o, "only the first");
  missing(o, *this, "only the second");
  if (all.empty() && series != o.series) all.push_back("the order of the series");
  return fmt::format("{}", fmt::join(all, "; "));
}

std::string differences_of_limits(const CampaignSpec& a, const CampaignSpec& b) {
  std::set<std::string> subjects;
  for (const CampaignSpec* spec : {&a, &b})
    for (const auto& limits : spec->limits) subjects.insert(limits->subject);
  std::vector<std::string> all;
  for (const std::string& subject : subjects) {
    std::string named[2], hash[2];
    for (const int i : {0, 1})
      for (const auto& limits : (i ? b : a).limits)
        if (limits->subject == subject)
          hash[i] = hash_of(*limits), named[i] = fmt::format("{} ({})", limits->file, hash[i]);
    if (hash[0] != hash[1])
      all.push_back(fmt::format("limits of {}: {} against {}", subject, named[0].empty() ? "none" : named[0],
                                named[1].empty() ? "none" : named[1]));
  }
  return fmt::format("{}", fmt::join(all, "; "));
}

std::string differences_of_profiles(const StoredCampaign& a, const StoredCampaign& b) {
  std::map<std::string, std::string> before;
  std::set<std::string> all;
  for (const StoredSeries& s : a.series) before[s.subject] = s.profile;
  for (const StoredSeries& s : b.series)
    if (const auto was = before.find(s.subject); was != before.end() && was->second != s.profile)
      all.insert(fmt::format("profile of {}: {} against {}", s.subject, was->second, s.profile));
  return fmt::format("{}", fmt::join(all, "; "));
}

std::string SeriesName::text() const {
  return fmt::format("{} of {} {} in {}, robot {}, profile {}", property, subject, subject_version, scalar,
                     robot, profile);
}

SeriesName name_of(const Series& s) {
  return {s.property, s.subject, s.subject_version, s.scalar, s.robot, name_of(s.profile)};
}

CampaignSpec spec_of(const CampaignOptions& o, const Robot& robot, const std::vector<SeriesResult>& series) {
  CampaignSpec s;
  s.seed = o.seed, s.cases = o.seconds ? 0 : o.cases;
  std::tie(s.first, s.last) = o.range();
  s.program = LIECHECK_VERSION;
  s.budgets = hexadecimal(sha256(budgets_csv)).substr(0, 16);
  s.robot = robot;
  s.limits = o.selection.limits;
  std::sort(s.limits.begin(), s.limits.end(),
            [](const auto& a, const auto& b) { return a->subject < b->subject; });
  s.environment = environment_text();
  s.beside = o.beside;
  for (const auto& r : series) s.series.push_back(name_of(*r.series).text());
  return s;
}

std::string StoredCampaign::not_measured() const {
  std::uint64_t open = 0, judged = 0;
  std::size_t never = 0;  // outputs that were recorded, but measured in no case
  for (const StoredSeries& s : series) {
    std::map<int, std::uint64_t> by_output;
    for (const auto& [cell, row] : s.tally.rows) {
      open += row.unresolved + row.unmeasured, judged += row.judged();
      by_output[cell.first] += row.judged();
    }
    for (const auto& [output, n] : by_output) never += n == 0;
  }
  if (judged == 0) return "nothing was measured";
  if (open > 0) return fmt::format("{} measurements have no verdict", open);
  return never == 0 ? "" : fmt::format("outputs that no case measured: {}", never);
}

bool StoredCampaign::complete() const {
  return spec.cases > 0 && std::all_of(series.begin(), series.end(), [this](const StoredSeries& s) {
           return s.tally.done.covers(spec.first, spec.last);
         });
}

}  // namespace liecheck::properties
