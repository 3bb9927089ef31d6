#pragma once
// The configuration space of a whole robot. Each joint has a segment of q [nq] and a segment of v [nv].
//
// Values and error bounds are those of the joints (se3_configuration.hpp, joints/). Every function throws
// std::invalid_argument with the actual and the expected size if an argument has the wrong size, and
// InvalidConfiguration, which names argument, joint, index and value, if a number is not finite or a
// quaternion or (cos, sin) is zero. One of another norm than 1 is taken as normalised; to refuse it too, call
// checkedConfiguration.

#include <liecheck/multibody/invalid_configuration.hpp>
#include <liecheck/multibody/joint_place.hpp>
#include <liecheck/multibody/model.hpp>
#include <liecheck/multibody/norm.hpp>
#include <liecheck/spatial/checked_rotation.hpp>
#include <type_traits>

namespace liecheck {

namespace configuration_detail {

using multibody_detail::checkSize;
using multibody_detail::forEachJoint;
template <Scalar S>
void checkConfigurationSize(const Model<S>& model, const VectorX<S>& q, const char* what) {
  checkSize(q.size(), model.nq, what, "nq");
}
template <Scalar S>
void checkTangentSize(const Model<S>& model, const VectorX<S>& v, const char* what) {
  checkSize(v.size(), model.nv, what, "nv");
}

/// True if all numbers are finite: 0 x is NaN for infinity and NaN.
template <Scalar S>
bool allFinite(const VectorX<S>& x) {
  return (x * S(0)).sum() == S(0);
}
/// Checks the size of q [nq], and that all numbers are finite.
template <Scalar S>
void checkConfiguration(const Model<S>& model, const VectorX<S>& q, const char* what) {
  checkConfigurationSize<S>(model, q, what);
  if (!allFinite<S>(q)) [[unlikely]]
    forEachJoint(model, [&](const auto& place) { refuseNonFiniteConfiguration(place, q, what); });
}
/// Throws InvalidConfiguration if a number of q [nq] is not finite, or a quaternion or (cos, sin) is zero. Kept
/// out of the loops that compute, which it would slow down.
template <Scalar S>
[[gnu::noinline, gnu::cold]] void refuseValues(const Model<S>& model, const VectorX<S>& q, const char* what) {
  forEachJoint(model, [&](const auto& place) {
    refuseNonFiniteConfiguration(place, q, what);
    refuseZero(place, q, what);
  });
}
/// Checks the size of v [nv], and that all numbers are finite.
template <Scalar S>
void checkTangent(const Model<S>& model, const VectorX<S>& v, const char* what) {
  checkTangentSize<S>(model, v, what);
  if (!allFinite<S>(v)) [[unlikely]]
    forEachJoint(model, [&](const auto& place) { refuseNonFiniteTangent(place, v, what); });
}

}  // namespace configuration_detail

/// Configurations are the same if they differ by at most 64 eps, the error of 16 operations of 4 eps each.
template <Scalar S>
S samenessBudget() {
  return S(64) * eps<S>();
}

/// The neutral configuration [nq]: (0 0 0, 0 0 0 1) of a free-flyer, (1, 0) of a continuous joint, else 0.
template <Scalar S>
VectorX<S> neutral(const Model<S>& model) {
  VectorX<S> q(model.nq);
  configuration_detail::forEachJoint(
      model, [&](const auto& place) { place.configuration(q) = place.joint.neutral(); });
  return q;
}

/// q [nq] with every quaternion and (cos, sin) normalised. Error 2 eps.
template <Scalar S>
VectorX<S> normalized(const Model<S>& model, In<S> q) {
  configuration_detail::checkConfiguration<S>(model, q, "q");
  VectorX<S> result(model.nq);
  configuration_detail::forEachJoint(model, [&](const auto& place) {
    refuseZero(place, q, "q");
    place.configuration(result) = place.joint.normalized(place.configuration(q));
  });
  return result;
}
/// q = normalized(model, q); q is unchanged if normalized throws.
template <Scalar S>
void normalize(const Model<S>& model, VectorX<S>& q) {
  q = normalized(model, q);
}

/// True if ||Q|^2 - 1| <= budget for every quaternion and every (cos, sin).
template <Scalar S>
bool isNormalized(const Model<S>& model, In<S> q,
                  const std::type_identity_t<S>& budget = normDefectBudget<S>()) {
  configuration_detail::checkConfigurationSize<S>(model, q, "q");
  bool all = true;
  configuration_detail::forEachJoint(model, [&](const auto& place) {
    all = all && isNormalized(place.joint, place.configuration(q), budget);
  });
  return all;
}

/// The configuration T exp(delta) of every joint [nq]; delta [nv; m, rad] is an increment, such as dt v.
/// Flattened: a call for each joint would take as long as the sum of a revolute joint.
template <Scalar S>
[[gnu::flatten]] VectorX<S> integrate(const Model<S>& model, In<S> q, In<S> delta) {
  using namespace configuration_detail;
  checkConfigurationSize<S>(model, q, "q");
  checkTangentSize<S>(model, delta, "delta");
  VectorX<S> result(model.nq);
  try {
    forEachJoint(model, [&](const auto& place) {
      place.configuration(result) = place.joint.integrate(place.configuration(q), place.tangent(delta));
    });
  } catch (const std::invalid_argument&) {
    refuseValues<S>(model, q, "q");
    throw;
  }
  // The result is not read: wide loads of numbers that were just stored one by one would stall.
  if (!allFinite<S>(q) || !allFinite<S>(delta)) [[unlikely]]
    refuseValues<S>(model, q, "q"), checkTangent<S>(model, delta, "delta");
  return result;
}

/// The increment log(T0^-1 T1) of every joint, from q0 to q1 [nv]: integrate(q0, difference(q0, q1)) is q1.
/// Flattened: a call for each joint would take as long as the subtraction of a revolute joint.
template <Scalar S>
[[gnu::flatten]] VectorX<S> difference(const Model<S>& model, In<S> q0, In<S> q1) {
  using namespace configuration_detail;
  checkConfigurationSize<S>(model, q0, "q0");
  checkConfigurationSize<S>(model, q1, "q1");
  VectorX<S> delta(model.nv);
  try {
    forEachJoint(model, [&](const auto& place) {
      place.tangent(delta) = place.joint.difference(place.configuration(q0), place.configuration(q1));
    });
  } catch (const std::invalid_argument&) {
    refuseValues<S>(model, q0, "q0"), refuseValues<S>(model, q1, "q1");
    throw;
  }
  if (!allFinite<S>(q0) || !allFinite<S>(q1)) [[unlikely]]
    refuseValues<S>(model, q0, "q0"), refuseValues<S>(model, q1, "q1");
  return delta;
}

/// integrate(q0, u difference(q0, q1)) [nq]: the geodesic of every joint, q0 at u = 0, q1 at u = 1. Throws
/// std::invalid_argument if u is not finite; any other u is allowed. delta = u difference(q0, q1) in
/// messages.
template <Scalar S>
VectorX<S> interpolate(const Model<S>& model, In<S> q0, In<S> q1, const std::type_identity_t<S>& u) {
  if (!finite<S>(u)) checked_rotation_detail::refuse<S>("u", u, "not finite");
  return integrate(model, q0, u * difference(model, q0, q1));
}

/// |difference|^2 of each joint except the universe [njoints - 1]; squares of m and of rad are added.
template <Scalar S>
VectorX<S> squaredDistance(const Model<S>& model, In<S> q0, In<S> q1) {
  using namespace configuration_detail;
  checkConfigurationSize<S>(model, q0, "q0");
  checkConfigurationSize<S>(model, q1, "q1");
  VectorX<S> result(model.njoints - 1);
  configuration_detail::forEachJoint(model, [&](const auto& place) {
    refuseZero(place, q0, "q0");
    refuseZero(place, q1, "q1");
    result[place.index - 1] = squaredDistance(place.joint, place.configuration(q0), place.configuration(q1));
  });
  if (!allFinite<S>(result)) [[unlikely]]
    checkConfiguration<S>(model, q0, "q0"), checkConfiguration<S>(model, q1, "q1");
  return result;
}

/// sqrt(sum_i (weights_i difference_i)^2), weights [nv; 1/m, 1/rad].
template <Scalar S>
S distance(const Model<S>& model, In<S> q0, In<S> q1, In<S> weights) {
  configuration_detail::checkTangent<S>(model, weights, "weights");
  const VectorX<S> delta = difference(model, q0, q1).cwiseProduct(weights);
  return multibody_detail::norm(delta);
}
/// |difference(q0, q1)| = sqrt(sum of squaredDistance), as Pinocchio defines it: 1 m counts as much as 1 rad.
template <Scalar S>
S distance(const Model<S>& model, In<S> q0, In<S> q1) {
  return distance(model, q0, q1, VectorX<S>::Ones(model.nv));
}

/// True if all joints differ by at most budget [rad; relative to max(1 m, |p|)]. Q and -Q are the same. False
/// if a number is not finite.
template <Scalar S>
bool isSameConfiguration(const Model<S>& model, In<S> q0, In<S> q1,
                         const std::type_identity_t<S>& budget = samenessBudget<S>()) {
  configuration_detail::checkConfigurationSize<S>(model, q0, "q0");
  configuration_detail::checkConfigurationSize<S>(model, q1, "q1");
  bool same = true;
  configuration_detail::forEachJoint(model, [&](const auto& place) {
    refuseZero(place, q0, "q0");
    refuseZero(place, q1, "q1");
    same = same && place.joint.isSame(place.configuration(q0), place.configuration(q1), budget);
  });
  return same;
}

/// The derivative [nv x nv] of integrate(q, delta) with respect to q (ARG0) or delta (ARG1), block-diagonal.
/// It maps a tangent increment of the argument to one of the result.
template <Scalar S>
MatrixX<S> dIntegrate(const Model<S>& model, In<S> q, In<S> delta, ArgumentPosition argument) {
  configuration_detail::checkConfiguration<S>(model, q, "q");
  configuration_detail::checkTangent<S>(model, delta, "delta");
  MatrixX<S> J = MatrixX<S>::Zero(model.nv, model.nv);
  configuration_detail::forEachJoint(model, [&](const auto& place) {
    refuseZero(place, q, "q");
    place.jacobian(J) = place.joint.dIntegrate(place.configuration(q), place.tangent(delta), argument);
  });
  return J;
}

/// The derivative [nv x nv] of difference(q0, q1) with respect to q0 (ARG0) or q1 (ARG1), block-diagonal.
template <Scalar S>
MatrixX<S> dDifference(const Model<S>& model, In<S> q0, In<S> q1, ArgumentPosition argument) {
  configuration_detail::checkConfiguration<S>(model, q0, "q0");
  configuration_detail::checkConfiguration<S>(model, q1, "q1");
  MatrixX<S> J = MatrixX<S>::Zero(model.nv, model.nv);
  configuration_detail::forEachJoint(model, [&](const auto& place) {
    refuseZero(place, q0, "q0");
    refuseZero(place, q1, "q1");
    place.jacobian(J) = place.joint.dDifference(place.configuration(q0), place.configuration(q1), argument);
  });
  return J;
}

/// The derivative [nq x nv] of the stored numbers of integrate(q, delta) with respect to delta, at delta = 0.
template <Scalar S>
MatrixX<S> integrateCoeffWiseJacobian(const Model<S>& model, In<S> q) {
  configuration_detail::checkConfiguration<S>(model, q, "q");
  MatrixX<S> J = MatrixX<S>::Zero(model.nq, model.nv);
  configuration_detail::forEachJoint(model, [&](const auto& place) {
    refuseZero(place, q, "q");
    const auto segment = place.configuration(q);
    // integrate normalises, so its result depends on u/|u|. Twice the budget, for the rounding of |u|^2.
    const bool unit = isNormalized(place.joint, segment, S(S(2) * normDefectBudget<S>()));
    place.coefficientJacobian(J) =
        place.joint.integrateCoeffWiseJacobian(unit ? segment : place.joint.normalized(segment));
  });
  return J;
}

/// Returns q [nq]. Throws InvalidConfiguration unless q is finite and every quaternion and (cos, sin) has
/// unit norm up to normDefectBudget. If q was rounded, for example in a text file, normalise it first.
template <Scalar S>
VectorX<S> checkedConfiguration(const Model<S>& model, In<S> q) {
  configuration_detail::checkConfiguration<S>(model, q, "q");
  configuration_detail::forEachJoint(model, [&](const auto& place) {
    refuseZero(place, q, "q");
    refuseOffUnit(place, q, normDefectBudget<S>());
  });
  return q;
}

/// Returns v [nv]. Throws InvalidConfiguration unless v is finite.
template <Scalar S>
VectorX<S> checkedTangent(const Model<S>& model, In<S> v) {
  configuration_detail::checkTangent<S>(model, v, "v");
  return v;
}

// instantiations.cpp instantiates these for float and double.
extern template decltype(neutral<float>) neutral<float>;
extern template decltype(normalized<float>) normalized<float>;
extern template VectorX<float> integrate<float>(const Model<float>&, In<float>, In<float>);
extern template VectorX<float> difference<float>(const Model<float>&, In<float>, In<float>);
extern template decltype(isSameConfiguration<float>) isSameConfiguration<float>;
extern template decltype(isNormalized<float>) isNormalized<float>;
extern template decltype(squaredDistance<float>) squaredDistance<float>;
extern template decltype(dIntegrate<float>) dIntegrate<float>;
extern template decltype(dDifference<float>) dDifference<float>;
extern template decltype(integrateCoeffWiseJacobian<float>) integrateCoeffWiseJacobian<float>;

extern template decltype(neutral<double>) neutral<double>;
extern template decltype(normalized<double>) normalized<double>;
extern template VectorX<double> integrate<double>(const Model<double>&, In<double>, In<double>);
extern template VectorX<double> difference<double>(const Model<double>&, In<double>, In<double>);
extern template decltype(isSameConfiguration<double>) isSameConfiguration<double>;
extern template decltype(isNormalized<double>) isNormalized<double>;
extern template decltype(squaredDistance<double>) squaredDistance<double>;
extern template decltype(dIntegrate<double>) dIntegrate<double>;
extern template decltype(dDifference<double>) dDifference<double>;
extern template decltype(integrateCoeffWiseJacobian<double>) integrateCoeffWiseJacobian<double>;

}  // namespace liecheck
