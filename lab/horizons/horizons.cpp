#include <horizons/horizons.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <campaign/case_id.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <oracles/exp.hpp>
#include <oracles/quaternion.hpp>
#include <stdexcept>
#include <subjects/subject_names.hpp>
#include <subjects/typed.hpp>
#include <support/names.hpp>
#include <support/run_state.hpp>
#include <support/stop.hpp>
#include <support/threads.hpp>

namespace liecheck::properties {

namespace {

using nlohmann::json;
using oracles::Quaternion;
using oracles::Real;

/// The increments come in sequences of so many, whose exact product is computed once.
constexpr std::uint64_t block = 64;
constexpr std::size_t sequences = 16;

constexpr auto number_of = [](const json& text) { return parse_float(text, oracles::scalar_of<double>); };

std::uint64_t mixed(std::uint64_t x) {  // splitmix64: Steele, Lea & Flood 2014
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}
double uniform(std::uint64_t x) {  // in [-1, 1)
  return std::ldexp(static_cast<double>(mixed(x) >> 11), -52) - 1;
}

/// A random increment, up to 0.1 rad a component.
template <class S>
Vec<S, 3> random_increment(std::uint64_t key, std::uint64_t k) {
  Vec<S, 3> phi;
  for (int i = 0; i < 3; ++i) phi[i] = S(0.1 * uniform(mixed(key) + 3 * k + static_cast<std::uint64_t>(i)));
  return phi;
}

/// 64 increments of a walk: pure is 1e-3 rad about one axis; coning has an axis that goes round; others are random.
template <class S>
std::array<Vec<S, 3>, block> increments(const std::string& walk, std::uint64_t key) {
  std::array<Vec<S, 3>, block> all;
  for (std::uint64_t k = 0; k < block; ++k) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(block);
    if (walk == "pure")
      all[k] = {S(1e-3 / 3), S(-2e-3 / 3), S(2e-3 / 3)};
    else if (walk == "coning")
      all[k] = {S(1e-2 * std::cos(turn)), S(1e-2 * std::sin(turn)), S(1e-3)};
    else
      all[k] = random_increment<S>(key, k);
  }
  return all;
}

template <class S>
Quaternion<Real> exact_exp(const Vec<S, 3>& phi) {
  return oracles::exp_so3(oracles::exact_vector<3>(phi)).Q;
}

/// The increments of a walk with the exact product of each sequence.
template <class S>
struct Increments {
  std::vector<std::array<Vec<S, 3>, block>> phi;
  std::vector<Quaternion<Real>> product;

  Increments(const Walk& walk, std::uint64_t seed) {
    for (std::size_t i = 0; i < (walk.random ? sequences : 1); ++i) {
      phi.push_back(increments<S>(walk.name, mixed(seed) + i));
      Quaternion<Real> Q{{0, 0, 0, 1}};
      for (const auto& one : phi.back()) Q = oracles::quaternion_product(Q, exact_exp(one));
      product.push_back(Q);
    }
  }
  std::size_t sequence(std::uint64_t seed, unsigned path, std::uint64_t at) const {
    return mixed(mixed(seed + path) + at) % phi.size();
  }
};

template <class S>
Vec<S, 4> product(const Vec<S, 4>& a, const Vec<S, 4>& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
          a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
          a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

/// One path, which can be written down between two blocks.
template <class S>
class Path {
 public:
  Path(const TypedOperations<S>& o, const Walk& walk, const Increments<S>& increments, std::uint64_t seed,
       unsigned number)
      : o_(o), walk_(walk), increments_(increments), seed_(seed), number_(number) {
    X_.R.setIdentity(), X_.p.setZero();
    q_ << 0, 0, 0, 0, 0, 0, 1;
  }
  static bool offered(const TypedOperations<S>& o, Step step) {
    switch (step) {
      case Step::integrate:
        return o[op::integrate] != nullptr;
      case Step::first_order_normalize:
        return o[op::exp3_quaternion] && o[op::first_order_normalize];
      case Step::normalize:
        return o[op::exp3_quaternion] && o[op::normalize];
      case Step::compose:
        return o[op::exp6] && o[op::compose] && o[op::inverse];
      case Step::scene:
        return false;
    }
    return false;
  }

  std::uint64_t n() const { return n_; }
  void advance() {
    for (std::uint64_t k = 0; k < block; ++k) step(n_ + k);
    if (!composes())
      truth_ = oracles::quaternion_product(
          truth_, increments_.product[increments_.sequence(seed_, number_, n_ / block)]);
    n_ += block;
    norm_ = larger(norm_, defect());
    longest_ = larger(longest_, X_.p.template cast<double>().norm());
  }
  /// Largest defect of the norm so far, and the angle to the exact attitude [eps]. For Step::compose, whose way back is made
  /// here, the larger one of the angle and of the distance over the longest one so far.
  std::pair<double, double> errors() const {
    if (!composes()) return {norm_ / eps, angle(Vec<S, 4>(q_.template tail<4>())) / eps};
    Path there = *this;
    for (std::uint64_t at = n_; at-- > 0 && (at % block != 0 || !stop_requested);)
      there.X_ = o_[op::compose](there.X_, o_[op::inverse](pose(at)));
    const double turned = (there.X_.R - Mat<S, 3>::Identity()).template cast<double>().norm() / std::sqrt(2);
    const double moved = there.X_.p.template cast<double>().norm() / longest_;
    return {norm_ / eps, larger(turned, moved) / eps};
  }

  json state() const {
    json numbers = json::array();
    for (int i = 0; i < 7; ++i) numbers.push_back(hexadecimal_float(q_[i]));
    for (int i = 0; i < 9; ++i) numbers.push_back(hexadecimal_float(X_.R(i / 3, i % 3)));
    for (int i = 0; i < 3; ++i) numbers.push_back(hexadecimal_float(X_.p[i]));
    json truth = json::array();
    for (int i = 0; i < 4; ++i) truth.push_back(truth_[i].str(0, std::ios_base::scientific));
    return {{"n", n_},
            {"norm", hexadecimal_float(norm_)},
            {"longest", hexadecimal_float(longest_)},
            {"numbers", numbers},
            {"truth", truth}};
  }
  void restore(const json& s) {
    if (!s.at("n").is_number_unsigned()) throw std::invalid_argument("its number of steps is no count");
    n_ = s.at("n"), norm_ = number_of(s.at("norm")), longest_ = number_of(s.at("longest"));
    const json& x = s.at("numbers");
    std::size_t at = 0;
    for (int i = 0; i < 7; ++i) q_[i] = static_cast<S>(number_of(x.at(at++)));
    for (int i = 0; i < 9; ++i) X_.R(i / 3, i % 3) = static_cast<S>(number_of(x.at(at++)));
    for (int i = 0; i < 3; ++i) X_.p[i] = static_cast<S>(number_of(x.at(at++)));
    for (int i = 0; i < 4; ++i)
      truth_[i] = Real(s.at("truth").at(static_cast<std::size_t>(i)).get<std::string>());
  }

 private:
  static constexpr double eps = std::numeric_limits<S>::epsilon();

  bool composes() const { return walk_.step == Step::compose; }
  Vec<S, 3> increment(std::uint64_t at) const {
    if (!walk_.repeated) return random_increment<S>(seed_ + number_, at);
    return increments_.phi[increments_.sequence(seed_, number_, at / block)][at % block];
  }
  void step(std::uint64_t at) {
    const Vec<S, 3> phi = increment(at);
    if (composes()) {
      X_ = o_[op::compose](X_, pose(at));
    } else if (walk_.step != Step::integrate) {
      const Vec<S, 4> Q = product<S>(q_.template tail<4>(), o_[op::exp3_quaternion](phi));
      q_.template tail<4>() =
          walk_.step == Step::normalize ? o_[op::normalize](Q) : o_[op::first_order_normalize](Q);
    } else {
      Vec<S, 6> delta = Vec<S, 6>::Zero();
      delta.template tail<3>() = phi;
      q_ = o_[op::integrate](q_, delta);
    }
  }
  /// The exponential of an increment and of up to 1 m a component.
  Pose<S> pose(std::uint64_t at) const {
    const std::uint64_t own =
        !walk_.repeated ? at : increments_.sequence(seed_, number_, at / block) * block + at % block;
    Vec<S, 6> xi;
    xi << S(10) * random_increment<S>(mixed(seed_ + number_), own), increment(at);
    return o_[op::exp6](xi);
  }
  double defect() const {
    if (composes())
      return (X_.R.template cast<double>().transpose() * X_.R.template cast<double>() -
              Mat<double, 3>::Identity())
          .norm();
    long double sum = -1;
    for (int i = 3; i < 7; ++i) sum += static_cast<long double>(q_[i]) * static_cast<long double>(q_[i]);
    return std::fabs(static_cast<double>(sum));
  }
  double angle(const Vec<S, 4>& stored) const {
    Quaternion<Real> Q = oracles::exact_vector<4>(stored);
    const Real size = oracles::norm(Q), true_size = oracles::norm(truth_);
    Real minus = 0, plus = 0;
    for (int i = 0; i < 4; ++i) {
      const Real a = Q[i] / size, b = truth_[i] / true_size;
      minus += (a - b) * (a - b), plus += (a + b) * (a + b);
    }
    return 2 * static_cast<double>(sqrt(std::min(minus, plus)));
  }

  const TypedOperations<S>& o_;
  Walk walk_;
  const Increments<S>& increments_;
  std::uint64_t seed_;
  unsigned number_;
  std::uint64_t n_ = 0;
  double norm_ = 0, longest_ = 0;
  Vec<S, 7> q_;
  Pose<S> X_;
  Quaternion<Real> truth_{{0, 0, 0, 1}};
};

/// 64 times the powers of sqrt(10), rounded up to multiples of 64, up to the number of steps.
std::vector<std::uint64_t> checkpoints(std::uint64_t steps) {
  std::vector<std::uint64_t> all;
  for (double at = block; at < static_cast<double>(steps); at *= std::sqrt(10.0))
    all.push_back((static_cast<std::uint64_t>(at) + block - 1) / block * block);
  all.push_back((steps + block - 1) / block * block);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// The state of all paths, for several threads.
struct Shared {
  RunState state;
  const HorizonOptions& options;
  std::mutex mutex;

  json get(const std::string& path) {
    const std::lock_guard lock(mutex);
    return state.get(path);
  }
  void put(const std::string& path, json value, bool later) {
    const std::lock_guard lock(mutex);
    state.put(path, std::move(value), later);
  }
  void tell(const std::string& path, double share) {
    const std::lock_guard lock(mutex);
    if (options.progress) options.progress(path, share);
  }
};

/// Goes on with a path to its end. Returns its errors at the checkpoints, or fewer if stop_requested.
template <class S>
std::vector<std::pair<double, double>> walked(Path<S> path, const std::string& name,
                                              const std::vector<std::uint64_t>& at, Shared& shared) {
  std::vector<std::pair<double, double>> errors;
  if (const json before = shared.get(name); !before.is_null()) try {
      path.restore(before);
      for (const json& e : before.at("errors")) errors.emplace_back(number_of(e.at(0)), number_of(e.at(1)));
      // A checkpoint that was reached exactly may have been written before its errors.
      const auto below = std::ranges::lower_bound(at, path.n()) - at.begin(),
                 reached = std::ranges::upper_bound(at, path.n()) - at.begin();
      const auto n = static_cast<std::ptrdiff_t>(errors.size());
      if (path.n() % block != 0 || path.n() > at.back() || n < below || n > reached)
        throw std::invalid_argument("its number of steps does not fit its errors");
    } catch (const json::exception&) {
      throw std::invalid_argument(
          fmt::format("{}: '{}': a member is missing or of another type", shared.state.file(), name));
    } catch (const std::exception& e) {
      throw std::invalid_argument(fmt::format("{}: '{}': {}", shared.state.file(), name, e.what()));
    }
  const auto write = [&](bool end) {
    json s = path.state();
    s["errors"] = json::array();
    for (const auto& [norm, attitude] : errors)
      s["errors"].push_back({hexadecimal_float(norm), hexadecimal_float(attitude)});
    shared.put(name, std::move(s), !end);
  };
  for (std::uint64_t blocks = 0; errors.size() < at.size() && !stop_requested; ++blocks) {
    while (path.n() < at[errors.size()] && !stop_requested) {
      path.advance();
      if (path.n() % (block << 14) != 0) continue;
      write(false);
      shared.tell(name, static_cast<double>(path.n()) / static_cast<double>(at.back()));
    }
    if (stop_requested) break;
    const auto e = path.errors();
    if (stop_requested) break;
    errors.push_back(e);
    write(errors.size() == at.size());
  }
  if (stop_requested) write(true);
  return errors;
}

template <class S>
std::optional<Horizon> measured(const TypedSubject<S>& subject, const Walk& walk, Shared& shared) {
  const HorizonOptions& o = shared.options;
  const unsigned paths = walk.random ? o.paths : 1;
  const Increments<S> increments(walk, o.seed);
  const auto at = checkpoints(o.steps);
  std::vector<std::vector<std::pair<double, double>>> errors(paths);
  std::atomic<unsigned> next{0};
  std::atomic<bool> stop{false};
  run_on_threads(std::min(o.jobs, paths), stop, [&] {
    for (unsigned i = next++; i < paths && !stop && !stop_requested; i = next++)
      errors[i] = walked(
          Path<S>(subject.operations, walk, increments, o.seed, i),
          fmt::format("{} {} {} {}", subject.name, std::string(oracles::scalar_of<S>.name), walk.name, i), at,
          shared);
  });
  if (stop_requested) return std::nullopt;
  Horizon h{subject.name, std::string(oracles::scalar_of<S>.name), walk.name, {}};
  h.norm_limit = walk.norm, h.angle_limit = walk.angle;
  for (std::size_t k = 0; k < at.size(); ++k) {
    HorizonPoint p{at[k]};
    for (const auto& e : errors) {
      p.norm = larger(p.norm, e[k].first);
      p.attitude += e[k].second * e[k].second / paths;
    }
    p.attitude = std::sqrt(p.attitude);
    h.points.push_back(p);
  }
  fit_growth(h, paths);
  return h;
}

template <class S>
bool measure_in(Shared& shared, const std::function<void(const Horizon&)>& report) {
  const HorizonOptions& o = shared.options;
  if (!std::ranges::count(o.scalars, std::string(oracles::scalar_of<S>.name))) return true;
  for (const std::string& name : o.subjects)
    for (const TypedSubject<S>* s : typed_subjects<S>()) {
      if (s->name != name) continue;
      for (const std::string& asked : o.walks) {
        const Walk& walk = *std::ranges::find(horizon_walks, asked, &Walk::name);
        if (walk.step == Step::scene) continue;
        if (!Path<S>::offered(s->operations, walk.step)) {
          if (o.left_out)
            o.left_out(fmt::format("{} offers no {} in {}", name, walk.name,
                                   std::string(oracles::scalar_of<S>.name)));
          continue;
        }
        const auto h = measured(*s, walk, shared);
        if (!h) return false;
        report(*h);
      }
    }
  return true;
}

}  // namespace

std::vector<std::string> horizon_walk_names() {
  return names_of(horizon_walks, &Walk::name);
}

bool measure_horizons(const HorizonOptions& o, const std::function<void(const Horizon&)>& report) {
  check_known(o.walks, horizon_walk_names(), "--walk", "walk");
  check_known(o.scalars, {"float", "double"}, "--scalar", "scalar");
  const auto subjects = subject_names();
  for (const std::string& name : o.subjects)
    if (!std::ranges::count(subjects, name))
      throw std::invalid_argument(
          fmt::format("--subject: unknown subject '{}'; 'liecheck list' shows them", name));
  Shared shared{{o.state,
                 {{"horizons_of_liecheck", LIECHECK_VERSION},
                  {"steps", o.steps},
                  {"paths", o.paths},
                  {"seed", o.seed}}},
                o,
                {}};
  return measure_in<float>(shared, report) && measure_in<double>(shared, report);
}

}  // namespace liecheck::properties
