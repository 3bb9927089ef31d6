// Operations on SE(2) are compared with those of the poses in space that move in the x y plane.

#include <generators/rotations.hpp>
#include <invariants/branch.hpp>
#include <oracles/orientations.hpp>

namespace liecheck::properties {
namespace {

class PlanarPoses final : public SlowLaw<PlanarPoses> {
 public:
  static constexpr Statement stated{
      .name = "planar_poses",
      .law = "SE(2) is the subgroup of SE(3) that moves the x y plane",
      .equation = "se2_exp(rho, omega) = exp6(rho, 0, 0, 0, omega); the same for the other operations",
      .source = "Sola, Deray & Atchuthan 2018, appendix A",
      .outputs = {op::se2_exp[block::rotation], op::se2_exp[block::translation],
                  op::se2_exp[block::norm_defect], op::se2_log[block::angle], op::se2_log[block::linear],
                  op::se2_compose[block::rotation], op::se2_compose[block::translation],
                  op::se2_compose[block::norm_defect], op::se2_integrate[block::rotation],
                  op::se2_integrate[block::translation], op::se2_integrate[block::norm_defect],
                  op::se2_difference[block::angle], op::se2_difference[block::linear]},
      .fields = {{"rho", Kind::vector, 2, "m", Reach::any},
                 {"omega", Kind::angle, 1, "rad", Reach::any},
                 {"p0", Kind::vector, 2, "m", Reach::any},
                 {"r0", Kind::direction, 2, "1", Reach::any},
                 {"p1", Kind::vector, 2, "m", Reach::any},
                 {"r1", Kind::direction, 2, "1", Reach::any}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    constexpr int binades = 16;
    constexpr S pi = boost::math::constants::pi<S>();
    const S sign = source.chance(1, 2) ? S(1) : S(-1);
    std::vector<S> x;
    append(x, vector3<S>(source, binades).template head<2>());
    x.push_back(std::clamp(S(sign * angle<S>(source, AngleRange::to_pi)), S(-pi), pi));
    const Vec<S, 3> p0 = vector3<S>(source, binades);
    const Vec<S, 2> r0 = unit_pair<S>(source);
    Vec<S, 2> p1 = p0.template head<2>();
    if (!source.chance(1, 4)) p1 = vector3<S>(source, binades).template head<2>();
    append(x, p0.template head<2>()), append(x, r0), append(x, p1), append(x, beside<S>(source, r0));
    return x;
  }
  bool valid(const std::vector<double>& input) const override {
    const auto unit = [&](std::size_t i) {
      const Real c = oracles::exact<Real>(input[i]), s = oracles::exact<Real>(input[i + 1]);
      return abs(Real(c * c + s * s - 1)) <= Real(8 * scalar().epsilon);
    };
    return Property::valid(input) && unit(5) && unit(9);
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    const auto& o = subject.operations;
    Reader read(input);
    const Vec<double, 3> delta = read.take<3>();
    const Vec<double, 4> q0 = read.take<4>(), q1 = read.take<4>();
    const auto step = oracles::exact_vector<3>(delta);
    const auto x0 = oracles::exact_vector<4>(q0), x1 = oracles::exact_vector<4>(q1);
    const std::size_t band = Bands::of(r.scalar()).classify(Real(abs(step[2])));
    if (o[op::se2_exp] || o[op::se2_integrate]) {
      const auto exp = oracles::planar_exp(step);
      if (o[op::se2_exp])
        record_pose(
            r,
            {op::se2_exp[block::rotation], op::se2_exp[block::translation], op::se2_exp[block::norm_defect]},
            band, o[op::se2_exp](delta), exp.value, exp.resolved, Real(0));
      if (o[op::se2_integrate]) {
        const auto exact = oracles::planar_compose(x0, exp.value);
        const Real scale = std::max(size_of(x0), apart(exact.value, x0));
        record_pose(r,
                    {op::se2_integrate[block::rotation], op::se2_integrate[block::translation],
                     op::se2_integrate[block::norm_defect]},
                    band, o[op::se2_integrate](q0, delta), exact.value, exp.resolved && exact.resolved,
                    scale);
      }
    }
    if (o[op::se2_compose]) {
      const auto exact = oracles::planar_compose(x0, x1);
      record_pose(r,
                  {op::se2_compose[block::rotation], op::se2_compose[block::translation],
                   op::se2_compose[block::norm_defect]},
                  0, o[op::se2_compose](q0, q1), exact.value, exact.resolved,
                  std::max(size_of(x0), size_of(x1)));
    }
    if (o[op::se2_log])
      record_difference(r, {op::se2_log[block::angle], op::se2_log[block::linear]}, o[op::se2_log](q1),
                        oracles::planar_difference({{Real(0), Real(0), Real(1), Real(0)}}, x1), {});
    if (o[op::se2_difference])
      record_difference(
          r, {op::se2_difference[block::angle], op::se2_difference[block::linear]},
          o[op::se2_difference](q0, q1), oracles::planar_difference(x0, x1),
          difference_scales(r, op::se2_difference[block::angle], apart(x1, x0), size_of(x0), size_of(x1)));
  }

 private:
  static Real size_of(const oracles::PlanarPose& q) { return sqrt(Real(q[0] * q[0] + q[1] * q[1])); }
  static Real apart(const oracles::PlanarPose& a, const oracles::PlanarPose& b) { return size_of(a - b); }

  template <class S>
  static Vec<S, 2> normalized(const Vec<S, 2>& r) {
    using std::sqrt;
    return r / S(sqrt(r.squaredNorm()));
  }
  /// Along an axis, near one, or any.
  template <class S>
  static Vec<S, 2> unit_pair(Source& source) {
    const S y = source.symmetric<S>(), x = source.symmetric<S>();
    Vec<S, 2> r(x, y);
    const std::uint64_t kind = source.below(4);
    const S sign = source.chance(1, 2) ? S(1) : S(-1);
    if (kind < 2) {
      r << sign,
          kind == 0
              ? S(0)
              : S(source.symmetric<S>() * binade_uniform<S>(source, -std::numeric_limits<S>::digits - 8, 0));
      if (source.chance(1, 2)) std::swap(r[0], r[1]);
    }
    if (!(r.squaredNorm() > S(1) / S(64))) r << sign, S(0);
    return normalized<S>(r);
  }
  /// Equal or opposite to r0, a few ulps from that, near it, or any.
  template <class S>
  static Vec<S, 2> beside(Source& source, const Vec<S, 2>& r0) {
    Vec<S, 2> r = source.chance(1, 3) ? Vec<S, 2>(-r0) : r0;
    switch (source.below(5)) {
      case 0:
        return r;
      case 1:
        for (int i = 0; i < 2; ++i) r[i] = step_ulps(r[i], source.between(-2, 2));
        return normalized<S>(r);
      case 2:
      case 3: {
        const S s = binade_uniform<S>(source, -std::numeric_limits<S>::digits - 4, 0);
        return normalized<S>(Vec<S, 2>(r[0] - s * r[1], r[1] + s * r[0]));
      }
      default:
        return unit_pair<S>(source);
    }
  }
  static void record_pose(Recorder& r, const std::array<Output, 3>& outputs, std::size_t band,
                          const Vec<double, 4>& computed, const oracles::PlanarPose& exact, bool resolved,
                          const Real& scale) {
    judged_value(r, {outputs[0], outputs[1], outputs[2]}, band, computed, resolved, [&] {
      const auto q = oracles::exact_vector<4>(computed);
      const Real square = q[2] * q[2] + q[3] * q[3], length = sqrt(square);
      const oracles::Vec<2> p{{q[0], q[1]}}, right{{exact[0], exact[1]}},
          turned{{q[2] / length - exact[2], q[3] / length - exact[3]}};
      r.record(outputs[0], band, oracles::in_eps(r.scalar(), norm(turned)));
      r.record(outputs[1], band, oracles::vector_error(r.scalar(), p, right, scale));
      r.record(outputs[2], band, oracles::in_eps(r.scalar(), Real(abs(square - 1))));
    });
  }
  static void record_difference(Recorder& r, const TwoOutputs& outputs, const Vec<double, 3>& computed,
                                const oracles::LogResult& exact, const LogScales<Real>& scales) {
    Vec<double, 6> xi;
    xi << computed[0], computed[1], 0, 0, 0, computed[2];
    record_log(r, {outputs[0], outputs[1]}, band_of_log(r.scalar(), exact), xi, exact, Side::either, scales);
  }
};

const RegisteredProperty<PlanarPoses> registered_planar_poses;

}  // namespace
}  // namespace liecheck::properties
