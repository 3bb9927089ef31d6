#pragma once
// The second formulation of scenes without a closed form: maximal coordinates and laws of forces in the
// world's axes (oracles/motions/maximal_tree.hpp, force_laws.hpp). It shares with lib the description of the
// scene, and nothing else.

#include <atomic>
#include <boost/multiprecision/float128.hpp>
#include <oracles/motions/maximal_motion.hpp>
#include <scenes/benchmark.hpp>

namespace liecheck::properties {

using float128 = boost::multiprecision::float128;

/// The names of the effects and actuations that it knows.
std::vector<std::string> independent_laws();

/// A part of an effect that it does not know, and why.
struct Unconfirmed {
  std::string effect, part, why;
};
const std::vector<Unconfirmed>& unconfirmed_parts();

/// The scene in maximal coordinates. One law for each effect that is a force, in the order of the scene.
/// Throws std::invalid_argument for an effect, a part of one or a joint that it does not know.
template <class T>
oracles::MaximalTree<T> independent_tree(const Benchmark& scene);

/// The states at the start and after each of `parts` equal parts of the duration.
template <class T>
std::vector<Moment> moments_of(oracles::MaximalTree<T> tree, const Benchmark& scene, long parts,
                               const T& tolerance, const std::atomic<bool>* stop = nullptr);

// For long double (64 bits) and float128, in independent.cpp.
extern template oracles::MaximalTree<long double> independent_tree(const Benchmark&);
extern template oracles::MaximalTree<float128> independent_tree(const Benchmark&);
extern template std::vector<Moment> moments_of(oracles::MaximalTree<long double>, const Benchmark&, long,
                                               const long double&, const std::atomic<bool>*);
extern template std::vector<Moment> moments_of(oracles::MaximalTree<float128>, const Benchmark&, long,
                                               const float128&, const std::atomic<bool>*);

}  // namespace liecheck::properties
