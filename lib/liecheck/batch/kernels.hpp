#pragma once
// The loops over packs of columns. Each set of instructions compiles them once, in a file of its own, for
// packs of its own size. Those files must define no function that another file defines too: a linker keeps
// one of the two, and it may keep the one with instructions that the processor lacks. So each function here
// depends on the type of the pack or is inlined.

#include <liecheck/batch/operations.hpp>
#include <liecheck/batch/pack.hpp>
#include <liecheck/batch/tree_kernels.hpp>
#include <utility>

namespace liecheck::batch::detail {

/// Computes column i alone. Row r of argument a is in[a][r * stride], and so on; the same for out.
template <class S>
using Alone = void (*)(const S* const* in, S* out, Eigen::Index stride, Eigen::Index i);
/// Computes `columns` columns, a multiple of the size of a pack.
template <class S>
using Kernel = void (*)(const S* const* in, S* out, Eigen::Index stride, Eigen::Index columns,
                        Alone<S> alone);

/// `poses` has one kernel for each operation, in their order.
template <class S>
struct KernelsIn {
  const Kernel<S>* poses;
  void (*forwardKinematics)(const TreeTask<S>&);
  void (*rnea)(const TreeTask<S>&);
  void (*aba)(const TreeTask<S>&);
  int width;                ///< columns of a pack
  std::size_t joint_bytes;  ///< workspace for a joint of a tree
};
struct Kernels {
  KernelsIn<float> in_float;
  KernelsIn<double> in_double;
  template <class S>
  const KernelsIn<S>& in() const {
    if constexpr (std::is_same_v<S, float>)
      return in_float;
    else
      return in_double;
  }
};
extern const Kernels baseline, avx2, avx512;

/// Column i, or the pack of columns from i on.
template <class T, int ROWS, class S>
[[gnu::always_inline]] inline Eigen::Matrix<T, ROWS, 1> column(const S* rows, Eigen::Index stride) {
  Eigen::Matrix<T, ROWS, 1> v;
  for (int r = 0; r < ROWS; ++r)
    if constexpr (side_by_side<T>)
      v[r] = T::load(rows + r * stride);
    else
      v[r] = rows[r * stride];
  return v;
}

/// Returns f(column i of each argument).
template <class Operation, class T, class S, class F>
[[gnu::always_inline]] inline auto withColumns(const S* const* in, Eigen::Index stride, Eigen::Index i, F f) {
  return [&]<std::size_t... A>(std::index_sequence<A...>) __attribute__((always_inline)) {
    return f(column<T, Operation::arguments[A]>(in[A] + i, stride)...);
  }
  (std::make_index_sequence<std::extent_v<decltype(Operation::arguments)>>());
}

template <class Operation, class P>
[[gnu::flatten]] void kernel(const Lane<P>* const* in, Lane<P>* out, Eigen::Index stride,
                             Eigen::Index columns, Alone<Lane<P>> alone) {
  for (Eigen::Index i = 0; i < columns; i += P::size)
    withColumns<Operation, P>(
        in, stride, i, [&](const auto&... x) __attribute__((always_inline)) {
          const auto result = Operation::template formula<P>(x...);
#pragma GCC unroll 36
          for (int r = 0; r < Operation::rows; ++r) result[r].store(out + r * stride + i);
          if constexpr (requires { Operation::template usual<P>(result, x...); }) {
            const auto usual = Operation::template usual<P>(result, x...);
            if (P::all(usual)) [[likely]]
              return;
            for (int lane = 0; lane < P::size; ++lane)
              if (usual[lane] == 0) alone(in, out, stride, i + lane);
          }
        });
}

template <class P, class List>
struct Table;
template <class P, class... Operations>
struct Table<P, std::tuple<Operations...>> {
  static constexpr Kernel<Lane<P>> of[] = {&kernel<Operations, P>...};
};
template <class P>
constexpr KernelsIn<Lane<P>> kernelsFor() {
  return {Table<P, Operations>::of,
          &treePoses<P>,
          &treeRnea<P>,
          &treeAba<P>,
          P::size,
          sizeof(JointWork<P>) + sizeof(Axis<P>)};
}
template <int BYTES>
constexpr Kernels kernelsOf() {
  return {kernelsFor<Pack<float, BYTES / 4>>(), kernelsFor<Pack<double, BYTES / 8>>()};
}

}  // namespace liecheck::batch::detail
