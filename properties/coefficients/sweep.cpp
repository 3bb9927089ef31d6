#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <coefficients/sweep.hpp>
#include <support/threads.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

namespace liecheck::properties {
namespace {

constexpr double eps = std::numeric_limits<float>::epsilon();
constexpr std::uint32_t block = 1u << 12, run = 1u << 20, unit = 1u << 22;  // floats
constexpr std::size_t lanes = 8;
/// Beyond it an interval is too wide for its cubic: 1e-4 eps.
constexpr double widest_bound = 1e-11;

float float_of(std::uint32_t bits) {
  return std::bit_cast<float>(bits);
}

/// What is known of one coefficient.
struct Found {
  std::uint64_t evaluated = 0, constant = 0;
  double error = 0, oracle = 0, condition = 0;
  std::uint32_t at = 0;  ///< bits

  void measured(double e, std::uint32_t bits) {
    if (e > error || (e == error && bits < at)) error = e, at = bits;
  }
  void merge(const Found& f) {
    evaluated += f.evaluated, constant += f.constant;
    oracle = std::max(oracle, f.oracle), condition = std::max(condition, f.condition);
    measured(f.error, f.at);
  }
};

using Pair = double __attribute__((vector_size(16)));
Pair both(double x) {
  return Pair{x, x};
}

/// |f p(u) - 1|, or |f - p(u)|; infinite where f is no number.
template <bool absolute, class T>
T error_of(const T& x, const T& f, const std::array<T, 5>& p, const T& one, const T& zero, const T& most) {
  const T u = x - p[4];
  const T value = p[0] + u * (p[1] + u * (p[2] + u * p[3]));
  const T e = absolute ? f - value : f * value - one;
  const T size = e < zero ? -e : e;
  return size < most ? size : most;
}

template <bool absolute>
double largest_error(const float* x, const float* f, std::size_t n, const oracles::LocalExpansion& o) {
  const std::array<Pair, 5> p = {both(o.p[0]), both(o.p[1]), both(o.p[2]), both(o.p[3]), both(o.centre)};
  const Pair one = both(1), zero = both(0), most = both(std::numeric_limits<double>::infinity());
  Pair worst[2] = {zero, zero};
  for (std::size_t i = 0; i < n; i += 4)
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t j = i + 2 * k;
      const Pair e = error_of<absolute>(Pair{x[j], x[j + 1]}, Pair{f[j], f[j + 1]}, p, one, zero, most);
      worst[k] = e > worst[k] ? e : worst[k];
    }
  return std::max({worst[0][0], worst[0][1], worst[1][0], worst[1][1]});
}

double error_at(float x, float f, const oracles::LocalExpansion& o, bool absolute) {
  const std::array<double, 5> p = {o.p[0], o.p[1], o.p[2], o.p[3], o.centre};
  constexpr double most = std::numeric_limits<double>::infinity();
  return absolute ? error_of<true, double>(x, f, p, 1, 0, most)
                  : error_of<false, double>(x, f, p, 1, 0, most);
}

/// One thread's work on one CoefficientCode.
class Sweeper {
 public:
  Sweeper(const CoefficientCode& code, std::uint32_t stride, const std::vector<bool>& wanted)
      : code_(code), stride_(stride), wanted_(wanted), found_(code.outputs.size()) {
    for (std::size_t k = 0; k < code.outputs.size(); ++k) out_[k] = results_[k].data();
  }
  const std::vector<Found>& found() const { return found_; }

  /// The floats whose bits are in [first, end), end - first <= unit, first a multiple of unit.
  void sweep(std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t from = first; from < end; from += run) {
      const std::uint32_t to = std::min(end, from + run);
      if (constant(from, to)) continue;
      for (std::uint32_t b = from; b < to; b += block) {
        const std::uint32_t until = std::min(to, b + block);
        if (!constant(b, until)) one_block(b, until);
      }
    }
  }

 private:
  /// Where the code returns one value over all of the interval and the exact one is monotone, the two ends
  /// hold the largest error.
  bool constant(std::uint32_t from, std::uint32_t end) {
    if (stride_ != 1) return false;
    const float low = float_of(from), high = float_of(end - 1);
    float value[outputs_at_most];
    if (!code_.constant(low, high, value)) return false;
    std::array<oracles::LocalExpansion, outputs_at_most> all;
    const double w = (static_cast<double>(high) - low) / 2;
    for (std::size_t k = 0; k < found_.size(); ++k) {
      const auto& o = all[k] = oracles::expand(code_.outputs[k], low, high);
      const bool monotone = std::fabs(o.p[1]) > w * (2 * std::fabs(o.p[2]) + w * 3 * std::fabs(o.p[3]));
      if (!monotone || !(o.bound <= widest_bound)) return false;
    }
    for (std::size_t k = 0; k < found_.size(); ++k) {
      if (!wanted_[k]) continue;
      note(k, all[k], w, end - from);
      found_[k].constant += end - from;
      const bool absolute = oracles::is_absolute(code_.outputs[k]);
      found_[k].measured(error_at(low, value[k], all[k], absolute), from);
      found_[k].measured(error_at(high, value[k], all[k], absolute), end - 1);
    }
    return true;
  }

  void one_block(std::uint32_t from, std::uint32_t end) {
    const std::uint64_t next = (std::uint64_t{from} + stride_ - 1) / stride_ * stride_;
    if (next >= end) return;
    const std::size_t n = (end - 1 - next) / stride_ + 1;
    for (std::size_t i = 0; i < n; ++i) x_[i] = float_of(static_cast<std::uint32_t>(next + i * stride_));
    for (std::size_t i = n; i < (n + lanes - 1) / lanes * lanes; ++i) x_[i] = x_[n - 1];
    code_.evaluate(x_.data(), n, out_.data());
    const float low = x_[0], high = x_[n - 1];
    for (std::size_t k = 0; k < found_.size(); ++k) {
      if (!wanted_[k]) continue;
      const bool absolute = oracles::is_absolute(code_.outputs[k]);
      const auto o = oracles::expand(code_.outputs[k], low, high);
      note(k, o, (static_cast<double>(high) - low) / 2, n);
      float* f = out_[k];
      for (std::size_t i = n; i < (n + lanes - 1) / lanes * lanes; ++i) f[i] = f[n - 1];
      const double most =
          absolute ? largest_error<true>(x_.data(), f, n, o) : largest_error<false>(x_.data(), f, n, o);
      if (!(most > found_[k].error)) continue;  // the first one is kept
      for (std::size_t i = 0; i < n; ++i)
        found_[k].measured(error_at(x_[i], f[i], o, absolute),
                           static_cast<std::uint32_t>(next + i * stride_));
    }
  }

  void note(std::size_t k, const oracles::LocalExpansion& o, double w, std::uint64_t n) {
    Found& f = found_[k];
    f.evaluated += n;
    f.oracle = std::max(f.oracle, o.bound);
    f.condition = std::max(f.condition, o.condition(w, oracles::is_absolute(code_.outputs[k])));
  }

  static constexpr std::size_t outputs_at_most = 6;
  const CoefficientCode& code_;
  std::uint32_t stride_;
  const std::vector<bool>& wanted_;
  std::vector<Found> found_;
  std::array<float, block + lanes> x_;
  std::array<std::array<float, block + lanes>, outputs_at_most> results_;
  std::array<float*, outputs_at_most> out_;
};

const CoefficientClaim& claim_of(Coefficient c) {
  return coefficient_claims().at(static_cast<std::size_t>(c));
}

double rounded_up(double x) {
  return x * (1 + 0x1p-50);
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
  struct Part {
    const CoefficientCode* code;
    std::vector<bool> wanted;
    std::vector<Found> found;
    std::uint64_t units, first_unit;
  };
  std::vector<Part> parts;
  std::uint64_t units = 0;
  for (const CoefficientCode& c : code) {
    Part part{&c, {}, std::vector<Found>(c.outputs.size()), 0, units};
    for (const Coefficient o : c.outputs)
      part.wanted.push_back(options.coefficients.empty() ||
                            std::count(options.coefficients.begin(), options.coefficients.end(), o));
    if (std::find(part.wanted.begin(), part.wanted.end(), true) == part.wanted.end()) continue;
    part.units = std::bit_cast<std::uint32_t>(c.last) / unit + 1;
    units += part.units;
    parts.push_back(std::move(part));
  }
  std::atomic<std::uint64_t> next{0}, done{0};
  std::atomic<bool> never{false};
  std::atomic<bool>& stop = options.stop ? *options.stop : never;
  std::mutex mutex;
  const auto work = [&] {
    std::vector<std::unique_ptr<Sweeper>> own;
    for (const Part& p : parts) own.push_back(std::make_unique<Sweeper>(*p.code, options.stride, p.wanted));
    while (!stop) {
      const std::uint64_t u = next++;
      if (u >= units) break;
      std::size_t k = 0;
      while (u >= parts[k].first_unit + parts[k].units) ++k;
      const std::uint64_t first = (u - parts[k].first_unit) * unit;
      const std::uint64_t end = std::uint64_t{std::bit_cast<std::uint32_t>(parts[k].code->last)} + 1;
      own[k]->sweep(static_cast<std::uint32_t>(first),
                    static_cast<std::uint32_t>(std::min(end, first + unit)));
      const std::uint64_t so_far = ++done;
      const std::lock_guard lock(mutex);
      options.progress(static_cast<double>(so_far) / static_cast<double>(units));
    }
    const std::lock_guard lock(mutex);
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (std::size_t i = 0; i < parts[k].found.size(); ++i) parts[k].found[i].merge(own[k]->found()[i]);
  };
  run_on_threads(options.jobs, stop, work);

  SweepResult result;
  result.stride = options.stride;
  result.complete = done == units;
  for (const Part& p : parts)
    for (std::size_t i = 0; i < p.found.size(); ++i) {
      if (!p.wanted[i]) continue;
      const Found& f = p.found[i];
      const Coefficient c = p.code->outputs[i];
      SweptCoefficient s{&claim_of(c)};
      s.evaluated = f.evaluated, s.constant = f.constant;
      s.max_eps = f.error / eps, s.max_at = float_of(f.at);
      s.oracle_bound_eps = rounded_up(f.oracle / eps);
      if (c != Coefficient::angle_over_sine && c != Coefficient::alpha)
        s.square_eps = rounded_up(f.condition / 2);
      // Relatively |f/F - 1| <= |f p - 1| + |f/F| |p F - 1|, and |f/F| <= 1 + error.
      const double factor = oracles::is_absolute(c) ? 1 : 1 + f.error + 2 * f.oracle;
      s.bound_eps = rounded_up((f.error + factor * f.oracle) / eps);
      result.coefficients.push_back(s);
    }
  result.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace liecheck::properties
