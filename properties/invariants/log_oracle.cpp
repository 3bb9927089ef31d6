// log against the exact logarithm of the stored numbers: of Q/|Q|, of the rotation nearest to R.

#include <generators/rotations.hpp>
#include <invariants/branch.hpp>
#include <invariants/common.hpp>
#include <oracles/log.hpp>

namespace liecheck::properties {
namespace {

template <class S>
class LogOracle final : public Law<LogOracle, S> {
 public:
  std::string name() const override { return "log_oracle"; }
  std::string law() const override {
    return "log of a pose is the inverse of exp with an angle of at most pi";
  }
  std::string equation() const override { return "exp(log(R, p)) = (R, p), |phi| <= pi"; }
  std::string source() const override { return "Higham 2008, section 11.5 (inverse scaling and squaring)"; }
  std::vector<Output> outputs() const override {
    return {{"log3_quaternion", "rotation vector"},
            {"log3_matrix", "rotation vector"},
            {"log6", "rotation vector"},
            {"log6", "linear"}};
  }
  std::vector<Field> fields() const override {
    return {{"Q", Kind::quaternion, 4, "1"},
            {"R", Kind::rotation_matrix, 9, "1"},
            {"p", Kind::vector, 3, "m", Reach::full}};
  }
  bool offered(const Subject<S>& s) const override {
    return s.operations.log3_quaternion || s.operations.log3_matrix || s.operations.log6;
  }
  std::vector<S> generate(Source& source) const override {
    std::vector<S> x;
    const auto Q = unit_quaternion<S>(source);
    append(x, Q);
    append(x, rotation_matrix<S>(Q));
    append(x, vector3<S>(source));
    return x;
  }
  bool valid(const std::vector<S>& input) const override {
    if (!Property<S>::valid(input)) return false;
    Reader<S> read(input);
    if (oracles::norm_defect<S>(oracles::exact_vector<4, Real>(read.template take<4>())) > 8) return false;
    return oracles::orthogonality_defect<S>(oracles::exact_matrix<3, 3, Real>(read.take_matrix())) <= 8;
  }
  template <class Real>
  void in(const Subject<S>& subject, const std::vector<S>& input, Recorder& r) const {
    const auto& o = subject.operations;
    Reader<S> read(input);
    const Vec<S, 4> Q = read.template take<4>();
    const Mat<S, 3> R = read.take_matrix();
    const Vec<S, 3> p = read.template take<3>();
    if (o.log3_quaternion) {
      const auto exact = oracles::log_so3(oracles::exact_vector<4, Real>(Q));
      rotation_vector_error(r, 0, o.log3_quaternion(Q), exact);
    }
    if (!o.log3_matrix && !o.log6) return;
    const auto exact =
        oracles::log_se3_matrix(oracles::exact_matrix<3, 3, Real>(R), oracles::exact_vector<3, Real>(p));
    if (o.log3_matrix) rotation_vector_error(r, 1, o.log3_matrix(R), exact);
    if (o.log6) {
      const std::size_t band = band_of_log<S>(exact);
      const Vec<S, 6> xi = o.log6({R, p});
      judged_value(r, {2, 3}, band, xi, exact.resolved, [&] {
        const auto error = oracles::log_error<S>(oracles::exact_vector<6, Real>(xi), exact);
        if (on_other_branch<S>(tail3(oracles::exact_vector<6, Real>(xi)), exact.phi, error.angular)) {
          for (int o : {2, 3}) r.outcome(o, band, Outcome::wrong_branch);
          return;
        }
        r.record(2, band, error.angular);
        r.record(3, band, error.linear);
      });
    }
  }

 private:
  template <class Real>
  static void rotation_vector_error(Recorder& r, int output, const Vec<S, 3>& phi,
                                    const oracles::LogValue<Real>& exact) {
    const std::size_t band = band_of_log<S>(exact);
    judged_value(r, {output}, band, phi, exact.resolved, [&] {
      Vec<S, 6> xi = Vec<S, 6>::Zero();
      xi.template tail<3>() = phi;
      const double error = oracles::log_error<S>(oracles::exact_vector<6, Real>(xi), exact).angular;
      if (on_other_branch<S>(oracles::exact_vector<3, Real>(phi), exact.phi, error))
        return r.outcome(output, band, Outcome::wrong_branch);
      r.record(output, band, error);
    });
  }
};

const RegisteredProperty<LogOracle> registered;

}  // namespace
}  // namespace liecheck::properties
