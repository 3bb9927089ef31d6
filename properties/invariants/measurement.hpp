#pragma once
// What a law measures, and on which robot.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <operations/description.hpp>
#include <oracles/scalar.hpp>
#include <string>
#include <subjects/outcome.hpp>
#include <type_traits>

namespace liecheck::properties {

class Property;  // property.hpp
struct Subject;  // subjects/subject.hpp
using oracles::Scalar;

/// One measurement. The error is in eps of the subject's scalar. kappa is 0 if it was not computed.
struct Residual {
  std::uint16_t output = 0;
  std::uint16_t band = 0;
  Outcome outcome = Outcome::measured;
  double error = 0;
  double kappa = 0;
};

/// A condition number that is computed only when needed. It refers to a callable, which must outlive it.
/// `least` is a known lower bound. If an error passes with kappa = `least`, kappa is not computed.
class Kappa {
 public:
  Kappa(std::nullptr_t = nullptr) {}  // NOLINT: none
  template <class F>
  requires(!std::is_same_v<F, Kappa> && std::is_invocable_v<const F&>)
      Kappa(const F& f, double least = 1)  // NOLINT
      : object_(&f),
        call_([](const void* object) -> double { return (*static_cast<const F*>(object))(); }),
        least_(least > 1 && std::isfinite(least) ? least : 1) {}
  explicit operator bool() const { return call_ != nullptr; }
  double operator()() const { return call_(object_); }
  double least() const { return least_; }

 private:
  const void* object_ = nullptr;
  double (*call_)(const void*) = nullptr;
  double least_ = 1;
};

/// Receives the measurements of an invariant. `kappa` is called only if the budget's rule needs it.
class Recorder {
 public:
  explicit Recorder(const oracles::Scalar& scalar) : scalar_(scalar) {}
  virtual ~Recorder() = default;
  /// The scalar of the subject, in whose eps errors are recorded.
  const oracles::Scalar& scalar() const { return scalar_; }
  virtual void record(const Output& output, std::size_t band, double error_eps, Kappa kappa = nullptr) = 0;
  virtual void outcome(const Output& output, std::size_t band, Outcome outcome) = 0;
  /// The error or excess in eps up to which the output passes in the band; infinity if nothing is judged.
  virtual double limit(const Output&, std::size_t /*band*/) const {
    return std::numeric_limits<double>::infinity();
  }
  /// Whether the output is judged as that of ordinary code: a correct form that is in wide use passes, although
  /// liecheck's own form gives more. True under every profile but `ours` (docs/limits.md).
  virtual bool ordinary(const Output&) const { return false; }

 private:
  const oracles::Scalar& scalar_;
};

/// The robot that configuration properties run on.
struct Robot {
  std::string name;     ///< the name in its <robot> element
  std::string urdf;     ///< the text of the URDF
  std::string path;     ///< the path that the user gave; empty for the built-in robot
  bool fixed = false;   ///< its root is fixed to the world; otherwise it floats
  bool mimics = false;  ///< some of its joints mimic another
  std::string hash;     ///< 16 hexadecimal digits of a SHA-256 of `urdf` and `fixed`
};

}  // namespace liecheck::properties
