#include <timing/batches.hpp>

#include <liecheck/batch/poses.hpp>
#include <operations/operations.hpp>

namespace liecheck::properties {
namespace {

template <auto f, class S, int... IN>
struct Batch {
  using Arguments = std::tuple<batch::Rows<S, IN>...>;

  static std::shared_ptr<const char> arguments(const std::vector<std::vector<double>>& numbers) {
    const auto n = static_cast<Eigen::Index>(numbers.size());
    const auto all = std::make_shared<Arguments>(batch::Rows<S, IN>(IN, n)...);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double* next = numbers[static_cast<std::size_t>(i)].data();
      const auto read = [&](auto& rows) {
        for (Eigen::Index k = 0; k < rows.rows(); ++k) rows(k, i) = static_cast<S>(*next++);
      };
      std::apply([&](auto&... rows) { (read(rows), ...); }, *all);
    }
    return {all, reinterpret_cast<const char*>(all.get())};
  }
  static void throughput(AnyFunction, const char* arguments, std::size_t) {
    const auto result = std::apply(f, *reinterpret_cast<const Arguments*>(arguments));
    asm volatile("" : : "r"(result.data()) : "memory");
  }
  static Signature signature() { return {&arguments, 0, &throughput, nullptr, nullptr, nullptr}; }
};

}  // namespace

template <class S>
Signature batch_signature(const Operation& operation) {
  using namespace batch;
  const auto is = [&operation](const Operation& other) { return &operation == &other; };
  if (is(op::exp6)) return Batch<[](const auto& xi) { return exp6Matrix(xi); }, S, 6>::signature();
  if (is(op::compose))
    return Batch<[](const auto& X, const auto& Y) { return compose(X, Y); }, S, 12, 12>::signature();
  if (is(op::act_point))
    return Batch<[](const auto& X, const auto& x) { return act(X, x); }, S, 12, 3>::signature();
  if (is(op::integrate))
    return Batch<[](const auto& q, const auto& delta) { return integrate(q, delta); }, S, 7, 6>::signature();
  if (is(op::difference))
    return Batch<[](const auto& q0, const auto& q1) { return difference(q0, q1); }, S, 7, 7>::signature();
  if (is(op::right_jacobian6)) return Batch<[](const auto& xi) { return Jexp6(xi); }, S, 6>::signature();
  if (is(op::right_jacobian6_inverse))
    return Batch<[](const auto& xi) { return rightJacobianInverse(xi); }, S, 6>::signature();
  return {};
}
template Signature batch_signature<float>(const Operation&);
template Signature batch_signature<double>(const Operation&);

}  // namespace liecheck::properties
