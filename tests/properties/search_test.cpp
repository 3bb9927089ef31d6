// Worst-case search, coverage, shrinking, and the printed program of a failure.

#include <gtest/gtest.h>

#include <campaign/coverage_report.hpp>
#include <cstdio>
#include <cstdlib>
#include <failures/program.hpp>
#include <filesystem>
#include <fstream>
#include <generators/trees.hpp>
#include <invariants/property.hpp>
#include <search/hunt.hpp>
#include <search/shrink.hpp>
#include <set>

#include "../campaigns.hpp"
#include "../scratch.hpp"

namespace liecheck::properties {
namespace {

std::unique_ptr<Series> series(const std::string& subject, const std::string& property,
                               const std::string& scalar = "double") {
  auto all = select({{subject}, {property}, {scalar}}, built_in_robot());
  return std::move(all.at(0));
}

Worst hunt(const std::string& subject, const std::string& operation, const std::string& block,
           std::uint64_t evaluations, bool random = false, const std::string& property = "exp_oracle") {
  HuntOptions options;
  options.operation = operation, options.block = block;
  options.evaluations = evaluations;
  options.random = random;
  return hunt(*series(subject, property), options).worst.at(0);
}

TEST(Hunt, FindsErrorsTenTimesLargerThanUniformSampling) {
  for (const char* subject : {"textbook:1e-8", "textbook:1e-6", "textbook:1e-4"}) {
    const Worst hunted = hunt(subject, "exp6", "translation", 3000);
    EXPECT_GE(hunted.score, 10 * hunt(subject, "exp6", "translation", 3000, true).score) << subject;
    EXPECT_EQ(hunted.broken, 0u);
  }
}

TEST(Hunt, ComesWithinAFactorOfTwoOfTheKnownPeak) {
  // For theta in [1e-8, 1.06e-8], (1 - cos(theta))/theta^2 is computed as 0 or 1: an error of theta/2 in p.
  EXPECT_GE(hunt("textbook:1e-8", "exp6", "translation", 3000).score, 0.5 * 1e-8 / 2 / 0x1p-52);
}

TEST(Hunt, OfAnAccurateOperationStaysWithinItsBudget) {
  const Worst w = hunt("liecheck", "exp6", "translation", 2000);
  EXPECT_GT(w.score, 0.5);
  EXPECT_FALSE(w.judged.failed);
}

TEST(Hunt, IsTheSameForTheSameSeedAndNumberOfEvaluations) {
  const Worst a = hunt("textbook", "exp6", "translation", 800),
              b = hunt("textbook", "exp6", "translation", 800);
  EXPECT_EQ(a.id.text(), b.id.text());
  EXPECT_EQ(a.at, b.at);
}

TEST(Hunt, ReplaysFromItsInput) {
  const Worst w = hunt("textbook", "log3_quaternion", "rotation vector", 500, false, "log_oracle");
  const auto again = series("textbook", "log_oracle")->replay(CaseId::parse(w.id.text()));
  EXPECT_EQ(again.at(0).residual.error, w.judged.residual.error);
}

TEST(Hunt, MaximisesTheErrorOverKappaIfRequested) {
  HuntOptions options;
  options.operation = "exp6", options.block = "translation";
  options.evaluations = 500;
  options.excess = true;
  const Worst w = hunt(*series("textbook", "exp_oracle"), options).worst.at(0);
  EXPECT_TRUE(w.by_kappa);
  EXPECT_GE(w.judged.residual.kappa, 1);
  EXPECT_NEAR(w.score, w.judged.residual.error / w.judged.residual.kappa, 1e-9 * w.score);
}

TEST(Subjects, WithAVariantRunOnlyIfTheyAreNamed) {
  for (const auto& s : select({}, built_in_robot())) EXPECT_EQ(s->subject.find(':'), std::string::npos);
  EXPECT_EQ(series("textbook:1e-4", "exp_oracle")->subject_version, "cutoff 1e-4");
}

template <class S>
class GeneratorStatements : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(GeneratorStatements, Scalars);

TYPED_TEST(GeneratorStatements, AboutFrequenciesHoldForEveryClass) {
  constexpr int n = 20000;
  for (auto& property : make_properties(oracles::scalar_of<TypeParam>)) {
    property->prepare(built_in_robot());
    const auto fields = property->fields();
    Coverage coverage;
    for (int i = 0; i < n; ++i) {
      Source source(sha256(property->name() + std::to_string(i)));
      coverage.add(fields, property->generate(source), property->scalar());
    }
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const auto& classes = classes_of(fields[f].kind);
      for (std::size_t c = 0; c < classes.size(); ++c)
        if (requires_class(fields[f], classes[c])) {
          const double expected = static_cast<double>(n) / static_cast<double>(classes[c].one_in);
          EXPECT_GE(static_cast<double>(coverage.count(f, c)), expected - 4 * std::sqrt(expected))
              << property->name() << " " << fields[f].name << ": " << classes[c].name;
        }
    }
  }
}

TEST(CoverageReport, NamesTheClassesThatANarrowGeneratorNeverReaches) {
  const auto s = series("liecheck", "exp_oracle");
  Tally tally;
  for (int i = 0; i < 6000; ++i) {
    Source source(sha256("narrow" + std::to_string(i)));
    std::vector<double> x(6);
    for (double& v : x) v = source.symmetric<double>();  // as a plain test would
    tally.coverage.add(s->fields, x, s->format(), {s->due, 0});
  }
  const auto all = coverage_of(*s, tally);
  const std::string line = coverage_line(all, tally);
  EXPECT_EQ(line.rfind("NOT COVERED", 0), 0u);
  for (const char* what :
       {"phi: zero", "phi: within 4 ulp of a cutoff", "phi: within 4 ulp of pi", "rho: 1e150"})
    EXPECT_NE(line.find(what), std::string::npos) << what;
}

TEST(CoverageReport, PassesForAFewCasesAndForTheWholeGenerator) {
  EXPECT_TRUE(run_quietly({{"liecheck"}, {"exp_oracle"}, {"double"}}, 20).measured);
  const CampaignResult r = run_quietly({{"liecheck"}, {"exp_oracle"}, {"double"}}, 3000);
  EXPECT_TRUE(r.measured);
  const auto all = coverage_of(*r.series[0].series, r.series[0].tally);
  EXPECT_GT(std::count_if(all.begin(), all.end(), [](const Covered& c) { return c.required; }), 15);
}

TEST(Shrinking, EndsInShortNumbers) {
  using V = std::vector<double>;
  const auto shrink = [](const V& x, Kind kind, auto fails) {
    return shrink_input(x, {{"x", kind, static_cast<int>(x.size()), ""}}, oracles::scalar_of<double>, fails,
                        5000);
  };
  EXPECT_EQ(shrink({123.456, -7.5e9, 0.3}, Kind::vector, [](const V& x) { return x[1] != 0; }), (V{0, 1, 0}));
  EXPECT_EQ(shrink({1.234e-5, 2e-5, 0.3e-5}, Kind::rotation_vector,
                   [](const V& x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2] > 1.5e-10; }),
            (V{2e-5, 0, 0}));
  EXPECT_EQ(
      shrink({0.3, -0.5, 0.7, std::sqrt(1 - 0.83)}, Kind::quaternion, [](const V& q) { return q[3] < 0.9; }),
      (V{1, 0, 0, 0}));
  EXPECT_EQ(shrink({3, 0.5, 4, -0.2, 0.1, 5}, Kind::inertia, [](const V& I) { return I[0] > 0; }),
            (V{1, 0, 1, 0, 0, 1}));
  EXPECT_EQ(shrink({3.7e9}, Kind::positive, [](const V& m) { return m[0] > 1e6; }), (V{4e9}));
  EXPECT_EQ(shrink({0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1}, Kind::rotation_matrix,
                   [](const V& R) { return R[1] < 0; }),
            (V{0, -1, 0, 1, 0, 0, 0, 0, 1}));
}

TEST(Shrinking, KeepsOnlyTheJointsThatMatter) {
  using V = std::vector<double>;
  const auto all = make_properties(oracles::scalar_of<double>);
  const auto law =
      std::find_if(all.begin(), all.end(), [](const auto& p) { return p->name() == "lagrange"; });
  ASSERT_NE(law, all.end());
  const auto count = [&](const V& x, auto wanted) {
    const TreeLayout at = TreeLayout::of_size(x.size());
    int n = 0;
    for (int i = 0; i < at.slots; ++i)
      n += x[static_cast<std::size_t>(at.parent(i))] >= -1 && wanted(x[static_cast<std::size_t>(at.kind(i))]);
    return n;
  };
  const auto any = [](double) { return true; };
  const auto spherical = [](double kind) { return kind == static_cast<int>(oracles::JointKind::spherical); };
  int trees = 0;
  for (int i = 0; i < 60; ++i) {
    Source source(sha256("tree" + std::to_string(i)));
    const V x = (*law)->generate(source);
    if (count(x, any) < 3 || count(x, spherical) == 0) continue;
    ++trees;
    const V small = shrink_input(
        x, (*law)->fields(), (*law)->scalar(),
        [&](const V& y) { return (*law)->valid(y) && count(y, spherical) > 0; }, 5000,
        [&](const V& y) { return (*law)->simpler(y); });
    EXPECT_EQ(count(small, any), 1) << i;
  }
  EXPECT_GT(trees, 5);
}

TEST(Shrinking, KeepsTheOutputAndTheOutcome) {
  const Worst w = hunt("textbook:1e-6", "exp6", "translation", 500);
  const Shrunk s = shrink(*series("textbook:1e-6", "exp_oracle"), w.id, w.output, 2000);
  EXPECT_TRUE(s.judged.failed);
  EXPECT_EQ(s.judged.residual.output, w.output);
  EXPECT_EQ(s.judged.residual.outcome, Outcome::measured);
  std::size_t zeros = 0;
  for (const std::string& x : s.decimal) {
    zeros += x == "0";
    EXPECT_LE(x.size(), 12u) << x;
  }
  EXPECT_GE(zeros, 4u);
}

/// Compiles the snippets of every law and operation as one translation unit, each in its own function.
TEST(Snippets, Compile) {
  namespace fs = std::filesystem;
  std::string unit, bodies;
  int k = 0;
  for (const char* scalar : {"double", "float"})
    for (const auto& s : select({{"liecheck"}, {}, {scalar}}, built_in_robot())) {
      std::set<std::string_view> seen;
      for (const Output& o : s->outputs) {
        if (!seen.insert(o.operation).second) continue;
        std::string text = program_of(*s, o, s->input(s->id(42, 1)));
        ASSERT_FALSE(text.empty()) << o.operation;
        for (std::size_t at; (at = text.find("#include ")) != std::string::npos;) {
          const std::size_t length = text.find('\n', at) + 1 - at;
          unit += text.substr(at, length);
          text.erase(at, length);
        }
        const auto at = text.find("int main()");
        ASSERT_NE(at, std::string::npos);
        bodies += text.replace(at, 10, "int case_" + std::to_string(k++) + "()")
                      .insert(text.rfind('}'), "  return 0;\n");
      }
    }
  EXPECT_GT(k, 60);
  const fs::path file = fs::path(liecheck::scratch()) / "liecheck_snippets.cpp";
  std::ofstream(file) << unit << bodies << "int main() { return 0; }\n";
  EXPECT_EQ(std::system((std::string(LIECHECK_SYNTAX_CHECK) + " '" + file.string() + "'").c_str()), 0);
}

}  // namespace
}  // namespace liecheck::properties
