#include <liecheck/batch/dispatch.hpp>

namespace liecheck::batch::detail {

namespace {

/// One operation in S.
template <class S>
struct Call {
  Kernel<S> kernel;
  Alone<S> alone;
  std::span<const int> heights;  ///< rows of each argument
  int rows;                      ///< rows of the result
};

/// The operation on one column.
template <class Operation, class S>
void computeAlone(const S* const* in, S* out, Eigen::Index stride, Eigen::Index i) {
  const auto result = withColumns<Operation, S>(
      in, stride, i, [](const auto&... x) { return Operation::template formula<S>(x...); });
  for (int r = 0; r < Operation::rows; ++r) out[r * stride + i] = result[r];
}

template <class S, class... O>
Call<S> callOf(std::tuple<O...>*, Operation operation, const Kernel<S>* kernels) {
  static constexpr Alone<S> alone[] = {&computeAlone<O, S>...};
  static constexpr std::span<const int> heights[] = {O::arguments...};
  static constexpr int rows[] = {O::rows...};
  const auto k = std::size_t(operation);
  return {kernels[k], alone[k], heights[k], rows[k]};
}

}  // namespace

template <std::floating_point S>
void run(Operation operation, std::initializer_list<const S*> arguments, S* result, Eigen::Index columns,
         const Options& options) {
  const auto& kernels = kernelsOf(options.instructions).template in<S>();
  const auto call = callOf<S>(static_cast<Operations*>(nullptr), operation, kernels.poses);
  const std::span<const S* const> all(arguments.begin(), arguments.size());
  const Eigen::Index in_packs = columns / kernels.width * kernels.width;
  inThreads(in_packs, kernels.width, 4096, options.threads, [&](Eigen::Index begin, Eigen::Index end) {
    const S* in[2] = {};
    for (std::size_t a = 0; a < all.size(); ++a) in[a] = all[a] + begin;
    call.kernel(in, result + begin, columns, end - begin, call.alone);
  });
  if (in_packs == columns) return;
  Tile<S> last(all, call.heights, call.rows, columns, kernels.width);
  last.read(in_packs, columns - in_packs);
  call.kernel(last.in, last.out(), last.columns, last.columns, call.alone);
  last.write(result);
}
template void run<float>(Operation, std::initializer_list<const float*>, float*, Eigen::Index,
                         const Options&);
template void run<double>(Operation, std::initializer_list<const double*>, double*, Eigen::Index,
                          const Options&);

}  // namespace liecheck::batch::detail
