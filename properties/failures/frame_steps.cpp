#include <failures/wrong_steps.hpp>

namespace liecheck::properties::spatial {

namespace {

/// A motion in the frame's axes, seen in WORLD, LOCAL or LOCAL_WORLD_ALIGNED.
Vector6 seen(const Tree& t, const Vector6& V, std::size_t view) {
  const Link& l = t.links[static_cast<std::size_t>(t.frame_joint)];
  const Matrix3 R = l.R * t.frame_R;
  return view == 1 ? V
                   : Vector6(motion_matrix(
                                 R, view == 0 ? Vector3(l.p + l.R * t.frame_p) : Vector3(Vector3::Zero())) *
                             V);
}
/// A motion of the frame's joint in the frame's axes.
Vector6 in_frame(const Tree& t, const Vector6& V) {
  return motion_matrix(t.frame_R.transpose(), -t.frame_R.transpose() * t.frame_p) * V;
}
Numbers half(const Vector6& V, std::string_view block) {
  return numbers_of(Vector(block == "linear" ? V.head<3>() : V.tail<3>()));
}

/// Whether a joint is `of` or one of its ancestors.
bool carries(const Tree& t, int joint, int of) {
  while (of > joint) of = t.links[static_cast<std::size_t>(of)].parent;
  return of == joint;
}
void add_velocities(Steps& s, std::string_view block) {
  const auto of_joints = [&](std::string text, auto counts) {
    s.add(std::move(text), [=](const Tree& t, std::size_t view) {
      const Link& f = t.links[static_cast<std::size_t>(t.frame_joint)];
      Vector6 world = Vector6::Zero();
      for (int i = 0; i < static_cast<int>(t.links.size()); ++i) {
        const Link& l = t.links[static_cast<std::size_t>(i)];
        if (counts(t, i)) world += motion_matrix(l.R, l.p) * (l.S * t.at.v.segment(l.v, l.size));
      }
      const Vector6 joint = motion_matrix(f.R.transpose(), -f.R.transpose() * f.p) * world;
      return std::optional(half(seen(t, in_frame(t, joint), view), block));
    });
  };
  of_joints("columns of all joints before the frame's, not of its ancestors alone,",
            [](const Tree& t, int i) { return i <= t.frame_joint; });
  of_joints("columns of all joints", [](const Tree&, int) { return true; });
  of_joints("columns of the frame's joint alone", [](const Tree& t, int i) { return i == t.frame_joint; });
  of_joints("columns without those of the frame's joint",
            [](const Tree& t, int i) { return i != t.frame_joint && carries(t, i, t.frame_joint); });
  of_joints("columns of the frame's joint and its parent alone", [](const Tree& t, int i) {
    return i == t.frame_joint || i == t.links[static_cast<std::size_t>(t.frame_joint)].parent;
  });
  for (int most = 2; most <= 12; ++most)
    of_joints(
        fmt::format("columns of the frame's joint and {} joints before it, with 0 for its other ancestors,",
                    most),
        [most](const Tree& t, int i) {
          int at = t.frame_joint;
          for (int k = 0; k < most && at > i; ++k) at = t.links[static_cast<std::size_t>(at)].parent;
          return at == i;
        });
}
/// The velocity or spatial acceleration of the frame where a lever arm of the reference frame has a wrong factor.
void add_references(Steps& s, bool velocity, std::string_view block) {
  for (const double factor : {0.0, -1.0})
    for (const std::size_t of_view : {0u, 2u})
      s.add(
          fmt::format(
              "a motion that is {} {} in {}", factor == 0 ? "not moved" : "moved by -p in place of p",
              of_view == 0 ? "from the frame to the world's origin" : "from the world's origin to the frame",
              of_view == 0 ? "WORLD" : "LOCAL_WORLD_ALIGNED"),
          [=](const Tree& t, std::size_t view) -> std::optional<Numbers> {
            if (view != of_view) return {};
            const Motions m = motions(t, t.at, Vector3::Zero(), right);
            const auto i = static_cast<std::size_t>(t.frame_joint);
            const Vector6 V = in_frame(t, velocity ? m.V[i] : m.A[i]);
            const Vector6 world = seen(t, V, 0), aligned = seen(t, V, 2);
            return half(view == 0 ? Vector6(aligned + factor * (world - aligned))
                                  : Vector6(world + factor * (aligned - world)),
                        block);
          });
}
/// Wrong steps from the joint to the frame at p in its axes.
void add_offsets(Steps& s, bool velocity, bool classical, std::string_view block) {
  const auto add = [&](const char* text, auto of) {
    s.add(text, [=](const Tree& t, std::size_t view) -> std::optional<Numbers> {
      const Motions m = motions(t, t.at, Vector3::Zero(), right);
      const auto i = static_cast<std::size_t>(t.frame_joint);
      const std::optional<Vector6> wrong = of(t, m.V[i], m.A[i], view);
      if (!wrong) return {};
      return half(*wrong, block);
    });
  };
  using Found = std::optional<Vector6>;
  const auto centripetal = [](const Vector6& V, const Vector3& u) { return V.tail<3>().cross(u).eval(); };
  if (!velocity)
    s.add("a recursion whose world accelerates by -g", [=](const Tree& t, std::size_t view) {
      const Motions m = motions(t, t.at, t.gravity, right);
      const auto i = static_cast<std::size_t>(t.frame_joint);
      const Vector6 V = seen(t, in_frame(t, m.V[i]), view);
      Vector6 A = seen(t, in_frame(t, m.A[i]), view);
      if (classical) A.head<3>() += centripetal(V, V.head<3>());
      return std::optional(half(A, block));
    });
  if (classical) {
    add("omega x u in the frame's axes in LOCAL_WORLD_ALIGNED",
        [=](const Tree& t, const Vector6& V, const Vector6& A, std::size_t view) -> Found {
          if (view != 2) return {};
          const Vector6 local = in_frame(t, V);
          Vector6 aligned = seen(t, in_frame(t, A), 2);
          aligned.head<3>() += centripetal(local, local.head<3>());
          return aligned;
        });
    add("the acceleration of the joint's origin and omega' x p, without omega x (omega x p),",
        [=](const Tree& t, const Vector6& V, Vector6 A, std::size_t view) -> Found {
          if (view == 0) return {};
          A.head<3>() += centripetal(V, V.head<3>());
          return seen(t, in_frame(t, A), view);
        });
    add("omega x u in WORLD with the velocity of the frame's origin",
        [=](const Tree& t, const Vector6& V, const Vector6& A, std::size_t view) -> Found {
          if (view != 0) return {};
          Vector6 world = seen(t, in_frame(t, A), 0);
          const Vector6 aligned = seen(t, in_frame(t, V), 2);
          world.head<3>() += centripetal(aligned, aligned.head<3>());
          return world;
        });
    return;
  }
  if (!velocity)
    add("a spatial acceleration with omega x (omega x p)",
        [=](const Tree& t, const Vector6& V, Vector6 A, std::size_t view) -> Found {
          A.head<3>() += centripetal(V, centripetal(V, t.frame_p));
          return seen(t, in_frame(t, A), view);
        });
  add("the frame's shift that is not turned to the world's axes",
      [=](const Tree& t, const Vector6& V, const Vector6& A, std::size_t view) -> Found {
        if (view != 2) return {};
        const Matrix3& R = t.links[static_cast<std::size_t>(t.frame_joint)].R;
        Vector6 aligned = motion_matrix(R, Vector3::Zero()) * (velocity ? V : A);
        aligned.head<3>() += centripetal(aligned, t.frame_p);
        return aligned;
      });
}
}  // namespace

void add_frame_steps(Steps& s, std::string_view operation, std::string_view block) {
  const bool velocity = operation == "frame_velocity" || operation == "frame_jacobian",
             rate = operation == "frame_jacobian_rate",
             classical = operation == "frame_classical_acceleration";
  const auto of_step = [=](const Tree& t, const Wrong& wrong, std::size_t view, double times) {
    const Motions m = motions(t, t.at, Vector3::Zero(), wrong);
    const auto i = static_cast<std::size_t>(t.frame_joint);
    const Vector6 V = seen(t, in_frame(t, m.V[i]), view);
    if (velocity) return half(V, block);
    Vector6 A = seen(t, in_frame(t, m.A[i]), view);
    if (classical || (rate && view == 2)) A.head<3>() += times * V.tail<3>().cross(V.head<3>());
    return half(A, block);
  };
  s.add(of_motions, [=](const Tree& t, const Wrong& wrong, std::size_t view) {
    return std::optional(of_step(t, wrong, view, 1));
  });
  if (velocity) add_velocities(s, block);
  if (!classical && !rate) add_references(s, velocity, block);
  if (classical || rate)
    for (const double times : {0.0, -1.0, 2.0})
      s.add(times == 0  ? "a spatial acceleration, without omega x u,"
            : times < 0 ? "a classical acceleration with - omega x u"
                        : "a classical acceleration with twice omega x u",
            [=](const Tree& t, std::size_t view) { return std::optional(of_step(t, right, view, times)); });
  add_offsets(s, velocity, classical, block);
}

void add_momenta(Steps& s, std::string_view block) {
  using Bodies = std::vector<MovingBody>;
  const auto add = [&](const char* text, Vector3 (*about)(const Tree&, const Bodies&), double orbits,
                       double spins, bool of_origins = false) {
    s.add(text, [=](const Tree& t, std::size_t) {
      const Bodies bodies = bodies_of(t);
      const Vector3 c = about(t, bodies);
      Vector6 h = Vector6::Zero();
      for (const MovingBody& b : bodies) {
        const Vector3 l = b.link.mass * (of_origins ? b.origin1 : b.x1);
        h.head<3>() += l, h.tail<3>() += orbits * (b.x - c).cross(l) + spins * b.spin;
      }
      return std::optional(half(h, block));
    });
  };
  const auto centre = [](const Tree&, const Bodies& b) { return centre_of(b, true); };
  add("velocities of the joints' origins in place of the centres of mass", centre, 1, 1, true);
  if (block == "linear") return;
  add(
      "the angular momentum about the world's origin",
      [](const Tree&, const Bodies&) { return Vector3(Vector3::Zero()); }, 1, 1);
  add(
      "the angular momentum about the origin of the first joint",
      [](const Tree& t, const Bodies&) { return t.links[0].p; }, 1, 1);
  add(
      "a centre of mass that is not weighted by the masses",
      [](const Tree&, const Bodies& b) { return centre_of(b, false); }, 1, 1);
  s.add("inertias that are not turned to the world's axes", [](const Tree& t, std::size_t) {
    const Bodies bodies = bodies_of(t);
    Vector3 k = Vector3::Zero();
    for (const MovingBody& b : bodies)
      k += b.link.mass * (b.x - centre_of(bodies, true)).cross(b.x1) + b.link.I_C * b.omega;
    return std::optional(numbers_of(Vector(k)));
  });
  add("the angular momenta of the bodies about their own centres of mass alone", centre, 0, 1);
  add("the angular momentum without those of the bodies about their own centres of mass", centre, 1, 0);
}
void add_energies(Steps& s) {
  const auto add = [&](const char* text, double (*of)(const MovingBody&)) {
    s.add(text, [=](const Tree& t, std::size_t) {
      double T = 0;
      for (const MovingBody& b : bodies_of(t)) T += of(b) / 2;
      for (const Link& l : t.links) T += l.armature * t.at.v.segment(l.v, l.size).squaredNorm() / 2;
      return std::optional(Numbers{T});
    });
  };
  s.add("the armature at the first velocity of a joint alone", [](const Tree& t, std::size_t) {
    return std::optional(Numbers{t.at.v.dot(mass_matrix(t, first_armature) * t.at.v) / 2});
  });
  add("the energy of the centres of mass alone",
      [](const MovingBody& b) { return b.link.mass * b.x1.squaredNorm(); });
  add("the energy of the rotations alone", [](const MovingBody& b) { return b.omega.dot(b.spin); });
  add("velocities of the joints' origins in place of the centres of mass",
      [](const MovingBody& b) { return b.link.mass * b.origin1.squaredNorm() + b.omega.dot(b.spin); });
  add("the energy without 2 m u . (omega x c)", [](const MovingBody& b) {
    const Vector3 c = b.x1 - b.origin1;
    return b.link.mass * (b.origin1.squaredNorm() + c.squaredNorm()) + b.omega.dot(b.spin);
  });
  add("the energy with m |omega|^2 |c|^2 in place of m |omega x c|^2", [](const MovingBody& b) {
    const Vector3 c = b.x1 - b.origin1;
    return b.link.mass *
               (b.x1.squaredNorm() - c.squaredNorm() + b.omega.squaredNorm() * b.link.com.squaredNorm()) +
           b.omega.dot(b.spin);
  });
}
void add_potentials(Steps& s) {
  s.add("centres of mass that are not turned to the world's axes", [](const Tree& t, std::size_t) {
    double V = 0;
    for (const Link& l : t.links) V -= l.mass * t.gravity.dot(l.p + l.com);
    return std::optional(Numbers{V});
  });
  s.add("a centre of mass that is not weighted by the masses", [](const Tree& t, std::size_t) {
    double mass = 0;
    for (const Link& l : t.links) mass += l.mass;
    return std::optional(Numbers{-mass * t.gravity.dot(centre_of(bodies_of(t), false))});
  });
}

}  // namespace liecheck::properties::spatial
