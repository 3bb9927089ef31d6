// MuJoCo: its URDF reader and the dynamics of a mjModel, in double. The velocity of a free joint is its linear part in
// world axes and its angular part in those of the body; matrices and vectors are converted by the rotation of the base.
// Joint damping, friction, limits and contacts are switched off. A free-flyer is a joint of the type floating, to a link
// that is added to the URDF.

#include <mujoco/mujoco.h>

#include <cstring>

#include "protocol.hpp"

namespace {

using namespace trees;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Free {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};

/// The text that MuJoCo reads.
std::string with_root_joint(const Robot& robot) {
  std::string text = robot.text;
  const auto end = text.rfind("</robot>");
  if (!robot.floating || end == text.npos) return text;
  return text.insert(end, "<link name=\"liecheck_world\"/><joint name=\"" + robot.joints[0].name +
                              "\" type=\"floating\"><parent link=\"liecheck_world\"/><child link=\"" +
                              robot.root + "\"/></joint>");
}

struct Tree {
  Robot robot;
  std::unique_ptr<mjModel, Free> m;
  std::unique_ptr<mjData, Free> d;
  std::vector<int> id;  ///< MuJoCo's joint of each joint

  explicit Tree(const Robot& given) : robot(given) {
    const std::string text = with_root_joint(robot);
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "robot.urdf", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char why[500] = "";
    m.reset(mj_loadXML("robot.urdf", files.get(), why, sizeof why));
    mj_deleteVFS(files.get());
    if (!m) throw std::invalid_argument(why);
    if (m->nv != robot.nv) throw std::invalid_argument("MuJoCo reads another number of velocities");
    m->opt.disableflags |=
        mjDSBL_CONSTRAINT | mjDSBL_PASSIVE | mjDSBL_CONTACT | mjDSBL_LIMIT | mjDSBL_FRICTIONLOSS;
    m->opt.enableflags |= mjENBL_ENERGY;
    mju_copy3(m->opt.gravity, robot.gravity.data());
    d.reset(mj_makeData(m.get()));
    for (const Joint& j : robot.joints) {
      id.push_back(mj_name2id(m.get(), mjOBJ_JOINT, j.name.c_str()));
      if (id.back() < 0) throw std::invalid_argument("MuJoCo reads no joint " + j.name);
    }
  }

  /// The rotation of the base; identity if the root is fixed.
  Matrix3d base() const {
    if (!robot.floating) return Matrix3d::Identity();
    const mjtNum* const q = d->qpos + m->jnt_qposadr[id[0]] + 3;
    return Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }
  /// P: MuJoCo's velocity is P v.
  MatrixXd P() const {
    MatrixXd p = MatrixXd::Zero(robot.nv, robot.nv);
    for (std::size_t i = 0; i < id.size(); ++i) {
      const int at = m->jnt_dofadr[id[i]], v = robot.joints[i].v;
      if (robot.joints[i].kind == "free-flyer")
        p.block<3, 3>(at, v) = base(), p.block<3, 3>(at + 3, v + 3).setIdentity();
      else
        p(at, v) = 1;
    }
    return p;
  }
  void put(mjtNum* to, const VectorXd& x) const { std::copy_n(x.data(), x.size(), to); }

  void set_q(std::span<const double> q) {
    for (std::size_t i = 0; i < id.size(); ++i) {
      const Joint& j = robot.joints[i];
      mjtNum* const to = d->qpos + m->jnt_qposadr[id[i]];
      if (j.kind != "free-flyer") {
        *to = robot.coordinate(j, q);
        continue;
      }
      const double* const x = &q[static_cast<std::size_t>(j.q)];
      std::copy_n(x, 3, to);
      to[3] = x[6], to[4] = x[3], to[5] = x[4], to[6] = x[5];
    }
    mj_fwdPosition(m.get(), d.get());
  }
  void set_v(std::span<const double> v) {
    put(d->qvel, P() * vector(v));
    mj_fwdVelocity(m.get(), d.get());
  }
  /// The part of MuJoCo's acceleration that is not P a: d/dt (R u) = R (u' + omega x u).
  VectorXd drift(std::span<const double> v) const {
    VectorXd x = VectorXd::Zero(robot.nv);
    if (robot.floating)
      x.segment<3>(m->jnt_dofadr[id[0]]) =
          base() * Vector3d(v[3], v[4], v[5]).cross(Vector3d(v[0], v[1], v[2]));
    return x;
  }
  /// The generalized force of a wrench on a joint's body, in its axes and at its origin.
  VectorXd force(std::span<const double> joint, std::span<const double> F) {
    VectorXd f = VectorXd::Zero(robot.nv);
    if (joint[0] < 0) return f;
    const int body = m->jnt_bodyid[id[static_cast<std::size_t>(joint[0])]];
    mjtNum linear[3], moment[3];
    mju_rotVecMat(linear, &F[0], d->xmat + 9 * body), mju_rotVecMat(moment, &F[3], d->xmat + 9 * body);
    mj_applyFT(m.get(), d.get(), linear, moment, d->xpos + 3 * body, body, f.data());
    return f;
  }
  MatrixXd full_mass() {
    Rows M(robot.nv, robot.nv);
    mj_fullM(m.get(), M.data(), d->qM);
    return M;
  }
};

Numbers rnea(Tree& t, const Given& x) {
  t.set_q(x[0]), t.set_v(x[1]);
  t.put(t.d->qacc, t.P() * vector(x[2]) + t.drift(x[1]));
  mj_inverse(t.m.get(), t.d.get());
  return rows(t.P().transpose() * (vector({t.d->qfrc_inverse, x[1].size()}) - t.force(x[3], x[4])));
}
Numbers aba(Tree& t, const Given& x) {
  t.set_q(x[0]), t.set_v(x[1]);
  const MatrixXd P = t.P();  // the inverse of P^T is P: its blocks are rotations
  t.put(t.d->qfrc_applied, P * vector(x[2]) + t.force(x[3], x[4]));
  mj_forward(t.m.get(), t.d.get());
  return rows(P.transpose() * (vector({t.d->qacc, x[1].size()}) - t.drift(x[1])));
}
Numbers mass(Tree& t, const Given& x) {
  t.set_q(x[0]);
  return rows(t.P().transpose() * t.full_mass() * t.P());
}
Numbers kinetic(Tree& t, const Given& x) {
  t.set_q(x[0]), t.set_v(x[1]);
  mj_energyVel(t.m.get(), t.d.get());
  return {t.d->energy[1]};
}
Numbers potential(Tree& t, const Given& x) {
  t.set_q(x[0]);
  mj_energyPos(t.m.get(), t.d.get());
  return {t.d->energy[0]};
}
/// A frame in the world.
std::pair<Matrix3d, Vector3d> placed(Tree& t, const Frame& f) {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R;
  Vector3d p;
  const mjtNum quat[4] = {f.Q.w(), f.Q.x(), f.Q.y(), f.Q.z()};
  mj_local2Global(t.d.get(), p.data(), R.data(), f.p.data(), quat, t.m->jnt_bodyid[t.id[f.joint]], 0);
  return {R, p};
}
Numbers frame_pose(Tree& t, const Given& x) {
  t.set_q(x[0]);
  const auto [R, p] = placed(t, Frame(x[1]));
  return pose(R, p);
}
Numbers frame_jacobian(Tree& t, const Given& x) {
  t.set_q(x[0]);
  const Frame f(x[2]);
  const auto [R, p] = placed(t, f);
  const Vector3d at = x[1][0] == 0 ? Vector3d(Vector3d::Zero()) : p;
  Rows linear(3, t.robot.nv), angular(3, t.robot.nv);
  mj_jac(t.m.get(), t.d.get(), linear.data(), angular.data(), at.data(), t.m->jnt_bodyid[t.id[f.joint]]);
  MatrixXd J(6, t.robot.nv);
  const Matrix3d to = x[1][0] == 1 ? Matrix3d(R.transpose()) : Matrix3d(Matrix3d::Identity());
  J << to * linear, to * angular;
  return rows(J * t.P());
}

}  // namespace

int main() {
  mju_user_warning = [](const char* text) { std::fprintf(stderr, "%s\n", text); };
  mju_user_error = [](const char* text) { throw std::runtime_error(text); };
  return serve<Tree>("mujoco_trees", mj_versionString(), {{"models", {"urdf"}}},
                     {{"tree_rnea", {"q v v 1 6", "v", rnea}},
                      {"tree_aba", {"q v v 1 6", "v", aba}},
                      {"tree_crba", {"q", "vv", mass}},
                      {"tree_kinetic_energy", {"q v", "1", kinetic}},
                      {"tree_potential_energy", {"q", "1", potential}},
                      {"frame_pose", {"q 8", "12", frame_pose}},
                      {"frame_jacobian", {"q 1 8", "6v", frame_jacobian}}});
}
