// Weighted means of three rotations and of three poses: the chordal mean, and the one from which the logarithms sum to zero.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <oracles/means.hpp>

namespace liecheck::properties {
namespace {

class Means final : public SlowLaw<Means> {
 public:
  static constexpr TwoOutputs chordal = rotation_and_norm(op::mean_rotation),
                              geodesic = rotation_and_norm(op::geodesic_mean),
                              of_poses = rotation_and_norm(op::mean_pose);
  static constexpr Output translation = op::mean_pose[block::translation];
  static constexpr Statement stated{
      .name = "means",
      .law = "a mean of rotations or poses is the minimiser that defines it",
      .equation = "max sum_i w_i (Q . Q_i)^2; sum_i w_i log(Q* Q_i) = 0; sum_i w_i log(T^-1 T_i) = 0",
      .source = "Markley et al. 2007; Moakher 2002; Pennec & Arsigny 2013",
      .outputs = {chordal[0], chordal[1], geodesic[0], geodesic[1], of_poses[0], of_poses[1], translation},
      .fields = {{"p0", Kind::vector, 3, "m", Reach::any},
                 {"Q0", Kind::quaternion, 4, "1"},
                 {"p1", Kind::vector, 3, "m", Reach::any},
                 {"Q1", Kind::quaternion, 4, "1", Reach::any},
                 {"p2", Kind::vector, 3, "m", Reach::any},
                 {"Q2", Kind::quaternion, 4, "1", Reach::any},
                 {"weights", Kind::positive, 3, "1", Reach::any}}};

  /// Rotations near each other, within 2 rad, opposite in sign, or any; weights equal or up to 256 times each other.
  template <class S>
  std::vector<S> draw(Source& source) const {
    std::vector<S> x;
    const auto Q0 = unit_quaternion<S>(source);
    const std::uint64_t kind = source.below(8);
    const auto beside = [&] {
      if (kind == 0) return unit_quaternion<S>(source);
      if (kind <= 2) return quaternion_near<S>(source, Q0);
      const S half = kind <= 4 ? binade_uniform<S>(source, -std::numeric_limits<S>::digits - 4, -1)
                               : S(source.unit<S>() / S(2));
      Vec<S, 4> turn;
      using std::cos, std::sin, std::sqrt;
      turn << S(sin(half)) * direction<S>(source), S(cos(half));
      Vec<S, 4> Q = quaternion_product<S>(Q0, turn);
      Q /= S(sqrt(Q.squaredNorm()));
      return source.chance(1, 3) ? Vec<S, 4>(-Q) : Q;
    };
    const int binades = source.chance(1, 4) ? 40 : 4;
    for (int i = 0; i < 3; ++i) {
      append(x, vector3<S>(source, binades));
      append(x, i == 0 ? Q0 : beside());
    }
    const bool equal = source.chance(1, 3);
    for (int i = 0; i < 3; ++i) x.push_back(equal ? S(1) : binade_uniform<S>(source, -4, 4));
    return x;
  }
  bool valid(const std::vector<double>& input) const override {
    return Property::valid(input) &&
           std::all_of(input.end() - 3, input.end(), [](double w) { return w >= 0x1p-10 && w <= 0x1p10; });
  }

  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    Reader read(input);
    const properties::Vec<double, 7> q[3] = {read.take<7>(), read.take<7>(), read.take<7>()};
    const properties::Vec<double, 3> w = read.take<3>();
    const properties::Vec<double, 4> Q[3] = {q[0].tail<4>(), q[1].tail<4>(), q[2].tail<4>()};
    std::vector<Real> weights;
    std::vector<Quaternion<>> rotations;
    std::vector<Vec7<>> poses;
    for (int i = 0; i < 3; ++i) {
      weights.push_back(oracles::exact<Real>(w[i]));
      poses.push_back(exact_vector<7>(q[i]));
      rotations.push_back(quaternion_of(poses.back()));
    }
    const MeanRotation chord = chordal_mean(rotations, weights);
    if (o[op::mean_rotation]) {
      const properties::Vec<double, 4> computed = o[op::mean_rotation](Q[0], Q[1], Q[2], w);
      const auto kappa = [&] { return std::max(1.0, static_cast<double>(Real(2 / chord.gap))); };
      if (chord.gap < Real(1e3 * r.scalar().epsilon) && all_finite(computed)) {  // two clusters
        for (const Output& out : chordal) r.outcome(out, 0, Outcome::ill_posed);
      } else {
        judged_value(r, {chordal[0], chordal[1]}, 0, computed, chord.resolved, [&] {
          const Quaternion<> m = exact_vector<4>(computed);
          r.record(chordal[0], 0, rotation_error(r.scalar(), m, chord.Q), kappa);
          r.record(chordal[1], 0, norm_defect(r.scalar(), m));
        });
      }
    }
    if (!o[op::geodesic_mean] && !o[op::mean_pose]) return;
    bool unique = true;  // all within 2 rad of one another
    static const Real cosine = cos(Real(1));
    for (std::size_t i = 0; i < 3; ++i)
      unique = unique && abs(conjugate_product(normalized(rotations[i]),
                                               normalized(rotations[(i + 1) % 3]))[3]) >= cosine;
    // The rotation of a mean of poses is the mean of their rotations, so that one value serves both.
    MeanPose exact;
    if (unique) exact = oracles::geodesic_mean(poses, weights, chord.Q);
    const Resolved<Quaternion<>> turn{exact.Q, exact.resolved};
    if (o[op::geodesic_mean]) {
      const properties::Vec<double, 4> computed = o[op::geodesic_mean](Q[0], Q[1], Q[2], w);
      if (unique)
        record_rotation(r, geodesic, 0, computed, turn);
      else
        for (const Output& out : geodesic) undetermined(r, out, all_finite(computed));
    }
    if (!o[op::mean_pose]) return;
    const properties::Vec<double, 7> computed = o[op::mean_pose](q[0], q[1], q[2], w);
    if (!unique) {
      for (const Output& out : {of_poses[0], of_poses[1], translation})
        undetermined(r, out, all_finite(computed));
      return;
    }
    record_rotation(r, of_poses, 0, properties::Vec<double, 4>(computed.tail<4>()), turn);
    judged_value(r, {translation}, 0, computed, exact.resolved, [&] {
      Real scale(0);
      for (const Vec7<>& pose : poses) scale = larger(scale, Real(norm(head3(pose))));
      r.record(translation, 0, vector_error(r.scalar(), exact_vector<3>(computed), exact.p, scale));
    });
  }

 private:
  static void undetermined(Recorder& r, const Output& output, bool finite) {
    r.outcome(output, 0, finite ? Outcome::ill_posed : Outcome::not_finite);
  }
};

const RegisteredProperty<Means> registered_means;

}  // namespace
}  // namespace liecheck::properties
