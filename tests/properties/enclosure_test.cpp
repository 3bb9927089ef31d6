// The slow oracle lies where interval arithmetic proves the exact value to be.
//
// Inputs: the project's generators in float, double and float128, as many for each band of angles, and directed ones
// where no generator goes. The seed is LIECHECK_SEED, or 42.

#include <generators/bands.hpp>
#include <generators/rotations.hpp>
#include <cstdlib>
#include <iomanip>
#include <oracles/closed.hpp>
#include <oracles/exp.hpp>
#include <oracles/integrate.hpp>
#include <oracles/jacobians.hpp>
#include <set>
#include <sstream>

#include "enclosure_ledger.hpp"
#include "enclosure_se3.hpp"

namespace liecheck::enclosures {
namespace {

using namespace oracles;
using boost::multiprecision::float128;

/// The oracle claims 1e-41 as confirmed (agree.hpp), and its numbers are of 168 bits: one rounding of a value that is
/// right at 100 digits is 2^-168 = 2.7e-51. Of each block, relative to the scale that its header names.
constexpr double claim = 1e-50;
/// What a planted error is larger by: the 49th digit is wrong.
constexpr double wrong = 10;

/// The same of the closed forms at 100 digits: 334 bits, of which a large angle takes two digits for each of its own,
/// and so does the distance d to 2 pi k: 1e-98 (theta / d)^2.
double claim_at_100_digits(const Real& theta) {
  if (theta < 1) return 1e-98;
  const Real turn = 2 * boost::math::constants::pi<Real>(), turns = round(Real(theta / turn));
  const Real d = turns == 0 ? theta : abs(Real(theta - turns * turn)), loss = d < 1 ? Real(theta / d) : theta;
  return 1e-98 * static_cast<double>(Real(loss * loss));
}

template <int N>
std::string text(const char* name, const Vec<N>& v) {
  std::ostringstream s;
  s << name << " =";
  for (int i = 0; i < N; ++i) s << " " << std::setprecision(36) << v[i];
  return s.str();
}

template <class T>
class Checks {
 public:
  explicit Checks(Ledger& ledger) : ledger_(ledger) {}

  void exp(const Vec6<>& xi) {
    const ExpResult r = exp_se3(xi);
    if (!r.resolved) ledger_.unresolved("exp");
    const Exp<T> e = enclosures::exp<T>(point<T>(xi));
    near("exp Q", e.Q, r.Q, T(1));
    if (r.theta <= Real(3.14159)) near("exp vector of Q", V3<T>(e.Q.template head<3>()), head3(r.Q));
    near("exp R", e.R, r.R, T(1));
    near("exp p", e.p, r.p);
    const UnitPose<Real100> closed = closed_exp(cast<Real100>(xi));
    const double digits = claim_at_100_digits(r.theta);
    near("exp Q at 100 digits", e.Q, closed.Q, T(1), digits);
    near("exp p at 100 digits", e.p, closed.p, T(0), digits);
  }

  void jacobians(const Vec6<>& xi) {
    const V6<T> x = point<T>(xi);
    const Blocks<T> left = left_jacobian<T>(x), right = left_jacobian<T>(-x);
    blocks("left_jacobian", left, left_jacobian_se3(xi));
    blocks("right_jacobian", right, right_jacobian_se3(xi));
    blocks("right_jacobian_fd", right, right_jacobian_fd(xi));
    rotations("left_jacobian_so3", left, left_jacobian_so3(tail3(xi)));
    rotations("right_jacobian_so3", right, right_jacobian_so3(tail3(xi)));
    const JacobianBlocks<Real100> J = closed_left_jacobian(cast<Real100>(xi)),
                                  K = closed_left_jacobian_inverse(cast<Real100>(xi));
    const M3<T> approximate = point<T>(K.J);
    const Blocks<T> left_inverse = inverse<T>(left, approximate),
                    right_inverse = inverse<T>(right, approximate.transpose());
    blocks("left_jacobian_inverse", left_inverse, left_jacobian_se3_inverse(xi));
    blocks("right_jacobian_inverse", right_inverse, right_jacobian_se3_inverse(xi));
    rotations("left_jacobian_so3_inverse", left_inverse, left_jacobian_so3_inverse(tail3(xi)));
    rotations("right_jacobian_so3_inverse", right_inverse, right_jacobian_so3_inverse(tail3(xi)));
    const double digits = claim_at_100_digits(norm(tail3(xi)));
    near("left_jacobian J at 100 digits", left.J, J.J, T(0), digits);
    near("left_jacobian C at 100 digits", left.C, J.C, T(0), digits);
    near("left_jacobian_inverse J at 100 digits", left_inverse.J, K.J, T(0), digits);
    near("left_jacobian_inverse C at 100 digits", left_inverse.C, K.C, T(0), digits);
  }

  void log(const Quaternion<>& Q, const Vec3<>& p) {
    const Q4<T> q = point<T>(Q);
    const V3<T> t = point<T>(p);
    logs("log", log_se3(Q, p), enclosures::log<T>(q, t), enclosures::log<T>(q, t, true));
  }

  void log(const Mat3<>& R, const Vec3<>& p) {
    const NearestRotation r = nearest_rotation(R);
    if (!r.resolved) ledger_.unresolved("nearest_rotation");
    const Q4<T> q = nearest<T>(point<T>(R), point<T>(r.Q));
    near("nearest_rotation R", M3<T>(rotation<T>(q)), r.R, T(1));
    const V3<T> t = point<T>(p);
    logs("log of a matrix", log_se3_matrix(R, p), enclosures::log<T>(q, t), enclosures::log<T>(q, t, true));
  }

  void integrate(const Vec7<>& q, const Vec6<>& delta) {
    const IntegrateResult r = oracles::integrate(q, delta);
    if (!r.resolved) ledger_.unresolved("integrate");
    const Exp<T> e = enclosures::integrate<T>(point<T>(q), point<T>(delta));
    near("integrate Q", e.Q, r.Q, T(1));
    const Real from = norm(head3(q));
    near("integrate p", e.p, r.p, point<T>(from > r.increment_norm ? from : r.increment_norm));
    blocks("d_integrate ARG0", adjoint_of_inverse<T>(point<T>(delta)), d_integrate_arg0(q, delta));
    blocks("d_integrate ARG1", left_jacobian<T>(-point<T>(delta)), d_integrate_arg1(q, delta));
  }

  void difference(const Vec7<>& q0, const Vec7<>& q1) {
    const DifferenceResult r = oracles::difference(q0, q1);
    const V7<T> a = point<T>(q0), b = point<T>(q1);
    const Log<T> l = enclosures::difference<T>(a, b);
    logs("difference", r, l, enclosures::difference<T>(a, b, true));
    V6<T> delta;
    delta << l.rho, l.phi;
    const Blocks<T> J = left_jacobian<T>(delta);
    const M3<T> K = point<T>(closed_left_jacobian_inverse(cast<Real100>(r.value())).J);
    const Blocks<T> left = inverse<T>(J, K);
    blocks("d_difference ARG0", {-left.J, -left.C}, d_difference_arg0(q0, q1));
    blocks("d_difference ARG1", inverse<T>(left_jacobian<T>(-delta), K.transpose()), d_difference_arg1(q0, q1));
  }

 private:
  template <int R, int C, class V>
  void near(const std::string& what, const Eigen::Matrix<T, R, C>& exact, const V& value, const T& scale = T(0),
            double claimed = claim) {
    ledger_.check<T, R, C>(what, exact, point<T>(value), claimed, wrong * claimed, scale);
  }
  void blocks(const std::string& what, const Blocks<T>& exact, const Jacobian6Result& r) {
    if (!r.resolved) ledger_.unresolved(what);
    near(what + " J", exact.J, r.J);
    near(what + " C", exact.C, r.C);
  }
  void rotations(const std::string& what, const Blocks<T>& exact, const Jacobian3Result& r) {
    if (!r.resolved) ledger_.unresolved(what);
    near(what, exact.J, r.J);
  }
  void logs(const std::string& what, const LogResult& r, const Log<T>& exact, const Log<T>& other) {
    if (!r.resolved) ledger_.unresolved(what);
    // At half a turn either axis is right, and which is `other` depends on how w was rounded
    const V3<T> phi = point<T>(r.phi);
    const bool swapped = r.at_pi && upper(T(phi.dot(exact.phi))) < 0;
    const Log<T>&first = swapped ? other : exact, &second = swapped ? exact : other;
    near(what + " phi", first.phi, r.phi);
    near(what + " rho", first.rho, r.rho);
    near(what + " theta", scalar(first.theta), Vec<1>{{r.theta}});
    const auto left = scalar(first.pi_minus_theta);
    if (!r.at_pi) return near(what + " pi - theta", left, Vec<1>{{r.pi_minus_theta}});
    near(what + " pi - theta at pi", left, Vec<1>{{r.pi_minus_theta}}, T(1), 2e-60);
    near(what + " other phi", second.phi, tail3(r.other));
    near(what + " other rho", second.rho, head3(r.other));
  }
  static Eigen::Matrix<T, 1, 1> scalar(const T& x) { return Eigen::Matrix<T, 1, 1>::Constant(x); }

  Ledger& ledger_;
};

std::uint64_t seed() {
  const char* text = std::getenv("LIECHECK_SEED");
  return text ? std::strtoull(text, nullptr, 0) : 42;
}

constexpr int per_band = 3;

/// Inputs of `draw`, at most `per_band` of each band of their exact `angle` [rad]. Every band comes up (with the seed
/// that is fixed) from `lowest` to pi, or beyond.
template <class S, class Draw, class Angle, class Use>
void in_every_band(std::uint64_t series, std::uint64_t draws, const Real& lowest, bool beyond, Draw&& draw, Angle&& angle,
                   Use&& use) {
  const auto& bands = properties::Bands::of<S>();
  std::vector<int> count(bands.all().size());
  for (std::uint64_t i = 0; i < draws; ++i) {
    properties::Source source({seed(), series, static_cast<std::uint64_t>(std::numeric_limits<S>::digits), i});
    const auto x = draw(source);
    if (++count[bands.classify(angle(x))] <= per_band) use(x);
  }
  if (seed() != 42) return;
  for (std::size_t b = 1; b < count.size(); ++b) {
    const bool reached = bands[b].region == properties::Region::to_pi
                             ? bands[b].axis != properties::Axis::theta || Real(bands[b].low) >= lowest
                             : beyond;
    EXPECT_TRUE(count[b] > 0 || !reached) << bands[b].name;
  }
}

template <class S>
Vec6<> draw_twist(properties::Source& s) {
  const Vec3<> rho = exact_vector<3>(properties::vector3<S>(s));
  return stack(rho, exact_vector<3>(properties::rotation_vector<S>(s, properties::AngleRange::unbounded)));
}
template <class S>
Vec7<> configuration(const Eigen::Matrix<S, 3, 1>& p, const Eigen::Matrix<S, 4, 1>& Q) {
  Eigen::Matrix<S, 7, 1> q;
  q << p, Q;
  return exact_vector<7>(q);
}
Real angle_of_quaternion(const Quaternion<>& Q) {
  return 2 * atan2(norm(head3(Q)), Real(abs(Q[3])));
}

template <class S>
class Enclosure : public testing::Test {
 protected:
  void TearDown() override { ledger_.print(); }
  using T = Interval<180>;
  Ledger ledger_;
  Checks<T> checks_{ledger_};
};
using Scalars = testing::Types<float, double, float128>;
TYPED_TEST_SUITE(Enclosure, Scalars);

TYPED_TEST(Enclosure, HoldsExpAndJacobiansOfTwistsInEveryBand) {
  in_every_band<TypeParam>(
      1, 100000, Real(0), true, draw_twist<TypeParam>, [](const Vec6<>& xi) { return norm(tail3(xi)); },
      [this](const Vec6<>& xi) {
        this->ledger_.input = text("xi", xi);
        this->checks_.exp(xi);
        this->checks_.jacobians(xi);
      });
}

struct StoredPose {
  Quaternion<> Q;
  Mat3<> R;
  Vec3<> p;
};

TYPED_TEST(Enclosure, HoldsLogOfQuaternionsAndMatricesInEveryBand) {
  using S = TypeParam;
  in_every_band<S>(
      2, 20000, Real(std::numeric_limits<S>::epsilon()), false,
      [](properties::Source& s) -> StoredPose {
        const Eigen::Matrix<S, 4, 1> Q = properties::unit_quaternion<S>(s);
        const Vec3<> p = exact_vector<3>(properties::vector3<S>(s));
        return {exact_vector<4>(Q), exact_matrix<3, 3>(properties::rotation_matrix<S>(Q)), p};
      },
      [](const StoredPose& x) { return angle_of_quaternion(x.Q); },
      [this](const StoredPose& x) {
        this->ledger_.input = text("Q", x.Q) + text("\nR", Vec<9>{x.R.x}) + text("\np", x.p);
        this->checks_.log(x.Q, x.p);
        this->checks_.log(x.R, x.p);
      });
}

TYPED_TEST(Enclosure, HoldsIntegrateAndItsDerivativesInEveryBand) {
  using S = TypeParam;
  struct Step {
    Vec7<> q;
    Vec6<> delta;
  };
  in_every_band<S>(
      3, 20000, Real(1e-30), true,
      [](properties::Source& s) -> Step {
        const Eigen::Matrix<S, 3, 1> p = properties::vector3<S>(s);
        return {configuration<S>(p, properties::unit_quaternion<S>(s)), draw_twist<S>(s)};
      },
      [](const Step& x) { return norm(tail3(x.delta)); },
      [this](const Step& x) {
        this->ledger_.input = text("q", x.q) + text("\ndelta", x.delta);
        this->checks_.integrate(x.q, x.delta);
      });
}

TYPED_TEST(Enclosure, HoldsDifferenceAndItsDerivativesInEveryBand) {
  using S = TypeParam;
  struct Pair {
    Vec7<> q0, q1;
  };
  in_every_band<S>(
      4, 20000, Real(std::numeric_limits<S>::epsilon()), false,
      [](properties::Source& s) -> Pair {
        const Eigen::Matrix<S, 3, 1> p0 = properties::vector3<S>(s), p1 = properties::point_near<S>(s, p0);
        const Eigen::Matrix<S, 4, 1> Q0 = properties::unit_quaternion<S>(s);
        return {configuration<S>(p0, Q0), configuration<S>(p1, properties::quaternion_near<S>(s, Q0))};
      },
      [](const Pair& x) {
        const auto Q = relative_pose(cast<Real100>(x.q0), cast<Real100>(x.q1)).Q;
        return angle_of_quaternion(cast<Real>(Q));
      },
      [this](const Pair& x) {
        this->ledger_.input = text("q0", x.q0) + text("\nq1", x.q1);
        this->checks_.difference(x.q0, x.q1);
      });
}

}  // namespace
}  // namespace liecheck::enclosures
