#include <integrators/make_runner.hpp>
#include <integrators/spins.hpp>

#include <chrono>
#include <cmath>
#include <integrators/liecheck_runner.hpp>
#include <limits>
#include <numbers>
#include <oracles/motions/torque_free.hpp>
#include <oracles/number.hpp>
#include <scenes/truth.hpp>

namespace liecheck::properties {
namespace {

using oracles::Real100;

Benchmark spinning(const Eigen::Vector3d& omega) {
  Benchmark b;
  b.name = "spin";
  const int i = b.robot.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "root");
  b.robot.appendBodyToJoint(
      i, Inertia<double>(1, Eigen::Vector3d::Zero(), Eigen::Matrix3d(Eigen::Vector3d(1, 2, 3).asDiagonal())));
  b.q0 = Eigen::VectorXd::Unit(7, 6), b.v0 = Eigen::VectorXd::Zero(6);
  b.v0.tail<3>() = omega;
  return b;
}

template <class S>
Flips flips_of(const Benchmark& b, double delta, const char* scalar, std::size_t count, int per_second,
               const std::atomic<bool>* stop) {
  using Body = scene::LoneBody<S>;
  Flips r{delta, scalar, "gauss12", {}, {}, 0, 0};
  const oracles::TriaxialBody<Real100> form({{Real100(1), Real100(2), Real100(3)}},
                                            {{{Real100(0), Real100(0), Real100(0), Real100(1)}},
                                             {{Real100(b.v0[3]), Real100(b.v0[4]), Real100(b.v0[5])}}});
  for (std::size_t n = 0; n < count; ++n) r.exact.push_back(static_cast<double>(form.flip_time(int(n))));
  Body body(b.robot.cast<S>());
  const auto method = make_method<Body>("gauss12"), finder = make_method<Body>("gauss12");
  scene::State<Body> state(body, b.q0.cast<S>(), b.v0.cast<S>());
  const S h = S(1) / S(per_second);
  const auto steps = long(1.5 * r.exact.back() * per_second) + 8;
  scene::State<Body> before = state;
  bool same = true;  // all flips so far agree with the closed form
  const scene::Outcome o = scene::simulate(
      body, *method, state, {static_cast<double>(S(steps) * h), steps, 1}, [&](const auto& now, long n) {
        if (n > 0 && (now.v[4] < S(0)) != (before.v[4] < S(0))) {
          S at = h * before.v[4] / (before.v[4] - now.v[4]);  // Newton's method, from the zero of the chord
          typename Body::Tangent rate;
          for (int i = 0; i < 8; ++i) {
            scene::State<Body> trial = before;
            finder->begin(body, trial);
            finder->step(body, trial, at);
            body.acceleration(S(0), trial.q, trial.v, rate);
            at -= trial.v[4] / rate[4];
          }
          const std::size_t k = r.relative.size();
          const oracles::Real found = oracles::exact<oracles::Real>(S(before.t + at));
          const oracles::Real exact(form.flip_time(int(k)));
          r.relative.push_back(static_cast<double>(abs(oracles::Real(found - exact)) / exact));
          same = same && r.relative.back() <= 1e-6;
          if (same) ++r.predicted, r.horizon = r.exact[k];
        }
        before = now;
        return r.relative.size() < count && !(stop && *stop);
      });
  if (stop && *stop) throw Stopped();
  if (o.diverged) throw std::runtime_error("Dzhanibekov's body diverges: " + o.why);
  r.relative.resize(count, std::numeric_limits<double>::infinity());
  return r;
}

}  // namespace

std::vector<LongSpin> long_spins(long turns, const std::atomic<bool>* stop) {
  Benchmark b = spinning({1, 2, -1});
  b.duration = double(turns) * 2 * std::numbers::pi / std::sqrt(6.0);
  const auto truth = truth_of(b);
  std::vector<Moment> exact;
  for (int k = 0; k <= 4; ++k) exact.push_back(truth->at(b.duration * k / 4));
  struct Asked {
    const char* name;
    int order;
    std::vector<long> per_turn;
  };
  std::vector<LongSpin> all;
  for (const Asked& m : {Asked{"rkmk4", 4, {64, 512}}, Asked{"rkmk6", 6, {64, 256}},
                         Asked{"gauss6", 6, {64, 256}}, Asked{"gauss12", 12, {8, 12, 16, 24}}})
    for (long n : m.per_turn) {
      const auto runner = make_runner(b, m.name, "double");
      runner->stop = stop;
      MotionError worst = MotionError::none();
      std::size_t k = 0;
      const auto start = std::chrono::steady_clock::now();
      try {
        runner->run({n * turns, 0}, 4, [&](double, const Moment& x) {
          if (k > 0) worst.take_larger(motion_error(b.robot, x, exact[k]));
          ++k;
        });
      } catch (const Stopped&) {
        return all;
      }
      all.push_back({m.name, m.order, turns, n, worst.attitude,
                     double(turns) * 2 * std::numbers::pi * std::numeric_limits<double>::epsilon(),
                     std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
    }
  return all;
}

std::vector<Flips> dzhanibekov_flips(std::size_t flips, const std::atomic<bool>* stop) {
  std::vector<Flips> all;
  try {
    for (int e = 2; e <= 12; ++e) {
      const double delta = std::pow(10.0, -e);
      const Benchmark b = spinning({delta, 1, delta});
      all.push_back(flips_of<double>(b, delta, "double", flips, 8, stop));
      // Later flips depend on the energy above the separatrix, delta^2, with a relative error of
      // eps / delta^2.
      const bool lost = all.back().predicted < flips;
      if (lost && (e <= 8 || e == 12))
        all.push_back(flips_of<float128>(b, delta, "float128", flips, 4, stop));
    }
  } catch (const Stopped&) {  // those that were found before are kept
  }
  return all;
}

}  // namespace liecheck::properties
