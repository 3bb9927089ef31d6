// Where a failure happens, as the condition on one feature of the call that separates failing from passing inputs.

#include <gtest/gtest.h>
#include <search/condition.hpp>

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

const bool are_registered = [] {
  add("where:w", [](const auto& Q, const auto&) { return Q[3] < 0; });
  add("where:length", [](const auto&, const auto& p) { return p.norm() > 3e5; });
  add("where:y", [](const auto& Q, const auto&) { return Q[1] < 0; });
  add("where:any",
      [](const auto& Q, const auto& p) { return std::fmod(std::fabs(1e3 * (Q[0] + p[1])), 1) < 0.3; });
  add("where:angle", [](const auto& Q, const auto&) { return std::fabs(Q[3]) < 0.5; });
  return true;
}();

std::optional<Condition> found(const std::string& subject) {
  for (const auto& s : select({{subject}, {}, {"double"}}, built_in_robot()))
    for (std::size_t i = 0; i < s->outputs.size(); ++i)
      if (s->outputs[i].operation == "rotate_point")
        return condition_of(*s, i, 42);
  ADD_FAILURE() << "no law measures rotate_point";
  return std::nullopt;
}
std::string text(const std::string& subject) {
  const auto c = found(subject);
  return c ? text_of(*c, oracles::scalar_of<double>) : "";
}

TEST(Conditions, NameTheFeatureThatSeparates) {
  EXPECT_EQ(text("where:w"), "w < 0");
  EXPECT_EQ(text("where:y"), "y < 0");
  const auto w = found("where:w").value();
  EXPECT_GT(w.failed, 300u);
  EXPECT_EQ(w.failed_elsewhere, 0u);
}

TEST(Conditions, FindABorderByBisection) {
  const auto c = found("where:length").value();
  EXPECT_EQ(c.feature, Feature::length);
  EXPECT_NEAR(std::exp2(c.low * 1024), 3e5, 1e4);
  EXPECT_EQ(text("where:length").substr(0, 21), "the longest vector >=");
}

TEST(Conditions, AreNotMadeUp) {
  EXPECT_EQ(text("where:any"), "");
  EXPECT_EQ(text("where:angle"), "") << "an angle, of which the bands tell";
}

}  // namespace
}  // namespace liecheck::properties
