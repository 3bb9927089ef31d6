// Statics, the Coriolis matrix, the centre of mass, and derivatives of momenta and of the motions of frames, times a
// direction d.

#include <invariants/tree_frames.hpp>

namespace liecheck::properties {
namespace {

using oracles::Tangent;

/// The size of the derivative of terms, and 1e-12 of the terms: an exact zero has a scale, too.
double slope_of(const Tangent& t) {
  return t.d + 1e-12 * t.x;
}

class StaticsLaw final : public TreeLaw<StaticsLaw> {
 public:
  static constexpr Output torque = op::tree_static_torque[block::torque],
                          by_q = op::static_torque_derivative[block::by_q];
  static constexpr Statement stated{.name = "statics",
                                    .law = "at rest, joint torques balance gravity and the external wrench",
                                    .equation = "tau = g(q) - J^T F; (dtau/dq) d = d/dt tau(q exp(t d))",
                                    .source = "Featherstone 2008, chapter 5",
                                    .outputs = {torque, by_q}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const TreeOperations<double> o = subject.tree(described(c.stored));
    if (!o[op::tree_static_torque] && !o[op::static_torque_derivative]) return;
    const std::vector<T> still(c.nv(), T(0));
    const std::vector<double> at_rest(c.nv(), 0);
    const auto standing = c.dynamics(still, still, c.exact.d, still, still);
    const std::vector<double> w = inverses(mass_roots(standing.mass(), c.nv()));
    const bool resolved = c.resolved(true);
    if (o[op::tree_static_torque])
      c.record(r, torque, o[op::tree_static_torque](c.q, c.F_joint, c.F), standing.torque(c.exact.wrench), w,
               weighted_size(c.sizes(at_rest, at_rest, true).tau, w), resolved);
    if (!o[op::static_torque_derivative]) return;
    const MatX<double> J = o[op::static_torque_derivative](c.q, c.F_joint, c.F);
    if (!oracles::all_finite(J)) return r.outcome(by_q, 0, Outcome::not_finite);
    const oracles::TreeSizes<Tangent> sizes(c.stored.tree, c.stored.q, at_rest, at_rest, c.stored.wrench,
                                            c.stored.d, at_rest, true);
    std::vector<double> values;
    for (const Tangent& x : sizes.tau) values.push_back(x.x);
    const double reach = weighted_size(c.stored.d, std::vector<double>(c.nv(), 1));
    const double underflow = std::ldexp(1, r.scalar().min_exponent + r.scalar().digits);
    c.record(r, by_q, exact_product(J, c.exact.d), standing.torque_derivative(c.exact.wrench), w,
             weighted_size(sizes.tau, w) + 1e-12 * reach * weighted_size(values, w) +
                 weighted_size(std::vector<double>(c.nv(), underflow), w),
             resolved);
  }
};

class CoriolisLaw final : public TreeLaw<CoriolisLaw> {
 public:
  static constexpr Output torque = op::tree_coriolis[block::torque],
                          symmetry = op::tree_coriolis[block::symmetry];
  static constexpr Statement stated{
      .name = "coriolis",
      .law = "the Coriolis matrix gives the torques of velocities, and its symmetric part the rate of M",
      .equation = "C v = h(q, v) - g(q); (C + C^T) d = M' d, M' = dM/dt along v",
      .source = "Echeandia & Wensing 2021, Numerical methods to compute the Coriolis matrix",
      .outputs = {torque, symmetry}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    Tree<double> weightless = described(c.stored);
    weightless.gravity = {{0, 0, 0}};
    const TreeOperations<double> o = subject.tree(weightless);
    if (!o[op::tree_coriolis]) return;
    const MatX<double> C = o[op::tree_coriolis](c.q, c.v);
    if (!oracles::all_finite(C)) {
      for (const Output& output : {torque, symmetry}) r.outcome(output, 0, Outcome::not_finite);
      return;
    }
    oracles::TreeOf<T> tree = c.exact.tree;
    oracles::TreeOf<double> rough = c.stored.tree;
    tree.gravity = oracles::zero_vector<3, T>(), rough.gravity = {{0, 0, 0}};
    const std::vector<T> still(c.nv(), T(0));
    const std::vector<double> at_rest(c.nv(), 0);
    const oracles::TreeDynamics<T> moving(tree, c.poses(), c.exact.v, still);
    const std::vector<double> w = inverses(mass_roots(moving.mass(), c.nv()));
    const bool resolved = c.resolved(true);
    // A matrix by columns has terms that cancel in C v: those of both factors.
    const oracles::TreeSizes<double> sizes(rough, c.stored.q, c.stored.v, at_rest, {}, {}, {}, true);
    const oracles::TreeSizes<Tangent> of_mass(rough, c.stored.q, at_rest, c.stored.d, {}, c.stored.v, at_rest,
                                              true),
        of_speed(rough, c.stored.q, at_rest, c.stored.v, {}, c.stored.v, at_rest, true),
        moved(rough, c.stored.q, c.stored.v, at_rest, {}, at_rest, c.stored.d, true);  // the terms of 2 C d
    c.record(r, torque, exact_product(C, c.exact.v), moving.torque(), w,
             weighted_size(sizes.tau, w) + weighted_size(of_speed.tau, w), resolved);
    // M' d is the derivative along v of the torque M d of an acceleration d at rest.
    const std::vector<T> rate =
        oracles::TreeDynamics<T>(tree, c.poses(), still, c.exact.d, c.exact.v, still, still)
            .torque_derivative();
    std::vector<T> sum = exact_product(C, c.exact.d);
    const std::vector<T> other = exact_product(MatX<double>(C.transpose()), c.exact.d);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += other[k];
    std::vector<double> values;
    for (const Tangent& x : of_mass.tau) values.push_back(x.x);
    const double reach = weighted_size(c.stored.v, std::vector<double>(c.nv(), 1));
    c.record(r, symmetry, sum, rate, w,
             2 * weighted_size(of_mass.tau, w) + weighted_size(moved.tau, w) +
                 1e-12 * reach * weighted_size(values, w),
             resolved);
  }
};

class CenterOfMassLaw final : public TreeLaw<CenterOfMassLaw> {
 public:
  static constexpr Output centre = op::tree_center_of_mass[block::point],
                          jacobian = op::tree_com_jacobian[block::linear];
  using FourOutputs = std::array<Output, 4>;
  static constexpr TwoOutputs momentum{op::momentum_derivative[block::linear_by_q],
                                       op::momentum_derivative[block::angular_by_q]};
  static constexpr FourOutputs rate{
      op::momentum_rate_derivatives[block::linear_by_q], op::momentum_rate_derivatives[block::angular_by_q],
      op::momentum_rate_derivatives[block::linear_by_v], op::momentum_rate_derivatives[block::angular_by_v]};
  static constexpr Statement stated{
      .name = "center_of_mass",
      .law = "the centre of mass moves by its Jacobian, and momentum and its rate by their derivatives",
      .equation =
          "m c = sum m_i c_i, c' = J_c v; (dh/dq) d = d/dt h(q exp(t d), v); likewise h' by q and by v",
      .source = "Orin & Goswami 2008; Carpentier & Mansard 2018",
      .outputs = {centre, jacobian, momentum[0], momentum[1], rate[0], rate[1], rate[2], rate[3]}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const TreeOperations<double> o = subject.tree(described(c.stored));
    const std::vector<T> still(c.nv(), T(0));
    const auto moving = c.dynamics(c.exact.v, c.exact.a, c.exact.d, still, still);
    const T mass = moving.total_mass();
    const bool has_mass = approximate(mass) > 0, resolved = c.resolved(true);
    const std::vector<double> three(3, 1);
    const auto sizes = c.sizes(c.stored.v, c.stored.v);
    const double by_mass = 1 / approximate(mass);
    const auto halves = [](const oracles::Vec6<T>& h, int part) {
      return std::vector<T>{h[3 * part], h[3 * part + 1], h[3 * part + 2]};
    };
    if (!has_mass) {  // there is no centre of mass
      for (const Output& output : stated.outputs)
        if (o.has(*output.record)) r.outcome(output, 0, Outcome::ill_posed);
      return;
    }
    if (o[op::tree_center_of_mass]) {
      double reach = 0;
      for (std::size_t i = 0; i < c.stored.tree.joints.size(); ++i)
        reach += c.stored.tree.joints[i].body.mass *
                 (position_of(c, i) + approximate(norm(c.exact.tree.joints[i].body.c)));
      c.record(r, centre, VecX<double>(o[op::tree_center_of_mass](c.q)), to_list(moving.centre()), three,
               reach * by_mass, resolved);
    }
    if (o[op::tree_com_jacobian]) {
      const MatX<double> J = o[op::tree_com_jacobian](c.q);
      std::vector<T> velocity = halves(moving.momentum(), 0);
      for (T& x : velocity) x /= mass;
      if (oracles::all_finite(J))
        c.record(r, jacobian, exact_product(J, c.exact.v), velocity, three, sizes.linear * by_mass, resolved);
      else
        r.outcome(jacobian, 0, Outcome::not_finite);
    }
    const auto judge = [&](const MatX<double>& D, const TwoOutputs& outputs, const oracles::Vec6<T>& exact,
                           const std::array<double, 2>& terms) {
      for (int part = 0; part < 2; ++part) {
        const MatX<double> rows = D.middleRows(3 * part, 3);
        const Output& output = outputs[static_cast<std::size_t>(part)];
        if (!oracles::all_finite(rows))
          r.outcome(output, 0, Outcome::not_finite);
        else
          c.record(r, output, exact_product(rows, c.exact.d), halves(exact, part), three,
                   terms[static_cast<std::size_t>(part)], resolved);
      }
    };
    if (o[op::momentum_derivative])
      judge(o[op::momentum_derivative](c.q, c.v), momentum, moving.momentum_change(false),
            terms_of(c, false, true));
    if (!o[op::momentum_rate_derivatives]) return;
    const auto [by_q, by_v] = o[op::momentum_rate_derivatives](c.q, c.v, c.a);
    judge(by_q, {rate[0], rate[1]}, moving.momentum_change(true), terms_of(c, true, true));
    const auto pushed = c.dynamics(c.exact.v, c.exact.a, still, c.exact.d, still);
    judge(by_v, {rate[2], rate[3]}, pushed.momentum_change(true), terms_of(c, true, false));
  }

 private:
  template <class Case>
  static double position_of(const Case& c, std::size_t joint) {
    return oracles::TreeSizes<double>(c.stored.tree, c.stored.q, c.stored.v, c.stored.v)
        .joints[joint]
        .position;
  }
  /// The sizes of the derivatives of the terms of h or h', along d in q or in v.
  template <class Case>
  static std::array<double, 2> terms_of(const Case& c, bool of_rate, bool by_q) {
    const std::vector<double> none(c.nv(), 0);
    oracles::TreeOf<double> tree = c.stored.tree;
    tree.gravity = {{0, 0, 0}};
    const oracles::TreeSizes<Tangent> sizes(tree, c.stored.q, c.stored.v, c.stored.a, {},
                                            by_q ? c.stored.d : none, by_q ? none : c.stored.d, true);
    Tangent linear, angular, reach;  // reach: of the centre of mass
    double mass = 0;
    for (std::size_t i = 0; i < sizes.joints.size(); ++i) {
      const double m = c.stored.tree.joints[i].body.mass;
      mass += m;
      reach +=
          Tangent(m) * (sizes.joints[i].position + Tangent(approximate(norm(c.exact.tree.joints[i].body.c))));
    }
    reach = Tangent(1 / mass) * reach;
    // Derivatives have terms about the root of each branch, and a displacement turns every vector.
    double turns = 0;
    if (by_q)
      for (const double x : c.stored.d) turns += std::fabs(x);
    const Tangent rotation(1, turns);
    std::vector<Tangent> from_root(sizes.joints.size());
    for (std::size_t i = 0; i < sizes.joints.size(); ++i) {
      const auto& j = sizes.joints[i];
      if (const int p = c.stored.tree.joints[i].parent; p >= 0)
        from_root[i] = from_root[static_cast<std::size_t>(p)] + j.r;
      const auto& b = c.stored.tree.joints[i].body;
      const Tangent lever(approximate(norm(c.exact.tree.joints[i].body.c)));
      double inertia = 0;
      for (const double x : b.I_C.x) inertia += x * x;
      const Tangent d = from_root[i] + lever, speed = j.u + j.w * (from_root[i] + d), I(std::sqrt(inertia)),
                    push = of_rate ? j.ac + j.al * (from_root[i] + d) + j.w * speed : speed,
                    turn = of_rate ? I * (j.al + j.w * j.w) + Tangent(b.mass) * speed * speed : I * j.w;
      const Tangent force = Tangent(b.mass) * push;
      linear += rotation * force;
      angular += rotation * (turn + (j.position + d + reach) * force);
    }
    return {slope_of(linear), 2 * slope_of(angular)};
  }
};

class FrameDerivatives final : public TreeLaw<FrameDerivatives> {
 public:
  using FourOutputs = std::array<Output, 4>;
  static constexpr FourOutputs velocity{op::frame_velocity_derivatives[block::linear_by_q],
                                        op::frame_velocity_derivatives[block::angular_by_q],
                                        op::frame_velocity_derivatives[block::linear_by_v],
                                        op::frame_velocity_derivatives[block::angular_by_v]},
      acceleration{op::frame_acceleration_derivatives[block::linear_by_q],
                   op::frame_acceleration_derivatives[block::angular_by_q],
                   op::frame_acceleration_derivatives[block::linear_by_v],
                   op::frame_acceleration_derivatives[block::angular_by_v]};
  static constexpr Statement stated{
      .name = "frame_derivatives",
      .law =
          "the derivatives of a frame's velocity and spatial acceleration by q and by v, times a direction d",
      .equation =
          "(dV/dq) d = d/dt V(q exp(t d), v), (dV/dv) d = d/dt V(q, v + t d), in each reference; likewise V'",
      .source = "Carpentier & Mansard 2018; Pinocchio issue 2702",
      .outputs = {velocity[0], velocity[1], velocity[2], velocity[3], acceleration[0], acceleration[1],
                  acceleration[2], acceleration[3]}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const TreeOperations<double> o = subject.tree(described(c.stored));
    if (!o[op::frame_velocity_derivatives] && !o[op::frame_acceleration_derivatives]) return;
    const std::vector<T> still(c.nv(), T(0));
    const auto by_q = c.dynamics(c.exact.v, c.exact.a, c.exact.d, still, still),
               by_v = c.dynamics(c.exact.v, c.exact.a, still, c.exact.d, still);
    const bool resolved = c.resolved(true), from_world = r.ordinary(velocity[0]);
    const Motion<T> at(c, by_q), pushed(c, by_v);
    const Terms of_q(c, true), of_v(c, false);
    for_each_view([&](Seen view) {
      const auto judge = [&](const FourOutputs& outputs, const std::pair<MatX<double>, MatX<double>>& D,
                             bool is_acceleration) {
        const auto half = [&](const MatX<double>& J, const Output& linear, const Output& angular,
                              const FrameViews<T>& exact, const Terms& terms) {
          const oracles::Vec6<T> value = is_acceleration ? exact.acceleration : exact.velocity;
          for (int part = 0; part < 2; ++part) {
            const Output& output = part == 0 ? linear : angular;
            const MatX<double> rows = J.middleRows(3 * part, 3);
            if (!oracles::all_finite(rows)) {
              r.outcome(output, 0, Outcome::not_finite);
              continue;
            }
            c.record(r, output, exact_product(rows, c.exact.d),
                     std::vector<T>{value[3 * part], value[3 * part + 1], value[3 * part + 2]}, {1, 1, 1},
                     terms.of(is_acceleration, part == 0, from_world || view == Seen::world), resolved);
          }
        };
        half(D.first, outputs[0], outputs[1], at.change(view), of_q);
        half(D.second, outputs[2], outputs[3], pushed.change(view), of_v);
      };
      if (o[op::frame_velocity_derivatives])
        judge(velocity, o[op::frame_velocity_derivatives](c.q, c.v, view), false);
      if (o[op::frame_acceleration_derivatives])
        judge(acceleration, o[op::frame_acceleration_derivatives](c.q, c.v, c.a, view), true);
    });
  }

 private:
  /// The frame's motion and its change along the direction of a TreeDynamics.
  template <class T>
  struct Motion {
    oracles::FrameMotion<T> f, d;
    template <class Case>
    Motion(const Case& c, const oracles::TreeDynamics<T>& dynamics)
        : f(dynamics.motion(), static_cast<std::size_t>(c.exact.frame_joint), c.exact.frame_Q,
            c.exact.frame_p),
          d(dynamics.frame_change(static_cast<std::size_t>(c.exact.frame_joint), c.exact.frame_Q,
                                  c.exact.frame_p)) {}
    /// The change of seen_from(view, f), by the product rule.
    FrameViews<T> change(Seen view) const {
      using namespace oracles;
      const Vec3<T> spatial = f.p2 - cross(f.w, f.p1), d_spatial = d.p2 - cross(d.w, f.p1) - cross(f.w, d.p1);
      const Vec6<T> none = zero_vector<6, T>();
      if (view == Seen::aligned) return {stack(d.p1, d.w), stack(d_spatial, d.w1), none};
      if (view == Seen::local) {
        const Mat3<T> Rt = transpose(f.R), dRt = transpose(d.R);
        const auto turned = [&](const Vec3<T>& x, const Vec3<T>& dx) { return Rt * dx + dRt * x; };
        return {stack(turned(f.p1, d.p1), turned(f.w, d.w)),
                stack(turned(spatial, d_spatial), turned(f.w1, d.w1)), none};
      }
      return {stack(d.p1 + cross(d.p, f.w) + cross(f.p, d.w), d.w),
              stack(d_spatial + cross(d.p, f.w1) + cross(f.p, d.w1), d.w1), none};
    }
  };
  /// The sizes of the derivatives of the terms, as FrameSizes has those of the terms.
  struct Terms {
    Tangent position, from_root, w, u, al, ac, rotation;
    template <class Case>
    Terms(const Case& c, bool by_q) {
      const std::vector<double> none(c.nv(), 0);
      oracles::TreeOf<double> tree = c.stored.tree;
      tree.gravity = {{0, 0, 0}};
      const oracles::TreeSizes<Tangent> sizes(tree, c.stored.q, c.stored.v, c.stored.a, {},
                                              by_q ? c.stored.d : none, by_q ? none : c.stored.d, true);
      const auto j = sizes.joints[static_cast<std::size_t>(c.stored.frame_joint)];
      const Tangent r(approximate(norm(c.exact.frame_p)));
      // A displacement turns every vector of the frame.
      double turns = 1;
      if (by_q)
        for (const double x : c.stored.d) turns += std::fabs(x);
      rotation = Tangent(1, turns);
      from_root = r;
      for (int i = c.stored.frame_joint; tree.joints[static_cast<std::size_t>(i)].parent >= 0;
           i = tree.joints[static_cast<std::size_t>(i)].parent)
        from_root += sizes.joints[static_cast<std::size_t>(i)].r;
      position = j.position + r, w = j.w, u = j.u + j.w * r, al = j.al, ac = j.ac + j.al * r;
    }
    double of(bool acceleration, bool linear, bool lever) const {
      if (!linear) return slope_of(rotation * (acceleration ? al : w));
      const Tangent& d = lever ? position : from_root;
      const Tangent sum = acceleration ? ac + w * u + (u + d * w) * w + d * al : u + d * w;
      return slope_of(rotation * sum);
    }
  };
};

const RegisteredTreeLaw<StaticsLaw> registered_statics;
const RegisteredTreeLaw<CoriolisLaw> registered_coriolis;
const RegisteredTreeLaw<CenterOfMassLaw> registered_center_of_mass;
const RegisteredTreeLaw<FrameDerivatives> registered_frame_derivatives;

}  // namespace
}  // namespace liecheck::properties
