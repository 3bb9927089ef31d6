// The oracles' results are compared with intervals that are proved to contain the exact values.
//
// The inputs are those of the project's generators in float and double, at most `per_band` for
// each band of angles, and chosen inputs outside the generators' range. The seed is LIECHECK_SEED, or 42.

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <generators/angle_bands.hpp>
#include <generators/rotations.hpp>
#include <iomanip>
#include <sstream>

#include "enclosure_checks.hpp"

namespace liecheck::enclosures {
namespace {

template <int N>
std::string text(const char* name, const Vec<N>& v) {
  std::ostringstream s;
  s << name << " =";
  for (int i = 0; i < N; ++i) s << " " << std::setprecision(36) << v[i];
  return s.str();
}

std::uint64_t seed() {
  const char* text = std::getenv("LIECHECK_SEED");
  if (!text) return 42;
  std::uint64_t value = 0;
  const char* end = text + std::strlen(text);
  if (const auto [rest, error] = std::from_chars(text, end, value); error != std::errc() || rest != end)
    throw std::invalid_argument("LIECHECK_SEED is \"" + std::string(text) +
                                "\", not a number from 0 to 2^64 - 1");
  return value;
}

constexpr int per_band = 3;

/// Draws `draws` inputs x with `draw` and sorts them into bands by their exact angle(x) [rad]. Calls `use` on
/// at most `per_band` inputs of each band. With the default seed, every band from `lowest` to pi must have an
/// input, and every band beyond pi as well if `beyond` is true.
template <class S, class Draw, class Angle, class Use>
void in_every_band(std::uint64_t series, std::uint64_t draws, const Real& lowest, bool beyond, Draw&& draw,
                   Angle&& angle, Use&& use) {
  const auto& bands = properties::Bands::of(scalar_of<S>);
  std::vector<int> count(bands.all().size());
  for (std::uint64_t i = 0; i < draws; ++i) {
    properties::Source source(
        {seed(), series, static_cast<std::uint64_t>(std::numeric_limits<S>::digits), i});
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
  using T = Interval<180>;  // 600 bits
  Ledger ledger_;
  Checks<T> checks_{ledger_};
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Enclosure, Scalars);

TYPED_TEST(Enclosure, ContainsExpAndJacobiansOfTwistsInEveryBand) {
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

TYPED_TEST(Enclosure, ContainsLogOfQuaternionsAndMatricesInEveryBand) {
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

TYPED_TEST(Enclosure, ContainsIntegrateAndItsDerivativesInEveryBand) {
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

TYPED_TEST(Enclosure, ContainsDifferenceAndItsDerivativesInEveryBand) {
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

// ---- chosen inputs

using EnclosureInDouble = Enclosure<double>;

Vec3<> vector(double x, double y, double z) {
  return {{Real(x), Real(y), Real(z)}};
}
const std::vector<Vec3<>>& lengths() {
  static const std::vector<Vec3<>> all{vector(0, 0, 0), vector(1, -2, 0.5), vector(1e150, -3e149, 1e-150),
                                       vector(-2e-150, 1e-150, 5e-324)};
  return all;
}

TEST_F(EnclosureInDouble, ContainsExpJacobiansAndIntegrateAtExtremeAnglesAndLengths) {
  const std::vector<Real> angles{Real(0),
                                 Real("1e-4940"),
                                 Real(5e-324),
                                 Real(3e-310),
                                 Real(1e-160),
                                 Real(1),
                                 Real(3.141592653589793),
                                 Real(3.1415926535897936),
                                 Real(6.283185307179586),
                                 Real(6.283185307179587),
                                 Real(15.9),
                                 Real(16),
                                 Real(16.1),
                                 Real(1e8),
                                 Real(1e24)};
  for (const Real& theta : angles)
    for (const Vec3<>& rho : lengths())
      for (const Vec3<>& axis : {vector(0, 0, 1), vector(1, 1e-20, 0), vector(1, 1, 1)}) {
        const Vec6<> xi = stack(rho, theta * axis);
        if (norm(tail3(xi)) > 1e24) continue;  // outside the Jacobians' domain
        ledger_.input = text("xi", xi);
        checks_.exp(xi);
        checks_.jacobians(xi);
        if (theta <= 1e8)
          checks_.integrate({{Real(1e150), Real(-1), Real(5), Real(0.5), Real(-0.5), Real(1), Real(-2)}}, xi);
      }
}

/// The enclosures reduce these angles modulo 2 pi without the code that the oracles use for it.
TEST_F(EnclosureInDouble, ContainsExpOfHugeAngles) {
  using Wide = Interval<5400>;
  for (const double theta : {1e26, 1e30, 2e60, 3e99, 1e100, 1e200, 7e250, -1.7e308})
    for (const Vec3<>& rho : lengths()) {
      const Vec6<> xi = stack(rho, vector(theta, theta / 3, 1));
      ledger_.input = text("xi", xi);
      Checks<Wide>(ledger_).exp(xi);
    }
  const Vec6<> xi = stack(lengths()[1], Vec3<>{{Real("1e4900"), Real("-3e4899"), Real(0)}});
  ledger_.input = text("xi", xi);
  Checks<Wide>(ledger_).exp(xi);
}

/// A translation across the axis shrinks with the distance to 2 pi.
TEST_F(EnclosureInDouble, ContainsExpNearTwoPi) {
  for (const char* distance : {"1e-10", "-1e-20", "1e-34", "-1e-40"}) {
    const Real theta = 2 * boost::math::constants::pi<Real>() + Real(distance);
    const Vec6<> xi = stack(vector(1, -2, 0), Vec3<>{{Real(0), Real(0), theta}});
    ledger_.input = text("xi", xi);
    checks_.exp(xi);
  }
}

TEST_F(EnclosureInDouble, ContainsLogsAtThetaEqualToPiAndNearIt) {
  for (const double w : {0.0, -0.0, 5e-324, -5e-324, 1e-200, -1e-70, 1e-50, -1e-17})
    for (const Vec3<>& p : lengths())
      for (const Vec3<>& v : {vector(0.6, 0, 0.8), vector(0, -1, 0), vector(3e-310, 1, 1e-20)}) {
        const Quaternion<> Q{{v[0], v[1], v[2], Real(w)}};
        ledger_.input = text("Q", Q) + text("\np", p);
        checks_.log(Q, p);
        checks_.difference({{Real(1), Real(2), Real(-3), Real(0), Real(0), Real(0), Real(-1)}},
                           {{p[0], p[1], p[2], Q[0], Q[1], Q[2], Q[3]}});
      }
  for (int i = 0; i < 3; ++i) {
    Mat3<> R = Real(-1) * identity<3, Real>();
    R(i, i) = 1;
    ledger_.input = text("R", Vec<9>{R.x});
    checks_.log(R, lengths()[1]);
  }
}

TEST_F(EnclosureInDouble, ContainsLogsAtTheIdentityAndAtSubnormalAngles) {
  for (const double t : {0.0, 5e-324, 1e-310, 1e-160, 1e-20})
    for (const double w : {1.0, -1.0, 1 + 2.2e-16})
      for (const Vec3<>& p : lengths()) {
        const Quaternion<> Q{{Real(t), Real(0), Real(-t), Real(w)}};
        Mat3<> R = identity<3, Real>();
        R(1, 1) = abs(Real(w));
        R(0, 1) = Real(t);
        R(1, 0) = Real(-t);
        ledger_.input = text("Q", Q) + text("\nR", Vec<9>{R.x}) + text("\np", p);
        checks_.log(Q, p);
        checks_.log(R, p);
        checks_.difference({{p[0], p[1], p[2], Q[0], Q[1], Q[2], Q[3]}},
                           {{p[0], p[1], Real(1), Q[0], Q[1], Q[2], -Q[3]}});
        checks_.difference({{p[0], p[1], p[2], Real(0), Real(0.6), Real(0), Real(0.8)}},
                           {{p[0], p[1] + Real(t), p[2], Real(t), Real(0.6), Real(0), Real(0.8)}});
      }
}

// ---- the enclosures themselves

/// sum_j A^j / (j + 1)!, with the remainder bounded by a geometric series of Frobenius norms.
template <class T, int N>
Eigen::Matrix<T, N, N> phi1(const Eigen::Matrix<T, N, N>& A) {
  using M = Eigen::Matrix<T, N, N>;
  const auto frobenius = [](const M& m) { return T(sqrt(T(m.cwiseProduct(m).sum()))); };
  M sum = M::Identity(), term = sum;
  for (int j = 1;; ++j) {
    term = term * A / T(j + 1);
    sum += term;
    const T ratio = frobenius(A) / (j + 2);
    if (upper(ratio) < 0.5 && exponent(frobenius(term)) < -600)
      return sum + M::Constant(around_zero(T(frobenius(term) * ratio / (1 - ratio))));
  }
}

template <class T, int R, int C>
void expect_overlap(const Eigen::Matrix<T, R, C>& a, const Eigen::Matrix<T, R, C>& b, const char* what) {
  for (int i = 0; i < R * C; ++i) {
    const T d = a(i) - b(i);
    EXPECT_TRUE(lower(d) <= 0 && upper(d) >= 0) << what << i;
    EXPECT_LT(exponent(d), -500) << what << i;
  }
}

TEST_F(EnclosureInDouble, OverlapsThePowerSeriesOfExpAndOfTheLeftJacobian) {
  // The enclosures of c_k use another formula from theta = 16 on.
  for (const double theta : {0.0, 1e-3, 0.5, 3.0, 6.3, 15.5, 16.5, 30.0}) {
    const V6<T> xi = point<T>(stack(vector(1, -2, 3), vector(theta * 0.6, 0, theta * 0.8)));
    const V3<T> rho = xi.head<3>(), phi = xi.tail<3>();
    Eigen::Matrix<T, 4, 4> A = Eigen::Matrix<T, 4, 4>::Zero();
    A.topLeftCorner<3, 3>() = hat<T>(phi);
    A.topRightCorner<3, 1>() = rho;
    const Eigen::Matrix<T, 4, 4> E = Eigen::Matrix<T, 4, 4>::Identity() + A * phi1<T, 4>(A);
    Eigen::Matrix<T, 6, 6> ad = Eigen::Matrix<T, 6, 6>::Zero();
    ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = hat<T>(phi);
    ad.topRightCorner<3, 3>() = hat<T>(rho);
    const Eigen::Matrix<T, 6, 6> J = phi1<T, 6>(ad);
    const Exp<T> e = enclosures::exp<T>(xi);
    const Blocks<T> b = left_jacobian<T>(xi);
    expect_overlap<T, 3, 3>(e.R, E.topLeftCorner<3, 3>(), "R");
    expect_overlap<T, 3, 1>(e.p, E.topRightCorner<3, 1>(), "p");
    expect_overlap<T, 3, 3>(rotation<T>(e.Q), e.R, "Q");
    expect_overlap<T, 3, 3>(b.J, J.topLeftCorner<3, 3>(), "J");
    expect_overlap<T, 3, 3>(b.C, J.topRightCorner<3, 3>(), "C");
    if (theta > 3.1) continue;
    const Log<T> l = enclosures::log<T>(e.Q, e.p);
    expect_overlap<T, 3, 1>(l.phi, phi, "phi");
    expect_overlap<T, 3, 1>(l.rho, rho, "rho");
    expect_overlap<T, 3, 3>(rotation<T>(nearest<T>(e.R, e.Q)), e.R, "nearest");
  }
}

TEST_F(EnclosureInDouble, ThrowsIfAResultCannotBeEnclosed) {
  const V3<T> p = point<T>(vector(1, 2, 3));
  const T wide = around_zero(T(1));
  EXPECT_THROW(enclosures::log<T>({T(1), T(0), T(0), wide}, p), Undecided);
  EXPECT_THROW(angle_of<T>(wide + 1, T(1)), Undecided);
  const M3<T> I = M3<T>::Identity();
  EXPECT_THROW(nearest<T>(-I, {T(0), T(0), T(0), T(1)}), Undecided);
  EXPECT_THROW(inverse<T>({I, I}, -I), Undecided);
}

}  // namespace
}  // namespace liecheck::enclosures
