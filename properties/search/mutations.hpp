#pragma once
// Mutations for the worst-case search: random changes of an input, by the kind of each group of numbers.
//
// The size of a step is log-uniform, because a defect may be one ulp or a decade wide. Rotations stay
// normalised up to rounding, and inertias are only scaled. The search discards an input that valid() rejects.

#include <generators/rotations.hpp>
#include <invariants/property.hpp>
#include <vector>

namespace liecheck::properties {

/// Mutations of numbers of the scalar S.
template <class S>
class TypedMutations {
 public:
  explicit TypedMutations(const std::vector<Field>& fields) {
    std::size_t from = 0;
    for (const Field& f : fields) {
      groups_.push_back({f.kind, from, static_cast<std::size_t>(f.size)});
      from += groups_.back().size;
    }
  }

  /// Changes x by one to three mutations. A group may be copied from `other`, a valid input of the same law.
  void apply(std::vector<S>& x, const std::vector<S>& other, Source& source) const {
    const int moves = source.chance(1, 2) ? 1 : source.between(2, 3);
    for (int i = 0; i < moves; ++i) {
      const Group& g = groups_[source.below(groups_.size())];
      if (source.chance(1, 24)) {
        std::copy_n(other.begin() + static_cast<long>(g.from), g.size, x.begin() + static_cast<long>(g.from));
        continue;
      }
      move(g, x, source);
    }
  }

  /// Samples as a plain test does: numbers uniform on [-1, 1), angles uniform on [0, pi] about a uniform
  /// axis. Groups of other kinds do not change.
  void uniform(std::vector<S>& x, Source& source) const {
    static const S pi = boost::math::constants::pi<S>();
    for (const Group& g : groups_) {
      const V3 n = axis(source), phi = S(pi * source.unit<S>()) * n;
      if (g.kind == Kind::rotation_vector) at3(x, g.from) = phi;
      if (g.kind == Kind::quaternion || g.kind == Kind::any_quaternion) at4(x, g.from) = quaternion(phi);
      if (g.kind == Kind::rotation_matrix) put_matrix(x, g.from, quaternion(phi));
      if (g.kind == Kind::vector)
        for (std::size_t k = 0; k < g.size; ++k) x[g.from + k] = source.symmetric<S>();
    }
  }

 private:
  using V3 = Vec<S, 3>;
  using V4 = Vec<S, 4>;
  struct Group {
    Kind kind;
    std::size_t from, size;
  };
  static constexpr int digits = std::numeric_limits<S>::digits;

  static Eigen::Map<V3> at3(std::vector<S>& x, std::size_t from) { return Eigen::Map<V3>(x.data() + from); }
  static Eigen::Map<V4> at4(std::vector<S>& x, std::size_t from) { return Eigen::Map<V4>(x.data() + from); }
  static S length(const V3& v) {
    using std::sqrt;
    const S n = v.squaredNorm();
    if (n > std::numeric_limits<S>::min() && n < std::numeric_limits<S>::max()) return S(sqrt(n));
    return v.cwiseAbs().maxCoeff();  // the norm within a factor of sqrt 3, which is enough for a step
  }

  /// +-2^-k u, with u uniform on [1/2, 1) and k uniform from 0 to the scalar's digits.
  static S step(Source& s) {
    using std::ldexp;
    const int k = s.between(0, digits);
    const S size = S(ldexp(S(1) + s.unit<S>(), -1 - k));
    return s.chance(1, 2) ? size : S(-size);
  }
  /// A step, relative to the size, along an axis.
  static V3 along_axis(Source& s, const S& size) {
    const V3 n = axis(s);
    return S(step(s) * size) * n;
  }
  /// 1 + step or, with probability 1/4, a factor between 2^-8 and 2^8.
  static S factor(Source& s) {
    using std::ldexp;
    if (!s.chance(1, 4)) return S(S(1) + step(s));
    const int k = s.between(-8, 7);
    return S(ldexp(S(1) + s.unit<S>(), k));
  }
  static int ulps(Source& s) {
    const int k = 1 << s.between(0, 10);
    return s.chance(1, 2) ? k : -k;
  }
  /// A uniformly distributed direction, normalised up to rounding.
  static V3 axis(Source& s) {
    V3 v = V3::UnitX();
    for (int attempt = 0; attempt < 32; ++attempt) {
      v << s.symmetric<S>(), s.symmetric<S>(), s.symmetric<S>();
      const S n = v.squaredNorm();
      if (n <= S(1) && n > S(1) / S(64)) break;
    }
    return v / length(v);
  }
  /// The quaternion of phi. sin and cos depend on the C library's rounding, so only `uniform` uses this.
  static V4 quaternion(const V3& phi) {
    using std::cos, std::sin;
    const S half = length(phi) / S(2);
    V4 q;
    q << (half > S(0) ? V3(S(sin(half)) / (S(2) * half) * phi) : V3(V3::Zero())), S(cos(half));
    return q;
  }
  static V4 conjugate(V4 q) {
    q.template head<3>() = V3(-q.template head<3>());
    return q;
  }
  static V4 unit(const V4& q) {
    using std::sqrt;
    const S n = q.squaredNorm();
    return n > std::numeric_limits<S>::min() ? V4(q / S(sqrt(n))) : V4(V4::Unit(3));
  }

  void move(const Group& g, std::vector<S>& x, Source& s) const {
    switch (g.kind) {
      case Kind::vector:
      case Kind::rotation_vector:
        if (g.size == 3) return move_vector(g, x, s);
        x[g.from + s.below(g.size)] *= factor(s);
        return;
      case Kind::quaternion:
        at4(x, g.from) = moved(at4(x, g.from), g.from, x, s);
        return;
      case Kind::any_quaternion:
        return move_any(at4(x, g.from), g.from, x, s);
      case Kind::rotation_matrix:
        if (s.chance(1, 4)) {
          S& entry = x[g.from + s.below(9)];
          entry = step_ulps(entry, s.between(-2, 2));
        } else {
          put_matrix(x, g.from, moved(of_matrix(x, g.from), g.from, x, s));
        }
        return;
      case Kind::direction: {
        V3 v = V3::Zero();
        if (g.size == 3)
          move_vector(g, x, s);
        else
          x[g.from + s.below(g.size)] *= factor(s);
        for (std::size_t k = 0; k < g.size; ++k) v[static_cast<int>(k)] = x[g.from + k];
        if (const S n = length(v); n > S(0))
          for (std::size_t k = 0; k < g.size; ++k) x[g.from + k] /= n;
        return;
      }
      case Kind::fraction: {
        S& t = x[g.from];
        t = s.chance(1, 4) ? S(S(1) - t) : s.chance(1, 4) ? step_ulps(t, s.between(-2, 2)) : S(t * factor(s));
        if (!(t >= S(0) && t <= S(1))) t = s.unit<S>();
        return;
      }
      case Kind::angle: {
        S& angle = x[g.from + s.below(g.size)];
        static const S quarter = boost::math::constants::half_pi<S>();
        if (s.chance(1, 3))  // beside a multiple of pi/2
          angle = S(s.between(-2, 2)) * quarter + S(step(s) * step(s));
        else
          angle = s.chance(1, 4) ? S(-angle) : S(angle * factor(s));
        if (!(angle >= S(-2) * quarter && angle <= S(2) * quarter)) angle = S(2) * quarter * s.symmetric<S>();
        return;
      }
      case Kind::near_rotation:
        x[g.from + s.below(9)] += step(s);
        return;
      case Kind::covariance: {  // scales a row and a column
        const std::size_t k = s.below(6);
        const S f = factor(s);
        for (std::size_t i = 0; i < 6; ++i) x[g.from + 6 * k + i] *= f, x[g.from + 6 * i + k] *= f;
        return;
      }
      case Kind::inertia:
      case Kind::positive:
      case Kind::masses: {  // scales one of several masses
        const S f = g.kind == Kind::inertia ? S(factor(s) * factor(s)) : factor(s);
        if (!(f > S(0))) return;
        const std::size_t first = g.kind == Kind::masses ? s.below(g.size) : 0;
        const std::size_t last = g.kind == Kind::masses ? first + 1 : g.size;
        for (std::size_t k = first; k < last; ++k) x[g.from + k] *= f;
        return;
      }
      default:;  // other kinds are only copied from `other`
    }
  }

  void move_vector(const Group& g, std::vector<S>& x, Source& s) const {
    auto v = at3(x, g.from);
    const int i = static_cast<int>(s.below(3));
    const S n = length(v);
    switch (s.below(9)) {
      case 0:
      case 1:  // changes only the length
        v *= factor(s);
        return;
      case 2:  // changes one component
        v[i] = step_ulps(S(v[i]), ulps(s));
        return;
      case 3:
        v[i] *= factor(s);
        return;
      case 4:  // changes the direction
        v += along_axis(s, n);
        if (length(v) > S(0) && s.chance(1, 2)) v *= n / length(v);
        return;
      case 5:  // projects onto a coordinate plane or an axis
        if (s.chance(1, 2))
          v[i] = S(0);
        else
          v = V3(n * V3::Unit(i));
        return;
      case 6:
        if (g.kind == Kind::rotation_vector && n > S(0)) {  // next to a cutoff
          const auto& cutoffs = common_cutoffs<S>();
          const int steps = s.between(-4, 4);
          v *= step_ulps(cutoffs[s.below(cutoffs.size())], steps) / n;
          if (s.chance(1, 2)) v *= S(1) + step(s);
        } else {
          v[i] = -v[i];
        }
        return;
      default:
        relate(g, v, n, x, s);
    }
  }

  /// Makes v equal, nearly parallel, opposite or perpendicular to another vector of the input, which may be
  /// rotated by a quaternion of the input first. Translations cancel in such cases.
  void relate(const Group& g, Eigen::Map<V3>& v, const S& n, std::vector<S>& x, Source& s) const {
    const Group& o = groups_[s.below(groups_.size())];
    if (o.size != 3 || o.from == g.from) return;
    V3 w = at3(x, o.from);
    const Group& q = groups_[s.below(groups_.size())];
    if (q.kind == Kind::quaternion && s.chance(1, 2)) {
      const V4 Q = at4(x, q.from);
      w = rotation_matrix<S>(s.chance(1, 2) ? Q : conjugate(Q)) * w;
    }
    const S m = length(w);
    if (!(m > S(0))) return;
    if (s.chance(1, 2)) w = -w;
    if (s.chance(1, 3)) {
      w = V3(w.cross(axis(s)));
    } else if (s.chance(1, 2)) {
      w += along_axis(s, m);
    }
    v = s.chance(1, 2) && g.kind == Kind::vector && o.kind == Kind::vector ? w : V3(S(n / m) * w);
  }

  /// Moves a rotation relative to the identity or to another quaternion of the input.
  V4 moved(const V4& q, std::size_t from, std::vector<S>& x, Source& s) const {
    V4 base = V4::Unit(3), d = q;
    const Group& o = groups_[s.below(groups_.size())];
    const bool any = o.kind == Kind::any_quaternion;
    if ((any || o.kind == Kind::quaternion) && o.from != from && s.chance(3, 4)) {
      base = at4(x, o.from);
      if (any && base.cwiseAbs().maxCoeff() > S(0)) base = unit(V4(base / base.cwiseAbs().maxCoeff()));
      d = quaternion_product<S>(conjugate(base), q);
    }
    const int i = static_cast<int>(s.below(4));
    switch (s.below(6)) {
      case 0:  // the angle
      case 1:
        d.template head<3>() *= factor(s);
        break;
      case 2:  // the distance of the angle from pi
        d[3] *= factor(s);
        break;
      case 3:
        d.template head<3>() += along_axis(s, length(d.template head<3>()));
        break;
      case 4: {  // one component, to the last bit
        V4 p = q;
        p[i] = step_ulps(S(p[i]), s.chance(1, 2) ? ulps(s) : s.between(-2, 2));
        return p;
      }
      default:
        if (s.chance(1, 2)) return -q;
        d[i] = S(0);
    }
    return unit(quaternion_product<S>(base, unit(d)));
  }

  /// Changes the norm, one component or the rotation of Q/|Q|.
  void move_any(Eigen::Map<V4> q, std::size_t from, std::vector<S>& x, Source& s) const {
    using std::sqrt;
    if (s.chance(1, 3)) {
      q *= s.chance(1, 4) ? quaternion_norm<S>(s) : factor(s);
    } else if (s.chance(1, 3)) {
      const int i = static_cast<int>(s.below(4));
      q[i] = step_ulps(S(q[i]), ulps(s));
    } else {
      const S size = q.cwiseAbs().maxCoeff();
      if (!(size > S(0))) return;
      const V4 u = V4(q / size);
      const S norm = S(sqrt(u.squaredNorm()));
      q = V4(S(size * norm) * moved(unit(u), from, x, s));
    }
  }

  static void put_matrix(std::vector<S>& x, std::size_t from, const V4& q) {
    const Mat<S, 3> R = rotation_matrix<S>(q);
    for (std::size_t k = 0; k < 9; ++k) x[from + k] = R(static_cast<int>(k / 3), static_cast<int>(k % 3));
  }
  /// The quaternion of a matrix, by its largest pivot.
  static V4 of_matrix(const std::vector<S>& x, std::size_t from) {
    const auto R = [&](int i, int j) { return x[from + static_cast<std::size_t>(3 * i + j)]; };
    const S t = R(0, 0) + R(1, 1) + R(2, 2);
    V4 q;
    int best = 3;
    S pivot = t;
    for (int i = 0; i < 3; ++i)
      if (R(i, i) > pivot) best = i, pivot = R(i, i);
    if (best == 3) {
      q << R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1), S(1) + t;
    } else {
      const int i = best, j = (i + 1) % 3, k = (i + 2) % 3;
      q[i] = S(1) + S(2) * pivot - t;
      q[j] = R(i, j) + R(j, i);
      q[k] = R(i, k) + R(k, i);
      q[3] = R(k, j) - R(j, k);
    }
    return unit(q);
  }

  std::vector<Group> groups_;
};

/// The same for numbers of a scalar, as doubles.
class Mutations {
 public:
  Mutations(const std::vector<Field>& fields, const oracles::Scalar& scalar)
      : scalar_(scalar), in_float_(fields), in_double_(fields) {}
  void apply(std::vector<double>& x, const std::vector<double>& other, Source& source) const {
    changed(x, [&]<class S>(const auto& mutations, std::vector<S>& numbers) {
      mutations.apply(numbers, oracles::numbers_in<S>(other), source);
    });
  }
  void uniform(std::vector<double>& x, Source& source) const {
    changed(x, [&]<class S>(const auto& mutations, std::vector<S>& numbers) {
      mutations.uniform(numbers, source);
    });
  }

 private:
  template <class F>
  void changed(std::vector<double>& x, const F& change) const {
    scalar_.with([&]<class S>() {
      std::vector<S> numbers = oracles::numbers_in<S>(x);
      if constexpr (std::is_same_v<S, float>)
        change(in_float_, numbers);
      else
        change(in_double_, numbers);
      x = oracles::as_doubles(numbers);
    });
  }
  const oracles::Scalar& scalar_;
  TypedMutations<float> in_float_;
  TypedMutations<double> in_double_;
};

}  // namespace liecheck::properties
