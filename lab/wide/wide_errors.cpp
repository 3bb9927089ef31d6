#include <wide/wide_errors.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <wide/wide_case.hpp>

namespace liecheck::properties {

using namespace wide_case;

namespace {

namespace formulas = oracles::formulas;

/// J_l(xi) or J_r(xi) = J_l(-xi), or the inverse of either.
template <bool left, bool inverse>
oracles::JacobianBlocks<Wide> jacobian6(const V6& xi) {
  const V6 at = left ? xi : -xi;
  return inverse ? closed_left_jacobian_inverse(at) : closed_left_jacobian(at);
}
template <bool left, bool inverse>
M3 jacobian3(const V3& phi) {
  return jacobian6<left, inverse>(stack(zero(), phi)).J;
}

void compare_integrate(Case& c) {
  const V7 q0 = c.x.read<V7>(), q1 = c.y.read<V7>();
  const auto exact = closed_integrate(q0, c.x.read<V6>());
  const V3 p0 = head3(q0);
  c.rotation(quaternion_of(q1), exact.Q);
  c.relative(block::translation, head3(q1), exact.p, std::max(Wide(norm(p0)), Wide(norm(exact.p - p0))));
}
void compare_difference(Case& c) {
  const V7 q0 = c.x.read<V7>(), q1 = c.x.read<V7>();
  c.log_with(closed_difference(q0, q1), norm(head3(q1) - head3(q0)));
}
/// dq / d delta of integrate at delta = 0: the upper block is R; column j of the lower is Q * (e_j, 0) / 2.
void compare_coefficient_jacobian(Case& c) {
  const V4 Q = quaternion_of(c.x.read<V7>());
  const auto J = c.y.read<oracles::Mat<7, 6, Wide>>();
  M3 translation;
  oracles::Mat<4, 3, Wide> computed, exact;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) translation(i, j) = J(i, j);
    const V4 column =
        Wide(0.5) * quaternion_product(Q, {{Wide(j == 0), Wide(j == 1), Wide(j == 2), Wide(0)}});
    for (int i = 0; i < 4; ++i) computed(i, j) = J(3 + i, 3 + j), exact(i, j) = column[i];
  }
  c.relative(block::translation_matrix, translation, oracles::rotation_matrix(oracles::normalized(Q)));
  c.relative(block::quaternion_matrix, computed, exact);
}
void compare_compose(Case& c) {
  const PoseValue X = c.x.read<PoseValue>(), Y = c.x.read<PoseValue>(), Z = c.y.read<PoseValue>();
  c.relative(block::matrix, Z.R, X.R * Y.R);
  c.relative(block::translation, Z.p, X.R * Y.p + X.p, std::max(Wide(norm(X.p)), Wide(norm(Y.p))));
}
void compare_inverse(Case& c) {
  const PoseValue X = c.x.read<PoseValue>(), Z = c.y.read<PoseValue>();
  const M3 Rt = transpose(X.R);
  c.relative(block::matrix, Z.R, Rt);
  c.relative(block::translation, Z.p, -(Rt * X.p));
}

const Comparison comparisons[] = {
    // exp and log
    {&op::exp3_quaternion, against(&Case::quaternion, exp3)},
    {&op::exp3_matrix, against(&Case::matrix, exp3)},
    {&op::exp6, against(&Case::pose, [](const V6& xi) { return closed_exp(xi); })},
    {&op::log3_quaternion,
     against(&Case::rotation_vector, [](const V4& Q) { return tail3(closed_log(Q, zero())); })},
    {&op::log3_matrix,
     against(&Case::rotation_vector,
             [](const M3& R) { return tail3(closed_log(nearest_quaternion(R).Q, zero())); })},
    {&op::log6,
     against(&Case::log, [](const PoseValue& X) { return closed_log(nearest_quaternion(X.R).Q, X.p); })},
    // configurations
    {&op::integrate, compare_integrate},
    {&op::difference, compare_difference},
    {&op::d_integrate_arg0, against(&Case::jacobian6,
                                    [](const V7&, const V6& delta) {
                                      const auto inverse = closed_exp(-delta);
                                      const M3 R = oracles::rotation_matrix(inverse.Q);
                                      return oracles::JacobianBlocks<Wide>{R, oracles::hat(inverse.p) * R};
                                    })},
    {&op::d_integrate_arg1,
     against(&Case::jacobian6, [](const V7&, const V6& delta) { return jacobian6<false, false>(delta); })},
    {&op::d_difference_arg0,
     against(&Case::jacobian6,
             [](const V7& q0, const V7& q1) {
               const auto exact = jacobian6<true, true>(closed_difference(q0, q1));
               return oracles::JacobianBlocks<Wide>{Wide(-1) * exact.J, Wide(-1) * exact.C};
             })},
    {&op::d_difference_arg1,
     against(&Case::jacobian6,
             [](const V7& q0, const V7& q1) { return jacobian6<false, true>(closed_difference(q0, q1)); })},
    {&op::integrate_coefficient_jacobian, compare_coefficient_jacobian},
    // quaternions of any norm
    {&op::normalize, against(&Case::unit, [](const V4& Q) { return oracles::normalized(Q); })},
    {&op::first_order_normalize,
     against(&Case::unit, [](const V4& Q) { return Wide((3 - squared_norm(Q)) / 2) * Q; })},
    {&op::matrix_from_quaternion_any_norm,
     against(&Case::entries, [](const V4& Q) { return oracles::rotation_matrix(oracles::normalized(Q)); })},
    {&op::rotate_point_any_norm,
     against(&Case::point, [](const V4& Q, const V3& p) { return rotate(Q, p); })},
    {&op::log3_any_norm,
     against(&Case::rotation_vector, [](const V4& Q) { return tail3(closed_log(Q, zero())); })},
    {&op::integrate_any_norm, compare_integrate},
    {&op::difference_any_norm, compare_difference},
    {&op::d_difference_any_norm,
     against(&Case::jacobian6,
             [](const V7& q0, const V7& q1) { return jacobian6<false, true>(closed_difference(q0, q1)); })},
    // Jacobians of exp
    {&op::left_jacobian3, against(&Case::jacobian3, jacobian3<true, false>)},
    {&op::right_jacobian3, against(&Case::jacobian3, jacobian3<false, false>)},
    {&op::left_jacobian3_inverse, against(&Case::jacobian3, jacobian3<true, true>)},
    {&op::right_jacobian3_inverse, against(&Case::jacobian3, jacobian3<false, true>)},
    {&op::left_jacobian6, against(&Case::jacobian6, jacobian6<true, false>)},
    {&op::right_jacobian6, against(&Case::jacobian6, jacobian6<false, false>)},
    {&op::left_jacobian6_inverse, against(&Case::jacobian6, jacobian6<true, true>)},
    {&op::right_jacobian6_inverse, against(&Case::jacobian6, jacobian6<false, true>)},
    // poses, motions and forces
    {&op::compose, compare_compose},
    {&op::inverse, compare_inverse},
    {&op::act_point, against(&Case::point, [](const PoseValue& X, const V3& p) { return X.R * p + X.p; })},
    {&op::rotate_point, against(&Case::point, [](const V4& Q, const V3& p) { return rotate(Q, p); })},
    {&op::act_motion, against(&Case::six, formulas::act_motion<Wide>)},
    {&op::act_inverse_motion, against(&Case::six, formulas::act_inverse_motion<Wide>)},
    {&op::act_force, against(&Case::six, formulas::act_force<Wide>)},
    {&op::act_inverse_force, against(&Case::six, formulas::act_inverse_force<Wide>)},
    {&op::cross_motion, against(&Case::six, formulas::cross_motion<Wide>)},
    {&op::cross_force, against(&Case::six, formulas::cross_force<Wide>)},
    // inertias
    {&op::act_inertia, against(&Case::body, formulas::act_inertia<Wide>)},
    {&op::act_inverse_inertia, against(&Case::body, formulas::act_inverse_inertia<Wide>)},
    {&op::momentum, against(&Case::six, formulas::momentum<Wide>)},
    {&op::kinetic_energy, against(&Case::energy, formulas::kinetic_energy<Wide>)},
    {&op::inertia_matrix, against(&Case::inertia_matrix, formulas::inertia_matrix<Wide>)}};

}  // namespace

void add_wide_errors(std::vector<BlockErrors>& blocks, const Operation& operation, double eps,
                     const WideNumbers& arguments, const WideNumbers& result) {
  std::vector<Comparison> all(std::begin(comparisons), std::end(comparisons));
  for (const auto& more : {comparisons_of_orientations(), comparisons_of_representations()})
    all.insert(all.end(), more.begin(), more.end());
  for (const auto& [record, compare] : all)
    if (record == &operation) {
      const bool finite = std::ranges::all_of(result, [](const Wide& number) { return isfinite(number); });
      Case one{blocks, eps, Reader(arguments), Reader(result), finite};
      return compare(one);
    }
  throw std::logic_error("no closed form of " + std::string(operation.name) + " at 100 digits");
}

}  // namespace liecheck::properties
