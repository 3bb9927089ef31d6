// Matrices that are not quite rotations: the nearest rotation, the one that Gram and Schmidt's process gives, and what
// conversions that expect a rotation give for a matrix that has drifted from one.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <oracles/exp.hpp>
#include <oracles/representations.hpp>

namespace liecheck::properties {
namespace {

/// R + R E with |E| up to 2^low ... 2^high.
template <class S>
Mat<S, 3> deformed(Source& source, int low, int high) {
  const Mat<S, 3> R = rotation_matrix<S>(unit_quaternion<S>(source));
  const S size = binade_uniform<S>(source, low, high);
  Mat<S, 3> E;
  const std::uint64_t kind = source.below(4);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      E(i, j) = kind == 0 ? S(i == j) : kind == 1 && i == j ? S(0) : source.symmetric<S>();
  if (source.chance(1, 2)) E = -E;
  return R + size * (R * E);
}

class NearestRotation final : public SlowLaw<NearestRotation> {
 public:
  static constexpr TwoOutputs nearest = rotation_and_defect(op::nearest_rotation),
                              by_columns = rotation_and_defect(op::gram_schmidt);
  static constexpr Statement stated{
      .name = "nearest_rotation",
      .law = "the nearest rotation is the polar factor of a matrix",
      .equation = "A = R H, R^T R = I, H symmetric and positive; or A = R U with U upper triangular",
      .source = "Higham 2008, section 8.1; Golub & Van Loan 2013, section 5.2.7",
      .outputs = {nearest[0], nearest[1], by_columns[0], by_columns[1]},
      .fields = {{"A", Kind::near_rotation, 9, "1"}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    return Joined<S>{deformed<S>(source, -std::numeric_limits<S>::digits - 2, -4)};
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    const auto& o = subject.operations;
    const Mat<double, 3> A = Reader(input).take_matrix();
    const auto a = oracles::exact_matrix<3, 3>(A);
    if (o[op::nearest_rotation])
      record_rotation(r, nearest, 0, o[op::nearest_rotation](A), oracles::quaternion_from_matrix(a));
    if (o[op::gram_schmidt])
      record_rotation(r, by_columns, 0, o[op::gram_schmidt](A), oracles::gram_schmidt(a));
  }
};

class DriftedMatrices final : public SlowLaw<DriftedMatrices> {
 public:
  static constexpr TwoOutputs to_quaternion = rotation_and_norm(op::quaternion_of_drifted_matrix);
  static constexpr Output to_log = op::log_of_drifted_matrix[block::rotation];
  static constexpr Statement stated{
      .name = "drifted_matrices",
      .law = "a conversion of a matrix that has drifted from a rotation errs by a multiple of the drift",
      .equation = "|f(A) - f(R)| <= 4 d of quaternions, 4 sqrt(d) of logarithms; d = |A^T A - I|, A = R H",
      .source = "Bar-Itzhack 2000, New method for extracting the quaternion",
      .outputs = {to_quaternion[0], to_quaternion[1], to_log},
      .fields = {{"A", Kind::near_rotation, 9, "1"}},
      .formed = {{&op::quaternion_of_drifted_matrix, {&op::quaternion_from_matrix}},
                 {&op::log_of_drifted_matrix, {&op::log3_matrix}}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    return Joined<S>{deformed<S>(source, 6 - std::numeric_limits<S>::digits, -13)};
  }
  bool valid(const std::vector<double>& input) const override {
    return SlowLaw::valid(input) &&
           oracles::orthogonality_distance({oracles::exact_vector<9>(input.data()).x}) <= Real(1) / 1000;
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    const properties::Mat<double, 3> A = Reader(input).take_matrix();
    const Mat3<> a = exact_matrix<3, 3>(A);
    const Real drift = orthogonality_distance(a);
    const auto exact = oracles::quaternion_from_matrix(a);
    const std::size_t band = band_of_rotation(r.scalar(), exact.value);
    const auto record = [&](const Output& output, const Real& error, const Real& allowed) {
      r.record(output, band, error > allowed ? in_eps(r.scalar(), Real(error - allowed)) : 0);
    };
    if (o[op::quaternion_from_matrix]) {
      const properties::Vec<double, 4> computed = o[op::quaternion_from_matrix](A);
      judged_value(r, {to_quaternion[0], to_quaternion[1]}, band, computed, exact.resolved, [&] {
        const auto Q = exact_vector<4>(computed);
        record(to_quaternion[0], rotation_distance(Q, exact.value), 4 * drift);
        record(to_quaternion[1], norm_distance(Q), 4 * drift);
      });
    }
    if (o[op::log3_matrix]) {
      const properties::Vec<double, 3> computed = o[op::log3_matrix](A);
      const ExpResult turn = all_finite(computed) ? exp_so3(exact_vector<3>(computed)) : ExpResult();
      judged_value(r, {to_log}, band, computed, exact.resolved && turn.resolved,
                   [&] { record(to_log, rotation_distance(turn.Q, exact.value), Real(4 * sqrt(drift))); });
    }
  }
};

const RegisteredProperty<NearestRotation> registered_nearest_rotation;
const RegisteredProperty<DriftedMatrices> registered_drifted_matrices;

}  // namespace
}  // namespace liecheck::properties
