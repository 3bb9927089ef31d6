#pragma once
// The arguments and results of operations as consecutive numbers: matrices row by row, a pose as R and p, a
// body as mass, c and I_C. docs/operations.md has the order of each operation.

#include <cstddef>
#include <operations/values.hpp>

namespace liecheck::properties::adapters {

/// size numbers; put() writes them and get() reads them.
template <class T>
struct Shape {
  static constexpr std::size_t size = 1;
  static void put(const T& x, T* to) { *to = x; }
  static T get(const T* from) { return *from; }
};
template <class S, int R, int C, int Options>
struct Shape<Eigen::Matrix<S, R, C, Options>> {
  using M = Eigen::Matrix<S, R, C, Options>;
  static constexpr std::size_t size = static_cast<std::size_t>(R * C);
  static void put(const M& x, S* to) {
    for (int i = 0; i < R; ++i)
      for (int j = 0; j < C; ++j) *to++ = x(i, j);
  }
  static M get(const S* from) {
    M x;
    for (int i = 0; i < R; ++i)
      for (int j = 0; j < C; ++j) x(i, j) = *from++;
    return x;
  }
};
template <class S>
struct Shape<Pose<S>> {
  using R = Shape<Mat<S, 3>>;
  using P = Shape<Vec<S, 3>>;
  static constexpr std::size_t size = R::size + P::size;
  static void put(const Pose<S>& x, S* to) { R::put(x.R, to), P::put(x.p, to + R::size); }
  static Pose<S> get(const S* from) { return {R::get(from), P::get(from + R::size)}; }
};
template <class S>
struct Shape<Body<S>> {
  using V = Shape<Vec<S, 3>>;
  using M = Shape<Mat<S, 3>>;
  static constexpr std::size_t size = 1 + V::size + M::size;
  static void put(const Body<S>& x, S* to) {
    *to = x.mass, V::put(x.c, to + 1), M::put(x.I_C, to + 1 + V::size);
  }
  static Body<S> get(const S* from) { return {*from, V::get(from + 1), M::get(from + 1 + V::size)}; }
};

}  // namespace liecheck::properties::adapters
