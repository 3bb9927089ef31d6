// Unit quaternions multiply, invert and become matrices as the rotations do that they stand for, and a rotation matrix
// becomes a quaternion.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <oracles/normalisation.hpp>
#include <oracles/representations.hpp>

namespace liecheck::properties {
namespace {

class Quaternions final : public Law<Quaternions> {
 public:
  static constexpr TwoOutputs of_matrix = rotation_and_norm(op::quaternion_from_matrix),
                              to_matrix = rotation_and_defect(op::matrix_from_quaternion),
                              product = rotation_and_norm(op::quaternion_product),
                              inverse = rotation_and_norm(op::quaternion_inverse);
  static constexpr Statement stated{
      .name = "quaternions",
      .law = "unit quaternions and rotation matrices are two representations of one group",
      .equation = "R(Q(R)) = R; R(Q0 Q1) = R(Q0) R(Q1); R(Q^-1) = R(Q)^T; |Q| = 1",
      .source = "Shepperd 1978; Sola 2017 (arXiv 1711.02508), section 2",
      .outputs = {of_matrix[0], of_matrix[1], to_matrix[0], to_matrix[1], product[0], product[1], inverse[0],
                  inverse[1]},
      .fields = {{"Q", Kind::quaternion, 4, "1"},
                 {"R", Kind::rotation_matrix, 9, "1"},
                 {"Q0", Kind::quaternion, 4, "1"},
                 {"Q1", Kind::quaternion, 4, "1", Reach::beside}}};

  /// R is that of Q, of another quaternion, or one that has lost some orthogonality, as after a product.
  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto Q = unit_quaternion<S>(source);
    Mat<S, 3> R = rotation_matrix<S>(source.chance(1, 2) ? Q : unit_quaternion<S>(source));
    if (source.chance(1, 4))
      for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = step_ulps(R(i / 3, i % 3), source.between(-1, 1));
    const auto Q0 = unit_quaternion<S>(source), Q1 = quaternion_near<S>(source, Q0);
    return Joined<S>{Q, R, Q0, Q1};
  }

  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    Reader read(input);
    const properties::Vec<double, 4> Q = read.take<4>();
    const properties::Mat<double, 3> R = read.take_matrix();
    const properties::Vec<double, 4> Q0 = read.take<4>(), Q1 = read.take<4>();
    const auto q = exact_vector<4, Real>(Q);
    if (o[op::quaternion_from_matrix]) {
      const auto exact = oracles::quaternion_from_matrix(exact_matrix<3, 3, Real>(R));
      record_rotation(r, of_matrix, band_of_rotation(r.scalar(), exact.value),
                      o[op::quaternion_from_matrix](R), exact);
    }
    if (o[op::matrix_from_quaternion])
      record_rotation(r, to_matrix, band_of_rotation(r.scalar(), q), o[op::matrix_from_quaternion](Q),
                      oracles::normalize(q));
    if (o[op::quaternion_inverse]) {
      auto exact = oracles::normalize(q);
      for (int i = 0; i < 3; ++i) exact.value[i] = -exact.value[i];
      record_rotation(r, inverse, band_of_rotation(r.scalar(), q), o[op::quaternion_inverse](Q), exact);
    }
    if (o[op::quaternion_product]) {
      const auto exact = unit_product(exact_vector<4, Real>(Q0), exact_vector<4, Real>(Q1));
      record_rotation(r, product, 0, o[op::quaternion_product](Q0, Q1), exact);
    }
  }
};

const RegisteredProperty<Quaternions> registered_quaternions;

}  // namespace
}  // namespace liecheck::properties
