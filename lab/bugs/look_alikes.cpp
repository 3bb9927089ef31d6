// Look-alikes: correct variants that no law may refuse. They use another order of operations, another
// formula, long double, or the other sign if both are correct.

#include <bugs/planted_bugs.hpp>

#include <cmath>

namespace liecheck::properties {
namespace {

using L = long double;
using L3 = Vec<L, 3>;
using LM = Mat<L, 3>;

template <class V>
L3 wide(const V& v) {
  return v.template cast<L>();
}

}  // namespace

template <class S>
auto Bugs<S>::look_alikes_of_rotations() -> Entries {
  return {
      {"exp_minus_Q", "exp returns -Q", "Q and -Q are the same rotation", op::exp3_quaternion,
       [](const V3& phi) -> V4 { return -good()[op::exp3_quaternion](phi); }},
      {"exp_long_double", "sine and cosine of the half angle in long double", "another formula",
       op::exp3_quaternion,
       [](const V3& phi) -> V4 {
         const L3 v = wide(phi);
         const L t = v.stableNorm(), s = t > 0 ? std::sin(t / 2) / t : L(0.5);
         V4 q;
         q << narrow(s * v), S(std::cos(t / 2));
         return q;
       }},
      {"log_long_double", "2 atan2(|v|, w) in long double", "another formula", op::log3_quaternion,
       [](const V4& Q) -> V3 {
         const L3 v = wide(Q.template head<3>());
         const L w = L(Q[3]), s = v.stableNorm();
         if (s == 0) return V3::Zero();
         const L t = w < 0 ? -2 * std::atan2(s, -w) : 2 * std::atan2(s, w);
         return narrow(t / s * v);
       }},
      {"log_other_half_turn", "the opposite axis at exactly theta = pi", "both signs are correct there",
       op::log3_quaternion,
       [](const V4& Q) -> V3 {
         const V3 phi = good()[op::log3_quaternion](Q);
         return Q[3] == S(0) ? V3(-phi) : phi;
       }},
      {"right_jacobian_transposed", "the right Jacobian of SO(3) is the transpose of the left one",
       "an identity", op::right_jacobian3,
       [](const V3& phi) -> M3 { return good()[op::left_jacobian3](phi).transpose(); }},
      {"left_jacobian_of_minus", "the left Jacobian is the right one at -xi", "an identity",
       op::left_jacobian6, [](const V6& xi) -> M6 { return good()[op::right_jacobian6](V6(-xi)); }},
      {"d_difference_by_log", "J_r^-1 of difference", "the definition", op::d_difference_arg1,
       [](const V7& a, const V7& b) -> M6 {
         return good()[op::right_jacobian6_inverse](good()[op::difference](a, b));
       }},
  };
}

template <class S>
auto Bugs<S>::look_alikes_of_poses_and_bodies() -> Entries {
  return {
      {"integrate_sign_by_dot", "the dot product with Q0 decides the sign of Q1", "the same sign",
       changed<op::integrate>([](V7& r, const V7& q, const V6&) {
         if (r.template tail<4>().dot(rotation_of(q)) < S(0)) r.template tail<4>() *= S(-1);
       })},
      {"rotate_long_double", "Q x Q* by cross products in long double", "another formula", op::rotate_point,
       [](const V4& Q, const V3& x) -> V3 {
         const L3 v = wide(Q.template head<3>()), y = wide(x), vx = v.cross(y);
         const L w = L(Q[3]), n = v.squaredNorm() + w * w;
         return narrow(y + 2 / n * (w * vx + v.cross(vx)));
       }},
      {"motion_long_double", "Ad V in long double", "another precision", op::act_motion,
       [](const P& X, const V6& V) -> V6 {
         const LM R = X.R.template cast<L>();
         const L3 w = R * wide(low(V));
         return stack(narrow(R * wide(top(V)) + wide(X.p).cross(w)), narrow(w));
       }},
      {"force_by_matrix", "n_A = R n + [p] (R f) as a matrix product in long double",
       "another operation order", op::act_force,
       [](const P& X, const V6& F) -> V6 {
         const LM R = X.R.template cast<L>();
         const L3 f = R * wide(top(F));
         return stack(narrow(f), narrow(R * wide(low(F)) + hat(wide(X.p)) * f));
       }},
      {"inertia_other_order", "R (I R^T) instead of (R I) R^T", "another operation order",
       changed<op::act_inertia>([](B& b, const P& X, const B& I) {
         const LM R = X.R.template cast<L>(), M = R * (I.I_C.template cast<L>() * R.transpose());
         b.I_C = M.template cast<S>();
       })},
      {"energy_by_momentum", "(m |u_C|^2 + w . I_C w) / 2 in long double", "another route",
       op::kinetic_energy,
       [](const B& I, const V6& V) -> S {
         const L3 u = wide(top(V)), w = wide(low(V)), c = wide(I.c), u_C = u + w.cross(c);
         const LM M = I.I_C.template cast<L>();
         return S((L(I.mass) * u_C.dot(u_C) + w.dot(M * w)) / 2);
       }},
  };
}

template struct Bugs<float>;
template struct Bugs<double>;

}  // namespace liecheck::properties
