// The lattice of faults: its triggers, perturbations and verdicts.

#include <gtest/gtest.h>
#include <unistd.h>

#include <campaign/robots.hpp>
#include <cstdlib>
#include <filesystem>
#include <invariants/property.hpp>
#include <lattice/lattice.hpp>
#include <map>
#include <numbers>
#include <set>
#include <support/files.hpp>

#include "../own_subject.hpp"
#include "../refusal.hpp"
#include "../sample.hpp"

namespace liecheck::properties {
namespace {

using F = Feature;
using V3 = Vec<double, 3>;
using V6 = Vec<double, 6>;

std::vector<Trigger> with(const Trigger& more) {
  std::vector<Trigger> all = triggers();
  all.push_back(more);
  return all;
}

Features features(const Operation& operation, const std::vector<double>& numbers) {
  return features_of({&operation, &oracles::scalar_of<double>}, numbers, {});
}

TEST(Triggers, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Trigger& t : triggers()) EXPECT_TRUE(names.insert(t.name).second) << t.name;
  EXPECT_GT(names.size(), 150u);
}

TEST(Features, OfARotationVectorAreItsAngleAndItsSigns) {
  const Features f = features(op::exp6, {1, 2, 3, -0.3, 0, 0.4});
  EXPECT_NEAR(f[F::theta], 0.5, 1e-15);
  EXPECT_NEAR(f[F::pi_minus_theta], std::numbers::pi - 0.5, 1e-15);
  EXPECT_EQ(f[F::octant], 1);
  EXPECT_EQ(f[F::zeros], 1);
  EXPECT_EQ(f[F::turn], f[F::theta]);
  EXPECT_TRUE(std::isnan(f[F::w]));
  EXPECT_NEAR(f[F::length], std::log2(std::sqrt(14)) / 1024, 1e-15);
}

TEST(Features, OfTwoConfigurationsAreTheAngleAndTheDistanceBetweenThem) {
  const double s = std::sin(0.05), c = std::cos(0.05);
  const Features f = features(op::difference, {2, 0, 0, 0, 0, 1, 0, 2, 0, 0.2, 0, 0, -c, s});
  EXPECT_NEAR(f[F::pi_minus_theta], std::numbers::pi - 0.1, 1e-15);  // -Q1 = Q0 times a turn by pi - 0.1
  EXPECT_NEAR(f[F::apart], 0.1, 1e-15);
  EXPECT_EQ(f[F::w], 0);
  EXPECT_TRUE(std::isnan(f[F::turn])) << "it cannot be larger than pi";
  EXPECT_LT(f[F::off_unit], 1);
}

TEST(Features, SeeSubnormalAndOverflowingSizes) {
  const auto scale = [](double x) { return features(op::exp6, {x, 0, 0, 0, x, 0}); };
  EXPECT_NEAR(scale(0x1p-1070)[F::theta_scale], -1070.0 / 1024, 1e-15);
  EXPECT_EQ(scale(0x1p-1070)[F::theta], 0x1p-1070);
  EXPECT_NEAR(scale(0x1p1000)[F::length], 1000.0 / 1024, 1e-15);
  EXPECT_EQ(scale(0)[F::length], -std::numeric_limits<double>::infinity());
}

TEST(Features, OfABodyAreItsPrincipalMoments) {
  const auto body = [](double xx, double yy, double zz) {
    return features(op::inertia_matrix, {2, 0, 0, 0, xx, 0, 0, 0, yy, 0, 0, 0, zz});
  };
  EXPECT_EQ(body(0, 0, 0)[F::point], 1);
  EXPECT_EQ(body(1, 1, 1)[F::moments_apart], 0);
  EXPECT_NEAR(body(1, 1 + 1e-6, 2)[F::moments_apart], 0.5e-6, 1e-12);
  EXPECT_NEAR(body(1e-9, 1, 1)[F::thin], 1e-9, 1e-15);
  EXPECT_NEAR(body(1, 2, 3)[F::flat], 0, 1e-15);
}

TEST(Perturbations, ChangeTheBlockAndTheComponentThatTheyName) {
  const auto blocks = blocks_of(op::log6, 6);
  ASSERT_EQ(block_names(op::log6), (std::vector<std::string>{"rho", "phi"}));
  const std::vector<double> result{1, -8, 2, 3, 4, 5}, before{9, 9, 9, 9, 9, 9};
  const auto after = [&](PlantedChange change) {
    std::vector<double> x = result;
    Perturbation{change, 10, 0, 2, 3}.apply(x, oracles::scalar_of<double>, blocks, before);
    return x;
  };
  EXPECT_EQ(after(PlantedChange::none), result);
  EXPECT_EQ(after(PlantedChange::size), (std::vector<double>{1, -8, 2 + 8 * 0x1p-42, 3, 4, 5}));
  EXPECT_EQ(after(PlantedChange::sign), (std::vector<double>{1, -8, -2, 3, 4, 5}));
  EXPECT_EQ(after(PlantedChange::whole_sign), (std::vector<double>{-1, 8, -2, 3, 4, 5}));
  EXPECT_EQ(after(PlantedChange::zero), (std::vector<double>{1, -8, 0, 3, 4, 5}));
  EXPECT_EQ(after(PlantedChange::swap), (std::vector<double>{2, -8, 1, 3, 4, 5}));
  EXPECT_EQ(after(PlantedChange::stale), (std::vector<double>{1, -8, 9, 3, 4, 5}));
  EXPECT_EQ(after(PlantedChange::unwritten), before);
  EXPECT_TRUE(std::isnan(after(PlantedChange::not_a_number)[2]));
}

TEST(Perturbations, AddNothingToAVectorOfZerosButToThoseOfAMatrix) {
  const Perturbation size{PlantedChange::size, 10, 0, 0, 1};
  std::vector<double> twist{0, 0, 0, 3, 4, 5};
  size.apply(twist, oracles::scalar_of<double>, blocks_of(op::log6, 6), {});
  EXPECT_EQ(twist, (std::vector<double>{0, 0, 0, 3, 4, 5}));
  std::vector<double> J(36, 0);
  J[0] = 1;
  Perturbation lower_left = size;
  lower_left.block = 2;
  lower_left.apply(J, oracles::scalar_of<double>, blocks_of(op::d_integrate_arg1, 36), {});
  EXPECT_EQ(J[18], 0x1p-42);
}

TEST(Perturbations, ReachEveryNumberOfAResult) {
  for (const Operation* o : all_operations()) {
    std::size_t numbers = 0, reached = 0;
    for (const Part& part : o->results[0]->parts)
      numbers += part.size > 0 ? static_cast<std::size_t>(part.size) : 4;
    for (const ResultBlock& b : blocks_of(*o, numbers)) reached += b.numbers.size();
    EXPECT_EQ(reached, numbers) << o->name;
  }
}

TEST(Lattice, ABaseWithoutAFaultIsNeverFound) {
  Lab lab(erased(own_subject()), triggers(), 1, built_in_robot(), {true, false});
  ASSERT_TRUE(lab.scan(200));
  EXPECT_EQ(lab.failures_of_base(), 0);
  for (Fault fault : lab.faults()) {
    if (triggers()[fault.trigger].feature != F::one) continue;
    fault.perturbation.change = PlantedChange::none;
    const FaultVerdict verdict = lab.judge(fault);
    EXPECT_EQ(verdict.found, Found::unchanged) << fault.operation->name << " by " << verdict.by;
    // Half turns have no Gibbs parameters and translations no screw: their laws do not call the function there.
    const bool partial =
        fault.operation == &op::gibbs_from_quaternion || fault.operation == &op::screw_parameters;
    if (partial)
      EXPECT_GT(verdict.share, 0.9) << fault.operation->name;
    else
      EXPECT_EQ(verdict.share, 1) << fault.operation->name;
  }
}

TEST(Lattice, AFaultThatNeverFiresIsReportedAsNotFired) {
  const auto table = with({"test", "an angle below zero", F::theta, -2, -1});
  Lab lab(erased(own_subject()), table, 1, built_in_robot(), {true, false});
  ASSERT_TRUE(lab.scan(100));
  std::size_t checked = 0;
  for (const Fault& fault : lab.faults()) {
    if (fault.trigger != table.size() - 1) continue;
    const FaultVerdict verdict = lab.judge(fault);
    EXPECT_EQ(verdict.found, Found::unfired) << fault.operation->name;
    EXPECT_EQ(verdict.share, 0) << fault.operation->name;
    ++checked;
  }
  EXPECT_GT(checked, 20u);
}

/// exp6 with an error of 2^-30 in x if theta is in [1.1, 1.2).
Pose<double> faulty_exp6(const V6& xi) {
  Pose<double> X = own_subject().operations[op::exp6](xi);
  const double theta = xi.tail<3>().norm();
  if (theta >= 1.1 && theta < 1.2) X.p[0] += 0x1p-30 * X.p.cwiseAbs().maxCoeff();
  return X;
}

TEST(Lattice, FindsAFaultInTheSameCaseAsARunOfAllCasesDoes) {
  const auto table = with({"test", "theta in [1.1, 1.2)", F::theta, 1.1, 1.2});
  Lab lab(erased(own_subject()), table, 5, built_in_robot(), {true, false});
  ASSERT_TRUE(lab.scan(1000));
  const Fault fault{&op::exp6, table.size() - 1, {PlantedChange::size, 22, 1, 0, 1}};
  const FaultVerdict verdict = lab.judge(fault);

  TypedSubject<double> faulty{"faulty", "", {}};
  faulty.operations[op::exp6] = faulty_exp6;
  const Subject tested = erased(faulty);
  std::uint64_t cases = 1000;
  for (auto& law : make_properties(oracles::scalar_of<double>)) {
    if (!law->offered(tested)) continue;
    const Series series(std::move(law), tested, built_in_robot());
    for (std::uint64_t i = 0; i < cases; ++i) {
      const auto judged = series.replay(series.id(5, i));
      if (std::any_of(judged.begin(), judged.end(), [](const Judged& j) { return j.failed; })) cases = i + 1;
    }
  }
  ASSERT_LT(cases, 1000u);
  EXPECT_EQ(verdict.found, Found::found);
  EXPECT_EQ(verdict.cases, cases);
  EXPECT_NE(verdict.by.find("exp6, translation"), std::string::npos) << verdict.by;
}

/// A rotation vector or a twist, too long by 2^-30 of itself if its angle is in [1.1, 1.2).
template <int N>
Vec<double, N> stretched(const Vec<double, N>& x) {
  const double theta = x.template tail<3>().norm();
  return theta >= 1.1 && theta < 1.2 ? Vec<double, N>(x * (1 + 0x1p-30)) : x;
}
/// The inverse of stretched.
template <int N>
Vec<double, N> shrunk(const Vec<double, N>& x) {
  const Vec<double, N> shorter = x / (1 + 0x1p-30);
  return stretched<N>(shorter) == shorter ? x : shorter;
}

TEST(Lattice, FindsTwoFaultsThatCancelInARoundTrip) {
  TypedSubject<double> faulty{"faulty", "", {}};
  auto& o = faulty.operations;
  static const auto& good = own_subject().operations;
  o[op::exp3_quaternion] = [](const V3& phi) { return good[op::exp3_quaternion](stretched<3>(phi)); };
  o[op::exp3_matrix] = [](const V3& phi) { return good[op::exp3_matrix](stretched<3>(phi)); };
  o[op::exp6] = [](const V6& xi) { return good[op::exp6](stretched<6>(xi)); };
  o[op::integrate] = [](const auto& q, const V6& d) { return good[op::integrate](q, stretched<6>(d)); };
  o[op::log3_quaternion] = [](const auto& Q) { return shrunk<3>(good[op::log3_quaternion](Q)); };
  o[op::log3_matrix] = [](const auto& R) { return shrunk<3>(good[op::log3_matrix](R)); };
  o[op::log6] = [](const auto& X) { return shrunk<6>(good[op::log6](X)); };
  o[op::difference] = [](const auto& a, const auto& b) { return shrunk<6>(good[op::difference](a, b)); };
  const Subject tested = erased(faulty);
  std::set<std::string_view> found;
  for (const char* name : {"exp_oracle", "integrate_difference", "log_oracle"})
    for (auto& law : make_properties(oracles::scalar_of<double>)) {
      if (law->name() != name) continue;
      const Series series(std::move(law), tested, built_in_robot());
      for (std::uint64_t i = 0; i < 1000; ++i)
        for (const Judged& j : series.replay(series.id(42, i)))
          if (j.failed) found.insert(series.outputs.at(j.residual.output).operation);
    }
  EXPECT_EQ(found, (std::set<std::string_view>{"exp3_quaternion", "exp3_matrix", "exp6", "integrate",
                                               "log3_quaternion", "log3_matrix", "log6", "difference"}))
      << "the round trips are right, and each operation is wrong";
}

TEST(Lattice, AFaultIsFoundInABaseThatFailsAnotherBlockOfTheCase) {
  TypedSubject<double> base{"partly wrong", "", {}};
  base.operations[op::exp3_matrix] = [](const V3& phi) {
    return Mat<double, 3>((1 + 1e-10) * own_subject().operations[op::exp3_matrix](phi));
  };
  base.operations[op::exp3_quaternion] = own_subject().operations[op::exp3_quaternion];
  Lab lab(erased(base), triggers(), 1, built_in_robot());
  ASSERT_TRUE(lab.scan(100));
  EXPECT_GT(lab.failures_of_base(), 0.4);
  const Perturbation size{PlantedChange::size, 20, 0, 0, 1};
  EXPECT_EQ(lab.judge({&op::exp3_quaternion, 0, size}).found, Found::found);
}

TEST(Lattice, AnErrorWithinTheLimitsIsGrantedAndNotAHole) {
  const std::vector<Trigger>& table = triggers();
  Lab lab(erased(own_subject()), table, 1, built_in_robot(), {true, false});
  ASSERT_TRUE(lab.scan(200));
  const FaultVerdict verdict = lab.judge({&op::exp6, 0, {PlantedChange::size, 0, 1, 0, 1}});  // 1 eps
  EXPECT_EQ(verdict.found, Found::granted) << verdict.by;
}

TEST(Lattice, HasThreeCorrectBasesAndThreeThousandFaults) {
  std::size_t faults = 0, correct = 0;
  const auto count = [&](const Subject& base) {
    Lab lab(base, triggers(), 42, built_in_robot(), {true, false});
    ASSERT_TRUE(lab.scan(20));
    faults += lab.faults().size();
    correct += lab.failures_of_base() == 0;
  };
  count(erased(own_subject()));
  count(look_alikes(oracles::scalar_of<double>));
  for (const auto* s : subjects(oracles::scalar_of<double>))
    if (s->name == "liecheck:fast") count(*s);
  EXPECT_GE(faults, 3000u);
  EXPECT_GE(correct, 3u);
}

class VerdictsOfARun : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  LatticeOptions options() const {
    LatticeOptions o;
    o.subjects = {"liecheck"}, o.operations = {"exp6", "log6"};
    o.cases = 50, o.faults = 20, o.resume = file_;
    return o;
  }
  std::string error_of(const LatticeOptions& o) const {
    return test::refusal<std::runtime_error>([&] { run_lattice(o, built_in_robot()); });
  }
  const std::string file_ =
      (std::filesystem::temp_directory_path() / ("liecheck_lattice_" + std::to_string(getpid()))).string();
};

TEST(Lattice, TheConditionOfAFaultIsToldRightlyOrNotAtAll) {
  LatticeOptions o;
  o.cases = 1000, o.faults = sample<std::size_t>(600, 4000);
  std::map<Told, std::size_t> told;
  for (const LatticeRow& row : run_lattice(o, built_in_robot()).rows) ++told[row.verdict.told];
  const auto asked = static_cast<double>(told[Told::right] + told[Told::other] + told[Told::silent]);
  EXPECT_GT(asked, 60);
  EXPECT_GE(static_cast<double>(told[Told::right]), 0.85 * asked);
  EXPECT_LE(static_cast<double>(told[Told::other]), 0.03 * asked);
}

TEST_F(VerdictsOfARun, AreKeptAndNotComputedAgain) {
  const LatticeResult first = run_lattice(options(), built_in_robot());
  ASSERT_EQ(first.rows.size(), 20u);
  EXPECT_TRUE(first.complete);
  const std::string text = read_whole(file_);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 21);
  const LatticeResult again = run_lattice(options(), built_in_robot());
  EXPECT_EQ(read_whole(file_), text) << "a known verdict was computed again";
  // Killed while it wrote the sixth verdict.
  std::size_t end = 0;
  for (int i = 0; i < 6; ++i) end = text.find('\n', end) + 1;
  write_whole(file_, text.substr(0, end + 5));
  const LatticeResult resumed = run_lattice(options(), built_in_robot());
  EXPECT_EQ(read_whole(file_), text);
  for (const LatticeResult* other : {&again, &resumed}) {
    ASSERT_EQ(other->rows.size(), first.rows.size());
    for (std::size_t i = 0; i < first.rows.size(); ++i) {
      EXPECT_EQ(other->rows[i].key(), first.rows[i].key());
      EXPECT_EQ(other->rows[i].verdict.found, first.rows[i].verdict.found);
      EXPECT_EQ(other->rows[i].verdict.cases, first.rows[i].verdict.cases);
    }
  }
}

TEST_F(VerdictsOfARun, AreKeptAfterCtrlC) {
  // The first pass of all laws takes some seconds; the cases of rarer triggers take minutes.
  const std::string line = "timeout --preserve-status -s INT 30 " LIECHECK_LAB
                           " lattice --subject liecheck --operation exp6 --cases 100000 --resume " +
                           file_ + " > " + file_ + ".out 2>&1";
  const int status = std::system(line.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3) << read_whole(file_ + ".out");
  std::filesystem::remove(file_ + ".out");
  const std::string text = read_whole(file_);
  EXPECT_GT(std::count(text.begin(), text.end(), '\n'), 50);
  LatticeOptions o;
  o.subjects = {"liecheck"}, o.operations = {"exp6"}, o.resume = file_;
  const LatticeResult resumed = run_lattice(o, built_in_robot());
  EXPECT_TRUE(resumed.complete);
  EXPECT_EQ(read_whole(file_), text) << "a verdict of the first pass was lost";
}

TEST_F(VerdictsOfARun, OfAnotherSeedOrABadLineAreRefusedWithTheirPlace) {
  run_lattice(options(), built_in_robot());
  LatticeOptions other = options();
  other.seed = 43;
  EXPECT_NE(error_of(other).find(file_ + ":1: "), std::string::npos) << error_of(other);
  const std::string text = read_whole(file_);
  write_whole(file_, text + "no verdict\n");
  EXPECT_NE(error_of(options()).find(file_ + ":22: "), std::string::npos) << error_of(options());
  std::string changed = text;
  changed.replace(text.find("\t50\t"), 4, "\t51\t");
  write_whole(file_, changed);
  EXPECT_NE(error_of(options()).find("this is no verdict of lattice"), std::string::npos);
  write_whole(file_, "a file of somebody else, without an end of its line");
  EXPECT_NE(error_of(options()).find(file_ + ":1: "), std::string::npos) << error_of(options());
}

}  // namespace
}  // namespace liecheck::properties
