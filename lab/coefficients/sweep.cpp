#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <coefficients/sweep.hpp>
#include <limits>
#include <memory>
#include <mutex>
#include <support/threads.hpp>
#include <utility>

namespace liecheck::properties {
namespace {

constexpr double eps = std::numeric_limits<float>::epsilon();
/// Numbers of consecutive floats: in one evaluation, in the largest interval that is tried for a constant
/// value, and in one task of a thread.
constexpr std::uint32_t block = 1U << 12, interval = 1U << 20, task = 1U << 22;
constexpr std::size_t padding = 4;  ///< CoefficientCode::evaluate may read and write beyond the end
/// If the oracle's bound exceeds this value, 1e-4 eps, an interval is too wide for a cubic polynomial.
constexpr double largest_oracle_bound = 1e-11;

float float_of(std::uint32_t bits) {
  return std::bit_cast<float>(bits);
}

/// The counts and the largest errors of one coefficient over the floats swept so far.
struct Largest {
  std::uint64_t evaluated = 0, constant = 0;
  double error = 0, oracle = 0, condition = 0;
  std::uint32_t at = 0;  ///< bits of the float with the largest error

  void add(double e, std::uint32_t bits) {
    if (e > error || (e == error && bits < at)) error = e, at = bits;
  }
  void merge(const Largest& f) {
    evaluated += f.evaluated, constant += f.constant;
    oracle = std::max(oracle, f.oracle), condition = std::max(condition, f.condition);
    add(f.error, f.at);
  }
};

using Pair = double __attribute__((vector_size(16)));

/// The error |f p(u) - 1|, or |f - p(u)| if `absolute`; infinity if f is NaN. T is double or Pair.
template <bool absolute, class T>
T error_of(const T& x, const T& f, const oracles::LocalExpansion& o) {
  const T u = x - o.centre, most = T{} + std::numeric_limits<double>::infinity();
  const T value = o.p[0] + u * (o.p[1] + u * (o.p[2] + u * o.p[3]));
  const T e = absolute ? f - value : f * value - 1.0;
  const T size = e < 0.0 ? -e : e;
  return size < most ? size : most;
}

template <bool absolute>
double largest_error(const float* x, const float* f, std::size_t n, const oracles::LocalExpansion& o) {
  Pair worst[2] = {};
  for (std::size_t i = 0; i < n; i += 4)
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t j = i + 2 * k;
      const Pair e = error_of<absolute>(Pair{x[j], x[j + 1]}, Pair{f[j], f[j + 1]}, o);
      worst[k] = e > worst[k] ? e : worst[k];
    }
  return std::max({worst[0][0], worst[0][1], worst[1][0], worst[1][1]});
}

double error_at(float x, float f, const oracles::LocalExpansion& o, bool absolute) {
  return absolute ? error_of<true, double>(x, f, o) : error_of<false, double>(x, f, o);
}

/// Sweeps one CoefficientCode, on one thread.
class Sweeper {
 public:
  Sweeper(const CoefficientCode& code, std::uint32_t stride, const std::vector<bool>& wanted)
      : code_(code), stride_(stride), wanted_(wanted), largest_(code.outputs.size()) {
    for (std::size_t k = 0; k < code.outputs.size(); ++k) out_[k] = results_[k].data();
  }
  const std::vector<Largest>& largest() const { return largest_; }

  /// Sweeps the floats whose bits are in [first, end). Returns false if it was stopped. Precondition: they belong to one
  /// task.
  bool sweep(std::uint32_t first, std::uint32_t end, const std::atomic<bool>& stop) {
    for (std::uint32_t from = first; from < end; from += interval) {
      const std::uint32_t to = std::min(end, from + interval);
      if (sweep_ends(from, to)) continue;
      for (std::uint32_t b = from; b < to; b += block) {
        if (stop) return false;
        const std::uint32_t until = std::min(to, b + block);
        if (!sweep_ends(b, until)) sweep_block(b, until);
      }
    }
    return true;
  }

 private:
  /// If the code returns one value over the interval and the exact coefficient is monotone, the largest error
  /// is at one of the ends. Then this function adds both ends and returns true. Otherwise it returns false.
  bool sweep_ends(std::uint32_t from, std::uint32_t end) {
    if (stride_ != 1) return false;
    const float low = float_of(from), high = float_of(end - 1);
    float value[outputs_at_most];
    if (!code_.constant(low, high, value)) return false;
    std::array<oracles::LocalExpansion, outputs_at_most> all;
    const double w = (static_cast<double>(high) - low) / 2;
    for (std::size_t k = 0; k < largest_.size(); ++k) {
      const auto& o = all[k] = oracles::expand(code_.outputs[k], low, high);
      const bool monotone = std::fabs(o.p[1]) > w * (2 * std::fabs(o.p[2]) + w * 3 * std::fabs(o.p[3]));
      if (!monotone || !(o.bound <= largest_oracle_bound)) return false;
    }
    for (std::size_t k = 0; k < largest_.size(); ++k) {
      if (!wanted_[k]) continue;
      add_interval(k, all[k], w, end - from);
      largest_[k].constant += end - from;
      const bool absolute = oracles::is_absolute(code_.outputs[k]);
      largest_[k].add(error_at(low, value[k], all[k], absolute), from);
      largest_[k].add(error_at(high, value[k], all[k], absolute), end - 1);
    }
    return true;
  }

  void sweep_block(std::uint32_t from, std::uint32_t end) {
    const std::uint64_t next = (std::uint64_t{from} + stride_ - 1) / stride_ * stride_;
    if (next >= end) return;
    const std::size_t n = (end - 1 - next) / stride_ + 1;
    for (std::size_t i = 0; i < n; ++i) x_[i] = float_of(static_cast<std::uint32_t>(next + i * stride_));
    for (std::size_t i = n; i < (n + padding - 1) / padding * padding; ++i) x_[i] = x_[n - 1];
    code_.evaluate(x_.data(), n, out_.data());
    const float low = x_[0], high = x_[n - 1];
    for (std::size_t k = 0; k < largest_.size(); ++k) {
      if (!wanted_[k]) continue;
      const bool absolute = oracles::is_absolute(code_.outputs[k]);
      const auto o = oracles::expand(code_.outputs[k], low, high);
      add_interval(k, o, (static_cast<double>(high) - low) / 2, n);
      float* f = out_[k];
      for (std::size_t i = n; i < (n + padding - 1) / padding * padding; ++i) f[i] = f[n - 1];
      const double most =
          absolute ? largest_error<true>(x_.data(), f, n, o) : largest_error<false>(x_.data(), f, n, o);
      if (!(most > largest_[k].error)) continue;  // the first of several equal errors is stored
      for (std::size_t i = 0; i < n; ++i)
        largest_[k].add(error_at(x_[i], f[i], o, absolute), static_cast<std::uint32_t>(next + i * stride_));
    }
  }

  /// Adds an interval of half width w with n floats.
  void add_interval(std::size_t k, const oracles::LocalExpansion& o, double w, std::uint64_t n) {
    Largest& f = largest_[k];
    f.evaluated += n;
    f.oracle = std::max(f.oracle, o.bound);
    f.condition = std::max(f.condition, o.condition(w, oracles::is_absolute(code_.outputs[k])));
  }

  static constexpr std::size_t outputs_at_most = 6;
  const CoefficientCode& code_;
  std::uint32_t stride_;
  const std::vector<bool>& wanted_;
  std::vector<Largest> largest_;
  std::array<float, block + padding> x_;
  std::array<std::array<float, block + padding>, outputs_at_most> results_;
  std::array<float*, outputs_at_most> out_;
};

/// One CoefficientCode, with its outputs that are selected.
struct Part {
  const CoefficientCode* code;
  std::vector<bool> wanted;
  std::vector<Largest> largest;
  /// One past the bits of the last float.
  std::uint64_t end() const { return std::uint64_t{std::bit_cast<std::uint32_t>(code->last)} + 1; }
};

/// The parts that compute a selected coefficient; an empty selection means all.
std::vector<Part> parts_of(const std::vector<CoefficientCode>& code,
                           const std::vector<Coefficient>& selected) {
  std::vector<Part> parts;
  for (const CoefficientCode& c : code) {
    Part part{&c, {}, std::vector<Largest>(c.outputs.size())};
    for (const Coefficient o : c.outputs)
      part.wanted.push_back(selected.empty() || std::ranges::count(selected, o));
    if (std::ranges::count(part.wanted, true)) parts.push_back(std::move(part));
  }
  return parts;
}

double rounded_up(double x) {
  return x * (1 + 0x1p-50);
}

SweptCoefficient swept(Coefficient c, const Largest& f) {
  SweptCoefficient s{&coefficient_claims().at(static_cast<std::size_t>(c))};
  s.evaluated = f.evaluated, s.constant = f.constant;
  s.max_eps = f.error / eps, s.max_at = float_of(f.at);
  s.oracle_bound_eps = rounded_up(f.oracle / eps);
  if (c != Coefficient::angle_over_sine && c != Coefficient::alpha)
    s.square_eps = rounded_up(f.condition / 2);
  // For relative errors |f/F - 1| <= |f p - 1| + |f/F| |p F - 1|, and |f/F| <= 1 + error.
  const double factor = oracles::is_absolute(c) ? 1 : 1 + f.error + 2 * f.oracle;
  s.bound_eps = rounded_up((f.error + factor * f.oracle) / eps);
  return s;
}

}  // namespace

bool SweepResult::failed(const SweptCoefficient& c) const {
  return !((upper_bound() ? c.bound_eps : c.max_eps - c.oracle_bound_eps) <= c.claim->documented_eps);
}

bool SweepResult::failed() const {
  return std::any_of(coefficients.begin(), coefficients.end(), [this](const auto& c) { return failed(c); });
}

SweepResult sweep(const SweepOptions& options, const std::vector<CoefficientCode>& code) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Part> parts = parts_of(code, options.coefficients);
  std::vector<std::pair<std::size_t, std::uint64_t>> tasks;  // a part, and the bits of the first float
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (std::uint64_t first = 0; first < parts[k].end(); first += task) tasks.emplace_back(k, first);
  std::atomic<std::uint64_t> next{0}, done{0};
  std::atomic<bool> never{false};
  std::atomic<bool>& stop = options.stop ? *options.stop : never;
  std::mutex mutex;
  const auto work = [&] {
    std::vector<std::unique_ptr<Sweeper>> own;
    for (const Part& p : parts) own.push_back(std::make_unique<Sweeper>(*p.code, options.stride, p.wanted));
    while (!stop) {
      const std::uint64_t t = next++;
      if (t >= tasks.size()) break;
      const auto [k, first] = tasks[t];
      const auto end = static_cast<std::uint32_t>(std::min(parts[k].end(), first + task));
      if (!own[k]->sweep(static_cast<std::uint32_t>(first), end, stop)) break;
      const std::uint64_t so_far = ++done;
      const std::lock_guard lock(mutex);
      options.progress(static_cast<double>(so_far) / static_cast<double>(tasks.size()));
    }
    const std::lock_guard lock(mutex);
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (std::size_t i = 0; i < parts[k].largest.size(); ++i)
        parts[k].largest[i].merge(own[k]->largest()[i]);
  };
  run_on_threads(options.jobs, stop, work);

  SweepResult result;
  result.stride = options.stride;
  result.complete = done == tasks.size();
  for (const Part& p : parts)
    for (std::size_t i = 0; i < p.largest.size(); ++i)
      if (p.wanted[i]) result.coefficients.push_back(swept(p.code->outputs[i], p.largest[i]));
  result.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace liecheck::properties
