// What a stored campaign is, apart from the file: its identity and its name.

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <store/store.hpp>
#include <support/embedded.hpp>
#include <support/environment.hpp>

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

std::string SeriesName::text() const {
  return fmt::format("{} of {} {} in {}, robot {}", property, subject, subject_version, scalar, robot);
}

SeriesName name_of(const Series& s) {
  return {s.property, s.subject, s.subject_version, s.scalar, s.robot};
}

CampaignSpec spec_of(const CampaignOptions& o, const Robot& robot, const std::vector<SeriesResult>& series) {
  CampaignSpec s;
  s.seed = o.seed, s.cases = o.seconds ? 0 : o.cases;
  std::tie(s.first, s.last) = o.range();
  s.program = LIECHECK_VERSION;
  s.budgets = hexadecimal(sha256(budgets_csv)).substr(0, 16);
  s.robot = robot;
  s.environment = environment_text();
  for (const auto& r : series) s.series.push_back(name_of(*r.series).text());
  return s;
}

bool StoredCampaign::complete() const {
  return spec.cases > 0 && std::all_of(series.begin(), series.end(), [this](const StoredSeries& s) {
           return s.tally.done.covers(spec.first, spec.last);
         });
}

bool is_store(const std::string& name) {
  std::error_code error;  // a pipe is read once, and not here
  if (!std::filesystem::is_regular_file(name, error)) return false;
  std::ifstream file(name, std::ios::binary);
  char head[16] = {};
  file.read(head, sizeof head);
  return file && std::string(head, sizeof head) == std::string("SQLite format 3\0", 16);
}

namespace {

/// "FILE@N" to FILE and N; a file of the whole name wins, and N is 0 then.
std::pair<std::string, int> split(const std::string& name) {
  const auto at = name.rfind('@');
  if (at == std::string::npos || std::filesystem::exists(name)) return {name, 0};
  const char *p = name.data() + at + 1, *end = name.data() + name.size();
  int number = 0;
  const auto r = std::from_chars(p, end, number);
  if (r.ec != std::errc() || r.ptr != end) return {name, 0};
  if (number < 1)
    throw std::runtime_error(fmt::format("{}: the campaigns of a store are numbered from 1", name));
  return {name.substr(0, at), number};
}

}  // namespace

std::string stored_file(const std::string& name) {
  return split(name).first;
}

StoredCampaign load_campaign(const std::string& name) {
  const auto [file, number] = split(name);
  Store store(file, Store::Open::existing);
  return store.load(number ? number : store.campaigns());
}

}  // namespace liecheck::properties
