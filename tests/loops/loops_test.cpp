// The loops of the adapters of Eigen and Ceres beside loops that a user of these libraries writes, compiled with the same
// flags: an adapter's time is that of the library.

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <ceres/rotation.h>
#include <liecheck_loops.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;
constexpr std::size_t n = 256;
using Run = std::function<void()>;

double processor_time() {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// Random rotations and points, as Eigen, Ceres and an adapter have them.
struct Inputs {
  std::vector<Quaterniond> q, q2;
  std::vector<Vector3d> p;
  std::vector<std::array<double, 4>> wxyz;
  std::vector<double> q_numbers, q_p, q_q, p_numbers;

  Inputs() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
    const auto add = [](std::vector<double>& to, const auto& numbers) {
      to.insert(to.end(), numbers.data(), numbers.data() + numbers.size());
    };
    for (std::size_t i = 0; i < n; ++i) {
      const auto rotation = [&] {
        return Quaterniond(AngleAxisd(1.5 + 1.4 * uniform(random), vector().normalized()));
      };
      q.push_back(rotation()), q2.push_back(rotation()), p.push_back(vector());
      wxyz.push_back({q[i].w(), q[i].x(), q[i].y(), q[i].z()});
      add(q_numbers, q[i].coeffs()), add(p_numbers, p[i]), add(q_p, q[i].coeffs()), add(q_p, p[i]);
      add(q_q, q[i].coeffs()), add(q_q, q2[i].coeffs());
    }
  }
};

/// The compiler may leave out no result.
template <class F>
Run throughput_by_hand(F f) {
  return [=] {
    for (std::size_t i = 0; i < n; ++i) {
      const auto result = f(i);
      asm volatile("" : : "r"(&result) : "memory");
    }
  };
}
/// Each call waits for the numbers of the result before that define latency (docs/adapters.md).
template <class F>
Run latency_by_hand(F f) {
  return [=] {
    volatile std::size_t unknown = 0;
    const std::size_t zero = unknown;
    std::size_t i = 0;
    for (std::size_t k = 0; k < n; ++k) i += 1 + (liecheck::adapter::bits_of(f(i)) & zero);
    asm volatile("" : : "r"(i));
  };
}

/// An adapter's loops over the same inputs.
class Adapter {
 public:
  Adapter(const char* file, const char* operation, const std::vector<double>& inputs) {
    void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    EXPECT_TRUE(library) << dlerror();
    const auto get =
        reinterpret_cast<decltype(&liecheck_get_adapter)>(dlsym(library, "liecheck_get_adapter"));
    loops_ = reinterpret_cast<decltype(&liecheck_get_loops)>(dlsym(library, "liecheck_get_loops"))(operation,
                                                                                                   "double");
    calls_ = loops_->prepare(get()->context, n, inputs.data());
  }
  bool own_types() const { return loops_->own_types != 0; }
  Run throughput() const {
    return [this] { loops_->throughput(calls_, 0, n); };
  }
  Run latency() const {
    return [this] { loops_->latency(calls_, 0, n); };
  }

 private:
  const liecheck_loops* loops_;
  void* calls_;
};

/// The median of the ratios of both times, each measured in turns for a tenth of a millisecond, so that what else the machine
/// does slows both.
double ratio(const Run& adapter, const Run& by_hand) {
  std::vector<double> ratios;
  const auto time = [](const Run& run) {
    const double start = processor_time();
    for (int pass = 0; pass < 30; ++pass) run();
    return processor_time() - start;
  };
  time(adapter), time(by_hand);
  for (int k = 0; k < 301; ++k) {
    const double a = time(adapter), b = time(by_hand), c = time(adapter);
    ratios.push_back((a + c) / 2 / b);
  }
  std::nth_element(ratios.begin(), ratios.begin() + 150, ratios.end());
  return ratios[150];
}

/// The time of a call by hand [ns].
double least_time(const Run& by_hand) {
  double ns = 1e9;
  for (int pass = 0; pass < 100; ++pass) {
    const double start = processor_time();
    by_hand();
    ns = std::min(ns, (processor_time() - start) / n);
  }
  return ns;
}

/// 5 %, and for a call 0.4 ns, a cycle of a processor: where the compiler lays out two loops otherwise, one of them may take
/// a cycle more, which is 5 % of a call of 8 ns only. The best of five copies of the arguments: a copy whose calls lie across
/// lines of the cache takes up to 2 ns more, and its address is chance. `cost` takes the median of 20 processes instead.
template <class F>
void compare(const char* file, const char* operation, const std::vector<double>& inputs, F f) {
  std::vector<std::unique_ptr<Adapter>> copies;
  std::vector<std::unique_ptr<char[]>> between;
  for (std::size_t i = 0; i < 5; ++i) {
    copies.push_back(std::make_unique<Adapter>(file, operation, inputs));
    between.push_back(std::make_unique<char[]>(1 + 16 * i));
  }
  for (const bool waits : {false, true}) {
    const Run by_hand = waits ? latency_by_hand(f) : throughput_by_hand(f);
    const double allowed = 0.05 + 0.4 / least_time(by_hand);
    double best = 10;
    for (const auto& adapter : copies) {
      const double r = ratio(waits ? adapter->latency() : adapter->throughput(), by_hand);
      if (std::abs(r - 1) < std::abs(best - 1)) best = r;
      if (std::abs(best - 1) <= allowed) break;
    }
    EXPECT_NEAR(best, 1, allowed) << operation << (waits ? " latency" : " throughput");
    std::printf("%-20s%-12s%.3f\n", operation, waits ? "latency" : "throughput", best);
  }
}

const Inputs& inputs() {
  static const Inputs all;
  return all;
}

TEST(Loops, OfEigenTakeTheTimeOfALoopByHand) {
  const Inputs& in = inputs();
  const Quaterniond *q = in.q.data(), *q2 = in.q2.data();
  const Vector3d* p = in.p.data();
  const char* const file = LIECHECK_EIGEN_ADAPTER;
  compare(file, "rotate_point", in.q_p, [=](std::size_t i) { return Vector3d(q[i] * p[i]); });
  compare(file, "quaternion_product", in.q_q, [=](std::size_t i) { return q[i] * q2[i]; });
  compare(file, "normalize", in.q_numbers, [=](std::size_t i) { return q[i].normalized(); });
  compare(file, "log3_quaternion", in.q_numbers, [=](std::size_t i) { return AngleAxisd(q[i]); });
}

TEST(Loops, OfCeresTakeTheTimeOfALoopByHand) {
  const Inputs& in = inputs();
  const auto* q = in.wxyz.data();
  const Vector3d* p = in.p.data();
  const char* const file = LIECHECK_CERES_ADAPTER;
  using Three = std::array<double, 3>;
  compare(file, "log3_quaternion", in.q_numbers, [=](std::size_t i) {
    Three phi;
    ceres::QuaternionToAngleAxis(q[i].data(), phi.data());
    return phi;
  });
  compare(file, "rotate_point", in.q_p, [=](std::size_t i) {
    Three y;
    ceres::UnitQuaternionRotatePoint(q[i].data(), p[i].data(), y.data());
    return y;
  });
  compare(file, "exp3_quaternion", in.p_numbers, [=](std::size_t i) {
    std::array<double, 4> Q;
    ceres::AngleAxisToQuaternion(p[i].data(), Q.data());
    return Q;
  });
}

TEST(Loops, SayWhetherTheyCallWithTheLibrarysOwnTypes) {
  EXPECT_TRUE(Adapter(LIECHECK_CERES_ADAPTER, "rotate_point", inputs().q_p).own_types());
  EXPECT_FALSE(Adapter(LIECHECK_CERES_ADAPTER, "exp3_matrix", inputs().p_numbers).own_types());
}

}  // namespace
