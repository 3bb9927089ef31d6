// Checks every limit of budgets.csv: it is at most 1.25 times its value. A value is derived, or is the
// largest error of a hunt, which a hard case of the corpus reproduces.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <budgets/budgets.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <cctype>
#include <fstream>
#include <hard_cases/attempt.hpp>
#include <hard_cases/corpus.hpp>
#include <invariants/tree_laws.hpp>
#include <map>
#include <memory>
#include <set>
#include <subjects/typed.hpp>
#include <timing/kernels.hpp>

namespace liecheck::properties {
namespace {

constexpr double margin = 1.25;      // limit / value, for errors larger than a hunt found
constexpr double reproduced = 0.97;  // error of a replay / value: libm's last bit varies

std::string name_of(const Budget& b) {
  return fmt::format("{} {}, {}, {}", b.subject, b.operation, b.block, b.region);
}

/// The anchors of docs/measuring.md: its headings in lower case, with hyphens for spaces.
std::set<std::string> anchors() {
  std::ifstream page(LIECHECK_FIXTURES "/../docs/measuring.md");
  std::set<std::string> all;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) != 0) continue;
    std::string anchor;
    for (const char c : line.substr(3))
      if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == ' ')
        anchor += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    all.insert(anchor);
  }
  return all;
}

TEST(Budgets, NoLimitIsMoreThanItsBasisAllows) {
  for (const Budget& b : budget_lines()) {
    if (b.basis == Basis::exact) {
      EXPECT_EQ(b.limit, 0) << name_of(b);
      EXPECT_EQ(b.value, 0) << name_of(b);
      continue;
    }
    EXPECT_GE(b.limit, b.value) << name_of(b);
    EXPECT_LE(b.limit, margin * b.value) << name_of(b);
    EXPECT_GT(b.value, 0) << name_of(b);
  }
}

TEST(Budgets, ARowThatCitesAnotherRowHasTheLimitOfThatRow) {
  for (const Budget& b : budget_lines()) {
    if (b.basis != Basis::row) continue;
    const std::size_t slash = b.hard_case.find('/');
    ASSERT_NE(slash, std::string::npos) << name_of(b);
    const Region region = b.region == "beyond_pi" ? Region::beyond_pi : Region::to_pi;
    const Budget& other =
        budget_of(b.subject, b.hard_case.substr(0, slash), b.hard_case.substr(slash + 1), region);
    EXPECT_EQ(b.limit, other.limit) << name_of(b);
    EXPECT_NE(other.basis, Basis::row) << name_of(b) << ": it names a row that is itself based on a row";
  }
}

TEST(Budgets, ALimitBeyondPiExceedsTheLimitUpToPiByTwo) {
  int rows = 0;
  for (const Budget& b : budget_lines()) {
    if (b.region != "beyond_pi") continue;
    EXPECT_DOUBLE_EQ(b.limit, 2 + budget_of(b.subject, b.operation, b.block, Region::to_pi).limit)
        << name_of(b);
    ++rows;
  }
  EXPECT_GT(rows, 0);
}

TEST(Budgets, ADerivationIsASumOrNamesASectionOfTheDocs) {
  const std::set<std::string> known = anchors();
  EXPECT_TRUE(known.count("beyond-pi"));
  const std::string section = "docs/measuring.md#", total = "= ",
                    letters = "abcdefghijklmnopqrstuvwxyz0123456789-";
  for (const Budget& b : budget_lines()) {
    if (const std::size_t at = b.reason.find(section); at != std::string::npos) {
      const std::string anchor = b.reason.substr(at + section.size());
      EXPECT_TRUE(known.count(anchor.substr(0, anchor.find_first_not_of(letters))))
          << name_of(b) << ": " << b.reason;
    } else if (b.basis == Basis::derived) {
      const std::size_t sum = b.reason.find(total);
      ASSERT_NE(sum, std::string::npos) << name_of(b) << ": " << b.reason;
      EXPECT_EQ(std::stod(b.reason.substr(sum + total.size())), b.value) << name_of(b);
    }
  }
}

/// The largest error (by the rule: error over kappa) of an input in the operation, block and region of a
/// budget line. Negative if nothing is measured.
double largest(const Budget& b, const Series& series, const std::vector<std::string>& input) {
  CaseId id = series.id(0, 0);
  id.raw = true;
  id.input = input;
  double worst = -1;
  for (const Judged& j : attempt(series, id).judged) {
    const Output& o = series.outputs.at(static_cast<std::size_t>(j.residual.output));
    const Region region = series.bands()[j.residual.band].region;
    if ((b.operation != "*" && o.operation != b.operation) || (b.block != "*" && o.block != b.block) ||
        (b.region != "any" && (b.region == "to_pi") != (region == Region::to_pi)) ||
        j.budget->rule != b.rule || j.residual.outcome != Outcome::measured)
      continue;
    worst = std::max(worst, b.rule == Rule::excess ? j.excess : j.residual.error);
  }
  return worst;
}

/// Makes each series once. of() returns null if this build or this processor lacks the subject.
class SeriesOfCases {
 public:
  const Series* of(const std::string& property, const std::string& scalar, const std::string& subject,
                   bool fma) {
    auto& series = made_[property + scalar + subject + (fma ? " fma" : "")];
    if (!series && !fma) {
      auto all = select({{subject}, {property}, {scalar}}, robot_);
      if (!all.empty()) series = std::move(all[0]);
    } else if (!series && !is_tree_law(property) && scalar == "double" && subject == "liecheck") {
      if (const Subject* module = fused()) series = series_of(property, *module, robot_);
    }
    return series.get();
  }

 private:
  const Subject* fused() {
#if defined(__x86_64__)
    if (modules_.empty() && has_kernels() && __builtin_cpu_supports("fma"))
      for (const TypedSubject<double>& module : load_kernels()) modules_.push_back(erased(module));
#endif
    for (const auto& m : modules_)
      if (m.name == "liecheck@gcc-O3-native") return &m;
    return nullptr;
  }

  Robot robot_ = built_in_robot();
  std::vector<Subject> modules_;
  std::map<std::string, std::unique_ptr<Series>> made_;
};

TEST(Budgets, EveryHuntedMaximumIsReproducedByItsHardCase) {
  std::map<std::string, const HardCase*> corpus;
  for (const HardCase& c : built_in_corpus()) corpus[c.name] = &c;
  SeriesOfCases all;
  int replayed = 0;
  for (const Budget& b : budget_lines()) {
    if (b.basis != Basis::hunted) continue;
    ASSERT_TRUE(corpus.count(b.hard_case)) << name_of(b) << ": no hard case " << b.hard_case;
    const HardCase& c = *corpus.at(b.hard_case);
    ASSERT_EQ(c.properties.size(), 1u) << c.name;
    ASSERT_EQ(c.scalars.size(), 1u) << c.name;
    const std::string subject = b.subject.empty() ? "liecheck" : b.subject;
    const Series* series = all.of(c.properties[0], c.scalars[0], subject, b.fma);
    if (!series && b.fma)
      continue;  // of() knows FMA only in double, without trees, and on a processor with FMA
    ASSERT_TRUE(series) << name_of(b);
    const double found =
        largest(b, *series, numbers_of(c, series->fields, oracles::scalar_named(c.scalars[0])));
    EXPECT_GE(found, reproduced * b.value) << name_of(b) << ": " << c.name;
    EXPECT_LE(found, b.limit) << name_of(b) << ": " << c.name;
    ++replayed;
  }
  EXPECT_GT(replayed, 20);
}

}  // namespace
}  // namespace liecheck::properties
