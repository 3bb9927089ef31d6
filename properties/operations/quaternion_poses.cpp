#include <operations/quaternion_poses.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace liecheck::properties {
namespace {

using Long = long double;  // one rounding of its results is that of the scalar
using Matrix = std::array<std::array<Long, 3>, 3>;

/// R (3 - R^T R) / 2, whose defect is of the order of the square of that of R (Bjorck and Bowie 1971).
Matrix nearer(const Matrix& R) {
  Matrix M{}, result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      M[i][j] = i == j ? 3 : 0;
      for (std::size_t k = 0; k < 3; ++k) M[i][j] -= R[k][i] * R[k][j];
    }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) result[i][j] += R[i][k] * M[k][j] / 2;
  return result;
}

/// x, y, z, w of the rotation nearest to R, with w >= 0, by its largest number (Shepperd 1978).
std::array<Long, 4> quaternion_of(std::span<const double> numbers) {
  Matrix R;
  for (std::size_t i = 0; i < 9; ++i) R[i / 3][i % 3] = numbers[i];
  R = nearer(R);
  std::array<Long, 4> squares{1 + R[0][0] - R[1][1] - R[2][2], 1 - R[0][0] + R[1][1] - R[2][2],
                              1 - R[0][0] - R[1][1] + R[2][2], 1 + R[0][0] + R[1][1] + R[2][2]};
  const auto largest = static_cast<std::size_t>(std::ranges::max_element(squares) - squares.begin());
  std::array<Long, 4> Q{};
  Q[largest] = squares[largest];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (largest == 3) Q[i] = R[k][j] - R[j][k];
    if (largest == i) Q[j] = R[i][j] + R[j][i], Q[k] = R[i][k] + R[k][i], Q[3] = R[k][j] - R[j][k];
  }
  Long norm = 0;
  for (const Long x : Q) norm += x * x;
  norm = std::copysign(std::sqrt(norm), Q[3]);
  for (Long& x : Q) x /= norm;
  return Q;
}

double rounded(Long x, bool is_float) {
  return is_float ? static_cast<double>(static_cast<float>(x)) : static_cast<double>(x);
}

/// One bit for each pose, which depend on every bit of the arguments.
std::uint64_t signs_of(std::span<const double> arguments) {
  std::uint64_t mixed = 0x9e3779b97f4a7c15;
  for (const double x : arguments) {
    mixed = (mixed ^ std::bit_cast<std::uint64_t>(x)) * 0xff51afd7ed558ccd;
    mixed ^= mixed >> 32;
  }
  return mixed;
}

std::size_t numbers_of(const Layout& layout) {
  std::size_t n = 0;
  for (const Part& part : layout.parts) n += static_cast<std::size_t>(part.size);
  return n;
}

}  // namespace

bool is_pose(const Layout& layout) {
  return layout.parts.size() == 2 && layout.parts[0].size == 9 && layout.parts[1].size == 3;
}

Layout with_quaternion(const Layout& layout) {
  if (!is_pose(layout)) return layout;
  return {layout.name,
          {layout.parts[1], {layout.parts[0].name == "R_Y" ? "Q_Y" : "Q", 4, "1"}},
          layout.frame,
          "Vector7<S>"};
}

std::vector<double> poses_as_quaternions(const Operation& operation, std::span<const double> arguments,
                                         bool is_float) {
  std::vector<double> all;
  std::uint64_t signs = signs_of(arguments);
  for (const Layout* l : operation.arguments) {
    const std::size_t n = numbers_of(*l);
    if (is_pose(*l)) {
      const double sign = signs & 1 ? -1 : 1;
      signs >>= 1;
      all.insert(all.end(), arguments.begin() + 9, arguments.begin() + 12);
      for (const Long x : quaternion_of(arguments.first(9))) all.push_back(sign * rounded(x, is_float));
    } else {
      all.insert(all.end(), arguments.begin(), arguments.begin() + static_cast<std::ptrdiff_t>(n));
    }
    arguments = arguments.subspan(n);
  }
  return all;
}

std::vector<double> poses_as_matrices(const Layout& result, std::span<const double> numbers, bool is_float) {
  if (!is_pose(result)) return {numbers.begin(), numbers.end()};
  const Long w = numbers[6];
  const std::array<Long, 3> v{numbers[3], numbers[4], numbers[5]};
  const Long diagonal = w * w - v[0] * v[0] - v[1] * v[1] - v[2] * v[2];
  std::vector<double> all(12);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    all[4 * i] = rounded(diagonal + 2 * v[i] * v[i], is_float);
    all[3 * j + k] = rounded(2 * (v[j] * v[k] - w * v[i]), is_float);
    all[3 * k + j] = rounded(2 * (v[j] * v[k] + w * v[i]), is_float);
    all[9 + i] = numbers[i];
  }
  return all;
}

}  // namespace liecheck::properties
