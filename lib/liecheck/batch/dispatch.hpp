#pragma once
// How a batch is divided: into packs, threads, and the last columns that fill no pack.

#include <algorithm>
#include <functional>
#include <liecheck/batch/kernels.hpp>
#include <span>
#include <vector>

namespace liecheck::batch::detail {

/// Throws std::invalid_argument if they are not supported.
const Kernels& kernelsOf(Instructions instructions);

/// Calls f(begin, end) for parts of `columns` of at least `least` columns, cut between packs of `width`
/// columns, each in a thread of OpenMP. An exception must not leave a thread.
void inThreads(Eigen::Index columns, int width, Eigen::Index least, int threads,
               const std::function<void(Eigen::Index begin, Eigen::Index end)>& f);

/// A few columns of a batch, copied to memory of their own. The last one is repeated until they fill packs.
template <class S>
class Tile {
 public:
  /// heights: rows of each argument; rows: those of the result.
  Tile(std::span<const S* const> arguments, std::span<const int> heights, int rows, Eigen::Index stride,
       int width)
      : arguments_(arguments), heights_(heights), rows_(rows), width_(width), stride_(stride) {}

  /// Copies `count` columns from `first` on.
  void read(Eigen::Index first, Eigen::Index count) {
    first_ = first, count_ = count, columns = (count + width_ - 1) / width_ * width_;
    Eigen::Index height = rows_;
    for (const int h : heights_) height += h;
    numbers_.resize(std::size_t(height * columns));
    S* to = numbers_.data() + rows_ * columns;
    for (std::size_t a = 0; a < arguments_.size(); ++a) {
      in[a] = to;
      for (int r = 0; r < heights_[a]; ++r, to += columns) {
        const S* const from = arguments_[a] + r * stride_ + first;
        std::fill(std::copy_n(from, count, to), to + columns, from[count - 1]);
      }
    }
  }
  S* out() { return numbers_.data(); }
  void write(S* result) const {
    for (int r = 0; r < rows_; ++r)
      std::copy_n(numbers_.data() + r * columns, count_, result + r * stride_ + first_);
  }
  const S* in[4] = {};
  Eigen::Index columns = 0;

 private:
  std::span<const S* const> arguments_;
  std::span<const int> heights_;
  std::vector<S> numbers_;
  int rows_, width_;
  Eigen::Index stride_, first_ = 0, count_ = 0;
};

}  // namespace liecheck::batch::detail
