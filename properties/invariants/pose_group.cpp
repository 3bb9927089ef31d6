// Poses compose, invert and act on points as their 4 x 4 matrices do. The oracle multiplies the stored
// matrices column by column, so R need not be exactly orthogonal.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <oracles/spatial.hpp>

namespace liecheck::properties {
namespace {

class PoseGroup final : public Law<PoseGroup> {
 public:
  static constexpr Statement stated{
      .name = "pose_group",
      .law = "poses compose, invert and act on points as their matrices do",
      .equation = "(R, p)(R_Y, p_Y) = (R R_Y, R p_Y + p); (R, p)^-1 = (R^T, -R^T p); (R, p) x = R x + p",
      .source = "Murray, Li & Sastry 1994, eqs. 2.19-2.22",
      .outputs = {op::compose[block::matrix], op::compose[block::translation], op::inverse[block::matrix],
                  op::inverse[block::translation], op::act_point[block::point]},
      .fields = {{"R", Kind::rotation_matrix, 9, "1"},
                 {"p", Kind::vector, 3, "m", Reach::full},
                 {"R_Y", Kind::rotation_matrix, 9, "1"},
                 {"p_Y", Kind::vector, 3, "m", Reach::full}}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    std::vector<S> x;
    for (int i = 0; i < 2; ++i) {
      append(x, rotation_matrix<S>(unit_quaternion<S>(source)));
      append(x, vector3<S>(source));
    }
    return x;
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    Reader read(input);
    const auto X = read.take_pose(), Y = read.take_pose();
    const Vec3<Real> none{{Real(0), Real(0), Real(0)}};
    const PoseOf<Real> x = exact_pose<Real>(X), y = exact_pose<Real>(Y), linear{x.R, none};

    if (o[op::compose]) {
      const auto XY = o[op::compose](X, Y);
      const auto p = oracles::act_point(x, y.p);
      oracles::Vec<9, Real> columns, computed;
      bool resolved = true;
      for (int j = 0; j < 3; ++j) {
        const auto column = oracles::act_point(linear, Vec3<Real>{{y.R(0, j), y.R(1, j), y.R(2, j)}});
        resolved = resolved && column.resolved;
        for (int i = 0; i < 3; ++i)
          columns[3 * j + i] = column.value[i], computed[3 * j + i] = exact<Real>(XY.R(i, j));
      }
      judged_value(r, {op::compose[block::matrix]}, 0, XY.R, resolved, [&] {
        r.record(op::compose[block::matrix], 0, vector_error(r.scalar(), computed, columns));
      });
      judged_value(r, {op::compose[block::translation]}, 0, XY.p, p.resolved, [&] {
        r.record(
            op::compose[block::translation], 0,
            vector_error(r.scalar(), exact_vector<3, Real>(XY.p), p.value, larger(norm(x.p), norm(y.p))));
      });
    }
    if (o[op::inverse]) {
      const auto inverse = o[op::inverse](X);
      const auto p = oracles::act_inverse_point(x, none);
      judged_value(r, {op::inverse[block::matrix]}, 0, inverse.R, true, [&] {
        r.record(op::inverse[block::matrix], 0,
                 vector_error(r.scalar(), exact_matrix<3, 3, Real>(inverse.R), transpose(x.R)));
      });
      judged_value(r, {op::inverse[block::translation]}, 0, inverse.p, p.resolved, [&] {
        r.record(op::inverse[block::translation], 0,
                 vector_error(r.scalar(), exact_vector<3, Real>(inverse.p), p.value));
      });
    }
    if (o[op::act_point]) {
      const properties::Vec<double, 3> point = o[op::act_point](X, Y.p);
      const auto p = oracles::act_point(x, y.p);
      record_sum(r, op::act_point[block::point], point, p.value, p.resolved, Real(norm(x.p) + norm(y.p)));
    }
  }
};

const RegisteredProperty<PoseGroup> registered_pose_group;

}  // namespace
}  // namespace liecheck::properties
