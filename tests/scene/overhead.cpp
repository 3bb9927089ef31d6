// overhead minimal|scene|tree lone|quadruped STEPS URDF makes STEPS steps and prints the state in
// hexadecimal; overhead.sh counts its instructions. `minimal` runs a hand-written loop, `scene` the system
// that a scene would choose, and `tree` the equations of articulated bodies, also for a lone body.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <liecheck/multibody/configuration.hpp>
#include <liecheck/scene/integrators/registry.hpp>
#include <liecheck/scene/simulate.hpp>
#include <liecheck/urdf/urdf.hpp>

#include "minimal.hpp"

namespace {

using namespace liecheck;

template <class V>
void show(const V& x) {
  for (int i = 0; i < x.size(); ++i) std::printf("%a ", x[i]);
  std::printf("\n");
}
template <class M>
void minimal(M& robot, const VectorX<double>& q, const VectorX<double>& v, long steps, double h) {
  robot.q = q, robot.v = v;
  for (long n = 0; n < steps; ++n) robot.step(h);
  show(robot.q), show(robot.v);
}
template <class Sys>
void scene_way(const Model<double>& model, const VectorX<double>& q, const VectorX<double>& v, long steps,
               double h) {
  Sys system(model);
  scene::State<Sys> state(system, q, v);
  const auto method = scene::makeMethod<Sys>("rkmk4");
  scene::simulate(system, *method, state, {h * double(steps), steps, steps},
                  [](const auto&, long) { return true; });
  show(state.q), show(state.v);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const bool by_hand = std::strcmp(argv[1], "minimal") == 0, as_tree = std::strcmp(argv[1], "tree") == 0;
  const bool lone = std::strcmp(argv[2], "lone") == 0;
  const long steps = std::atol(argv[3]);
  const double h = 0x1p-10;
  Model<double> model;
  const Vector3<double> I(0.5, 0.75, 1);
  if (lone) {
    model.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "root_joint");
    model.appendBodyToJoint(1, {2, Vector3<double>::Zero(), Matrix3<double>(I.asDiagonal())});
  } else {
    model = buildModelFromUrdf(argv[4], RootJoint::FreeFlyer);
    model.gravity.setZero();
  }
  const VectorX<double> q = neutral(model);
  VectorX<double> v(model.nv);
  for (int i = 0; i < model.nv; ++i) v[i] = 0.25 * (i % 5) - 0.5;
  if (by_hand && lone) {
    test::MinimalBody body(I);
    minimal(body, q, v, steps, h);
  } else if (by_hand) {
    test::MinimalTree tree(model);
    minimal(tree, q, v, steps, h);
  } else if (lone && !as_tree) {
    scene_way<scene::LoneBody<double>>(model, q, v, steps, h);
  } else {
    scene_way<scene::Tree<double>>(model, q, v, steps, h);
  }
}
