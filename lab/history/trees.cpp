// Algorithms on trees of bodies, and what loaders of URDF do to a tree.

#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

using X = VecX<double>;
using M = MatX<double>;
using T = Tree<double>;
using TO = TreeOperations<double>;
using oracles::JointKind;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}
/// The first joint if it is a free-flyer on the world, or -1.
int base(const T& tree) {
  return !tree.joints.empty() && tree.joints[0].kind == JointKind::free_flyer && tree.joints[0].parent < 0
             ? 0
             : -1;
}
TO with_frame_at(T tree, int joint) {
  tree.frame_joint = joint;
  tree.frame_Q = {{0, 0, 0, 1}};
  tree.frame_p = {{0, 0, 0}};
  return correct_tree(tree);
}
M3 matrix_of(const oracles::Mat3<double>& A) {
  M3 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = A(i, j);
  return m;
}
void set(oracles::Mat3<double>& A, const M3& m) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A(i, j) = m(i, j);
}
V3 vector_of(const oracles::Vec3<double>& v) {
  return {v[0], v[1], v[2]};
}
/// M(q) a + h(q, v) minus the torque of the wrench: inverse dynamics by its definition.
X inverse_dynamics(const TO& good, const X& q, const X& v, const X& a, int i, const V6& F) {
  const X none = X::Zero(a.size());
  X tau = good[op::tree_crba](q) * a + good[op::tree_nonlinear_effects](q, v);
  if (i >= 0) tau += good[op::tree_rnea](q, none, none, i, F) - good[op::tree_gravity](q);
  return tau;
}
const auto fixed_rnea = [](const T&, const TO& good) {
  return [good](const X& q, const X& v, const X& a, int i, const V6& F) -> X {
    return inverse_dynamics(good, q, v, a, i, F);
  };
};

// Longer than 80 lines: a list of independent rows.
std::vector<HistoricBug> dynamics() {
  const auto row = tree_rows_of(op::tree_rnea, fixed_rnea);
  return {
      row("dart_1450", "DART 6.3.0", "dartsim/dart#1450", "damping != 0", "f != ID(FD(f))",
          "Inverse dynamics added damping times acceleration times the time step.",
          [](const T&, const TO& good) {
            return [good](const X& q, const X& v, const X& a, int i, const V6& F) -> X {
              return inverse_dynamics(good, q, v, a, i, F) +
                     1e-3 * good[op::tree_crba](q).diagonal().cwiseProduct(a);
            };
          }),
      row("jaxsim_13", "JaxSim", "gbionics/jaxsim#13", "omega of the base != 0", "wrong torques",
          "With mixed velocities the base's acceleration was used without the term omega x v.",
          [](const T& tree, const TO& good) {
            return [good, base = base(tree)](const X& q, const X& v, const X& a, int i, const V6& F) -> X {
              X mixed = a;
              if (base == 0) mixed.head<3>() += V3(v.segment<3>(3)).cross(V3(v.head<3>()));
              return inverse_dynamics(good, q, v, mixed, i, F);
            };
          }),
      row("auralius_2", "inverse-dynamics-rne", "auralius/inverse-dynamics-rne#2", "bodies after the first",
          "a wrong gyroscopic torque",
          "The gyroscopic term of every body used the angular velocity of body 1.",
          [](const T& tree, const TO& good) {
            std::vector<TO> frames;
            std::vector<M3> I;
            for (std::size_t i = 0; i < tree.joints.size(); ++i) {
              frames.push_back(with_frame_at(tree, static_cast<int>(i)));
              I.push_back(matrix_of(tree.joints[i].body.I_C));
            }
            return [good, frames, I](const X& q, const X& v, const X& a, int i, const V6& F) -> X {
              X tau = inverse_dynamics(good, q, v, a, i, F);
              const X none = X::Zero(a.size()), rest = good[op::tree_gravity](q);
              V3 first = V3::Zero();
              for (std::size_t k = 0; k < frames.size(); ++k) {
                const V3 w = frames[k][op::frame_velocity](q, v, Seen::local).tail<3>();
                if (k == 0) first = w;
                const V6 less = H::stack(V3::Zero(), w.cross(I[k] * (w - first)));
                tau += good[op::tree_rnea](q, none, none, static_cast<int>(k), less) - rest;
              }
              return tau;
            };
          }),
      row("drake_2201", "Drake", "RobotLocomotion/drake#2201", "a != 0", "wrong torques",
          "Inverse dynamics was wrong for accelerations other than zero: those behind the first joint got "
          "lost.",
          [](const T& tree, const TO& good) {
            return [good, n = velocity_size(tree.joints[0].kind)](const X& q, const X& v, const X& a, int i,
                                                                  const V6& F) -> X {
              X first = X::Zero(a.size());
              first.head(n) = a.head(n);
              return inverse_dynamics(good, q, v, first, i, F);
            };
          }),
      {"idyntree_81", "iDynTree before 0.3.8", "gbionics/idyntree#81", "gravity != 0",
       "wrong gravity torques", "Gravity became the proper acceleration of the base with the wrong sign.",
       tree_forms(
           op::tree_gravity,
           [](const T&, const TO& good) {
             return [good](const X& q) -> X { return -good[op::tree_gravity](q); };
           },
           [](const T&, const TO& good) {
             return [good](const X& q) -> X {
               return good[op::tree_nonlinear_effects](q, X::Zero(good[op::tree_crba](q).rows()));
             };
           })},
      {"mujoco_warp_1663", "MuJoCo Warp", "google-deepmind/mujoco_warp#1663", "velocities in 3D",
       "velocities explode", "The velocity derivative of the Coriolis terms was subtracted instead of added.",
       tree_forms(
           op::rnea_derivatives,
           [](const T&, const TO& good) {
             return [good](const X& q, const X& v, const X& a, int i, const V6& F) -> std::pair<M, M> {
               auto [by_q, by_v] = good[op::rnea_derivatives](q, v, a, i, F);
               return {by_q, -by_v};
             };
           },
           [](const T&, const TO& good) { return good[op::rnea_derivatives]; })},
  };
}

std::vector<HistoricBug> mass_matrices() {
  const auto row = tree_rows_of(op::tree_crba, [](const T&, const TO& good) { return good[op::tree_crba]; });
  return {
      row("idyntree_1276", "iDynTree", "gbionics/idyntree#1276", "spherical joints",
          "zeros in a diagonal block",
          "The off-diagonal terms within the block of one spherical joint were not computed.",
          [](const T& tree, const TO& good) {
            return [good, tree](const X& q) -> M {
              M A = good[op::tree_crba](q);
              for (std::size_t i = 0; i < tree.joints.size(); ++i)
                if (tree.joints[i].kind == JointKind::spherical) {
                  auto block = A.block<3, 3>(tree.idx_v[i], tree.idx_v[i]);
                  block = M3(block.diagonal().asDiagonal());
                }
              return A;
            };
          }),
      row("choreonoid_26", "Choreonoid", "choreonoid/choreonoid#26", "rotor inertia != 0",
          "rotor inertia twice",
          "The inverse dynamics that builds the columns had added the rotor inertia already.",
          [](const T& tree, const TO& good) {
            return [good, tree](const X& q) -> M {
              M A = good[op::tree_crba](q);
              oracles::for_each_armature(tree, [&](std::size_t k, double m) {
                A(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) += m;
              });
              return A;
            };
          }),
      row("urdf2casadi_2", "urdf2casadi", "mahaarbo/urdf2casadi#2", "ixy, ixz, iyz != 0",
          "another mass matrix", "The products of inertia were put into the tensor with the wrong sign.",
          [](const T& tree, const TO&) {
            T flipped = tree;
            for (auto& j : flipped.joints) {
              M3 I = -matrix_of(j.body.I_C);
              I.diagonal() *= -1;
              set(j.body.I_C, I);
            }
            return correct_tree(flipped)[op::tree_crba];
          }),
  };
}

/// The Jacobian with the base's angular columns about another point.
std::vector<HistoricBug> jacobians() {
  const auto row =
      tree_rows_of(op::frame_jacobian, [](const T&, const TO& good) { return good[op::frame_jacobian]; });
  return {
      row("dart_1657", "DART 6.12.1", "dartsim/dart#1657", "a free joint with offset frames",
          "a wrong world Jacobian",
          "The world Jacobian of a free joint lacked the lever of its offset frames.",
          [](const T& tree, const TO& good) {
            return [good, tree](const X& q, Seen s) -> M {
              M J = good[op::frame_jacobian](q, s);
              if (base(tree) == 0 && s == Seen::world)
                J.block<3, 3>(0, 3) -= hat(vector_of(tree.joints[0].p)) * J.block<3, 3>(3, 3);
              return J;
            };
          }),
      row("newton_3866", "Newton 1.5.0", "newton-physics/newton#3866", "a base far from the origin",
          "1 per metre",
          "The base's angular columns were taken about the world's origin instead of the base.",
          [](const T& tree, const TO& good) {
            return [good, origin = with_frame_at(tree, 0), free = base(tree) == 0](const X& q, Seen s) -> M {
              M J = good[op::frame_jacobian](q, s);
              if (free && s == Seen::aligned)
                J.block<3, 3>(0, 3) -= hat(origin[op::frame_pose](q).p) * J.block<3, 3>(3, 3);
              return J;
            };
          }),
      row("exotica_668", "EXOTica", "ipab-slmc/exotica#668", "a floating base", "two columns swapped",
          "Two of the three rotational columns of the floating base were exchanged.",
          [](const T& tree, const TO& good) {
            return [good, free = base(tree) == 0](const X& q, Seen s) -> M {
              M J = good[op::frame_jacobian](q, s);
              if (free) J.col(3).swap(J.col(4));
              return J;
            };
          }),
      row("optas_157", "OpTaS", "cmower/optas#157", "p != 0", "a Jacobian at the wrong point",
          "The Jacobian was brought into another frame by the rotation alone, without the adjoint's lever.",
          [](const T&, const TO& good) {
            return [good](const X& q, Seen s) -> M {
              return good[op::frame_jacobian](q, s == Seen::world ? Seen::aligned : s);
            };
          }),
  };
}

/// The tree without fixed bodies: they are lumped into the body of their joint, whose inertia is `inertia` of
/// the parts: mass, centre of mass and inertia in the joint's frame.
struct Part {
  double mass;
  V3 c, origin;
  M3 rotated, stored;  ///< I_C in the joint's axes, and as stored in the fixed body's axes
};
template <class Inertia>
T lumped(T tree, Inertia inertia) {
  std::vector<std::vector<Part>> parts(tree.joints.size());
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    const auto& b = tree.joints[i].body;
    const M3 I = matrix_of(b.I_C);
    parts[i].push_back({b.mass, vector_of(b.c), V3::Zero(), I, I});
  }
  for (const auto& f : tree.fixed) {
    const M3 R = Eigen::Quaterniond(f.Q[3], f.Q[0], f.Q[1], f.Q[2]).toRotationMatrix(),
             I = matrix_of(f.body.I_C);
    const V3 p = vector_of(f.p);
    parts[at(f.joint)].push_back({f.body.mass, p + R * vector_of(f.body.c), p, R * I * R.transpose(), I});
  }
  tree.fixed.clear();
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    if (parts[i].size() < 2) continue;
    auto& body = tree.joints[i].body;
    double mass = 0;
    V3 first = V3::Zero();
    for (const Part& p : parts[i]) mass += p.mass, first += p.mass * p.c;
    const V3 c = mass > 0 ? V3(first / mass) : V3(parts[i][0].c);
    M3 I = M3::Zero();
    for (const Part& p : parts[i]) I += inertia(p, c);
    body.mass = mass;
    body.c = {{c[0], c[1], c[2]}};
    set(body.I_C, (I + I.transpose()) / 2);
  }
  return tree;
}
M3 steiner(double m, const V3& d) {
  return -m * hat(d) * hat(d);
}
M3 right_inertia(const Part& p, const V3& c) {
  return p.rotated + steiner(p.mass, p.c - c);
}
template <class Inertia>
OnTree<std::remove_cvref_t<decltype(op::tree_rnea)>> rnea_of_lumped(Inertia inertia) {
  return [inertia](const T& tree, const TO&) { return correct_tree(lumped(tree, inertia))[op::tree_rnea]; };
}

std::vector<HistoricBug> loaders() {
  return {
      {"mujoco_2982", "MuJoCo 3.3.7", "google-deepmind/mujoco#2982", "a rotated fixed child",
       "a wrong inertia", "fusestatic added the child's inertia in the child's axes to that of the parent.",
       tree_forms(op::tree_rnea, rnea_of_lumped([](const Part& p, const V3& c) -> M3 {
                    return p.stored + steiner(p.mass, p.c - c);
                  }),
                  rnea_of_lumped(right_inertia))},
      {"drcsim_308", "Gazebo, drcsim", "osrf/drcsim#308", "a child whose centre is not at its origin",
       "a wrong inertia",
       "Lumping moved the child's inertia from its link's origin instead of from its centre of mass.",
       tree_forms(op::tree_rnea, rnea_of_lumped([](const Part& p, const V3& c) -> M3 {
                    return p.rotated + steiner(p.mass, p.origin - c);
                  }),
                  rnea_of_lumped(right_inertia))},
  };
}

const HistoryRows registered_trees[] = {HistoryRows(dynamics), HistoryRows(mass_matrices),
                                        HistoryRows(jacobians), HistoryRows(loaders)};

}  // namespace
}  // namespace liecheck::properties::history
