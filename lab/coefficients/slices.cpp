#include <coefficients/slices.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <budgets/budgets.hpp>
#include <cmath>
#include <generators/random_bits.hpp>
#include <limits>
#include <mutex>
#include <numbers>
#include <oracles/slice_reference.hpp>
#include <stdexcept>
#include <support/threads.hpp>

#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/jacobians.hpp>

namespace liecheck::properties {
namespace {

namespace reference = oracles::slice;
using reference::V3;

constexpr double float_eps = std::numeric_limits<float>::epsilon();
constexpr std::uint32_t floats_per_task = 1U << 20;

/// One input: phi, or the quaternion with its angle, and rho.
struct Input {
  V3 phi, rho;
  Vector3<float> phi_float, rho_float;
};

/// As in the laws, the denominator is at least min_normal / eps.
template <class A, class B>
double relative(const A& computed, const B& exact) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double e = double(computed(Eigen::Index(i))) - exact[i];
    error += e * e, size += exact[i] * exact[i];
  }
  return std::sqrt(error) / std::max(std::sqrt(size), double(std::numeric_limits<float>::min()) / float_eps);
}
/// The entries of a matrix, row by row.
auto rows(const Matrix3<float>& M) {
  return [M](Eigen::Index i) { return M(i / 3, i % 3); };
}

double exp_quaternion(const Input& in) {
  const Vector4<double> Q = quaternion::exp3(in.phi_float).to_vector().template cast<double>().normalized();
  const auto exact = reference::quaternion(in.phi);
  double error = 0;
  for (Eigen::Index i = 0; i < 4; ++i)
    error += (Q[i] - exact[std::size_t(i)]) * (Q[i] - exact[std::size_t(i)]);
  return 2 * std::sqrt(error);
}
double exp_matrix(const Input& in) {
  const Matrix3<double> R = exp3(in.phi_float).template cast<double>();
  const auto exact = reference::rotation(in.phi);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> E(exact.data());
  const Matrix3<double> D = E.transpose() * R;
  return std::hypot(D(2, 1) - D(1, 2), D(0, 2) - D(2, 0), D(1, 0) - D(0, 1)) / 2;
}
/// On the float quaternion nearest to exp(phi).
double log_quaternion(const Input& in) {
  const auto Q = reference::quaternion(in.phi);
  const Vector4<float> stored{float(Q[0]), float(Q[1]), float(Q[2]), float(Q[3])};
  if (stored[3] < 0) return 0;  // beyond pi
  const V3 exact =
      reference::logarithm({double(stored[0]), double(stored[1]), double(stored[2]), double(stored[3])});
  return exact == V3{} ? 0 : relative(quaternion::log3(SO3<float>(stored)), exact);
}
double exp_translation(const Input& in) {
  const Motion<float> xi(in.rho_float, in.phi_float);
  return relative(exp6(xi).translation(), reference::translation(in.rho, in.phi));
}
double left(const Input& in) {
  return relative(rows(leftJacobian(in.phi_float)), reference::left_jacobian(in.phi));
}
double left_inverse(const Input& in) {
  return relative(rows(leftJacobianInverse(in.phi_float)), reference::left_jacobian_inverse(in.phi));
}
double left_coupling(const Input& in) {
  const Matrix6<float> J = leftJacobian(Motion<float>(in.rho_float, in.phi_float));
  return relative(rows(J.template topRightCorner<3, 3>()), reference::coupling(in.rho, in.phi));
}

struct SweptOperation {
  const char* name;
  const char* block;
  bool has_rho;
  double (*error)(const Input&);
};
constexpr SweptOperation all_operations[] = {{"exp3_quaternion", "rotation", false, exp_quaternion},
                                             {"exp3_matrix", "rotation", false, exp_matrix},
                                             {"log3_quaternion", "rotation vector", false, log_quaternion},
                                             {"exp6", "translation", true, exp_translation},
                                             {"left_jacobian3", "jacobian", false, left},
                                             {"left_jacobian3_inverse", "jacobian", false, left_inverse},
                                             {"left_jacobian6", "coupling", true, left_coupling}};

const SweptOperation& named(const std::string& name) {
  for (const SweptOperation& o : all_operations)
    if (o.name == name) return o;
  throw std::invalid_argument(fmt::format("--operation: no slices of '{}'; there are slices of: {}", name,
                                          fmt::join(slice_operations(), ", ")));
}

/// The error in eps; 0 if the rounded phi is longer than pi.
double error_at(const SweptOperation& o, float theta, const std::array<float, 3>& axis,
                const std::array<float, 3>& rho) {
  Input in;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = Eigen::Index(i);
    in.phi_float[k] = theta * axis[i], in.phi[i] = in.phi_float[k];
    in.rho_float[k] = rho[i], in.rho[i] = rho[i];
  }
  if (reference::dot(in.phi, in.phi) > std::numbers::pi * std::numbers::pi) return 0;
  const double e = o.error(in) / float_eps;
  return e < std::numeric_limits<double>::infinity() ? e : std::numeric_limits<double>::infinity();
}

std::array<float, 3> random_axis(Source& source) {
  for (;;) {
    const std::array<double, 3> v{source.symmetric<double>(), source.symmetric<double>(),
                                  source.symmetric<double>()};
    const double n = std::hypot(v[0], v[1], v[2]);
    if (n > 0.1 && n <= 1) return {float(v[0] / n), float(v[1] / n), float(v[2] / n)};
  }
}

/// The axis and rho with the largest error at random angles.
Slice worst_axis(const SweptOperation& o, const SliceOptions& options) {
  Slice worst;
  double most = -1;
  for (unsigned k = 0; k < options.tried && !(options.stop && *options.stop); ++k) {
    Source source({options.seed, k, 0, 0x736c6963});
    const auto axis = random_axis(source), rho = random_axis(source);
    for (int i = 0; i < 500; ++i) {
      const float theta =
          float(std::numbers::pi) * (i % 2 ? source.unit<float>() : std::exp2(-30 * source.unit<float>()));
      if (const double e = error_at(o, theta, axis, rho); e > most)
        most = e, worst.axis = axis, worst.rho = rho;
    }
  }
  return worst;
}

}  // namespace

std::vector<std::string> slice_operations() {
  std::vector<std::string> all;
  for (const SweptOperation& o : all_operations) all.emplace_back(o.name);
  return all;
}

double slice_error(const std::string& operation, float theta, const std::array<float, 3>& axis,
                   const std::array<float, 3>& rho) {
  return error_at(named(operation), theta, axis, rho);
}

std::vector<Slice> sweep_slices(const SliceOptions& options) {
  std::vector<const SweptOperation*> chosen;
  for (const std::string& name : options.operations) chosen.push_back(&named(name));
  if (chosen.empty())
    for (const SweptOperation& o : all_operations) chosen.push_back(&o);
  std::vector<Slice> slices;
  std::vector<const SweptOperation*> of;
  for (const SweptOperation* o : chosen) {
    const auto add = [&](Slice s) {
      s.operation = o->name, s.block = o->block,
      s.limit = budget_of("liecheck", o->name, o->block, Region::to_pi).limit;
      slices.push_back(s), of.push_back(o);
    };
    Slice worst = worst_axis(*o, options);
    if (options.axes.empty()) {
      Slice x;
      x.axis = {1, 0, 0}, x.rho = worst.rho;
      add(x), add(worst);
    }
    for (const auto& axis : options.axes) {
      const double n = std::hypot(axis[0], axis[1], axis[2]);
      worst.axis = {float(axis[0] / n), float(axis[1] / n), float(axis[2] / n)};
      add(worst);
    }
  }
  const std::uint32_t end = std::bit_cast<std::uint32_t>(float(std::numbers::pi)) + 1,
                      tasks = (end + floats_per_task - 1) / floats_per_task;
  const std::uint64_t total = std::uint64_t{tasks} * slices.size();
  std::atomic<std::uint64_t> next{0}, done{0};
  std::atomic<bool> never{false};
  std::atomic<bool>& stop = options.stop ? *options.stop : never;
  std::vector<std::uint64_t> finished(slices.size(), 0);
  std::mutex mutex;
  run_on_threads(options.jobs, stop, [&] {
    for (std::uint64_t t; !stop && (t = next++) < total;) {
      const std::size_t k = std::size_t(t / tasks);
      const auto first = std::uint32_t(t % tasks) * floats_per_task;
      double most = 0;
      std::uint32_t at = end;
      std::uint64_t n = 0;
      for (std::uint32_t bits = (first + options.stride - 1) / options.stride * options.stride;
           bits < std::min(end, first + floats_per_task) && !stop; bits += options.stride, ++n)
        if (const double e = error_at(*of[k], std::bit_cast<float>(bits), slices[k].axis, slices[k].rho);
            e > most)
          most = e, at = bits;
      const std::lock_guard lock(mutex);
      Slice& s = slices[k];
      s.evaluated += n;
      if (most > s.max_eps || (most == s.max_eps && std::bit_cast<float>(at) < s.max_at))
        s.max_eps = most, s.max_at = std::bit_cast<float>(at);
      if (!stop) s.complete = ++finished[k] == tasks;
      options.progress(double(++done) / double(total));
    }
  });
  return slices;
}

}  // namespace liecheck::properties
