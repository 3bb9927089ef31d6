#include <timing/batch_bench.hpp>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <liecheck/algorithms/aba.hpp>
#include <liecheck/batch/poses.hpp>
#include <liecheck/batch/trees.hpp>
#include <liecheck/multibody/se3_configuration.hpp>
#include <liecheck/urdf/urdf.hpp>
#include <random>
#include <support/embedded.hpp>
#include <support/stop.hpp>
#include <tuple>

namespace liecheck::properties {

namespace {

using Clock = std::chrono::steady_clock;
using batch::Rows;

/// How a user stores one column, and its conversion from rows.
template <class S, int ROWS>
struct Single {
  using type = Eigen::Matrix<S, ROWS, 1>;
  static type of(const Rows<S, ROWS>& rows, Eigen::Index i) { return rows.col(i); }
};
template <class S>
struct Single<S, 12> {
  using type = SE3<S>;
  static type of(const Rows<S, 12>& rows, Eigen::Index i) {
    SE3<S> X(Matrix3<S>::Zero(), Vector3<S>(rows.col(i).template tail<3>()));
    Matrix3<S> R;
    for (int k = 0; k < 9; ++k) R(k / 3, k % 3) = rows(k, i);
    return SE3<S>(R, X.translation());
  }
};
template <class S>
struct Single<S, 36> {
  using type = Matrix6<S>;
};

/// Columns of random poses with |phi| < pi and translations about 1 m.
template <class S>
struct Inputs {
  Rows<S, 6> delta;
  Rows<S, 7> q, q1;
  Rows<S, 12> X, Y;
  Rows<S, 3> x;
  explicit Inputs(long n) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    constexpr long period = 4096;  // random numbers take long
    Rows<S, 6> some(6, period), others(6, period);
    for (auto* all : {&some, &others})
      for (Eigen::Index i = 0; i < all->size(); ++i) all->data()[i] = S(1.8 * uniform(random));
    delta = some.replicate(1, n / period + 1).leftCols(n);
    q = batch::exp6<S>(Rows<S, 6>(others.replicate(1, n / period + 1).leftCols(n)));
    q1 = batch::integrate<S>(q, delta);
    X = batch::exp6Matrix<S>(delta), Y = X.rowwise().reverse();
    x = delta.template topRows<3>();
  }
};

/// Seconds of one call of f, from as many calls as take `least` seconds. The clock is read after some calls
/// each.
double seconds_of(const std::function<void()>& f, long some, double least) {
  const auto start = Clock::now();
  double elapsed = 0;
  long calls = 0;
  do {
    for (long k = 0; k < some; ++k) f();
    calls += some;
    elapsed = std::chrono::duration<double>(Clock::now() - start).count();
  } while (elapsed < least && !stop_requested);
  return elapsed / double(calls);
}

BatchTime summary(std::vector<double> times, long columns) {
  std::ranges::sort(times);
  const auto quantile = [&](double f) { return times[std::size_t(f * double(times.size() - 1) + 0.5)]; };
  return {quantile(0.5) / double(columns) * 1e9, (quantile(0.75) - quantile(0.25)) / 2 / quantile(0.5)};
}

class Bench {
 public:
  Bench(const BatchBenchOptions& options, const std::function<void(const BatchRow&)>& done)
      : options_(options), done_(done) {}

  /// single(columns...) computes one column, many(rows..., options, result) a batch.
  template <int OUT, class S, class One, class Many, int... IN>
  void row(const char* name, One single, Many many, const Rows<S, IN>&... in) const {
    if (!wanted(name)) return;
    const auto n = std::get<0>(std::tie(in...)).cols();
    const auto make = [](const auto& rows, auto column) {
      std::vector<typename decltype(column)::type> all;
      for (Eigen::Index i = 0; i < rows.cols(); ++i) all.push_back(decltype(column)::of(rows, i));
      return all;
    };
    const auto one_by_one = std::make_tuple(make(in, Single<S, IN>())...);
    std::vector<typename Single<S, OUT>::type> results(
        std::size_t(n), std::apply([&](const auto&... x) { return single(x.front()...); }, one_by_one));
    Rows<S, OUT> result(OUT, n);
    measure<S>(
        name, n, (OUT + ... + IN),
        [&] {
          std::apply(
              [&](const auto&... x) {
                for (std::size_t i = 0; i < results.size(); ++i) results[i] = single(x[i]...);
              },
              one_by_one);
          keep(results.data());
        },
        [&](const batch::Options& o) {
          result = many(in..., o, std::move(result));
          keep(result.data());
        });
  }

  bool wanted(const std::string& name) const {
    return !stop_requested &&
           (options_.operations.empty() || std::ranges::count(options_.operations, name) > 0);
  }
  static void keep(const void* data) { asm volatile("" : : "r"(data) : "memory"); }

  /// `rows` numbers of each of n columns are read or written.
  template <class S>
  void measure(const char* name, long n, long rows, const std::function<void()>& loop,
               const std::function<void(const batch::Options&)>& many) const {
    const std::size_t moved = std::size_t(rows * n) * sizeof(S) / 2;
    const std::vector<char> from(moved, 1);
    std::vector<char> to(moved);
    std::vector<std::function<void()>> work{loop};
    work.push_back([&] { std::memcpy(to.data(), from.data(), moved), keep(to.data()); });
    for (const auto instructions : options_.instructions)
      work.push_back([&, o = batch::Options{options_.threads, instructions}] { many(o); });
    std::vector<std::vector<double>> times(work.size());
    for (const auto& f : work) f();
    for (int round = 0; round < options_.rounds; ++round)
      for (std::size_t w = 0; w < work.size(); ++w)
        times[w].push_back(seconds_of(work[w], 1 + 10000 / n, options_.seconds));
    if (stop_requested) return;
    BatchRow row{name, sizeof(S) == 4 ? "float" : "double", n, summary(times[0], n), summary(times[1], n),
                 {}};
    for (std::size_t w = 2; w < work.size(); ++w) row.batch.push_back(summary(times[w], n));
    done_(row);
  }

 private:
  const BatchBenchOptions& options_;
  const std::function<void(const BatchRow&)>& done_;
};

/// Calls visit(name, rows of the result, single, many, arguments of `in`...) for each operation.
template <class S>
void rows_of(const Bench& bench, const Inputs<S>& in) {
  bench.row<7, S>(
      "exp6", [](const Vector6<S>& xi) { return quaternion::exp6<S>(Motion<S>(xi)); },
      [](auto&&... a) { return batch::exp6(std::forward<decltype(a)>(a)...); }, in.delta);
  bench.row<6, S>(
      "log6", [](const Vector7<S>& q) { return quaternion::log6<S>(q).to_vector(); },
      [](auto&&... a) { return batch::log6(std::forward<decltype(a)>(a)...); }, in.q);
  bench.row<7, S>(
      "integrate", [](const auto& q, const auto& delta) { return integrateSE3<S>(q, delta); },
      [](auto&&... a) { return batch::integrate(std::forward<decltype(a)>(a)...); }, in.q, in.delta);
  bench.row<6, S>(
      "difference", [](const auto& q0, const auto& q1) { return differenceSE3<S>(q0, q1); },
      [](auto&&... a) { return batch::difference(std::forward<decltype(a)>(a)...); }, in.q, in.q1);
  bench.row<3, S>(
      "act",
      [](const Vector7<S>& q, const Vector3<S>& x) {
        const Vector3<S> r = SO3<S>(Vector4<S>(q[3], q[4], q[5], q[6])).act(x);
        return Vector3<S>(q[0] + r[0], q[1] + r[1], q[2] + r[2]);
      },
      [](auto&&... a) { return batch::act(std::forward<decltype(a)>(a)...); }, in.q, in.x);
  bench.row<12, S>(
      "exp6Matrix", [](const Vector6<S>& xi) { return exp6<S>(Motion<S>(xi)); },
      [](auto&&... a) { return batch::exp6Matrix(std::forward<decltype(a)>(a)...); }, in.delta);
  bench.row<12, S>(
      "compose", [](const SE3<S>& X, const SE3<S>& Y) { return X * Y; },
      [](auto&&... a) { return batch::compose(std::forward<decltype(a)>(a)...); }, in.X, in.Y);
  bench.row<3, S>(
      "actMatrix", [](const SE3<S>& X, const Vector3<S>& x) { return X.act(x); },
      [](auto&&... a) { return batch::act(std::forward<decltype(a)>(a)...); }, in.X, in.x);
  bench.row<36, S>(
      "Jexp6", [](const Vector6<S>& xi) { return Jexp6<S>(Motion<S>(xi)); },
      [](auto&&... a) { return batch::Jexp6(std::forward<decltype(a)>(a)...); }, in.delta);
  bench.row<36, S>(
      "Jlog6", [](const Vector7<S>& q) { return rightJacobianInverse<S>(quaternion::log6<S>(q)); },
      [](auto&&... a) { return batch::Jlog6(std::forward<decltype(a)>(a)...); }, in.q);
}

/// The built-in quadruped with a free-flyer, in n random states.
template <class S>
void tree_rows(const Bench& bench, const Model<S>& m, long n) {
  using batch::States;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto states = [&](int rows) {
    return States<S>(States<S>::NullaryExpr(rows, n, [&] { return S(uniform(random)); }));
  };
  States<S> q = states(m.nq), result;
  const States<S> v = states(m.nv), a = states(m.nv);
  for (Eigen::Index i = 0; i < n; ++i) q.col(i).template segment<4>(3).matrix().normalize();
  const auto columns = [](const States<S>& rows) {
    std::vector<VectorX<S>> all;
    for (Eigen::Index i = 0; i < rows.cols(); ++i) all.push_back(rows.col(i));
    return all;
  };
  const auto qs = columns(q), vs = columns(v), as = columns(a);
  auto results = vs;
  Data<S> data(m);
  if (bench.wanted("forwardKinematics")) {
    const std::size_t joints = std::size_t(m.njoints), size = qs.size();
    std::vector<SE3<S>> poses(size * joints);
    bench.measure<S>(
        "forwardKinematics", n, m.nq + 12 * m.njoints,
        [&] {
          for (std::size_t i = 0; i < size; ++i) {
            forwardKinematics(m, data, qs[i]);
            std::ranges::copy(data.oMi(), poses.begin() + std::ptrdiff_t(i * joints));
          }
        },
        [&](const batch::Options& o) { result = batch::forwardKinematics(m, q, o, std::move(result)); });
  }
  const auto row = [&](const char* name, const auto& single, const auto& many) {
    if (bench.wanted(name))
      bench.measure<S>(
          name, n, m.nq + 3 * m.nv,
          [&] {
            for (std::size_t i = 0; i < qs.size(); ++i) results[i] = single(m, data, qs[i], vs[i], as[i]);
          },
          [&](const batch::Options& o) { result = many(m, q, v, a, o, States<S>(), std::move(result)); });
  };
  row(
      "rnea", [](auto&&... x) { return rnea<S>(x...); },
      [](auto&&... x) { return batch::rnea<S>(std::forward<decltype(x)>(x)...); });
  row(
      "aba", [](auto&&... x) { return aba<S>(x...); },
      [](auto&&... x) { return batch::aba<S>(std::forward<decltype(x)>(x)...); });
}

}  // namespace

std::vector<std::pair<std::string, batch::Instructions>> supportedInstructions() {
  std::vector<std::pair<std::string, batch::Instructions>> all{{"baseline", batch::Instructions::baseline},
                                                               {"avx2", batch::Instructions::avx2},
                                                               {"avx512", batch::Instructions::avx512}};
  std::erase_if(all, [](const auto& i) { return !batch::supported(i.second); });
  return all;
}

std::vector<std::string> batch_operations() {
  return {"exp6",      "log6",  "integrate", "difference",        "act",  "exp6Matrix", "compose",
          "actMatrix", "Jexp6", "Jlog6",     "forwardKinematics", "rnea", "aba"};
}

void time_batches(const BatchBenchOptions& options, const std::function<void(const BatchRow&)>& done) {
  const Bench bench(options, done);
  const Model<double> quadruped = buildModelFromUrdfText(quadruped_urdf, RootJoint::FreeFlyer);
  for (const long n : options.columns) {
    if (!stop_requested) rows_of(bench, Inputs<double>(n));
    if (!stop_requested) rows_of(bench, Inputs<float>(n));
    if (n > 100'000) continue;
    if (!stop_requested) tree_rows<double>(bench, quadruped, n);
    if (!stop_requested) tree_rows<float>(bench, quadruped.cast<float>(), n);
  }
}

}  // namespace liecheck::properties
