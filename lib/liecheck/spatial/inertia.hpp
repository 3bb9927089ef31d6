#pragma once
// Inertia: a rigid body's mass m [kg], centre of mass c = p_BoBcm_B [m] and inertia I_C about the centre of
// mass in the axes of B [kg m^2].
//
//   I_O = I_C + m (|c|^2 I - c c^T)          momentum: f = m (u + omega x c),  n = I_C omega + c x f
//   6 x 6 about the origin of B:  [ m I    -m [c] ]
//                                 [ m [c]   I_O   ]        Featherstone (2008), eq. 2.63, linear part first

#include <Eigen/Eigenvalues>
#include <liecheck/spatial/force.hpp>
#include <liecheck/spatial/motion.hpp>
#include <liecheck/spatial/symmetric3.hpp>
#include <sstream>
#include <string>

namespace liecheck {

template <Scalar S>
class Inertia {
 public:
  /// Uninitialised: NaN in debug.
  Inertia() {
    mark_uninitialised(lever_);
    mark_uninitialised(inertia_);
  }
  /// mass [kg], lever = centre of mass [3, m], inertia about the centre of mass [3 x 3, kg m^2], symmetric.
  Inertia(const S& mass, const Vector3<S>& lever, const Matrix3<S>& inertia)
      : mass_(mass), lever_(lever), inertia_(inertia) {}

  static Inertia Zero() { return Inertia(S(0), Vector3<S>::Zero(), Matrix3<S>::Zero()); }

  const S& mass() const { return mass_; }
  const Vector3<S>& lever() const { return lever_; }
  const Matrix3<S>& inertia() const { return inertia_; }

  /// I_O = I_C + m (|c|^2 I - c c^T). Each diagonal entry is a sum of squares: no cancellation. Error 3 eps.
  Matrix3<S> inertiaAboutOrigin() const {
    const Vector3<S> c = lever_, mc = mass_ * lever_;
    Matrix3<S> m = inertia_;
    m(0, 0) += mc.y() * c.y() + mc.z() * c.z();
    m(1, 1) += mc.x() * c.x() + mc.z() * c.z();
    m(2, 2) += mc.x() * c.x() + mc.y() * c.y();
    m(0, 1) = m(1, 0) = inertia_(0, 1) - mc.x() * c.y();
    m(0, 2) = m(2, 0) = inertia_(0, 2) - mc.x() * c.z();
    m(1, 2) = m(2, 1) = inertia_(1, 2) - mc.y() * c.z();
    return m;
  }

  /// The 6 x 6 matrix about the origin, linear part first.
  Matrix6<S> matrix() const {
    Matrix6<S> M;
    const Matrix3<S> mc = skew<S>(mass_ * lever_);
    M.template topLeftCorner<3, 3>() = mass_ * Matrix3<S>::Identity();
    M.template topRightCorner<3, 3>() = -mc;
    M.template bottomLeftCorner<3, 3>() = mc;
    M.template bottomRightCorner<3, 3>() = inertiaAboutOrigin();
    return M;
  }

  /// Momentum about the origin [kg m/s, kg m^2/s]. Error 4 eps of the sum of absolute values of its terms.
  Force<S> operator*(const Motion<S>& V) const {
    const Vector3<S> f = mass_ * (V.linear() + cross<S>(V.angular(), lever_));
    return {f, Vector3<S>(inertia_ * V.angular()) + cross<S>(lever_, f)};
  }

  /// Kinetic energy 1/2 V^T I V = 1/2 m |u + omega x c|^2 + 1/2 omega^T I_C omega [J].
  S kineticEnergy(const Motion<S>& V) const {
    const Vector3<S> u_C = V.linear() + cross<S>(V.angular(), lever_);
    const S rotational = V.angular().dot(Vector3<S>(inertia_ * V.angular()));
    return (mass_ * u_C.squaredNorm() + rotational) / S(2);
  }

  /// The inertia of two rigidly joined bodies, in the same frame:
  /// c = (m1 c1 + m2 c2)/m,  I_C = I1 + I2 + (m1 m2/m)(|d|^2 I - d d^T), d = c1 - c2 (parallel-axis theorem).
  [[gnu::always_inline]] Inertia operator+(const Inertia& o) const {
    const S mass = mass_ + o.mass_;
    if (mass == S(0)) [[unlikely]]
      return Inertia(S(0), Vector3<S>::Zero(), Matrix3<S>(inertia_ + o.inertia_));
    const Vector3<S>&a = lever_, &b = o.lever_;
    const Simd<S, 2> share = Simd<S, 2>(mass_, o.mass_) / Simd<S, 2>(mass);
    const S s = share.v[0], t = share.v[1], reduced = s * o.mass_;
    const Vector3<S> c = each<S>([&](int i) { return mul_add(s, a[i], S(t * b[i])); });
    const S x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    const S mx = reduced * x, my = reduced * y, mz = reduced * z;
    const auto sum = [&](int i, int j) __attribute__((always_inline)) {
      return S(inertia_(i, j) + o.inertia_(i, j));
    };
    const S xy = sum(0, 1) - mx * y, xz = sum(0, 2) - mx * z, yz = sum(1, 2) - my * z;
    const S xx = sum(0, 0) + (my * y + mz * z), yy = sum(1, 1) + (mx * x + mz * z),
            zz = sum(2, 2) + (mx * x + my * y);
    return Inertia(mass, c, rows<S>(xx, xy, xz, xy, yy, yz, xz, yz, zz));
  }

  /// True if a real body can have this inertia: its mass is > 0 and whyUnphysical finds nothing.
  bool isValid() const;

 private:
  S mass_ = std::numeric_limits<S>::quiet_NaN();
  Vector3<S> lever_;
  Matrix3<S> inertia_;
};

/// The pseudo-inertia J [4 x 4] = [Sigma, m c; m c^T, m], Sigma = 1/2 tr(I_O) 1 - I_O [kg m^2]: the second
/// moments of the mass in homogeneous coordinates. J >= 0 if and only if a body of density >= 0 can have the
/// inertia. Wensing, Kim & Slotine (2018), eq. 12. To avoid cancellation, Sigma is computed as
/// 1/2 tr(I_C) 1 - I_C + m c c^T.
template <Scalar S>
Eigen::Matrix<S, 4, 4> pseudoInertia(const Inertia<S>& I) {
  const Vector3<S> mc = I.mass() * I.lever();
  Matrix3<S> Sigma = mc * I.lever().transpose() - I.inertia();
  Sigma.diagonal().array() += S(I.inertia().trace() / S(2));
  Eigen::Matrix<S, 4, 4> J;
  J << Sigma, mc, mc.transpose(), I.mass();
  return J;
}

namespace inertia_detail {
template <class... Numbers>
std::string say(const char* what, const Numbers&... values) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << what;
  ((text << ' ' << double(values)), ...);
  return text.str();
}
}  // namespace inertia_detail

/// The reason why the numbers are no inertia, or an empty string: one is not finite, the mass is negative, or
/// I_C is not symmetric up to relative_slack times its largest entry.
template <Scalar S>
std::string whyInvalid(const Inertia<S>& I, const S& relative_slack = S(16) * eps<S>()) {
  using inertia_detail::say;
  const Matrix3<S>& I_C = I.inertia();
  const Vector3<S>& c = I.lever();
  if (!finite<S>(I.mass())) return say("the mass is not finite:", I.mass());
  if (!c.allFinite()) return say("the centre of mass is not finite:", c[0], c[1], c[2]);
  for (int i = 0; i < 9; ++i)
    if (!finite<S>(I_C.data()[i])) return say("a number of the inertia is not finite:", I_C.data()[i]);
  if (I.mass() < S(0)) return say("the mass is negative:", I.mass());
  const S slack = relative_slack * S(I_C.cwiseAbs().maxCoeff());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j)
      if (!(absolute<S>(S(I_C(i, j) - I_C(j, i))) <= slack))
        return say("the inertia is not symmetric: two products of inertia are", I_C(i, j), I_C(j, i));
  return {};
}

/// The reason why no body can have the inertia, or an empty string if one can. Reasons are those of
/// whyInvalid, a negative principal moment, or one larger than the sum of the other two. The checks of I_C
/// tolerate errors of relative_slack times its largest entry. The default covers the rounding errors of the
/// eigenvalues; numbers printed with n digits need about 10^(1-n). A massless point is valid.
template <Scalar S>
std::string whyUnphysical(const Inertia<S>& I, const S& relative_slack = S(16) * eps<S>()) {
  const std::string invalid = whyInvalid(I, relative_slack);
  if (!invalid.empty()) return invalid;
  using inertia_detail::say;
  const S scale = I.inertia().cwiseAbs().maxCoeff(), slack = relative_slack * scale;
  if (scale == S(0)) return {};
  const Eigen::SelfAdjointEigenSolver<Matrix3<S>> solver(I.inertia() / scale, Eigen::EigenvaluesOnly);
  const Vector3<S> m = solver.eigenvalues() * scale;
  if (!(m[0] >= -slack)) return say("a principal moment of inertia is negative:", m[0], m[1], m[2]);
  if (!(m[2] <= m[0] + m[1] + slack))
    return say("a principal moment of inertia is larger than the sum of the other two:", m[0], m[1], m[2]);
  return {};
}

template <Scalar S>
bool Inertia<S>::isValid() const {
  return mass_ > S(0) && whyUnphysical(*this).empty();
}

}  // namespace liecheck
