// Choices: which of several right results a library returns is found, named and, if the adapter states it, held to.

#include <gtest/gtest.h>
#include <adapters/check.hpp>
#include <adapters/chosen.hpp>
#include <adapters/converted.hpp>
#include <adapters/sizes.hpp>
#include <algorithm>
#include <cmath>
#include <conventions/choices.hpp>
#include <conventions/reference.hpp>
#include <fstream>
#include <functional>
#include <numbers>

#include "../scratch.hpp"
#include "../shell.hpp"

namespace liecheck::properties::adapters {
namespace {

using conventions::Numbers;
using Choose = std::function<void(std::string_view operation, const Numbers& x, Numbers& y)>;
constexpr double pi = std::numbers::pi;

/// A library whose results are the exact ones, among which it chooses.
class Chooses final : public Adapter {
 public:
  Chooses(std::vector<std::string> operations, Choose choose, conventions::Statements stated)
      : choose_(std::move(choose)) {
    description_.name = "chooses", description_.version = "1", description_.conventions = std::move(stated);
    for (std::string& o : operations) description_.offered.insert({std::move(o), "double"});
  }
  const Description& description() const override { return description_; }
  std::string call(const Batch& b) override {
    const Operation& o = conventions::operation_named(b.operation.operation);
    for (std::size_t i = 0; i < b.n; ++i) {
      const auto* const from = reinterpret_cast<const double*>(b.inputs.data()) + i * b.operation.inputs;
      const Numbers x(from, from + b.operation.inputs);
      Numbers y = conventions::reference(o, x);
      choose_(o.name, x, y);
      std::ranges::copy(y, reinterpret_cast<double*>(b.results.data()) + i * b.operation.results);
      b.status[i] = Status::done;
    }
    return "";
  }

 private:
  Choose choose_;
  Description description_;
};

Checked checked(const std::vector<std::string>& operations, const Choose& choose,
                const conventions::Statements& stated = {}) {
  Chosen adapter(std::make_unique<Converted>(std::make_unique<Chooses>(operations, choose, stated), stated));
  return check(adapter);
}
std::vector<std::string> complaints(const Checked& all) {
  std::vector<std::string> texts;
  for (const CheckedOperation& o : all.operations)
    if (!o.complaint.empty()) texts.push_back(o.complaint);
  return texts;
}

void negate(Numbers& y, std::size_t from = 0) {
  for (std::size_t i = from; i < y.size(); ++i) y[i] = -y[i];
}
/// The opposite quaternion if `other(Q)`.
template <class Other>
Choose opposite_if(Other other) {
  return [other](std::string_view o, const Numbers& x, Numbers& y) {
    const std::size_t from = o == "integrate" ? 3 : 0;
    if (other(x, Numbers(y.begin() + std::ptrdiff_t(from), y.end()))) negate(y, from);
  };
}
/// Q as near as it can be to its input at x[from].
Choose continuous(std::size_t from) {
  return opposite_if([from](const Numbers& x, const Numbers& Q) {
    double product = 0;
    for (std::size_t i = 0; i < 4; ++i) product += x[from + i] * Q[i];
    return product < 0;
  });
}
const Choose positive_w = opposite_if([](const Numbers&, const Numbers& Q) { return Q[3] < 0; });
const Choose negative_w = opposite_if([](const Numbers&, const Numbers& Q) { return Q[3] > 0; });
const Choose exact = [](std::string_view, const Numbers&, Numbers&) {};
const Choose positive_angles = [](std::string_view, const Numbers&, Numbers& y) {
  for (std::size_t i = 0; i < y.size(); i += 2)
    if (y[i] < 0) y[i] += 2 * pi;
};
const Choose beyond = [](std::string_view, const Numbers&, Numbers& y) {
  if (y[0] > 1) y[0] -= 4 * pi;
};
/// At gimbal lock, the angle `zero` is 0 and the other one takes it over.
Choose zero_at_lock(std::size_t zero, double rest = 0) {
  return [zero, rest](std::string_view, const Numbers& x, Numbers& y) {
    const bool proper = x[0] >= 12, at_zero = std::fabs(y[1]) < 1e-7, at_end = std::fabs(y[1] - pi) < 1e-7;
    if (proper ? !at_zero && !at_end : std::fabs(std::fabs(y[1]) - pi / 2) > 1e-7) return;
    y[1] = proper ? at_zero ? 0 : pi : std::copysign(pi / 2, y[1]);
    const double moved = y[zero] - rest;
    y[zero] = rest;
    // Of Tait-Bryan angles a + s c is unique at b = +-pi/2, with s = -+1 as the axes turn; the tests compare no rotation.
    y[2 - zero] = std::remainder(y[2 - zero] + moved, 2 * pi);
  };
}
Choose half_turn(bool stored) {
  return [stored](std::string_view o, const Numbers& x, Numbers& y) {
    const bool of_matrix = o == "log3_matrix";
    if (of_matrix ? x[1] != x[3] || x[0] + x[4] + x[8] > 0 : x[3] != 0) return;
    if (o == "twist_angle") {
      const double along = x[0] * x[4] + x[1] * x[5] + x[2] * x[6];
      if (along != 0) y[0] = !stored || along > 0 ? pi : -pi;
      return;
    }
    const auto first = std::ranges::find_if(y, [](double number) { return std::fabs(number) > 1e-9; });
    for (double& number : y)
      if (std::fabs(number) < 1e-9) number = 0;
    const double along = of_matrix ? 1 : x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    if (stored ? along < 0 : *first < 0) negate(y);
  };
}
const Choose keeps_norm = [](std::string_view, const Numbers& x, Numbers& y) {
  const double norm = std::hypot(std::hypot(x[3], x[4]), std::hypot(x[5], x[6]));
  for (std::size_t i = 3; i < 7; ++i) y[i] *= norm;
};

struct Library {
  std::string operation, choice, value;
  Choose choose, other;
};

TEST(Choices, OfALibraryAreNamedAndHeldToOnceTheyAreStated) {
  const Choose opposite = [](std::string_view o, const Numbers&, Numbers& y) {
    negate(y, o == "integrate" ? 3 : 0);
  };
  const Library libraries[] = {
      {"exp3_quaternion", "quaternion sign", "continuous", exact, positive_w},
      {"exp3_quaternion", "quaternion sign", "w >= 0", positive_w, exact},
      {"exp3_quaternion", "quaternion sign", "free", negative_w, opposite},
      {"integrate", "quaternion sign", "continuous", continuous(3), positive_w},
      {"integrate", "quaternion sign", "w >= 0", positive_w, continuous(3)},
      {"normalize", "quaternion sign", "w >= 0", positive_w, continuous(0)},
      {"slerp", "quaternion sign", "continuous", continuous(0), positive_w},
      {"euler_to_quaternion", "quaternion sign", "w >= 0", positive_w, negative_w},
      {"euler_from_matrix", "angle range", "0 to 2 pi", positive_angles, exact},
      {"euler_from_quaternion", "angle range", "-pi to pi", exact, positive_angles},
      {"twist_angle", "angle range", "0 to 2 pi", positive_angles, exact},
      {"euler_from_matrix", "gimbal lock", "first is 0", zero_at_lock(0), zero_at_lock(2)},
      {"euler_from_quaternion", "gimbal lock", "last is 0", zero_at_lock(2), zero_at_lock(2, 0.5)},
      {"log3_quaternion", "half turn", "as stored", half_turn(true), half_turn(false)},
      {"log3_matrix", "half turn", "first number positive", half_turn(false),
       [](std::string_view o, const Numbers& x, Numbers& y) {
         half_turn(false)(o, x, y);
         if (x[1] == x[3]) negate(y);
       }},
      {"twist_angle", "half turn", "first number positive", half_turn(false), half_turn(true)},
      {"integrate", "quaternion norm", "kept", keeps_norm, exact},
      {"integrate", "quaternion norm", "1", exact, keeps_norm},
      {"euler_from_quaternion", "angle range", "free", beyond, exact},
  };
  for (const Library& l : libraries) {
    const std::string what = l.operation + ", " + l.choice + ", " + l.value;
    const Checked undeclared = checked({l.operation}, l.choose);
    EXPECT_EQ(complaints(undeclared), std::vector<std::string>()) << what;
    const std::string named = "choice \"" + l.choice + "\": \"" + l.value + "\"";
    EXPECT_TRUE(std::ranges::any_of(undeclared.findings,
                                    [&](const auto& f) { return f.choice && f.sentence.starts_with(named); }))
        << what << ": " << (undeclared.findings.empty() ? "nothing" : undeclared.findings[0].sentence);
    const conventions::Statements stated{{l.choice, l.value}};
    const Checked kept = checked({l.operation}, l.choose, stated);
    EXPECT_EQ(complaints(kept), std::vector<std::string>()) << what;
    EXPECT_TRUE(std::ranges::none_of(kept.findings, [&](const auto& f) {
      return f.sentence.starts_with(named);
    })) << what;
    if (l.value == "free") continue;
    const std::vector<std::string> broken = complaints(checked({l.operation}, l.other, stated));
    ASSERT_EQ(broken.size(), 1u) << what;
    EXPECT_TRUE(broken[0].starts_with("the adapter states \"" + l.choice)) << broken[0];
  }
}

TEST(Choices, ThatDifferBetweenOperationsAreNamedForEach) {
  const Checked all =
      checked({"exp3_quaternion", "integrate"}, [](std::string_view o, const Numbers& x, Numbers& y) {
        o == "integrate" ? continuous(3)(o, x, y) : positive_w(o, x, y);
      });
  EXPECT_TRUE(std::ranges::any_of(all.findings, [](const auto& f) {
    return f.sentence ==
               R"(choice "quaternion sign": "w >= 0" in exp3_quaternion, "continuous" in integrate; all are right)" &&
           !f.usual;
  }));
}

TEST(Choices, OneOfEulerAnglesThatIsStatedAndBrokenIsAFinding) {
  const std::string file = scratch() + "/liecheck_choices_breaks.py";
  std::ofstream(file) << R"(import json, math, struct, sys
calls, answers = sys.stdin.buffer, sys.stdout.buffer
calls.readline()
answers.write(json.dumps({"protocol": 1, "name": "breaks", "version": "1", "conventions": {"angle range": "0 to 2 pi"},
                          "operations": {"euler_from_quaternion": ["double"]}}).encode() + b"\n")
answers.flush()
for line in iter(calls.readline, b""):
    n, y, status = int(line.split()[3]), [], b""
    numbers = struct.unpack(f"<{5 * n}d", calls.read(40 * n))
    for order, a, b, c, d in zip(*[iter(numbers)] * 5):
        status += bytes([order != 11])
        y += [math.atan2(2 * (d * c + a * b), 1 - 2 * (b * b + c * c)), math.asin(max(-1, min(1, 2 * (d * b - c * a)))),
              math.atan2(2 * (d * a + b * c), 1 - 2 * (a * a + b * b))]
    answers.write(f"done {n}\n".encode() + status + struct.pack(f"<{3 * n}d", *y))
    answers.flush()
)";
  const auto [code, text] = shell(LIECHECK_PROGRAM " test '/usr/bin/python3 " + file + "' --cases 300");
  EXPECT_EQ(code, 1) << text;
  EXPECT_NE(text.find("1  euler_from_quaternion (rotation, range): wrong branch in double"), text.npos) << text;
  EXPECT_NE(text.find("\n            the adapter states \"angle range\": \"0 to 2 pi\", but an angle is -"),
            text.npos)
      << text;
}

TEST(Choices, AnUnknownValueIsRefused) {
  EXPECT_THROW(checked({"exp3_quaternion"}, exact, {{"quaternion sign", "w > 0"}}), AdapterFailed);
}

}  // namespace
}  // namespace liecheck::properties::adapters
