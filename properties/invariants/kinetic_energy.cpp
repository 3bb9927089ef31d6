// Kinetic energy does not depend on the frame. The operations on inertias that compute it are measured too.

#include <invariants/common.hpp>

#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#include <generators/rotations.hpp>

namespace liecheck::properties {
namespace {

class KineticEnergy final : public Law<KineticEnergy> {
 public:
  static constexpr Statement stated{
      .name = "kinetic_energy",
      .law = "the kinetic energy of a body is the same in every frame",
      .equation =
          "V_A^T M_A V_A / 2 = V_B^T M_B V_B / 2 = m |u_C|^2 / 2 + w^T I_C w / 2, u_C = u + w x c; "
          "scale m s^2 + |I_C| |w|^2 / 2, s = |u| + |w| (|c| + 2 |p|)",
      .source = "Featherstone 2008, eqs. 2.62-2.67, sections 2.13, 2.14",
      .outputs = {op::kinetic_energy[block::energy], op::momentum[block::linear],
                  op::momentum[block::angular], op::inertia_matrix[block::matrix],
                  op::act_inertia[block::mass], op::act_inertia[block::lever],
                  op::act_inertia[block::inertia], op::act_inverse_inertia[block::mass],
                  op::act_inverse_inertia[block::lever], op::act_inverse_inertia[block::inertia],
                  op::energy_frames[block::energy]},
      .fields = {{"R", Kind::rotation_matrix, 9, "1"},
                 {"p", Kind::vector, 3, "m"},
                 {"mass", Kind::positive, 1, "kg"},
                 {"c", Kind::vector, 3, "m"},
                 {"I_C", Kind::inertia, 6, "kg m^2"},  // xx xy yy xz yz zz
                 {"u", Kind::vector, 3, "m/s"},
                 {"omega", Kind::vector, 3, "rad/s"}},
      .formed = {{&op::energy_frames, {&op::kinetic_energy, &op::act_inertia, &op::act_motion}}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    std::vector<S> input;
    append(input, rotation_matrix<S>(unit_quaternion<S>(source)));
    const std::uint64_t extreme = source.below(32);
    const int binades = extreme <= 1 ? 2 : std::numeric_limits<S>::max_exponent / 8;
    append(input, vector3<S>(source, binades));
    const S mass =
        source.chance(1, 2) ? S(source.between(1, 16)) : binade_uniform<S>(source, -binades, binades);
    input.push_back(mass);
    append(input, vector3<S>(source, binades));
    const Mat<S, 3> I = inertia<S>(source, mass, binades);
    for (const auto& [i, j] : unique) input.push_back(I(i, j));
    append(input, vector3<S>(source, binades));
    append(input, vector3<S>(source, binades));
    // Units in which velocities, or lengths, are very small or large, but energies are not. The energy contains
    // squares of the sizes, so these are at most the root of the largest number.
    if (extreme <= 1) {
      const int most = (std::numeric_limits<S>::max_exponent - 32) / 2, e = source.between(-most, most);
      if (extreme == 0)
        scale(input, {{12, 1, -2 * e}, {16, 6, -2 * e}, {22, 6, e}});
      else
        scale(input, {{9, 3, e}, {12, 1, -2 * e}, {13, 3, e}, {22, 3, e}});
    }
    return input;
  }

  /// R must be near a rotation, m > 0, and I_C that of a physical body: its second moment tr(I_C) / 2 - I_C
  /// is positive semidefinite, up to the rounding of I_C. The products of the law are finite.
  bool valid(const std::vector<double>& input) const override {
    if (!oracles::all_finite(input)) return false;
    using oracles::Real;
    const Case<Real> x(input);
    const Real m = x.I_e.mass, c = norm(x.I_e.c), p = norm(x.X_e.p), u = norm(head3(x.V_e)),
               w = norm(tail3(x.V_e)), moment = norm(x.I_e.I_C), lever = c + 2 * p, s = u + w * lever;
    const Real largest = oracles::two_to<Real>(scalar().max_exponent - 8);
    for (const Real& product :
         {m, Real(lever * lever), Real(s * s), Real(w * w), Real(m * lever), Real(m * lever * lever),
          Real(m * s), Real(m * s * lever), Real(m * s * s), moment, Real(moment * w), Real(moment * w * w)})
      if (product > largest) return false;
    const Real eps32 = 32 * scalar().epsilon;
    const auto& R = x.X_e.R;
    const auto& I = x.I_e.I_C;
    const Real trace = I(0, 0) + I(1, 1) + I(2, 2);
    if (!(x.I.mass > 0) || trace < 0) return false;
    using oracles::Real100;  // the determinant of a needle is only eps^2 times its terms
    oracles::Mat3<Real100> second = Real100(-1) * oracles::cast<Real100>(I);
    for (int i = 0; i < 3; ++i) second(i, i) += Real100(trace) / 2 + Real100(eps32) * Real100(trace);
    const auto C = cofactors(second);
    return oracles::orthogonality_distance(R) <= eps32 && determinant(R, cofactors(R)) > 0 &&
           second(0, 0) >= 0 && C(2, 2) >= 0 && determinant(second, C) >= 0;
  }

  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& recorder) const {
    const auto& o = subject.operations;
    const Case<Real> x(input);
    // The terms of a body whose inertia is about its origin or about its centre of mass: s bounds the speeds
    // u, w x c and their sum. A speed or its square loses digits below `least`, before it is multiplied by m.
    const Real least(recorder.scalar().least_denominator());
    const Real c = norm(x.I_e.c), w = norm(tail3(x.V_e)), s = norm(head3(x.V_e)) + w * c;
    const Real mass_terms = x.I_e.mass * (s + least), spin_terms = norm(x.I_e.I_C) * w;

    if (o[op::kinetic_energy]) {
      const Vec<double, 1> E(o[op::kinetic_energy](x.I, x.V));
      const oracles::Resolved<Real> exact = oracles::kinetic_energy(x.I_e, x.V_e);
      record_sum(recorder, op::kinetic_energy[block::energy], E, oracles::Vec<1, Real>{{exact.value}},
                 exact.resolved, Real((x.I_e.mass * (s * s + least) + spin_terms * w) / Real(2)));
    }
    if (o[op::momentum]) {
      const Vec<double, 6> h = o[op::momentum](x.I, x.V);
      const oracles::Resolved<oracles::Vec6<Real>> exact = oracles::momentum(x.I_e, x.V_e);
      record_sum(recorder, op::momentum[block::linear], Vec<double, 3>(h.head<3>()), head3(exact.value),
                 exact.resolved, mass_terms);
      record_sum(recorder, op::momentum[block::angular], Vec<double, 3>(h.tail<3>()), tail3(exact.value),
                 exact.resolved, Real(spin_terms + c * mass_terms));
    }
    if (o[op::inertia_matrix])
      measure_matrix(recorder, o[op::inertia_matrix](x.I), oracles::inertia_matrix(x.I_e));
    if (o[op::act_inertia])
      measure_body<op::act_inertia>(recorder, o[op::act_inertia](x.X, x.I),
                                    oracles::act_inertia(x.X_e, x.I_e), x);
    if (o[op::act_inverse_inertia])
      measure_body<op::act_inverse_inertia>(recorder, o[op::act_inverse_inertia](x.X, x.I),
                                            oracles::act_inverse_inertia(x.X_e, x.I_e), x);
    if (o[op::kinetic_energy] && o[op::act_inertia] && o[op::act_motion]) {
      const Vec<double, 2> T(o[op::kinetic_energy](o[op::act_inertia](x.X, x.I), o[op::act_motion](x.X, x.V)),
                             o[op::kinetic_energy](x.I, x.V));
      if (!comparable(recorder, op::energy_frames[block::energy], T, true)) return;
      const auto T_e = oracles::exact_vector<2, Real>(T);
      const Real speed = s + Real(2) * w * norm(x.X_e.p);
      const Real scale = x.I_e.mass * speed * speed + spin_terms * w / Real(2);
      // The error is relative to `scale`, because T_B is a result of the subject and not an exact value.
      const Real size = oracles::larger(scale, Real(recorder.scalar().least_denominator()));
      recorder.record(op::energy_frames[block::energy], 0,
                      oracles::in_eps(recorder.scalar(), Real(abs(T_e[0] - T_e[1]) / size)), one);
    }
  }

 private:
  static constexpr auto one = [] { return 1.0; };
  static constexpr std::pair<int, int> unique[] = {{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}};

  template <class Real>
  struct Case {
    explicit Case(const std::vector<double>& input) {
      Reader reader(input);
      X = reader.take_pose();
      I.mass = reader.take<1>()[0];
      I.c = reader.take<3>();
      for (const auto& [i, j] : unique) I.I_C(i, j) = I.I_C(j, i) = reader.take<1>()[0];
      V = reader.take<6>();
      X_e = exact_pose<Real>(X);
      I_e = {oracles::exact<Real>(I.mass), oracles::exact_vector<3, Real>(I.c),
             oracles::exact_matrix<3, 3, Real>(I.I_C)};
      V_e = oracles::exact_vector<6, Real>(V);
    }
    Pose<double> X;
    Body<double> I;
    Vec<double, 6> V;
    oracles::PoseOf<Real> X_e;
    oracles::BodyOf<Real> I_e;
    oracles::Vec6<Real> V_e;
  };

  /// Adds m (|r|^2 - r r^T), the inertia of a point mass. Every sum of these belongs to a physical body.
  template <class S>
  static void add_point(Mat<S, 3>& I, const S& mass, const Vec<S, 3>& r) {
    const S xx = r[0] * r[0], yy = r[1] * r[1], zz = r[2] * r[2];
    I(0, 0) += mass * S(yy + zz);
    I(1, 1) += mass * S(xx + zz);
    I(2, 2) += mass * S(xx + yy);
    for (const auto& [i, j] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      I(i, j) -= mass * S(r[i] * r[j]);
      I(j, i) = I(i, j);
    }
  }
  /// A random inertia, from radii of gyration about the principal axes or from a cloud of 3 to 5 points.
  template <class S>
  static Mat<S, 3> inertia(Source& source, const S& mass, int binades) {
    Mat<S, 3> I = Mat<S, 3>::Zero();
    const auto length = [&source, binades] {
      return source.chance(1, 2) ? S(source.unit<S>()) : binade_uniform<S>(source, -binades, binades);
    };
    Vec<S, 3> a = Vec<S, 3>::Zero();  // radii of gyration
    switch (source.below(9)) {
      case 0:  // a point mass
        return I;
      case 1:  // a homogeneous sphere
        a[0] = a[1] = a[2] = length();
        break;
      case 2:  // a needle
        a[source.below(3)] = length();
        break;
      case 3:  // a plate
        a << length(), length(), S(0);
        break;
      case 4: {  // nearly a needle
        const S l = length();
        a << l, l * binade_uniform<S>(source, -std::numeric_limits<S>::digits, -4), S(0);
        a[2] = a[1];
        break;
      }
      case 5:  // three independent radii
        a << length(), length(), length();
        break;
      case 6: {  // nearly a sphere
        const S l = length();
        for (int k = 0; k < 3; ++k)
          a[k] = l + l * binade_uniform<S>(source, -std::numeric_limits<S>::digits, -4);
        break;
      }
      default: {  // a cloud
        const int count = source.between(3, 5);
        const S scale = length();
        for (int k = 0; k < count; ++k) {
          const S share = mass / S(count);
          const S distance = scale * source.unit<S>();
          add_point<S>(I, share, distance * direction<S>(source));
        }
        return I;
      }
    }
    const bool aligned = source.chance(1, 4);
    const Mat<S, 3> R = rotation_matrix<S>(unit_quaternion<S>(source));
    for (int k = 0; k < 3; ++k) {
      Vec<S, 3> r = Vec<S, 3>::Zero();
      r[k] = a[k];
      if (!aligned) r = a[k] * R.col(k);
      add_point<S>(I, mass, r);
    }
    return I;
  }

  /// Records the largest error of the four 3 x 3 blocks, each relative to the norm of that block.
  template <class Real>
  static void measure_matrix(Recorder& recorder, const Mat<double, 6>& computed,
                             const oracles::Resolved<oracles::Mat6<Real>>& exact) {
    constexpr Output output = op::inertia_matrix[block::matrix];
    if (!comparable(recorder, output, computed, exact.resolved)) return;
    const auto M = oracles::exact_matrix<6, 6, Real>(computed);
    double error = 0;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        error = std::max(error, oracles::vector_error(recorder.scalar(), oracles::block(M, i, j),
                                                      oracles::block(exact.value, i, j)));
    recorder.record(output, 0, error, one);
  }

  /// Records the mass, lever and inertia (about the centre of mass) from act_inertia or act_inverse_inertia.
  template <const auto& operation, class Real>
  static void measure_body(Recorder& recorder, const Body<double>& computed,
                           const oracles::Resolved<oracles::BodyOf<Real>>& exact, const Case<Real>& x) {
    if (comparable(recorder, operation[block::mass], Vec<double, 1>(computed.mass), exact.resolved))
      recorder.record(
          operation[block::mass], 0,
          oracles::scalar_error(recorder.scalar(), oracles::exact<Real>(computed.mass), exact.value.mass),
          one);
    record_sum(recorder, operation[block::lever], computed.c, exact.value.c, exact.resolved,
               Real(norm(x.I_e.c) + norm(x.X_e.p)));
    if (comparable(recorder, operation[block::inertia], computed.I_C, exact.resolved)) {
      const auto I_C = oracles::exact_matrix<3, 3, Real>(computed.I_C);
      recorder.record(operation[block::inertia], 0,
                      oracles::vector_error(recorder.scalar(), I_C, exact.value.I_C), one);
    }
  }
};

const RegisteredProperty<KineticEnergy> registered_kinetic_energy;

}  // namespace
}  // namespace liecheck::properties
