// integrate and difference of free-flyer configurations are compared with their oracles. They must also be
// local inverses of each other; difference(q, integrate(q, d)) is compared with d only up to theta = pi.

#include <generators/rotations.hpp>
#include <invariants/increments.hpp>

namespace liecheck::properties {
namespace {

class IntegrateDifference final : public Law<IntegrateDifference> {
 public:
  static constexpr Statement stated{
      .name = "integrate_difference",
      .law = "integrate and difference are exact, and local inverses in both directions",
      .equation =
          "integrate(q, d) = T exp(d); difference(q0, q1) = log(T0^-1 T1); difference(q, integrate(q, d)) = "
          "d for |phi| < pi; integrate(q0, difference(q0, q1)) = q1 as poses",
      .source = "Sola, Deray & Atchuthan 2018, eqs. 25-28",
      .outputs = {op::integrate[block::rotation], op::integrate[block::translation],
                  op::integrate[block::norm_defect], op::difference[block::rotation_vector],
                  op::difference[block::linear], op::difference_of_integrate[block::rotation_vector],
                  op::difference_of_integrate[block::linear], op::integrate_of_difference[block::rotation],
                  op::integrate_of_difference[block::translation]},
      .fields = {{"p0", Kind::vector, 3, "m", Reach::full},
                 {"Q0", Kind::quaternion, 4, "1"},
                 {"p1", Kind::vector, 3, "m", Reach::beside},
                 {"Q1", Kind::quaternion, 4, "1", Reach::beside},
                 {"rho", Kind::vector, 3, "m", Reach::full},
                 {"phi", Kind::rotation_vector, 3, "rad", Reach::full}},
      .formed = {{&op::difference_of_integrate, {&op::integrate, &op::difference}},
                 {&op::integrate_of_difference, {&op::integrate, &op::difference}}}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto p0 = vector3<S>(source);
    const auto Q0 = unit_quaternion<S>(source);
    return Joined<S>{p0,
                     Q0,
                     point_near<S>(source, p0),
                     quaternion_near<S>(source, Q0),
                     vector3<S>(source),
                     rotation_vector<S>(source, AngleRange::unbounded)};
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    Reader read(input);
    const Vec<double, 7> q0 = read.take<7>(), q1 = read.take<7>();
    const Vec<double, 6> d = read.take<6>();
    const auto x0 = exact_vector<7, Real>(q0), x1 = exact_vector<7, Real>(q1);
    const auto xd = exact_vector<6, Real>(d);
    const Bands& bands = Bands::of(r.scalar());

    if (o[op::integrate]) {
      const Vec<double, 7> q = o[op::integrate](q0, d);
      const std::size_t band = band_of_angle(r.scalar(), tail3(xd));
      const auto exact = record_integrate(r,
                                          {op::integrate[block::rotation], op::integrate[block::translation],
                                           op::integrate[block::norm_defect]},
                                          band, q, x0, xd);
      if (o[op::difference]) {
        const bool beyond =
            bands[band].region == Region::beyond_pi;  // then difference returns a shorter delta
        if (beyond || !all_finite(q) || !exact.resolved)
          without_value(r, op::difference_of_integrate, band, !all_finite(q), beyond);
        else
          back(r, o[op::difference](q0, q), xd, x0, exact_vector<7, Real>(q), band);
      }
    }
    if (o[op::difference]) {
      const Vec<double, 6> v = o[op::difference](q0, q1);
      const auto exact = oracles::difference(x0, x1);
      const std::size_t band = band_of_difference(r.scalar(), x0, x1, exact);
      record_difference(r, {op::difference[block::rotation_vector], op::difference[block::linear]}, band, v,
                        exact, x0, x1);
      if (o[op::integrate] && (!all_finite(v) || !exact.resolved)) {
        without_value(r, op::integrate_of_difference, band, !all_finite(v), false);
      } else if (o[op::integrate]) {
        const Vec<double, 7> q = o[op::integrate](q0, v);
        Quaternion<Real> Q1 = quaternion<Real>(q1);
        const Real n = norm(Q1);
        for (Real& c : Q1.x) c /= n;
        constexpr Output rotation = op::integrate_of_difference[block::rotation],
                         translation = op::integrate_of_difference[block::translation];
        judged_value(r, {rotation, translation}, band, q, true, [&] {
          const Real scale =
              largest(norm(exact_vector<3, Real>(q1)), norm(exact_vector<3, Real>(q0)), exact.separation);
          r.record(rotation, band, rotation_error(r.scalar(), quaternion<Real>(q), Q1));
          r.record(translation, band,
                   vector_error(r.scalar(), exact_vector<3, Real>(q), exact_vector<3, Real>(q1), scale));
        });
      }
    }
  }

 private:
  /// Records for both blocks of a round trip why they have no error.
  static void without_value(Recorder& r, const Operation& round_trip, std::size_t band, bool broken,
                            bool undetermined) {
    for (const Block& b : round_trip.blocks)
      r.outcome({round_trip.name, b.name.text, &round_trip, &b}, band,
                undetermined ? Outcome::ill_posed
                : broken     ? Outcome::not_finite
                             : Outcome::unresolved);
  }
  template <class Real>
  static oracles::Quaternion<Real> quaternion(const Vec<double, 7>& q) {
    return oracles::exact_vector<4, Real>(q.tail<4>());
  }
  template <class Real>
  static Real largest(const Real& a, const Real& b, const Real& c) {
    return oracles::larger(oracles::larger(a, b), c);
  }

  /// Compares difference(q, integrate(q, d)) with d. The rounding of the intermediate configuration is part
  /// of the error, so kappa is that of difference at that configuration.
  template <class Real>
  static void back(Recorder& r, const Vec<double, 6>& v, const oracles::Vec6<Real>& xd,
                   const oracles::Vec<7, Real>& x0, const oracles::Vec<7, Real>& xq, std::size_t band) {
    using namespace oracles;
    constexpr Output angular = op::difference_of_integrate[block::rotation_vector],
                     linear = op::difference_of_integrate[block::linear];
    if (!all_finite(v)) return judged_value(r, {angular, linear}, band, v, true, [] {});
    const auto xv = exact_vector<6, Real>(v);
    const auto at = oracles::difference(x0, xq);
    // If the rounding of q moved theta across pi, the exact result has the opposite axis.
    // integrate_of_difference measures that case.
    Real along(0);
    for (int i = 3; i < 6; ++i) along += xv[i] * xd[i];
    if (at.pi_minus_theta < Real(64 * static_cast<double>(r.scalar().epsilon)) && along < 0)
      return without_value(r, op::difference_of_integrate, band, false, true);
    // The quaternions affect both blocks. Their entries are known to eps of the norm 1, so the arguments are
    // factors of 1, whose changes are added. The positions affect only rho, which is linear in p1 - p0.
    const auto kappa = sensitivity<Real>(
        [&](const std::vector<Real>& factors) {
          oracles::Vec<7, Real> from = x0, to = xq;
          for (int i = 0; i < 4; ++i) {
            const auto k = static_cast<std::size_t>(i);
            from[3 + i] += factors[k] - Real(1), to[3 + i] += factors[4 + k] - Real(1);
          }
          return to_list(closed_difference(from, to));
        },
        [] { return std::vector<Real>(8, Real(1)); }, {{0, 3}, {3, 3}});
    const auto movement_of_positions = [&] {
      oracles::Vec<7, Real> from = x0, to = xq;
      Real sum(0);
      for (int i = 0; i < 3; ++i) from[i] = Real(0), to[i] = Real(0);
      for (int i = 0; i < 3; ++i) {
        to[i] = Real(1);
        sum += (abs(x0[i]) + abs(xq[i])) * norm(head3(closed_difference(from, to)));
        to[i] = Real(0);
      }
      return sum;
    };
    const Real rho = norm(head3(xd)), phi = norm(tail3(xd));
    r.record(angular, band, vector_error(r.scalar(), tail3(xv), tail3(xd)),
             [&] { return kappa.kappa(1, larger(phi, Real(r.scalar().least_denominator()))); });
    const Real scale = larger(rho, at.separation);
    // M = J^-1 R^T shortens no vector. So the term sum_i |x_i| ||M e_i|| of kappa is at least sum_i |x_i|.
    double moved = 0;
    for (int i = 0; i < 3; ++i) moved += at_most(x0[i]) + at_most(xq[i]);
    const Real by = larger(scale, Real(r.scalar().least_denominator()));
    const auto kappa_linear = [&] {
      return condition_number<Real>(kappa.movement(0) + movement_of_positions(), by);
    };
    r.record(linear, band, vector_error(r.scalar(), head3(xv), head3(xd), scale),
             Kappa(kappa_linear, 0.99 * moved / at_most(by)));
  }
};

const RegisteredProperty<IntegrateDifference> registered_integrate_difference;

}  // namespace
}  // namespace liecheck::properties
