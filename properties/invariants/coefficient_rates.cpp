// The rates of a configuration's stored numbers, from its velocity and back, are compared with the definition.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>

namespace liecheck::properties {
namespace {

class CoefficientRates final : public SlowLaw<CoefficientRates> {
 public:
  static constexpr Statement stated{
      .name = "coefficient_rates",
      .law = "N(q) gives the rates of the stored numbers, and its pseudo-inverse the velocity",
      .equation = "p_dot = R u, Q_dot = 1/2 Q (omega, 0); u = R^T p_dot, omega = 2 (Q* Q_dot)_xyz / |Q|^2",
      .source = "Sola 2017 (arXiv 1711.02508), eqs. 197-201",
      .outputs = {op::velocity_to_rate[block::translation], op::velocity_to_rate[block::rotation_rate],
                  op::rate_to_velocity[block::linear], op::rate_to_velocity[block::angular]},
      .fields = {{"p", Kind::vector, 3, "m", Reach::any},
                 {"Q", Kind::quaternion, 4, "1"},
                 {"u", Kind::vector, 3, "m/s"},
                 {"omega", Kind::vector, 3, "rad/s"},
                 {"p_dot", Kind::vector, 3, "m/s"},
                 {"Q_dot", Kind::vector, 4, "1/s", Reach::any}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    constexpr int binades = 16;
    const Vec<S, 3> p = vector3<S>(source, binades);
    const Vec<S, 4> Q = unit_quaternion<S>(source);
    std::vector<S> x = Joined<S>{p, Q, vector3<S>(source, binades), vector3<S>(source, binades),
                                 vector3<S>(source, binades)};
    // Any rate; one of a rotation, Q (omega, 0); or one that changes only the norm.
    const std::uint64_t kind = source.below(4);
    const Vec<S, 3> v = vector3<S>(source, binades);
    Vec<S, 4> rate;
    rate << v, kind == 0 ? source.symmetric<S>() : S(0);
    if (kind > 0) rate = quaternion_product<S>(Q, rate);
    append(x, kind == 3 ? Vec<S, 4>(source.symmetric<S>() * Q) : rate);
    return x;
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    properties::Reader read(input);
    properties::Vec<double, 7> q, q_dot;
    properties::Vec<double, 6> V;
    q << read.take<7>();
    V << read.take<6>();
    q_dot << read.take<7>();
    const Quaternion<> Q = exact_vector<4>(properties::Vec<double, 4>(q.tail<4>()));
    if (o[op::velocity_to_rate]) {
      constexpr Output translation = op::velocity_to_rate[block::translation],
                       rate = op::velocity_to_rate[block::rotation_rate];
      const properties::Vec<double, 7> computed = o[op::velocity_to_rate](q, V);
      const auto v = exact_vector<6>(V);
      const Vec3<> u = head3(v), omega = tail3(v);
      const Quaternion<> exact =
          Real(Real(1) / 2) * quaternion_product(Q, Quaternion<>{{omega[0], omega[1], omega[2], Real(0)}});
      judged_value(r, {translation, rate}, 0, computed, true, [&] {
        const auto got = exact_vector<7>(computed);
        r.record(translation, 0, vector_error(r.scalar(), head3(got), rotate(Q, u), norm(u)));
        r.record(rate, 0, vector_error(r.scalar(), quaternion_of(got), exact));
      });
    }
    if (!o[op::rate_to_velocity]) return;
    constexpr Output linear = op::rate_to_velocity[block::linear],
                     angular = op::rate_to_velocity[block::angular];
    const properties::Vec<double, 6> computed = o[op::rate_to_velocity](q, q_dot);
    const auto rates = exact_vector<7>(q_dot);
    const Quaternion<> Q_dot = quaternion_of(rates);
    const Real square = squared_norm(Q);
    const Vec3<> p_dot = head3(rates), omega = Real(2 / square) * head3(conjugate_product(Q, Q_dot));
    judged_value(r, {linear, angular}, 0, computed, true, [&] {
      const auto got = exact_vector<6>(computed);
      r.record(linear, 0, vector_error(r.scalar(), head3(got), rotate(Q, p_dot, true), norm(p_dot)));
      r.record(angular, 0, vector_error(r.scalar(), tail3(got), omega, Real(2 * norm(Q_dot) / sqrt(square))));
    });
  }
};

const RegisteredProperty<CoefficientRates> registered_coefficient_rates;

}  // namespace
}  // namespace liecheck::properties
