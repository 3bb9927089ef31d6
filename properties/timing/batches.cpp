#include <timing/batches.hpp>

#include <liecheck/multibody/batch.hpp>
#include <operations/operations.hpp>

namespace liecheck::batch {
template decltype(integrate<float>) integrate<float>;
template decltype(integrate<double>) integrate<double>;
template decltype(difference<float>) difference<float>;
template decltype(difference<double>) difference<double>;
}  // namespace liecheck::batch

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
  if (&operation == &op::integrate) return Batch<&batch::integrate<S>, S, 7, 6>::signature();
  if (&operation == &op::difference) return Batch<&batch::difference<S>, S, 7, 7>::signature();
  return {};
}
template Signature batch_signature<float>(const Operation&);
template Signature batch_signature<double>(const Operation&);

}  // namespace liecheck::properties
