#include <timing/wide_errors.hpp>

#include <algorithm>
#include <operations/operations.hpp>
#include <oracles/closed_forms.hpp>
#include <oracles/log.hpp>
#include <oracles/spatial_formulas.hpp>
#include <stdexcept>
#include <string>

namespace liecheck::properties {
namespace {

using Wide = oracles::Real100;
using V3 = oracles::Vec3<Wide>;
using V4 = oracles::Quaternion<Wide>;
using V6 = oracles::Vec6<Wide>;
using V7 = oracles::Vec7<Wide>;
using M3 = oracles::Mat3<Wide>;
using M6 = oracles::Mat6<Wide>;
using PoseValue = oracles::PoseOf<Wide>;
using BodyValue = oracles::BodyOf<Wide>;

/// Numbers read one after another.
class Reader {
 public:
  explicit Reader(const WideNumbers& all) : next_(all.data()) {}
  Wide number() { return *next_++; }
  template <int N>
  oracles::Vec<N, Wide> vector() {
    oracles::Vec<N, Wide> v;
    for (Wide& x : v.x) x = *next_++;
    return v;
  }
  template <int R, int C = R>
  oracles::Mat<R, C, Wide> matrix() {
    return {vector<R * C>().x};
  }
  PoseValue pose() {
    const M3 R = matrix<3>();
    return {R, vector<3>()};
  }
  BodyValue body() {
    const Wide mass = number();
    const V3 c = vector<3>();
    return {mass, c, matrix<3>()};
  }

 private:
  const Wide* next_;
};

V3 zero() {
  return oracles::zero_vector<3, Wide>();
}
V4 quaternion_of(const V7& q) {
  return {{q[3], q[4], q[5], q[6]}};
}

/// The errors of one call.
class Errors {
 public:
  Errors(std::vector<BlockErrors>& blocks, double eps) : blocks_(blocks), eps_(eps) {}

  void distance(BlockName name, const Wide& distance) {
    const auto error = static_cast<double>(Wide(distance / Wide(eps_)));
    auto found = std::find_if(blocks_.begin(), blocks_.end(), [&](auto& b) { return b.block == name.text; });
    if (found == blocks_.end())
      found = blocks_.insert(blocks_.end(), BlockErrors{std::string(name.text), {}});
    if (std::isfinite(error))
      found->errors.push_back(error);
    else
      ++found->not_finite;
  }
  template <int N>
  void relative(BlockName name, const oracles::Vec<N, Wide>& computed, const oracles::Vec<N, Wide>& exact,
                const Wide& scale = Wide(0)) {
    const Wide size = std::max(Wide(norm(exact)), scale), error = norm(computed - exact);
    distance(name, size > 0 ? Wide(error / size) : error);
  }
  template <int R, int C>
  void relative(BlockName name, const oracles::Mat<R, C, Wide>& computed,
                const oracles::Mat<R, C, Wide>& exact) {
    relative(name, oracles::Vec<R * C, Wide>{computed.x}, oracles::Vec<R * C, Wide>{exact.x});
  }
  void relative(BlockName name, const Wide& computed, const Wide& exact) {
    relative(name, oracles::Vec<1, Wide>{{computed}}, oracles::Vec<1, Wide>{{exact}});
  }
  void rotation(const V4& Q, const V4& exact) {
    const V4 unit = oracles::normalized(Q);
    distance(block::rotation, 2 * std::min(Wide(norm(unit - exact)), Wide(norm(unit + exact))));
  }
  void rotation(const M3& R, const V4& exact) {
    distance(block::rotation, frobenius(R - oracles::rotation_matrix(exact)) / sqrt(Wide(2)));
  }
  void pose(const PoseValue& X, const oracles::UnitPose<Wide>& exact) {
    rotation(X.R, exact.Q);
    relative(block::translation, X.p, exact.p);
  }
  void log(const V6& xi, const V6& exact, const Wide& scale = Wide(0)) {
    relative(block::rotation_vector, oracles::tail3(xi), oracles::tail3(exact));
    relative(block::linear, oracles::head3(xi), oracles::head3(exact), scale);
  }
  void six(const V6& computed, const V6& exact) {
    relative(block::linear, oracles::head3(computed), oracles::head3(exact));
    relative(block::angular, oracles::tail3(computed), oracles::tail3(exact));
  }
  void jacobian(const M6& J, const oracles::JacobianBlocks<Wide>& exact) {
    const auto error = [&](int i) { return Wide(frobenius(oracles::block(J, i, i) - exact.J)); };
    distance(block::jacobian, std::max(error(0), error(1)) / frobenius(exact.J));
    relative(block::coupling, oracles::block(J, 0, 1), exact.C);
  }
  void body(const BodyValue& computed, const BodyValue& exact) {
    relative(block::mass, computed.mass, exact.mass);
    relative(block::lever, computed.c, exact.c);
    relative(block::inertia, computed.I_C, exact.I_C);
  }
  /// The worst of the four 3 x 3 blocks.
  void inertia_matrix(const M6& computed, const M6& exact) {
    Wide worst(0);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const M3 right = oracles::block(exact, i, j);
        const Wide error = frobenius(oracles::block(computed, i, j) - right);
        worst = std::max(worst, error > 0 ? Wide(error / frobenius(right)) : error);
      }
    distance(block::matrix, worst);
  }

 private:
  std::vector<BlockErrors>& blocks_;
  double eps_;
};

/// J_l(xi), J_r(xi) = J_l(-xi), or their inverses, with that sign.
oracles::JacobianBlocks<Wide> jacobian(const V6& xi, bool left, bool inverse) {
  const V6 at = left ? xi : -xi;
  return inverse ? oracles::closed_left_jacobian_inverse(at) : oracles::closed_left_jacobian(at);
}
template <bool left, bool inverse>
void compare_jacobian3(Errors& e, Reader x, Reader y) {
  const V3 phi = x.vector<3>();
  e.relative(block::jacobian, y.matrix<3>(), jacobian(oracles::stack(zero(), phi), left, inverse).J);
}
template <bool left, bool inverse>
void compare_jacobian6(Errors& e, Reader x, Reader y) {
  e.jacobian(y.matrix<6>(), jacobian(x.vector<6>(), left, inverse));
}
/// d q / d delta of integrate at delta = 0: R above, and half of the product Q * (e_j, 0) below.
void compare_coefficient_jacobian(Errors& e, Reader x, Reader y) {
  const V4 Q = quaternion_of(x.vector<7>());
  const auto J = y.matrix<7, 6>();
  M3 translation;
  oracles::Mat<4, 3, Wide> computed, exact;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) translation(i, j) = J(i, j);
    const V4 column =
        Wide(0.5) * oracles::quaternion_product(Q, {{Wide(j == 0), Wide(j == 1), Wide(j == 2), Wide(0)}});
    for (int i = 0; i < 4; ++i) computed(i, j) = J(3 + i, 3 + j), exact(i, j) = column[i];
  }
  e.relative(block::translation_matrix, translation, oracles::rotation_matrix(oracles::normalized(Q)));
  e.relative(block::quaternion_matrix, computed, exact);
}
template <V6 (*formula)(const PoseValue&, const V6&)>
void compare_action(Errors& e, Reader x, Reader y) {
  const PoseValue X = x.pose();
  e.six(y.vector<6>(), formula(X, x.vector<6>()));
}
template <V6 (*formula)(const V6&, const V6&)>
void compare_bracket(Errors& e, Reader x, Reader y) {
  const V6 V = x.vector<6>();
  e.six(y.vector<6>(), formula(V, x.vector<6>()));
}

using Compare = void (*)(Errors& e, Reader x, Reader y);
const std::pair<const Operation*, Compare> comparisons[] = {
    // exp and log
    {&op::exp3_quaternion,
     [](Errors& e, Reader x, Reader y) {
       e.rotation(y.vector<4>(), oracles::closed_exp(oracles::stack(zero(), x.vector<3>())).Q);
     }},
    {&op::exp3_matrix,
     [](Errors& e, Reader x, Reader y) {
       e.rotation(y.matrix<3>(), oracles::closed_exp(oracles::stack(zero(), x.vector<3>())).Q);
     }},
    {&op::exp6, [](Errors& e, Reader x, Reader y) { e.pose(y.pose(), oracles::closed_exp(x.vector<6>())); }},
    {&op::log3_quaternion,
     [](Errors& e, Reader x, Reader y) {
       e.relative(block::rotation_vector, y.vector<3>(),
                  oracles::tail3(oracles::closed_log(x.vector<4>(), zero())));
     }},
    {&op::log3_matrix,
     [](Errors& e, Reader x, Reader y) {
       const V4 Q = oracles::nearest_quaternion(x.matrix<3>()).Q;
       e.relative(block::rotation_vector, y.vector<3>(), oracles::tail3(oracles::closed_log(Q, zero())));
     }},
    {&op::log6,
     [](Errors& e, Reader x, Reader y) {
       const PoseValue X = x.pose();
       e.log(y.vector<6>(), oracles::closed_log(oracles::nearest_quaternion(X.R).Q, X.p));
     }},
    // configurations
    {&op::integrate,
     [](Errors& e, Reader x, Reader y) {
       const V7 q0 = x.vector<7>(), q1 = y.vector<7>();
       const auto exact = oracles::closed_integrate(q0, x.vector<6>());
       const V3 p0 = oracles::head3(q0);
       e.rotation(quaternion_of(q1), exact.Q);
       e.relative(block::translation, oracles::head3(q1), exact.p,
                  std::max(Wide(norm(p0)), Wide(norm(exact.p - p0))));
     }},
    {&op::difference,
     [](Errors& e, Reader x, Reader y) {
       const V7 q0 = x.vector<7>(), q1 = x.vector<7>();
       e.log(y.vector<6>(), oracles::closed_difference(q0, q1),
             norm(oracles::head3(q1) - oracles::head3(q0)));
     }},
    {&op::d_integrate_arg0,
     [](Errors& e, Reader x, Reader y) {
       x.vector<7>();
       const auto inverse = oracles::closed_exp(-x.vector<6>());
       const M3 R = oracles::rotation_matrix(inverse.Q);
       e.jacobian(y.matrix<6>(), {R, oracles::hat(inverse.p) * R});
     }},
    {&op::d_integrate_arg1,
     [](Errors& e, Reader x, Reader y) {
       x.vector<7>();
       e.jacobian(y.matrix<6>(), jacobian(x.vector<6>(), false, false));
     }},
    {&op::d_difference_arg0,
     [](Errors& e, Reader x, Reader y) {
       const V7 q0 = x.vector<7>();
       const auto exact = jacobian(oracles::closed_difference(q0, x.vector<7>()), true, true);
       e.jacobian(y.matrix<6>(), {Wide(-1) * exact.J, Wide(-1) * exact.C});
     }},
    {&op::d_difference_arg1,
     [](Errors& e, Reader x, Reader y) {
       const V7 q0 = x.vector<7>();
       e.jacobian(y.matrix<6>(), jacobian(oracles::closed_difference(q0, x.vector<7>()), false, true));
     }},
    {&op::integrate_coefficient_jacobian, &compare_coefficient_jacobian},
    // Jacobians of exp
    {&op::left_jacobian3, &compare_jacobian3<true, false>},
    {&op::right_jacobian3, &compare_jacobian3<false, false>},
    {&op::left_jacobian3_inverse, &compare_jacobian3<true, true>},
    {&op::right_jacobian3_inverse, &compare_jacobian3<false, true>},
    {&op::left_jacobian6, &compare_jacobian6<true, false>},
    {&op::right_jacobian6, &compare_jacobian6<false, false>},
    {&op::left_jacobian6_inverse, &compare_jacobian6<true, true>},
    {&op::right_jacobian6_inverse, &compare_jacobian6<false, true>},
    // poses, motions and forces
    {&op::compose,
     [](Errors& e, Reader x, Reader y) {
       const PoseValue X = x.pose(), Y = x.pose(), Z = y.pose();
       e.relative(block::matrix, Z.R, X.R * Y.R);
       e.relative(block::translation, Z.p, X.R * Y.p + X.p, std::max(Wide(norm(X.p)), Wide(norm(Y.p))));
     }},
    {&op::inverse,
     [](Errors& e, Reader x, Reader y) {
       const PoseValue X = x.pose(), Z = y.pose();
       const M3 Rt = oracles::transpose(X.R);
       e.relative(block::matrix, Z.R, Rt);
       e.relative(block::translation, Z.p, -(Rt * X.p));
     }},
    {&op::act_point,
     [](Errors& e, Reader x, Reader y) {
       const PoseValue X = x.pose();
       e.relative(block::point, y.vector<3>(), X.R * x.vector<3>() + X.p);
     }},
    {&op::rotate_point,
     [](Errors& e, Reader x, Reader y) {
       const V4 Q = x.vector<4>();
       e.relative(block::point, y.vector<3>(), oracles::rotate(Q, x.vector<3>()));
     }},
    {&op::act_motion, &compare_action<&oracles::formulas::act_motion<Wide>>},
    {&op::act_inverse_motion, &compare_action<&oracles::formulas::act_inverse_motion<Wide>>},
    {&op::act_force, &compare_action<&oracles::formulas::act_force<Wide>>},
    {&op::act_inverse_force, &compare_action<&oracles::formulas::act_inverse_force<Wide>>},
    {&op::cross_motion, &compare_bracket<&oracles::formulas::cross_motion<Wide>>},
    {&op::cross_force, &compare_bracket<&oracles::formulas::cross_force<Wide>>},
    // inertias
    {&op::act_inertia,
     [](Errors& e, Reader x, Reader y) {
       const PoseValue X = x.pose();
       e.body(y.body(), oracles::formulas::act_inertia(X, x.body()));
     }},
    {&op::act_inverse_inertia,
     [](Errors& e, Reader x, Reader y) {
       const PoseValue X = x.pose();
       e.body(y.body(), oracles::formulas::act_inverse_inertia(X, x.body()));
     }},
    {&op::momentum,
     [](Errors& e, Reader x, Reader y) {
       const BodyValue I = x.body();
       e.six(y.vector<6>(), oracles::formulas::momentum(I, x.vector<6>()));
     }},
    {&op::kinetic_energy,
     [](Errors& e, Reader x, Reader y) {
       const BodyValue I = x.body();
       e.relative(block::energy, y.number(), oracles::formulas::kinetic_energy(I, x.vector<6>()));
     }},
    {&op::inertia_matrix, [](Errors& e, Reader x, Reader y) {
       e.inertia_matrix(y.matrix<6>(), oracles::formulas::inertia_matrix(x.body()));
     }}};

}  // namespace

void add_wide_errors(std::vector<BlockErrors>& blocks, const Operation& operation, double eps,
                     const WideNumbers& arguments, const WideNumbers& result) {
  for (const auto& [record, compare] : comparisons)
    if (record->name == operation.name) {
      Errors errors(blocks, eps);
      return compare(errors, Reader(arguments), Reader(result));
    }
  throw std::logic_error("no closed form of " + std::string(operation.name) + " at 100 digits");
}

}  // namespace liecheck::properties
