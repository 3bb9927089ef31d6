// What a library refuses at every probe of one kind (a t, an axis, a reference frame) is outside its domain, and it gets
// cases of the others.

#include <gtest/gtest.h>
#include <adapters/asked.hpp>
#include <adapters/check.hpp>
#include <adapters/liecheck_adapter.hpp>
#include <adapters/subjects.hpp>
#include <adapters/trees.hpp>
#include <map>
#include <set>
#include <stdexcept>

#include "../campaigns.hpp"
#include "../own_subject.hpp"

namespace liecheck::properties::adapters {
namespace {

/// slerp at t = 1/2 only, and twists about x, y and z.
struct Few {
  const char *name = "few_kinds", *version = "1";
  bool wrong = false;

  void slerp(std::span<const double, 9> x, std::span<double, 4> Q) const {
    if (x[8] != 0.5) throw std::domain_error("only halfway");
    const Vec<double, 4> y =
        own_subject().operations[op::slerp](Vec<double, 4>(x.data()), Vec<double, 4>(x.data() + 4), 0.5);
    std::copy_n(y.data(), 4, Q.begin());
    if (wrong) Q[0] += 0.1;
  }
  void twist_angle(std::span<const double, 7> x, std::span<double, 1> angle) const {
    if (*std::max_element(x.begin() + 4, x.end()) != 1) throw std::domain_error("only x, y and z");
    angle[0] =
        own_subject().operations[op::twist_angle](Vec<double, 4>(x.data()), Vec<double, 3>(x.data() + 4));
  }
};
LIECHECK_SUBJECT(Few, slerp, twist_angle)

std::string registered(Few& library, const char* name) {
  library.name = name;
  return register_adapter(*new liecheck_adapter(liecheck_described(library)));
}

TEST(RefusedKinds, AreOutsideTheDomainAndTheCasesAreOfTheOthers) {
  static Few few;
  const std::string name = registered(few, "few_kinds");
  const CampaignResult r = run_quietly({{name}, {}, {}}, 400);
  EXPECT_FALSE(r.failed);
  EXPECT_TRUE(r.measured);
  std::set<std::string> from;
  for (const auto& [series, tally] : r.series) {
    from.insert(series->robot);
    for (const auto& [cell, row] : tally.rows) EXPECT_EQ(row.outside_domain + row.refused, 0u);
  }
  EXPECT_EQ(from, (std::set<std::string>{"fractions_1", "axes_0_1_2"}));
  EXPECT_EQ(
      refusals(*description_of(name + ".so")),
      (std::vector<std::string>{"few_kinds refuses every t but 1/2: they are outside its domain",
                                "few_kinds refuses every axis but x, y, z: they are outside its domain"}));
  for (const CheckedOperation& o : check(*linked(liecheck_described(few))).operations)
    EXPECT_EQ(o.complaint, "") << o.operation;

  static Few wrong;
  wrong.wrong = true;
  EXPECT_TRUE(run_quietly({{registered(wrong, "few_wrong")}, {"relative_rotation"}, {}}, 50).failed);
}

TEST(RefusedKinds, WhoTakesEveryKindGetsTheInputsOfAll) {
  for (const char* law : {"relative_rotation", "twist"})
    EXPECT_EQ(select({{"liecheck"}, {law}, {"double"}}, built_in_robot()).at(0)->robot, "none");
}

/// Angles to matrices in two orders, and back in one of them.
struct Orders {
  const char *name = "two_orders", *version = "1";
  void euler_to_matrix(std::span<const double, 4> x, std::span<double, 9> R) const {
    if (x[0] != 11 && x[0] != 1) throw std::domain_error("only 1 and 11");
    const Mat<double, 3> y =
        own_subject().operations[op::euler_to_matrix](x[0], Vec<double, 3>(x.data() + 1));
    for (int i = 0; i < 9; ++i) R[std::size_t(i)] = y(i / 3, i % 3);
  }
  void euler_from_matrix(std::span<const double, 10> x, std::span<double, 3> angles) const {
    if (x[0] != 11) throw std::domain_error("only 11");
    Mat<double, 3> R;
    for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = x[std::size_t(i + 1)];
    const Vec<double, 3> y = own_subject().operations[op::euler_from_matrix](x[0], R);
    std::copy_n(y.data(), 3, angles.begin());
  }
};
LIECHECK_SUBJECT(Orders, euler_to_matrix, euler_from_matrix)

TEST(RefusedKinds, OfOneFunctionAreThoseOfNoOther) {
  static Orders orders;
  const std::string name = register_adapter(*new liecheck_adapter(liecheck_described(orders)));
  const CampaignResult r = run_quietly({{name}, {}, {}}, 400);
  EXPECT_FALSE(r.failed);
  std::map<std::string, std::uint64_t> outside, refused;  // by operation
  for (const auto& [series, tally] : r.series) {
    EXPECT_EQ(series->robot, "orders_1_11");
    for (const auto& [cell, row] : tally.rows) {
      const std::string operation(series->outputs.at(std::size_t(cell.first)).operation);
      outside[operation] += row.outside_domain, refused[operation] += row.refused;
    }
  }
  EXPECT_EQ(outside["euler_to_matrix"], 0u);
  EXPECT_GT(outside["euler_from_matrix"], 100u);
  EXPECT_EQ(refused["euler_from_matrix"], 0u);
}

/// liecheck's velocities of frames in LOCAL only.
class Local final : public Adapter {
 public:
  const Description& description() const override { return description_; }
  std::string call(const Batch& b) override {
    const auto seen = reinterpret_cast<const double*>(b.inputs.data())[b.operation.inputs - 9];
    std::ranges::fill(b.status, seen == 1 || all ? Status::done : Status::refused);
    std::ranges::fill(b.results, std::byte{});
    return "only LOCAL";
  }
  bool all = false;

 private:
  Description description_{"local", "1", {{"frame_velocity", "double"}}, {}};
};

TEST(RefusedKinds, OfReferenceFramesAreNotAskedAgain) {
  Local local;
  EXPECT_EQ(references_taken(local), (std::set<std::string>{"local"}));
  local.all = true;
  EXPECT_EQ(references_taken(local), (std::set<std::string>{"world", "local", "aligned"}));
}

}  // namespace
}  // namespace liecheck::properties::adapters
