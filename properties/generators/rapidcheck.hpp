#pragma once
// RapidCheck generators for the tests of other projects. They produce the angles, scales and axes at which
// code breaks, and shrink to short numbers. RapidCheck's own floating-point generators and shrinkers are weak
// (its issues 134 and 139).
//
//   rc::check("log is the inverse of exp", [] {
//     const auto xi = *liecheck::properties::gen::twist<double>(AngleRange::to_pi);
//     RC_ASSERT((log6(exp6(xi)) - xi).norm() <= 8e-16 * xi.norm());
//   });
//
// The file is header-only and needs Eigen, Boost's headers and RapidCheck (CMake: liecheck_generators).

#include <rapidcheck.h>

#include <generators/rotations.hpp>
#include <generators/shrinks.hpp>

namespace liecheck::properties::gen {

namespace detail {

/// All inputs in which one group of x is replaced by a simpler group.
template <class S>
std::vector<std::vector<S>> simpler(const std::vector<S>& x, const std::vector<Field>& fields) {
  std::vector<std::vector<S>> all;
  auto from = x.begin();
  for (const Field& f : fields) {
    const std::vector<S> group(from, from + f.size);
    for (const auto& candidate : shrinks::candidates<S>(group, f.kind)) {
      if (candidate == group) break;  // the following candidates are not simpler
      all.push_back(x);
      std::copy(candidate.begin(), candidate.end(), all.back().begin() + (from - x.begin()));
    }
    from += f.size;
  }
  return all;
}

/// Stops after `depth` shrinking steps: rounding can turn a simpler value back into an earlier one.
template <class S>
rc::Shrinkable<std::vector<S>> shrinkable(const std::vector<S>& x, const std::vector<Field>& fields,
                                          int depth) {
  if (depth == 0) return rc::shrinkable::just(x);
  return rc::shrinkable::shrink(rc::fn::constant(x), [fields, depth](const std::vector<S>& value) {
    return rc::seq::map(
        rc::seq::fromContainer(simpler(value, fields)),
        [fields, depth](const std::vector<S>& c) { return shrinkable<S>(c, fields, depth - 1); });
  });
}

/// `make` writes the groups of numbers; `read` converts them to the type that the test uses.
template <class S, class Make, class Read>
auto generator(std::vector<Field> fields, Make make, Read read) {
  const rc::Gen<std::vector<S>> numbers([fields, make](const rc::Random& random, int) {
    rc::Random r = random;
    Source source({r.next(), r.next(), r.next(), r.next()});
    std::vector<S> x;
    make(source, [&x](const auto& m) {
      for (int i = 0; i < m.rows(); ++i)
        for (int j = 0; j < m.cols(); ++j) x.push_back(m(i, j));
    });
    return shrinkable<S>(x, fields, 64);
  });
  return rc::gen::map(numbers, read);
}

template <int N, class S>
Eigen::Matrix<S, N, 1> as_vector(const std::vector<S>& x) {
  return Eigen::Map<const Eigen::Matrix<S, N, 1>>(x.data());
}
template <class S>
Eigen::Matrix<S, 3, 3> as_matrix(const std::vector<S>& x) {
  return Eigen::Map<const Eigen::Matrix<S, 3, 3, Eigen::RowMajor>>(x.data());
}

}  // namespace detail

/// Three lengths, speeds or forces: at unit scale, zero, simple, tiny or huge, up to 2^binades.
template <class S>
rc::Gen<Eigen::Matrix<S, 3, 1>> vector(int binades = widest<S>) {
  return detail::generator<S>(
      {{"x", Kind::vector, 3, ""}}, [binades](Source& s, auto&& put) { put(vector3<S>(s, binades)); },
      [](const std::vector<S>& x) { return detail::as_vector<3>(x); });
}

/// A rotation vector [rad].
template <class S>
rc::Gen<Eigen::Matrix<S, 3, 1>> rotation_vector(AngleRange range = AngleRange::unbounded) {
  return detail::generator<S>(
      {{"phi", Kind::rotation_vector, 3, "rad"}},
      [range](Source& s, auto&& put) { put(properties::rotation_vector<S>(s, range)); },
      [](const std::vector<S>& x) { return detail::as_vector<3>(x); });
}

/// (rho, phi) [m, rad]: linear part first.
template <class S>
rc::Gen<Eigen::Matrix<S, 6, 1>> twist(AngleRange range = AngleRange::unbounded, int binades = widest<S>) {
  return detail::generator<S>(
      {{"rho", Kind::vector, 3, "m"}, {"phi", Kind::rotation_vector, 3, "rad"}},
      [range, binades](Source& s, auto&& put) {
        put(vector3<S>(s, binades));
        put(properties::rotation_vector<S>(s, range));
      },
      [](const std::vector<S>& x) { return detail::as_vector<6>(x); });
}

/// A quaternion of either sign with | |Q|^2 - 1 | <= 8 eps.
template <class S>
rc::Gen<Eigen::Quaternion<S>> unit_quaternion() {
  return detail::generator<S>(
      {{"Q", Kind::quaternion, 4, ""}}, [](Source& s, auto&& put) { put(properties::unit_quaternion<S>(s)); },
      [](const std::vector<S>& x) { return Eigen::Quaternion<S>(detail::as_vector<4>(x)); });
}

/// A rotation matrix, orthogonal to a few eps.
template <class S>
rc::Gen<Eigen::Matrix<S, 3, 3>> rotation_matrix() {
  return detail::generator<S>(
      {{"R", Kind::rotation_matrix, 9, ""}},
      [](Source& s, auto&& put) { put(properties::rotation_matrix<S>(properties::unit_quaternion<S>(s))); },
      [](const std::vector<S>& x) { return detail::as_matrix(x); });
}

/// R_AB and p_AB [m].
template <class S>
rc::Gen<Eigen::Transform<S, 3, Eigen::Isometry>> pose(int binades = widest<S>) {
  return detail::generator<S>(
      {{"R", Kind::rotation_matrix, 9, ""}, {"p", Kind::vector, 3, "m"}},
      [binades](Source& s, auto&& put) {
        put(properties::rotation_matrix<S>(properties::unit_quaternion<S>(s)));
        put(vector3<S>(s, binades));
      },
      [](const std::vector<S>& x) {
        Eigen::Transform<S, 3, Eigen::Isometry> T = Eigen::Transform<S, 3, Eigen::Isometry>::Identity();
        T.matrix().template topLeftCorner<3, 3>() = detail::as_matrix(x);
        T.matrix().template topRightCorner<3, 1>() = Eigen::Map<const Eigen::Matrix<S, 3, 1>>(x.data() + 9);
        return T;
      });
}

/// A free-flyer's configuration [p; x y z w].
template <class S>
rc::Gen<Eigen::Matrix<S, 7, 1>> configuration(int binades = widest<S>) {
  return detail::generator<S>(
      {{"p", Kind::vector, 3, "m"}, {"Q", Kind::quaternion, 4, ""}},
      [binades](Source& s, auto&& put) {
        put(vector3<S>(s, binades));
        put(properties::unit_quaternion<S>(s));
      },
      [](const std::vector<S>& x) { return detail::as_vector<7>(x); });
}

}  // namespace liecheck::properties::gen
