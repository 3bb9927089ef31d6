#include <search/trial.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <generators/tree_shrinks.hpp>
#include <invariants/property.hpp>
#include <invariants/tree_case.hpp>
#include <invariants/tree_laws.hpp>
#include <search/shrink.hpp>
#include <thread>
#include <utility>

namespace liecheck::properties {
namespace {

/// While it exists, calls of this thread go through a hook.
class Hooked {
 public:
  explicit Hooked(CallHook& hook) : before_(std::exchange(call_hook(), &hook)) {}
  Hooked(const Hooked&) = delete;
  Hooked& operator=(const Hooked&) = delete;
  ~Hooked() { call_hook() = before_; }

 private:
  CallHook* before_;
};

/// The features of a tree and its state, of which an output is formed by several calls.
Features of_state(const TreeCase<double>& c, Features f) {
  const auto any = [](const std::vector<double>& x) {
    return std::ranges::any_of(x, [](double number) { return number != 0; });
  };
  f[Feature::moves] = any(c.v), f[Feature::accelerates] = any(c.a);
  f[Feature::wrench] = !c.wrench.empty();
  f[Feature::wrench_joint] = c.wrench.empty() ? 0 : c.wrench[0].joint + 1;
  return f;
}

std::vector<double> values_of(const Features& features) {
  std::vector<double> values;
  for (const FeatureName& name : fixed_names()) values.push_back(features[name.feature]);
  return values;
}

}  // namespace

std::chrono::duration<double> at_this_load(double seconds) {
  double load = 0;
  const auto processors = double(std::max(1u, std::thread::hardware_concurrency()));
  if (getloadavg(&load, 1) < 1) load = 0;
  return std::chrono::duration<double>(seconds * std::clamp(load / processors, 1.0, 10.0));
}

TrialOfFeatures::TrialOfFeatures(const Series& series, std::size_t output)
    : series_(series), output_(output), of_tree_(is_tree_law(series.property) && !series.on_robot) {}

std::vector<double> TrialOfFeatures::features_of(const NumberFunction& f, const void* arguments,
                                                 const Context& context) {
  const std::size_t n = count_numbers(f.operation->arguments, f.model);
  const std::vector<double> numbers = f.scalar->with([&]<class S>() {
    return std::vector<double>(static_cast<const S*>(arguments), static_cast<const S*>(arguments) + n);
  });
  if (names_.size() == fixed_names().size()) {
    const std::vector<FeatureName> of_arguments = argument_names(f);
    names_.insert(names_.end(), of_arguments.begin(), of_arguments.end());
  }
  std::vector<double> values = values_of(properties::features_of(f, numbers, context));
  const std::vector<double> of_arguments = argument_features(f, numbers, context.floating);
  values.insert(values.end(), of_arguments.begin(), of_arguments.end());
  return values;
}

std::vector<Tried> TrialOfFeatures::operator()(const std::vector<double>& x) {
  std::vector<std::vector<double>> calls;
  Context context;
  std::optional<TreeCase<double>> tree;
  if (of_tree_) context = context_of(described(tree.emplace(TreeLayout::of_size(x.size()), x, x)));
  CallHook* const before = call_hook();
  CallHook hook = [&](const NumberFunction& f, void* arguments, void* results) {
    if (f.operation == series_.outputs[output_].record) calls.push_back(features_of(f, arguments, context));
    before ? (*before)(f, arguments, results) : f.compute(arguments, results);
  };
  std::vector<Judged> judged;
  {
    const Hooked hooked(hook);
    judged = series_.measure(x);
  }
  std::vector<Judged> of_output;
  for (const Judged& j : judged)
    if (static_cast<std::size_t>(j.residual.output) == output_) of_output.push_back(j);
  const auto outside = [](const Judged& j) { return j.residual.outcome == Outcome::outside_domain; };
  if (of_output.empty() || std::ranges::any_of(of_output, outside)) return {};
  if (calls.empty() && tree) calls.push_back(values_of(of_state(*tree, context.features)));
  if (calls.empty()) return {};
  std::vector<Tried> tried;
  const std::size_t n = of_output.size();
  if (n > 1 && calls.size() % n == 0) {  // measured once more with more digits, perhaps
    for (std::size_t i = 0; i < n; ++i) {
      const Residual& r = of_output[i].residual;
      tried.push_back({x, calls[calls.size() - n + i], of_output[i].failed, r.error, r.band});
    }
    return tried;
  }
  const auto failure = failure_of(judged, static_cast<int>(output_));
  const Residual& r = (failure ? *failure : of_output.front()).residual;
  tried.push_back({x, calls.front(), failure.has_value(), r.error, r.band});
  return tried;
}

std::vector<double> input_between(const Series& series, const std::vector<double>& a,
                                  const std::vector<double>& b, double t) {
  std::vector<double> x(a.size());
  std::size_t at = 0;
  for (const Field& f : series.fields) {
    const auto n = static_cast<std::size_t>(f.size);
    const bool quaternion = n == 4 && (f.kind == Kind::quaternion || f.kind == Kind::any_quaternion),
               matrix = n == 9 && f.kind == Kind::rotation_matrix;
    double square = 0, square_a = 0, square_b = 0;
    for (std::size_t i = at; i < at + n; ++i)
      x[i] = (1 - t) * a[i] + t * b[i], square += x[i] * x[i], square_a += a[i] * a[i],
      square_b += b[i] * b[i];
    const double size = quaternion && f.kind == Kind::any_quaternion
                            ? std::sqrt(square) / ((1 - t) * std::sqrt(square_a) + t * std::sqrt(square_b))
                            : std::sqrt(square);
    if (quaternion || f.kind == Kind::direction)
      for (std::size_t i = at; i < at + n; ++i) x[i] /= size;
    if (matrix) {
      using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
      const Eigen::Matrix3d R0 = Eigen::Map<const Rows>(&a[at]), R1 = Eigen::Map<const Rows>(&b[at]);
      Eigen::Map<Rows>{&x[at]} = Eigen::Quaterniond(R0).slerp(t, Eigen::Quaterniond(R1)).toRotationMatrix();
    }
    const bool smooth = quaternion || matrix || f.kind == Kind::vector || f.kind == Kind::rotation_vector ||
                        f.kind == Kind::fraction || f.kind == Kind::angle || f.kind == Kind::positive ||
                        f.kind == Kind::direction || f.kind == Kind::inertia;
    if (!smooth)
      for (std::size_t i = at; i < at + n; ++i) {
        if (a[i] != b[i]) return {};
        x[i] = a[i];
      }
    at += n;
  }
  if (at != a.size()) return {};
  for (double& number : x) number = series.format().rounded(number);
  return x;
}

std::vector<double> without_last_joint(const Series& series, const std::vector<double>& x) {
  if (!is_tree_law(series.property) || series.on_robot) return {};
  const TreeLayout at = TreeLayout::of_size(x.size());
  int joints = 0;
  while (joints < at.slots && x[static_cast<std::size_t>(at.parent(joints))] > absent_joint) ++joints;
  return joints < 2 ? std::vector<double>() : shrinks::first_joints(x, joints - 1);
}

}  // namespace liecheck::properties
