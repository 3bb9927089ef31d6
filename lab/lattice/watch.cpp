#include <lattice/watch.hpp>

#include <algorithm>
#include <cmath>
#include <subjects/hooked.hpp>

namespace liecheck::properties {
namespace {

std::vector<double> read(const Scalar& scalar, const void* numbers, std::size_t n) {
  return scalar.with([&]<class S>() {
    return std::vector<double>(static_cast<const S*>(numbers), static_cast<const S*>(numbers) + n);
  });
}
void write(const Scalar& scalar, void* to, const std::vector<double>& numbers) {
  scalar.with([&]<class S>() {
    std::ranges::transform(numbers, static_cast<S*>(to), [](double x) { return static_cast<S>(x); });
  });
}

/// Whether two lists differ in a number. NaN equals NaN, and 0 equals -0.
bool differ(const std::vector<double>& a, const std::vector<double>& b) {
  return !std::ranges::equal(a, b, [](double x, double y) { return x == y || (x != x && y != y); });
}
/// The largest change of a number of the block, in eps of the block's largest number; NaN is infinite.
double movement(const ResultBlock& block, const Scalar& scalar, const std::vector<double>& from,
                const std::vector<double>& to) {
  double largest = 0, change = 0;
  for (const std::size_t i : block.numbers) {
    const double a = from[i], b = to[i];
    largest = std::fmax(largest, std::fmax(std::fabs(a), std::fabs(b)));
    if (a == b || (a != a && b != b)) continue;
    if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
    change = std::fmax(change, std::fabs(a - b));
  }
  return change > 0 ? change / largest / scalar.epsilon : 0;
}

}  // namespace

Subject Watch::watched(const Subject& subject) {
  Subject s = subject;
  const auto tell = [this](auto o, const Context& of) {
    const auto context = std::make_shared<const Context>(of);
    hook_slots(o, [this, context](const Operation&, const auto& function, const auto&... arguments) {
      context_ = context;
      return function(arguments...);
    });
    return o;
  };
  Operations& o = s.operations;
  if (o.robot)
    o.robot = [tell, robot = o.robot](const std::string& urdf, bool fixed) {
      return tell(robot(urdf, fixed), {{}, !fixed});
    };
  if (o.tree)
    o.tree = [tell, build = o.tree](const Tree<double>& tree) { return tell(build(tree), context_of(tree)); };
  return s;
}

void Watch::call(const NumberFunction& f, void* arguments, void* results) {
  const Operation& operation = *f.operation;
  f.compute(arguments, results);
  const std::uint64_t number = ++calls[&operation];
  const bool again = last_ == &operation;
  last_ = &operation;
  const bool at_fault = fault && fault->operation == &operation;
  if (!seen && !at_fault) return;
  const std::vector<double> x = read(*f.scalar, arguments, count_numbers(operation.arguments, f.model));
  Remembered& before = remembered_[&operation];
  Features features = features_of(f, x, f.model.nv > 0 ? *context_ : Context());
  features[Feature::call] = static_cast<double>(number);
  features[Feature::call_mod_1000] = static_cast<double>(number % 1000);
  features[Feature::call_mod_2] = static_cast<double>(number % 2);
  features[Feature::after_itself] = again;
  features[Feature::same_arguments] = !differ(before.arguments, x);
  features[Feature::second_thread] = std::this_thread::get_id() != first_thread_;
  if (seen) seen(operation, features);
  before.arguments = x;
  if (!at_fault) return;
  std::vector<double> computed = read(*f.scalar, results, count_numbers(operation.results, f.model));
  if (planted && triggers[fault->trigger].fires(features)) {
    const std::vector<double> result = faulty(f, computed, before.result);
    const bool is_truth = &operation == &op::robot_is_same;  // of which every change of yes is no
    if (differ(computed, result))
      write(*f.scalar, results, is_truth ? std::vector<double>{1 - computed[0]} : result);
    if (fault->perturbation.change == PlantedChange::argument) write_to_argument(f, arguments, x);
  }
  before.result = std::move(computed);
}

std::vector<double> Watch::faulty(const NumberFunction& f, const std::vector<double>& computed,
                                  const std::vector<double>& before) {
  std::vector<double> result = computed;
  const auto blocks = blocks_of(*f.operation, result.size());
  fault->perturbation.apply(result, *f.scalar, blocks, before);
  for (const ResultBlock& b : blocks) moved = std::max(moved, movement(b, *f.scalar, computed, result));
  return result;
}

void Watch::write_to_argument(const NumberFunction& f, void* arguments, std::vector<double> numbers) {
  const Layout* const first[] = {f.operation->arguments[0]};
  const Perturbation& p = fault->perturbation;
  double& number = numbers[p.component % count_numbers(first, f.model)];
  if (number == 0) return;
  number += number * std::ldexp(f.scalar->epsilon, p.k);
  write(*f.scalar, arguments, numbers);
  moved = std::numeric_limits<double>::infinity();
}

}  // namespace liecheck::properties
