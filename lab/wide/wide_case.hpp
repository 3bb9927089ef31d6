#pragma once
// One call of an operation, whose result is compared with a closed form at 100 digits.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <operations/operations.hpp>
#include <oracles/closed_forms.hpp>
#include <oracles/log.hpp>
#include <oracles/spatial_formulas.hpp>
#include <string>
#include <timing/cost.hpp>
#include <tuple>
#include <vector>

namespace liecheck::properties {
namespace wide_case {

using Wide = oracles::Real100;
using V3 = oracles::Vec3<Wide>;
using V4 = oracles::Quaternion<Wide>;
using V6 = oracles::Vec6<Wide>;
using V7 = oracles::Vec7<Wide>;
using M3 = oracles::Mat3<Wide>;
using M6 = oracles::Mat6<Wide>;
using PoseValue = oracles::PoseOf<Wide>;
using BodyValue = oracles::BodyOf<Wide>;

/// Reads numbers one after another, matrices row by row.
class Reader {
 public:
  explicit Reader(const std::vector<oracles::Real100>& all) : next_(all.data()) {}
  template <class T>
  T read() {
    if constexpr (std::is_same_v<T, Wide>) {
      return *next_++;
    } else if constexpr (std::is_same_v<T, PoseValue>) {
      return {read<M3>(), read<V3>()};  // braces evaluate in this order
    } else if constexpr (std::is_same_v<T, BodyValue>) {
      return {read<Wide>(), read<V3>(), read<M3>()};
    } else {
      T value;
      for (Wide& number : value.x) number = *next_++;
      return value;
    }
  }
  /// The value of a formula, whose arguments are read in their order.
  template <class Value, class... A>
  Value evaluate(Value (*formula)(const A&...)) {
    const std::tuple<A...> arguments{read<A>()...};
    return std::apply(formula, arguments);
  }

 private:
  const Wide* next_;
};

inline V3 zero() {
  return oracles::zero_vector<3, Wide>();
}

/// One call: its arguments x and its result y. Most functions read y and add its errors to the blocks.
struct Case {
  std::vector<BlockErrors>& blocks;
  double eps;
  Reader x, y;
  bool finite;  ///< whether all numbers of the result are finite; std::min and std::max may drop a NaN

  void distance(BlockName name, const Wide& distance) {
    const auto error = static_cast<double>(Wide(distance / Wide(eps)));
    auto found = std::find_if(blocks.begin(), blocks.end(), [&](auto& b) { return b.block == name.text; });
    if (found == blocks.end()) found = blocks.insert(blocks.end(), BlockErrors{std::string(name.text), {}});
    if (finite && std::isfinite(error))
      found->errors.push_back(error);
    else
      ++found->not_finite;
  }
  template <int N>
  void relative(BlockName name, const oracles::Vec<N, Wide>& computed, const oracles::Vec<N, Wide>& exact,
                const Wide& scale = Wide(0)) {
    const Wide size = std::max(Wide(norm(exact)), scale), error = norm(computed - exact);
    distance(name, size > 0 ? Wide(error / size) : error);
  }
  template <int R, int C>
  void relative(BlockName name, const oracles::Mat<R, C, Wide>& computed,
                const oracles::Mat<R, C, Wide>& exact) {
    relative(name, oracles::Vec<R * C, Wide>{computed.x}, oracles::Vec<R * C, Wide>{exact.x});
  }
  void relative(BlockName name, const Wide& computed, const Wide& exact) {
    relative(name, oracles::Vec<1, Wide>{{computed}}, oracles::Vec<1, Wide>{{exact}});
  }
  void rotation(const V4& Q, const V4& exact) {
    const V4 unit = oracles::normalized(Q);
    distance(block::rotation, 2 * std::min(Wide(norm(unit - exact)), Wide(norm(unit + exact))));
  }
  void unit(const V4& exact) { relative(block::quaternion, y.read<V4>(), exact); }
  void entries(const M3& exact) {
    const M3 E = y.read<M3>() - exact;
    Wide worst(0);
    for (const Wide& x : E.x) worst = std::max(worst, Wide(abs(x)));
    distance(block::entry, worst);
  }
  void quaternion(const V4& exact) { rotation(y.read<V4>(), exact); }
  void matrix(const V4& exact) {
    distance(block::rotation, norm(y.read<M3>() - oracles::rotation_matrix(exact)) / sqrt(Wide(2)));
  }
  void pose(const oracles::UnitPose<Wide>& exact) {
    matrix(exact.Q);
    relative(block::translation, y.read<V3>(), exact.p);
  }
  void rotation_vector(const V3& exact) { relative(block::rotation_vector, y.read<V3>(), exact); }
  void log_with(const V6& exact, const Wide& scale) {
    const V6 xi = y.read<V6>();
    relative(block::rotation_vector, tail3(xi), tail3(exact));
    relative(block::linear, head3(xi), head3(exact), scale);
  }
  void log(const V6& exact) { log_with(exact, Wide(0)); }
  void point(const V3& exact) { relative(block::point, y.read<V3>(), exact); }
  void energy(const Wide& exact) { relative(block::energy, y.read<Wide>(), exact); }
  void six(const V6& exact) {
    relative(block::linear, y.read<V3>(), head3(exact));
    relative(block::angular, y.read<V3>(), tail3(exact));
  }
  void jacobian3(const M3& exact) { relative(block::jacobian, y.read<M3>(), exact); }
  void jacobian6(const oracles::JacobianBlocks<Wide>& exact) {
    const M6 J = y.read<M6>();
    const auto error = [&](int i) { return Wide(norm(oracles::block(J, i, i) - exact.J)); };
    const bool zero_below = norm(oracles::block(J, 1, 0)) == 0;
    distance(block::jacobian, zero_below ? Wide(std::max(error(0), error(1)) / norm(exact.J))
                                         : std::numeric_limits<Wide>::infinity());
    relative(block::coupling, oracles::block(J, 0, 1), exact.C);
  }
  void body(const BodyValue& exact) {
    relative(block::mass, y.read<Wide>(), exact.mass);
    relative(block::lever, y.read<V3>(), exact.c);
    relative(block::inertia, y.read<M3>(), exact.I_C);
  }
  /// The worst of the four 3 x 3 blocks.
  void inertia_matrix(const M6& exact) {
    const M6 computed = y.read<M6>();
    Wide worst(0);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const M3 right = oracles::block(exact, i, j);
        const Wide error = norm(oracles::block(computed, i, j) - right);
        worst = std::max(worst, error > 0 ? Wide(error / norm(right)) : error);
      }
    distance(block::matrix, worst);
  }
};

using Compare = std::function<void(Case&)>;
using V2 = oracles::Vec<2, Wide>;

/// Compares the result with a formula of the arguments.
template <class Exact, class Formula>
Compare against(void (Case::*compare)(const Exact&), Formula formula) {
  return [=](Case& c) { (c.*compare)(c.x.evaluate(+formula)); };
}

inline V4 exp3(const V3& phi) {
  return closed_exp(stack(zero(), phi)).Q;
}

}  // namespace wide_case

using Comparison = std::pair<const Operation*, wide_case::Compare>;
/// Those of the operations between rotations and directions, of Euler angles, rates and poses in the plane.
std::vector<Comparison> comparisons_of_orientations();
/// Those of the representations of rotations, of adjoints, means and inertial navigation.
std::vector<Comparison> comparisons_of_representations();

}  // namespace liecheck::properties
