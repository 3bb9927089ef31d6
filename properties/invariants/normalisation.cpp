// The first-order normalisation of a quaternion whose norm is near 1 is compared with its definition.

#include <generators/rotations.hpp>
#include <invariants/any_norm.hpp>
#include <invariants/common.hpp>
#include <oracles/normalisation.hpp>

namespace liecheck::properties {
namespace {

class Normalisation final : public Law<Normalisation> {
 public:
  static constexpr const auto& measured = op::first_order_normalize;
  static constexpr Statement stated{.name = "normalisation",
                                    .law = "a first-order normalisation is one Newton step to Q/|Q|",
                                    .equation = "Q_n = Q (3 - |Q|^2) / 2 for ||Q|^2 - 1| <= 1/2",
                                    .source = "Higham 2008, eq. 8.20 (Newton-Schulz)",
                                    .outputs = {measured[block::quaternion]},
                                    .fields = {{"Q", Kind::any_quaternion, 4, "1", Reach::any}}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto Q = unit_quaternion<S>(source);
    const std::uint64_t kind = source.below(4);
    const S step = source.symmetric<S>();  // the norms 0.75 and 1.2 are in the domain
    if (kind == 0) return Joined<S>{Q};
    return Joined<S>{
        Vec<S, 4>((kind == 1 ? S(1) + step / S(1000000) : S(39) / S(40) + step * S(9) / S(40)) * Q)};
  }
  bool valid(const std::vector<double>& input) const override {
    return oracles::all_finite(input) &&
           norm_defect_at(scalar(), input, 0) <= std::ldexp(0.5, scalar().digits - 1);
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    if (!subject.operations[measured]) return;
    const Vec<double, 4> Q = Reader(input).take<4>(), computed = subject.operations[measured](Q);
    const auto exact = oracles::first_order_normalize(oracles::exact_vector<4, Real>(Q));
    judged_value(r, {measured[block::quaternion]}, 0, computed, exact.resolved, [&] {
      constexpr Output quaternion = measured[block::quaternion];
      const auto stored = oracles::exact_vector<4, Real>(computed);
      r.record(quaternion, 0,
               oracles::vector_error(r.scalar(), stored, nearer_sign(r, quaternion, stored, exact.value)));
    });
  }
};

const RegisteredProperty<Normalisation> registered_normalisation;

}  // namespace
}  // namespace liecheck::properties
