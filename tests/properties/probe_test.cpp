// The probe of conventions names what differs between a library and liecheck.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <conventions/probe.hpp>
#include <conventions/reference.hpp>
#include <conventions/stated.hpp>

#include "altered_libraries.hpp"

namespace liecheck::properties::conventions {
namespace {

template <class S>
std::vector<Probed> answers(const Library& l) {
  std::vector<Probed> all;
  for (const auto& [name, function] : l) {
    Probed p{&operation_named(name), {}};
    for (const Numbers& x : probe_arguments<S>(*p.operation)) p.answers.push_back({x, function(x)});
    all.push_back(std::move(p));
  }
  return all;
}

/// The sentences of the findings, one a line.
template <class S = double>
std::string findings(const Library& l) {
  std::string text;
  for (const Finding& f : explain(answers<S>(l))) text += f.sentence + "\n";
  return text;
}

Library only(std::initializer_list<const char*> names) {
  Library l;
  for (const char* name : names) l[name] = correct()[name];
  return l;
}

struct Mismatch {
  std::vector<void (*)(Library&)> changes;
  std::vector<const char*> meanings;  ///< of the conventions, in the order of the findings
};

const Mismatch mismatches[] = {
    {{w_first}, {"quaternions are stored w x y z"}},
    {{passive_quaternions}, {"quaternions are those of the inverse rotations"}},
    {{twists_angular_first}, {"twists are angular first"}},
    {{wrenches_moment_first}, {"wrenches are moment first"}},
    {{columns}, {"matrices are stored column by column"}},
    {{passive_poses}, {"poses are those of A in B"}},
    {{jacobians_angular_first}, {"Jacobians are angular first"}},
    {{degrees}, {"angles are in degrees"}},
    {{quaternion_before_p}, {"configurations are (Q, p)"}},
    {{inertia_about_the_origin}, {"inertias are about the origin of the body"}},
    {{right_jacobian_is_left}, {"the right Jacobian is the left one"}},
    {{log_of_the_inverse}, {"log is that of the inverse"}},
    {{left_increments}, {"increments are on the left"}},
    {{reversed_quaternion_product}, {"the product of quaternions is in the reverse order (JPL)"}},
    {{translation_without_V}, {"the translation is rho, not V(phi) rho"}},
    {{forces_as_motions}, {"forces are treated as motions"}},
    {{cross_force_sign}, {"the product of a motion and a force is ad^T"}},
    {{angle_for_half_angle}, {"quaternions turn by twice the rotation vector"}},
    {{passive_rotation_matrices}, {"rotation matrices are those of the inverse rotations"}},
    {{exp_of_the_opposite}, {"exp is that of the opposite argument"}},
    {{opposite_tangents}, {"rotation vectors and tangents have the opposite sign"}},
    {{left_jacobian_is_right}, {"the left Jacobian is the right one"}},
    {{jacobians_exchanged_with_inverses}, {"a Jacobian and its inverse are exchanged"}},
    {{quarter_angles}, {"quaternions turn by half of the rotation vector"}},
    {{left_derivatives}, {"the derivatives are those of increments on the left"}},
    {{difference_from_q1}, {"the difference goes from q1 to q0"}},
    {{added_translations}, {"the translation is added in the axes of the parent"}},
    {{motions_as_forces}, {"motions are treated as forces"}},
    {{cross_motion_exchanged}, {"the product of motions is [W, V]"}},
    {{compose_exchanged}, {"the product of poses is in the reverse order"}},
    {{momentum_about_the_centre}, {"momentum is about the centre of mass"}},
    // representations, poses, inertial navigation
    {{quaternion_product_exchanged}, {"the product of quaternions is Q1 Q0"}},
    {{rows_made_orthogonal}, {"the rows of the matrix are made orthogonal, not its columns"}},
    {{axis_and_angle_inverse}, {"the rotation of an axis and an angle is the inverse one"}},
    {{adjoint_of_the_inverse}, {"the adjoint is that of the inverse pose"}},
    {{coadjoint_transposed}, {"the coadjoint is Ad^T"}},
    {{pitch_of_a_turn}, {"the pitch of a screw is that of a whole turn"}},
    {{position_rotation_velocity}, {"tangents of SE_2(3) are (rho, phi, nu)"}},
    {{rotation_velocity_position}, {"tangents of SE_2(3) are (phi, nu, rho)"}},
    {{by_measurements}, {"the derivatives are those by the measurements"}},
    // two at a time
    {{w_first, twists_angular_first}, {"quaternions are stored w x y z", "twists are angular first"}},
    {{columns, degrees}, {"matrices are stored column by column", "angles are in degrees"}},
    {{twists_angular_first, jacobians_angular_first},
     {"twists are angular first", "Jacobians are angular first"}},
    {{log_of_the_inverse, quaternion_before_p}, {"configurations are (Q, p)", "log is that of the inverse"}},
    {{left_increments, w_first}, {"quaternions are stored w x y z", "increments are on the left"}},
    {{degrees, twists_angular_first}, {"twists are angular first", "angles are in degrees"}},
};

class Mismatches : public testing::TestWithParam<Mismatch> {};

TEST_P(Mismatches, AreNamed) {
  Library l = correct();
  for (const auto change : GetParam().changes) change(l);
  const std::vector<Finding> found = explain(answers<double>(l));
  ASSERT_EQ(found.size(), GetParam().meanings.size()) << findings(l);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(found[i].named);
    EXPECT_TRUE(found[i].sentence.starts_with(GetParam().meanings[i])) << found[i].sentence;
    EXPECT_EQ(found[i].sentence.find("do not tell which"), std::string::npos) << found[i].sentence;
    EXPECT_EQ(found[i].sentence.find("but not"), std::string::npos) << found[i].sentence;
  }
}
INSTANTIATE_TEST_SUITE_P(Probe, Mismatches, testing::ValuesIn(mismatches), [](const auto& info) {
  std::string name;
  for (const char* meaning : info.param.meanings)
    for (const char* c = meaning; *c; ++c)
      if (std::isalnum(static_cast<unsigned char>(*c))) name += *c;
  return name;
});

struct Stated {
  std::vector<void (*)(Library&)> changes;
  Statements statements;
};

TEST(Probe, FindsNothingIfTheConventionsAreStated) {
  const Stated all[] = {
      {{w_first}, {{"quaternion", "wxyz"}}},
      {{passive_quaternions}, {{"quaternion sense", "passive"}}},
      {{twists_angular_first}, {{"twist", "angular first"}, {"quaternion", "xyzw"}}},
      {{wrenches_moment_first}, {{"wrench", "moment first"}}},
      {{columns}, {{"matrix", "columns"}}},
      {{jacobians_angular_first}, {{"jacobian", "angular first"}}},
      {{quaternion_before_p}, {{"configuration", "Q first"}}},
      {{passive_rotation_matrices}, {{"rotation matrix", "passive"}}},
      {{w_first, quaternion_before_p, columns},
       {{"quaternion", "wxyz"}, {"matrix", "columns"}, {"configuration", "Q first"}}},
  };
  for (const Stated& s : all) {
    Library l = correct();
    for (const auto change : s.changes) change(l);
    for (auto& [name, function] : l)
      function = [f = function, r = rearranged(operation_named(name), s.statements)](const Numbers& x) {
        Numbers arguments(x.size()), result(r.result.size());
        encode(r.arguments, x.data(), arguments.data());
        decode(r.result, f(arguments).data(), result.data());
        return result;
      };
    EXPECT_EQ(findings(l), "");
  }
}

TEST(Probe, NamesOneOperationThatDiffersFromTheOthers) {
  Library l = correct();
  l["log6"] = [f = l["log6"]](const Numbers& x) {
    Numbers r = f(x);
    std::swap_ranges(r.begin(), r.begin() + 3, r.begin() + 3);
    return r;
  };
  const std::string text = findings(l);
  EXPECT_TRUE(text.starts_with("twists are angular first in log6, but not in ")) << text;
  l = correct();
  l["log6"] = [f = l["log6"]](const Numbers& x) {
    Numbers r = f(x);
    for (double& number : r) number = -number;
    return r;
  };
  EXPECT_EQ(findings(l),
            "log is that of the inverse in log6, but not in log3_any_norm, log3_matrix and log3_quaternion: "
            "change its sign, or its order of frames\n");
  EXPECT_FALSE(explain(answers<double>(l)).at(0).named) << "a fault of log6, and not what the library means";
}

TEST(Probe, SeparatesConversionsThatExplainAsMuch) {
  const Library l = {{"quaternion_inverse", [](const Numbers& x) { return x; }}};
  EXPECT_TRUE(findings(l).starts_with(
      "quaternions are those of the inverse rotations (passive), but only as arguments, or "))
      << findings(l);
}

TEST(Probe, NamesAConversionOfOneSideOnly) {
  Library l = correct();
  change_results(l, {{"integrate", 3}}, [](double* q) { std::rotate(q, q + 3, q + 4); });
  EXPECT_TRUE(findings(l).starts_with(
      "quaternions are stored w x y z, but only as results, in integrate, but not in "))
      << findings(l);
  l = correct();
  change_arguments(l,
                   {{"act_motion", 12}, {"act_inverse_motion", 12}, {"cross_motion", 0}, {"cross_motion", 6}},
                   exchange_halves);
  EXPECT_EQ(
      findings(l),
      "twists are angular first, but only as arguments, in act_inverse_motion, act_motion and cross_motion: "
      "exchange their halves: the linear part comes first\n");
}

TEST(Probe, TakesAnAxisAndItsAngleAsOneTurn) {
  const Places pairs = {{"axis_angle_from_quaternion", 0}, {"axis_angle_from_matrix", 0}};
  Library l = correct();
  change_results(l, pairs, [](double* x) {
    for (int i = 0; i < 4; ++i) x[i] = -x[i];
  });
  EXPECT_EQ(findings(l), "");
  change_results(l, pairs, [](double* x) { x[3] += 8 * std::atan(1.0); });
  EXPECT_EQ(findings(l), "");
  change_results(l, pairs, [](double* x) { x[0] = -x[0], x[1] = -x[1], x[2] = -x[2]; });
  EXPECT_NE(findings(l), "") << "the inverse rotation";
}

TEST(Probe, SaysWhichConventionsTheAnswersDoNotTellApart) {
  Library l = only({"exp3_matrix"});
  columns(l);
  EXPECT_TRUE(findings(l).starts_with(
      "matrices are stored column by column, or rotation matrices are those of the inverse rotations "
      "(passive), or "
      "exp is that of the opposite argument, or rotation vectors and tangents have the opposite sign (these "
      "operations do not tell which) in exp3_matrix: "))
      << findings(l);
}

TEST(Probe, ShowsAnOperationThatNothingExplains) {
  Library l = correct();
  l["exp6"] = [f = l["exp6"]](const Numbers& x) {
    Numbers r = f(x);
    r[10] *= 1.01;
    return r;
  };
  l["momentum"] = [](const Numbers&) { return Numbers(6, std::nan("")); };
  twists_angular_first(l);
  const std::vector<Finding> found = explain(answers<double>(l));
  ASSERT_EQ(found.size(), 3u) << findings(l);
  EXPECT_TRUE(found[0].named);
  EXPECT_TRUE(found[1].sentence.starts_with("no known convention explains exp6: its R[0,0] is "))
      << findings(l);
  EXPECT_NE(found[1].sentence.find("; 9 of 9 numbers of R are wrong\n  at xi = ("), std::string::npos);
  EXPECT_NE(found[2].sentence.find("is nan, and "), std::string::npos) << findings(l);
  EXPECT_NE(found[2].sentence.find("; 3 of 3 numbers of "), std::string::npos) << findings(l);
  EXPECT_FALSE(found[2].named);
}

TEST(Probe, SaysInTwoShortLinesWhatIsWrongOfALargeMatrix) {
  Library l = only({"inertia_matrix", "left_jacobian6", "act_inertia"});
  for (auto& [name, f] : l)
    f = [f = f](const Numbers& x) {
      Numbers r = f(x);
      for (std::size_t i = 0; i < r.size(); ++i) r[i] = r[i] * r[i] + static_cast<double>(i % 7);
      return r;
    };
  for (const Finding& found : explain(answers<double>(l))) {
    EXPECT_EQ(std::ranges::count(found.sentence, '\n'), 1) << found.sentence;
    EXPECT_LT(found.sentence.size(), 260u) << found.sentence;
  }
}

/// The right result, rounded to double; what is below 1e-15 is 0, as in a matrix that is made of 0 and 1.
Numbers right(const char* operation, const Numbers& arguments) {
  Numbers all;
  for (const oracles::Real& x :
       exact_result(operation_named(operation), {arguments.begin(), arguments.end()}))
    all.push_back(std::fabs(static_cast<double>(x)) < 1e-15 ? 0 : static_cast<double>(x));
  return all;
}

TEST(Reference, EulerAnglesGiveTheRotationBackInEveryOrderAndAtGimbalLock) {
  const double pi = std::acos(-1.0);
  for (int order = 0; order < 24; ++order)
    for (const double b : {0.0, pi / 2, -pi / 2, pi, 0.7, -1.1, 1e-9, pi / 2 - 1e-9, pi - 1e-9})
      for (const double a : {0.0, 0.4, -2.0, pi / 2})
        for (const double c : {0.0, 1.3, pi}) {
          const double number = order;
          Numbers R = right("euler_to_matrix", {number, a, b, c}), x{number};
          x.insert(x.end(), R.begin(), R.end());
          const Numbers angles = right("euler_from_matrix", x);
          const Numbers back = right("euler_to_matrix", {number, angles[0], angles[1], angles[2]});
          for (std::size_t i = 0; i < 9; ++i)
            ASSERT_NEAR(back[i], R[i], 1e-14) << order << ": " << a << " " << b << " " << c;
          const bool proper = order >= 12;  // the first axis is also the last
          EXPECT_LE(std::fabs(angles[1] - (proper ? pi / 2 : 0)), pi / 2) << order;
        }
}

TEST(Reference, OppositeDirectionsHaveARotation) {
  for (const Numbers& a : {Numbers{1, 0, 0}, Numbers{0, 0, 1}, Numbers{0.6, 0, 0.8}}) {
    const Numbers Q = right("rotation_between", {a[0], a[1], a[2], -a[0], -a[1], -a[2]});
    const Numbers b = right("rotate_point", {Q[0], Q[1], Q[2], Q[3], a[0], a[1], a[2]});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(b[i], -a[i], 1e-14);
  }
}

}  // namespace
}  // namespace liecheck::properties::conventions
