#pragma once
// The errors of integrate(q0, delta) and of its derivatives for a free-flyer, alone or as the base of a robot.

#include <invariants/branch.hpp>
#include <oracles/ball_oracles.hpp>
#include <oracles/closed_forms.hpp>
#include <oracles/integrate.hpp>

namespace liecheck::properties {

/// Records the errors of q1 = integrate(q0, delta), and returns the exact value. `outputs`: rotation,
/// translation, norm defect.
template <class T>
oracles::IntegrateValue<T> record_integrate(Recorder& r, const std::array<Output, 3>& outputs,
                                            std::size_t band, const Vec<double, 7>& q1,
                                            const oracles::Vec7<T>& q0, const oracles::Vec6<T>& delta) {
  using namespace oracles;
  const auto exact = oracles::integrate(q0, delta);
  const auto& [rotation, translation, defect] = outputs;
  const T scale = larger(larger(norm(exact.p), norm(head3(q0))), exact.increment_norm);
  const auto kappa = sensitivity<T>(
      [](const std::vector<T>& v) {
        const auto pose = closed_integrate(from_list<7>(v), from_list<6>(v, 7));
        return to_list(pose.p, pose.Q);
      },
      [&] { return to_list(q0, delta); }, {{0, 3}, {3, 4}});
  judged_value(r, {rotation, translation, defect}, band, q1, exact.resolved, [&] {
    const auto got = exact_vector<7, T>(q1);
    r.record(rotation, band, rotation_error(r.scalar(), quaternion_of(got), exact.Q),
             [&] { return kappa.kappa(1, T(1) / T(2)); });
    r.record(translation, band, vector_error(r.scalar(), head3(got), exact.p, scale),
             [&] { return kappa.kappa(0, scale); });
    r.record(defect, band, norm_defect(r.scalar(), quaternion_of(got)));
  });
  return exact;
}

/// Records how far Q1 is on the side of -Q0: max(0, -Q0 . Q1). Near 0 either sign is right, up to rounding. Ordinary
/// code may choose it in another way: that of the product Q0 exp(phi/2), w >= 0, or that of a conversion.
template <class T>
void record_sign(Recorder& r, const Output& output, std::size_t band, const Vec<double, 4>& Q0,
                 const Vec<double, 4>& Q1) {
  if (!oracles::all_finite(Q1)) return r.outcome(output, band, Outcome::not_finite);
  if (r.ordinary(output)) return r.record(output, band, 0);
  T product(0);
  for (int i = 0; i < 4; ++i) product += oracles::exact<T>(Q0[i]) * oracles::exact<T>(Q1[i]);
  r.record(output, band, oracles::in_eps(r.scalar(), oracles::larger(T(-product), T(0))));
}

/// Records the blocks of a derivative of integrate. kappa is that of `blocks` at the increment.
template <class T, class Blocks>
void record_by_increment(Recorder& r, const TwoOutputs& outputs, const oracles::Vec6<T>& delta,
                         const Mat<double, 6>& J, const oracles::Jacobian6Value<T>& exact,
                         const Blocks& blocks) {
  using namespace oracles;
  const std::size_t band = band_of_angle(r.scalar(), tail3(delta));
  const bool beyond = Bands::of(r.scalar())[band].region == Region::beyond_pi;
  const auto kappa = sensitivity<T>([&](const std::vector<T>& v) { return blocks(from_list<6>(v)); },
                                    [&] { return to_list(delta); }, {{0, 9}, {9, 9}});
  const T rho = norm(head3(delta)), n = norm(exact.J), least = rho * smaller(n, T(1));
  record_jacobian6(
      r, outputs, band, J, exact, rho, beyond, [&] { return kappa.kappa(0, n); },
      [&] { return kappa.kappa(1, larger(T(norm(exact.C)), least)); });
}
/// J = Ad(exp(-delta)), the derivative of integrate(q0, delta) with respect to q0.
template <class T>
void record_d_integrate_arg0(Recorder& r, const TwoOutputs& outputs, const oracles::Vec7<T>& q0,
                             const oracles::Vec6<T>& delta, const Mat<double, 6>& J) {
  record_by_increment(r, outputs, delta, J, oracles::d_integrate_arg0(q0, delta),
                      [](const oracles::Vec6<T>& v) {
                        const auto step = oracles::closed_exp(v);
                        const oracles::Mat3<T> Rt = transpose(oracles::rotation_matrix(step.Q));
                        return to_list(Rt, oracles::times_hat(Rt, step.p));
                      });
}
/// J = J_r(delta), the derivative with respect to delta. J_l has the transposed blocks.
template <class T>
void record_d_integrate_arg1(Recorder& r, const TwoOutputs& outputs, const oracles::Vec7<T>& q0,
                             const oracles::Vec6<T>& delta, const Mat<double, 6>& J) {
  record_by_increment(r, outputs, delta, J, oracles::d_integrate_arg1(q0, delta),
                      [](const oracles::Vec6<T>& v) {
                        const auto left = oracles::closed_left_jacobian(v);
                        return to_list(left.J, left.C);
                      });
}

}  // namespace liecheck::properties
