#pragma once
#include <liecheck/multibody/configuration.hpp>

namespace liecheck {

namespace random_configuration_detail {

/// A number in [0, 1) with 53 random bits, the same on every machine. A 32-bit generator is called twice.
template <Scalar S, class Generator>
S uniform(Generator& bits) {
  static_assert(Generator::min() == 0, "the generator must fill whole words");
  unsigned long long word = bits();
  if constexpr (Generator::max() <= 0xFFFFFFFFULL) word = word << 32 | (bits() & 0xFFFFFFFFULL);
  using std::ldexp;
  return S(ldexp(S(double(word >> 11)), -53));
}

}  // namespace random_configuration_detail

/// A random q [nq] by a generator such as std::mt19937_64, uniform in [lowerPositionLimit,
/// upperPositionLimit] and, for rotations, over the group (Shoemake 1992). Throws InvalidConfiguration, which
/// names joint, limit and value, if a limit is not finite, lower > upper or their difference overflows.
template <Scalar S, class Generator>
VectorX<S> randomConfiguration(const Model<S>& model, Generator& bits) {
  using random_configuration_detail::uniform;
  using std::cos, std::sin, std::sqrt;
  VectorX<S> q(model.nq);
  configuration_detail::forEachJoint(model, [&]<class Joint>(const Joint& joint) {
    using J = std::remove_cvref_t<decltype(joint.joint)>;
    typename J::Configuration x = joint.joint.neutral();
    for (int i = 0; i < J::unit_begin; ++i) {
      const S &low = model.lowerPositionLimit[joint.idx_q + i],
              &high = model.upperPositionLimit[joint.idx_q + i];
      if (!finite<S>(high - low) || high < low) {
        const bool upper = finite<S>(low) && !(high < low);
        refuse(joint, upper ? "upperPositionLimit" : "lowerPositionLimit", joint.idx_q + i,
               upper ? high : low, "a random position needs finite limits, lower <= upper");
      }
      x[i] = low + (high - low) * uniform<S>(bits);
    }
    if constexpr (J::nq - J::unit_begin == 2) {
      const S angle = S(2) * pi<S>() * uniform<S>(bits);
      x.template tail<2>() << cos(angle), sin(angle);
    } else if constexpr (J::nq - J::unit_begin == 4) {
      const S u = uniform<S>(bits), a = S(2) * pi<S>() * uniform<S>(bits),
              b = S(2) * pi<S>() * uniform<S>(bits);
      const S r = sqrt(S(1) - u), s = sqrt(u);
      x.template tail<4>() << r * sin(a), r * cos(a), s * sin(b), s * cos(b);
    }
    joint.configuration(q) = x;
  });
  return q;
}

}  // namespace liecheck
