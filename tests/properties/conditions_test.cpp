// Where a failure happens, as the condition on one or two features of the call that separates failing from passing inputs.

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <budgets/limits.hpp>
#include <oracles/orientations.hpp>
#include <search/condition.hpp>
#include <search/feature_names.hpp>

#include "../campaigns.hpp"
#include "../own_subject.hpp"

namespace liecheck::properties {
namespace {

/// liecheck's rotate_point, twice as long where `wrong(Q, p)`.
void add(const std::string& name,
         const std::function<bool(const Vec<double, 4>&, const Vec<double, 3>&)>& wrong) {
  Subject s{name, "1", "", &oracles::scalar_of<double>};
  s.operations[op::rotate_point] = [wrong, right = erased(own_subject()).operations[op::rotate_point]](
                                       const Vec<double, 4>& Q, const Vec<double, 3>& p) -> Vec<double, 3> {
    const Vec<double, 3> x = right(Q, p);
    return wrong(Q, p) ? Vec<double, 3>(2 * x) : x;
  };
  register_subject(s);
}

/// liecheck's euler_to_matrix, transposed where `wrong(order, angles)`.
void add_euler(const std::string& name,
               const std::function<bool(const oracles::Order&, const Vec<double, 3>&)>& wrong) {
  Subject s{name, "1", "", &oracles::scalar_of<double>};
  s.operations[op::euler_to_matrix] = [wrong, right = erased(own_subject()).operations[op::euler_to_matrix]](
                                          const double& order,
                                          const Vec<double, 3>& angles) -> Mat<double, 3> {
    const Mat<double, 3> R = right(order, angles);
    return wrong(oracles::Order(static_cast<int>(order)), angles) ? Mat<double, 3>(R.transpose()) : R;
  };
  register_subject(s);
}

/// liecheck's angle_between, doubled where rounding has left a longer than 1.
void add_angle(const std::string& name) {
  Subject s{name, "1", "", &oracles::scalar_of<double>};
  s.operations[op::angle_between] = [right = erased(own_subject()).operations[op::angle_between]](
                                        const Vec<double, 3>& a, const Vec<double, 3>& b) -> double {
    const long double square = a.cast<long double>().squaredNorm();
    return right(a, b) * (square >= 1 ? 2 : 1);
  };
  register_subject(s);
}

const bool are_registered = [] {
  add_angle("where:rounding");
  add("where:w", [](const auto& Q, const auto&) { return Q[3] < 0; });
  add("where:length", [](const auto&, const auto& p) { return p.norm() > 3e5; });
  add("where:y", [](const auto& Q, const auto&) { return Q[1] < 0; });
  add("where:any",
      [](const auto& Q, const auto& p) { return std::fmod(std::fabs(1e3 * (Q[0] + p[1])), 1) < 0.3; });
  add("where:angle", [](const auto& Q, const auto&) { return std::fabs(Q[3]) < 0.5; });
  add("where:zero", [](const auto&, const auto& p) { return p[2] == 0; });
  add("where:along", [](const auto&, const auto& p) { return p[0] == 0 && p[1] == 0; });
  add("where:short", [](const auto&, const auto& p) { return p.norm() < 1e-3; });
  add("where:two", [](const auto& Q, const auto& p) { return Q[0] < 0 && p[1] < 0; });
  add("where:only",
      [](const auto& Q, const auto& p) { return p[0] > 0 && std::fmod(std::fabs(1e3 * Q[0]), 1) < 0.5; });
  add_euler("where:axes", [](const oracles::Order& o, const auto&) {
    return o.axes == std::array<int, 3>{1, 2, 0};
  });
  add_euler("where:proper",
            [](const oracles::Order& o, const auto&) { return !o.rotating && o.axes[0] == o.axes[2]; });
  add_euler("where:angles", [](const oracles::Order&, const auto& angles) { return angles[2] < 0; });
  return true;
}();

std::optional<Condition> found(const std::string& subject, const std::string& domain = "") {
  Selection selection{{subject}, {}, {"double"}};
  if (!domain.empty())
    selection.limits = {std::make_shared<const SubjectLimits>(
        parse_limits("own.limits", "version = 1\nsubject = " + subject + "\n[domain]\n*, " + domain + "\n"))};
  for (const auto& s : select(selection, built_in_robot()))
    for (std::size_t i = 0; i < s->outputs.size(); ++i)
      if (s->outputs[i].operation == "angle_between" || s->outputs[i].operation == "rotate_point" ||
          s->outputs[i].operation == "euler_to_matrix")
        return condition_of(*s, i, 42);
  ADD_FAILURE() << "no law measures the operation";
  return std::nullopt;
}
std::string text(const std::string& subject) {
  const auto c = found(subject);
  return c ? c->text : "";
}

TEST(Conditions, OnlyIfIsSaidOfAQuarterAndMore) {
  const auto degree = [](std::uint64_t failed, std::uint64_t failed_elsewhere) {
    Condition c;
    c.failed = failed, c.cases = 100, c.failed_elsewhere = failed_elsewhere, c.elsewhere = 900;
    return std::string(c.degree());
  };
  EXPECT_EQ(degree(75, 0), "");
  EXPECT_EQ(degree(74, 0), "only if ");
  EXPECT_EQ(degree(26, 0), "only if ");
  EXPECT_EQ(degree(25, 0), "mostly if ");
  EXPECT_EQ(degree(50, 1), "mostly if ");
}

TEST(Conditions, NameTheNumberOfTheArgumentThatSeparates) {
  EXPECT_EQ(text("where:w"), "Q.w < 0");
  EXPECT_EQ(text("where:y"), "Q.y < 0");
  EXPECT_EQ(text("where:zero"), "p.z = 0");
  EXPECT_EQ(text("where:along"), "p.x = p.y = 0");
  EXPECT_EQ(text("where:angles"), "angles[2] < 0");
  const auto w = found("where:w").value();
  EXPECT_GT(w.failed, 300u);
  EXPECT_EQ(w.failed_elsewhere, 0u);
}

TEST(Conditions, CountNoInputOutsideTheDomain) {
  const Condition all = found("where:w").value(), near = found("where:w", "translation = 10").value();
  EXPECT_EQ(near.text, all.text);
  EXPECT_LT(near.cases + near.elsewhere, (all.cases + all.elsewhere) * 9 / 10);
}

TEST(Conditions, FindABorderByBisection) {
  EXPECT_EQ(text("where:length"), "|p| >= 3e+05 m");
  EXPECT_EQ(text("where:short"), "0 < |p| < 0.001 m");
}

TEST(Conditions, NameOrdersOfEulerAngles) {
  EXPECT_EQ(text("where:axes"), "the order is YZX");
  const std::string proper = text("where:proper");
  EXPECT_NE(proper.find("the order is static"), std::string::npos) << proper;
  EXPECT_NE(proper.find("the first axis of the order is its last"), std::string::npos) << proper;
}

TEST(Conditions, MayBeTwoAtOnce) {
  const auto c = found("where:two").value();
  EXPECT_TRUE(c.text == "Q.x < 0 and p.y < 0" || c.text == "p.y < 0 and Q.x < 0") << c.text;
  EXPECT_EQ(c.failed_elsewhere, 0u);
}

TEST(Conditions, WithoutWhichNoneFailsAreFound) {
  const auto c = found("where:only").value();
  EXPECT_EQ(c.text, "p.x > 0");
  EXPECT_LT(c.failed, 3 * c.cases / 4);
  EXPECT_EQ(c.failed_elsewhere, 0u);
}

TEST(Conditions, AreNotMadeUp) {
  EXPECT_EQ(text("where:any"), "");
  EXPECT_EQ(text("where:rounding"), "") << "the length of a unit vector";
  EXPECT_EQ(text("where:angle"), "") << "an angle, of which the bands tell";
}

TEST(Conditions, SayWhatAJointIs) {
  const Scalar& scalar = oracles::scalar_of<double>;
  const FeatureName& prismatic = *std::ranges::find(fixed_names(), Feature::prismatic, &FeatureName::feature);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double from : {above_zero, 1.0})
    EXPECT_EQ(text_of(prismatic, from, infinity, scalar), "a joint is prismatic");
  EXPECT_EQ(text_of(prismatic, 0, above_zero, scalar), "no joint is prismatic");
  EXPECT_EQ(text_of(prismatic, 2, infinity, scalar), "prismatic joints >= 2");
}

TEST(Conditions, OfTreesAreOnTheirJointsAndState) {
  using oracles::JointKind;
  Tree<double> tree;
  const auto add_joint = [&](JointKind kind, int parent, double armature = 0) {
    oracles::JointOf<double> j;
    j.kind = kind, j.parent = parent, j.armature = armature;
    tree.joints.push_back(j);
  };
  tree.gravity = {{0, 0, -9.81}};
  tree.frame_joint = 1, tree.frame_p = {{0, 0, 1}};
  add_joint(JointKind::spherical, -1);
  add_joint(JointKind::prismatic, 0);
  Features f = context_of(tree).features;
  EXPECT_EQ(f[Feature::turned_prismatic], 1);
  EXPECT_EQ(f[Feature::narrower], 1);
  EXPECT_EQ(f[Feature::depth], 2);
  EXPECT_EQ(f[Feature::frame_depth], 2);
  EXPECT_EQ(f[Feature::frame_off], 1);
  EXPECT_EQ(f[Feature::several], 1);
  EXPECT_EQ(f[Feature::several_armature], 0);
  EXPECT_EQ(f[Feature::inner_free_flyer], 0);
  EXPECT_EQ(f[Feature::gravity], 0);
  tree.joints.clear();
  tree.gravity = {{0, 1, -9.81}};
  tree.frame_joint = 0;
  add_joint(JointKind::prismatic, -1);
  add_joint(JointKind::free_flyer, 0, 1);
  f = context_of(tree).features;
  EXPECT_EQ(f[Feature::turned_prismatic], 0);
  EXPECT_EQ(f[Feature::narrower], 0);
  EXPECT_EQ(f[Feature::frame_depth], 1);
  EXPECT_EQ(f[Feature::several_armature], 1);
  EXPECT_EQ(f[Feature::inner_free_flyer], 1);
  EXPECT_EQ(f[Feature::gravity], 1);
  EXPECT_EQ(f[Feature::tilted_gravity], 1);
}

}  // namespace
}  // namespace liecheck::properties
