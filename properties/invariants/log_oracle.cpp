// log is compared with the exact logarithm of Q/|Q|, or of the rotation nearest to R, for the stored numbers.

#include <generators/rotations.hpp>
#include <invariants/branch.hpp>
#include <oracles/log.hpp>

namespace liecheck::properties {
namespace {

class LogOracle final : public Law<LogOracle> {
 public:
  static constexpr Statement stated{
      .name = "log_oracle",
      .law = "log of a pose is the inverse of exp with an angle of at most pi",
      .equation = "exp(log(R, p)) = (R, p), |phi| <= pi",
      .source = "Higham 2008, section 11.5 (inverse scaling and squaring)",
      .outputs = {op::log3_quaternion[block::rotation_vector], op::log3_matrix[block::rotation_vector],
                  op::log6[block::rotation_vector], op::log6[block::linear]},
      .fields = {{"Q", Kind::quaternion, 4, "1"},
                 {"R", Kind::rotation_matrix, 9, "1"},
                 {"p", Kind::vector, 3, "m", Reach::full}}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto Q = unit_quaternion<S>(source);
    return Joined<S>{Q, rotation_matrix<S>(Q), vector3<S>(source)};
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    const auto& o = subject.operations;
    Reader read(input);
    const Vec<double, 4> Q = read.take<4>();
    const Mat<double, 3> R = read.take_matrix();
    const Vec<double, 3> p = read.take<3>();
    if (o[op::log3_quaternion]) {
      const auto exact = oracles::log_so3(oracles::exact_vector<4, Real>(Q));
      constexpr Output output = op::log3_quaternion[block::rotation_vector];
      const std::size_t band = band_of_log(r.scalar(), exact);
      record_log(r, {output}, band, rotation(o[op::log3_quaternion](Q)), exact, side_of(r, output, band));
    }
    if (!o[op::log3_matrix] && !o[op::log6]) return;
    const auto exact =
        oracles::log_se3_matrix(oracles::exact_matrix<3, 3, Real>(R), oracles::exact_vector<3, Real>(p));
    const std::size_t band = band_of_log(r.scalar(), exact);
    if (o[op::log3_matrix])
      record_log(r, {op::log3_matrix[block::rotation_vector]}, band, rotation(o[op::log3_matrix](R)), exact,
                 Side::either);
    if (o[op::log6])
      record_log(r, {op::log6[block::rotation_vector], op::log6[block::linear]}, band, o[op::log6]({R, p}),
                 exact, Side::either);
  }

 private:
  static Vec<double, 6> rotation(const Vec<double, 3>& phi) {
    Vec<double, 6> xi;
    xi << Vec<double, 3>::Zero(), phi;
    return xi;
  }
};

const RegisteredProperty<LogOracle> registered_log_oracle;

}  // namespace
}  // namespace liecheck::properties
