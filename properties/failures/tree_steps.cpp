#include <failures/wrong_steps.hpp>

namespace liecheck::properties::spatial {

namespace {

constexpr Named of_torque[]{
    {no_gyroscopic, "inverse dynamics without V x* (I V)"},
    {opposite_gyroscopic, "inverse dynamics with -V x* (I V)"},
    {gyroscopic_of_motions, "inverse dynamics with the cross product of motions in V x* (I V)"},
    {no_gyroscopic_force, "inverse dynamics without the force of V x* (I V)"},
    {no_gyroscopic_moment, "inverse dynamics without the moment of V x* (I V)"},
    {spin_gyroscopic, "inverse dynamics with omega x n alone in V x* (I V)"},
    {no_gyroscopic_arm, "inverse dynamics without u x f in the moment of V x* (I V)"},
    {turned_forces, "forces that are passed to the parent without p x f"},
    {opposite_arms, "forces that are passed to the parent with -p x f"},
    {own_forces, "forces that are not passed to the parent"},
    {one_child, "forces of one child alone passed to the parent"},
    {own_wrench, "the wrench that is not passed to the parent"},
    {diagonal_gyroscopic, "V x* (I V) with the diagonal of I_C alone"},
    {gyroscopic_of_own, "V x* (I V) with S v in place of V"},
    {gravity_of_first, "gravity on the first joint and what it carries alone"},
    {about_world, "moments about the world's origin in place of the joint's"},
    {one_torque, "the torque of one joint alone where mimics share it"},
    {first_armature, "the armature at the first velocity of a joint alone"}};
constexpr Named of_mass[]{
    {turned_inertias, "inertias that are turned, but not moved, to the parent"},
    {own_inertias, "inertias that are not passed to the parent"},
    {inertia_of_one_child, "the inertia of one child alone passed to the parent"},
    {turned_columns, "columns of M whose forces are passed to the parent without p x f"},
    {stale_columns,
     "columns of M whose forces are passed on by the transform of their own joint at each step"},
    {columns_of_parents, "columns of M whose forces are passed on by the transform of the parent"},
    {only_blocks, "M without what couples joints"},
    {only_parents, "M that couples each joint with its parent alone"},
    {once_of_mimic, "M to which the coupling of a mimic with its primary is added once, not twice,"},
    {armature_of_joint,
     "armatures on the diagonal of M at the numbers of the joints, not of their velocities,"},
    {first_armature, "the armature at the first velocity of a joint alone"}};
constexpr Named of_articulated[]{
    {no_bias_of_c, "forward dynamics without I_a c in the bias force"},
    {no_bias_of_u, "forward dynamics without U D^-1 u in the bias force"},
    {not_reduced, "articulated inertias without - U D^-1 U^T"},
    {no_last_c, "forward dynamics without c in the last pass"},
    {no_last_a, "forward dynamics without U^T a in the last pass"},
    {diagonal_D, "D^-1 of the diagonal of D alone"},
    {turned_articulated, "articulated inertias that are turned, but not moved, to the parent"},
    {turned_bias, "bias forces that are passed to the parent without p x f"},
    {inertia_of_one_child, "the articulated inertia of one child alone passed to the parent"},
    {one_child, "the bias force of one child alone passed to the parent"}};
constexpr Named of_derivatives[]{{held_V_of_momentum, "a derivative without dV x* (I V)"},
                                 {held_momentum, "a derivative without V x* (I dV)"},
                                 {held_V_of_coriolis, "a derivative without dV x (S v)"},
                                 {held_joint_velocity, "a derivative without V x (S dv)"},
                                 {held_velocities, "a derivative that holds the velocities"},
                                 {held_motions, "a derivative that holds the transforms of accelerations"},
                                 {held_forces, "a derivative that holds the transforms of forces"}};

/// The tree's state at a = 0, or at rest.
State without_a(const Tree& t, bool at_rest = false) {
  return {t.at.X, at_rest ? t.zero() : t.at.v, t.zero()};
}
Vector solved(const Matrix& M, const Vector& b) {
  return inverse_of(M) * b;
}
/// The right acceleration for the torques a.
Vector right_acceleration(const Tree& t) {
  return solved(mass_matrix(t, right), t.at.a - torque(t, without_a(t), t.gravity, true, right));
}

template <class F>
void add_of_torque(Steps& s, const F& f) {
  s.add(of_torque, f), s.add(of_motions, f);
}
void add_torques(Steps& s, std::string_view operation) {
  const bool whole = operation == "tree_rnea", at_rest = operation == "tree_gravity";
  add_of_torque(s, [=](const Tree& t, const Wrong& step) -> std::optional<Numbers> {
    return numbers_of(torque(t, whole ? t.at : without_a(t, at_rest), t.gravity, whole, step));
  });
}
void add_masses(Steps& s) {
  s.add(of_mass, [](const Tree& t, const Wrong& step) -> std::optional<Numbers> {
    return numbers_of(mass_matrix(t, step));
  });
}
/// M with a number on its diagonal, as of a damped solution.
void add_damped(Steps& s, bool of_aba) {
  for (int k = 3; k <= 12; ++k)
    s.add(fmt::format("M with 1e-{} on its diagonal", k), [=](const Tree& t, std::size_t) {
      const Matrix damped = mass_matrix(t, right) + std::pow(10, -k) * Matrix::Identity(t.nv(), t.nv());
      if (!of_aba) return std::optional(numbers_of(inverse_of(damped)));
      return std::optional(
          numbers_of(solved(damped, t.at.a - torque(t, without_a(t), t.gravity, true, right))));
    });
}
void add_mass_inverses(Steps& s) {
  s.add(of_mass, [](const Tree& t, const Wrong& step) -> std::optional<Numbers> {
    return numbers_of(inverse_of(mass_matrix(t, step)));
  });
  s.add(of_articulated, [](const Tree& t, const Wrong& step) -> std::optional<Numbers> {
    if (t.has_mimics) return {};
    Matrix inverse(t.nv(), t.nv());
    for (int k = 0; k < t.nv(); ++k)
      inverse.col(k) =
          acceleration(t, without_a(t, true), Vector::Unit(t.nv(), k), Vector3::Zero(), false, step);
    return numbers_of(inverse);
  });
  add_damped(s, false);
  s.add("forward dynamics with gravity", [](const Tree& t, std::size_t) {
    Matrix inverse = inverse_of(mass_matrix(t, right));
    inverse.colwise() -= (inverse * torque(t, without_a(t, true), t.gravity, false, right)).eval();
    return std::optional(numbers_of(inverse));
  });
}
void add_accelerations(Steps& s) {
  add_of_torque(s, [](const Tree& t, const Wrong& step) -> std::optional<Numbers> {
    return numbers_of(solved(mass_matrix(t, right), t.at.a - torque(t, without_a(t), t.gravity, true, step)));
  });
  s.add(of_mass, [](const Tree& t, const Wrong& step) -> std::optional<Numbers> {
    return numbers_of(solved(mass_matrix(t, step), t.at.a - torque(t, without_a(t), t.gravity, true, right)));
  });
  s.add(of_articulated, [](const Tree& t, const Wrong& step) -> std::optional<Numbers> {
    if (t.has_mimics) return {};
    return numbers_of(acceleration(t, t.at, t.at.a, t.gravity, true, step));
  });
  add_damped(s, true);
}

/// The derivative of torque() along d, by central differences.
Vector torque_derivative(const Tree& t, const Vector& a, bool by_q, const Wrong& step) {
  const double h = 1e-5 / std::max(t.d.cwiseAbs().maxCoeff(), 1e-300);
  const State before{t.at.X, t.at.v, a};
  const auto at = [&](double x) {
    State s = before;
    if (!by_q) s.v += x * t.d;
    for (std::size_t i = 0; by_q && i < t.links.size(); ++i) {
      const Link& l = t.links[i];
      s.X[i] = moved_by(l.S * (x * t.d.segment(l.v, l.size))) * s.X[i];
    }
    return torque(t, s, t.gravity, true, step, &before);
  };
  return (at(h) - at(-h)) / (2 * h);
}
void add_derivatives(Steps& s, bool by_q, bool of_aba) {
  const auto along_d = [=](const Tree& t, const Wrong& step) -> std::optional<Numbers> {
    const Vector of_tau = torque_derivative(t, of_aba ? right_acceleration(t) : t.at.a, by_q, step);
    return numbers_of(of_aba ? solved(mass_matrix(t, right), -of_tau) : of_tau);
  };
  s.add(of_derivatives, along_d);
  add_of_torque(s, along_d);
  if (!of_aba || !by_q) return;
  s.add("derivatives of inverse dynamics at a = 0", [](const Tree& t, std::size_t) {
    return std::optional(
        numbers_of(solved(mass_matrix(t, right), -torque_derivative(t, t.zero(), true, right))));
  });
  s.add("derivatives of inverse dynamics at the a without the wrench", [](const Tree& t, std::size_t) {
    const Vector a = solved(mass_matrix(t, right), t.at.a - torque(t, without_a(t), t.gravity, false, right));
    return std::optional(numbers_of(solved(mass_matrix(t, right), -torque_derivative(t, a, true, right))));
  });
  s.add("derivatives of inverse dynamics at a = tau", [](const Tree& t, std::size_t) {
    return std::optional(
        numbers_of(solved(mass_matrix(t, right), -torque_derivative(t, t.at.a, true, right))));
  });
}

}  // namespace

std::vector<WrongStep> wrong_steps(std::string_view operation, std::string_view block) {
  Steps s;
  if (operation == "tree_rnea" || operation == "tree_nonlinear_effects" || operation == "tree_gravity")
    add_torques(s, operation);
  else if (operation == "tree_crba")
    add_masses(s);
  else if (operation == "tree_mass_inverse")
    add_mass_inverses(s);
  else if (operation == "tree_aba")
    add_accelerations(s);
  else if (operation == "rnea_derivatives" || operation == "aba_derivatives")
    add_derivatives(s, block == "by q", operation == "aba_derivatives");
  else if (operation == "tree_momentum" || operation == "tree_momentum_map")
    add_momenta(s, block);
  else if (operation == "tree_kinetic_energy")
    add_energies(s);
  else if (operation == "tree_potential_energy")
    add_potentials(s);
  else if (operation.starts_with("frame_") && operation != "frame_pose" &&
           !operation.ends_with("_derivatives"))
    add_frame_steps(s, operation, block);
  return std::move(s.all);
}

}  // namespace liecheck::properties::spatial
