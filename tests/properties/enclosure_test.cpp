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

constexpr double claim = 1e-41, wrong = 1e-40;
constexpr double claim100 = 1e-90, wrong100 = 1e-89;

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
    near100("exp Q", e.Q, closed.Q, T(1));
    near100("exp p", e.p, closed.p);
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
    near100("left_jacobian J", left.J, J.J);
    near100("left_jacobian C", left.C, J.C);
    near100("left_jacobian_inverse J", left_inverse.J, K.J);
    near100("left_jacobian_inverse C", left_inverse.C, K.C);
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
  void near(const std::string& what, const Eigen::Matrix<T, R, C>& exact, const V& value, const T& scale = T(0)) {
    ledger_.check<T, R, C>(what, exact, point<T>(value), claim, wrong, scale);
  }
  template <int R, int C, class V>
  void near100(const std::string& what, const Eigen::Matrix<T, R, C>& exact, const V& value, const T& scale = T(0)) {
    ledger_.check<T, R, C>(what + " at 100 digits", exact, point<T>(value), claim100, wrong100, scale);
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
    near(what + " phi", exact.phi, r.phi);
    near(what + " rho", exact.rho, r.rho);
    near(what + " theta", scalar(exact.theta), Vec<1>{{r.theta}});
    near(what + " pi - theta", scalar(exact.pi_minus_theta), Vec<1>{{r.pi_minus_theta}}, T(1e-60));
    if (!r.at_pi) return;
    near(what + " other phi", other.phi, tail3(r.other));
    near(what + " other rho", other.rho, head3(r.other));
  }
  static Eigen::Matrix<T, 1, 1> scalar(const T& x) { return Eigen::Matrix<T, 1, 1>::Constant(x); }

  Ledger& ledger_;
};

std::uint64_t seed() {
  const char* text = std::getenv("LIECHECK_SEED");
  return text ? std::strtoull(text, nullptr, 0) : 42;
}

constexpr int per_band = 3, draws = 20000;

/// Inputs of `draw` until every band has `per_band`; `take` uses one and returns its exact angle [rad].
template <class S, class Draw, class Angle, class Use>
void in_every_band(std::uint64_t series, const std::set<std::string>& absent, Draw&& draw, Angle&& angle,
                   Use&& use) {
  const auto& bands = properties::Bands::of<S>();
  std::vector<int> count(bands.all().size());
  for (std::uint64_t i = 0; i < draws; ++i) {
    properties::Source source({seed(), series, static_cast<std::uint64_t>(std::numeric_limits<S>::digits), i});
    const auto x = draw(source);
    if (++count[bands.classify(angle(x))] <= per_band) use(x);
  }
  for (std::size_t b = 1; b < count.size(); ++b)
    if (!absent.contains(bands[b].name)) {
      EXPECT_GE(count[b], per_band) << bands[b].name;
    }
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
      1, {},
      [](properties::Source& s) {
        const Vec3<> rho = exact_vector<3>(properties::vector3<TypeParam>(s));
        return stack(rho, exact_vector<3>(
                              properties::rotation_vector<TypeParam>(s, properties::AngleRange::unbounded)));
      },
      [](const Vec6<>& xi) { return norm(tail3(xi)); },
      [this](const Vec6<>& xi) {
        this->ledger_.input = text("xi", xi);
        this->checks_.exp(xi);
        this->checks_.jacobians(xi);
      });
}

}  // namespace
}  // namespace liecheck::enclosures
