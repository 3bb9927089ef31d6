#pragma once
// An invariant: one law, in words and as an equation, its source, the operations that it needs, its generator,
// and `measure`: residual per block with scale and kappa. It measures; it never judges. Tests compare with the
// budget table, reports tabulate.
//
// Adding one touches one file: derive from Property<S> as a template and register it with RegisteredProperty.

#include <cmath>
#include <functional>
#include <generators/angle_bands.hpp>
#include <generators/input_layout.hpp>
#include <generators/random_bits.hpp>
#include <memory>
#include <oracles/number.hpp>
#include <string>
#include <string_view>
#include <subjects/subject.hpp>
#include <vector>

namespace liecheck::properties {

enum class Outcome : std::uint8_t { measured, not_finite, wrong_branch, unresolved, refused };

/// One measured number. error in eps of the subject's scalar, kappa >= 1 or 0 where it was not asked for.
struct Residual {
  std::uint16_t output = 0;
  std::uint16_t band = 0;
  Outcome outcome = Outcome::measured;
  double error = 0;
  double kappa = 0;
};

/// A condition number on demand: refers to a callable that outlives the call it is given to. Where it is known to be
/// `least` or more, an error within the budget for that much needs no more of it.
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

/// Receives what an invariant measures. `kappa` is called only where the budget's rule needs it.
class Recorder {
 public:
  virtual ~Recorder() = default;
  virtual void record(const Output& output, std::size_t band, double error_eps, Kappa kappa = nullptr) = 0;
  virtual void outcome(const Output& output, std::size_t band, Outcome outcome) = 0;
};

/// The robot that configuration properties run on.
struct Robot {
  std::string name;    ///< of its <robot> element
  std::string urdf;    ///< the text
  std::string path;    ///< as given; empty for the built-in one
  bool fixed = false;  ///< its root is welded to the world; otherwise it floats
  std::string hash;    ///< 16 hexadecimal digits of the SHA-256 of the text, and of whether it is fixed
};

template <class S>
class Property {
 public:
  virtual ~Property() = default;
  virtual std::string name() const = 0;
  virtual std::string law() const = 0;       ///< in words
  virtual std::string equation() const = 0;  ///< as an equation
  virtual std::string source() const = 0;    ///< author, year, equation
  virtual std::vector<Output> outputs() const = 0;
  virtual std::vector<Field> fields() const = 0;
  /// Does the subject offer at least one of the operations that the law speaks of?
  virtual bool offered(const Subject<S>& subject) const = 0;
  virtual bool needs_robot() const { return false; }  ///< asked after prepare
  /// Readies robot-dependent state; called once, before any case.
  virtual void prepare(const Robot&) {}
  /// Valid by construction; uses only the source.
  virtual std::vector<S> generate(Source& source) const = 0;
  /// Is this (shrunk or typed) input one that the generator could mean? Default: every number is finite.
  virtual bool valid(const std::vector<S>& input) const {
    using std::isfinite;
    for (const S& x : input)
      if (!isfinite(x)) return false;
    return true;
  }
  /// Simpler inputs, where that takes more than one field; not all need be valid.
  virtual std::vector<std::vector<S>> simpler(const std::vector<S>&) const { return {}; }
  /// A C++ program that makes what was measured with liecheck's own functions; empty where the law has none of its
  /// own, and the fields and the operation tell (campaign/snippet.hpp).
  virtual std::string program(const Output&, const std::vector<S>&) const { return ""; }
  /// Against the oracles at 50 and 100 digits.
  virtual void measure(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder) const = 0;
  /// Against the fast oracles, the cheapest of which is tier 0; false where the law has none of that tier. Throws
  /// oracles::Undecided where their error bound is too wide; what was recorded until then is void.
  virtual bool measure_fast(const Subject<S>&, const std::vector<S>&, Recorder&, std::size_t /*tier*/) const {
    return false;
  }
};

/// A law that is written once for every oracle's number: P<S> has
///   template <class Real> void in(const Subject<S>&, const std::vector<S>&, Recorder&) const.
template <template <class> class P, class S>
class Law : public Property<S> {
 public:
  void measure(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder) const override {
    static_cast<const P<S>*>(this)->template in<oracles::Real>(subject, input, recorder);
  }
  bool measure_fast(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder,
                    std::size_t tier) const override {
    using Tiers = typename oracles::BallTiers<S>::type;
    if constexpr (requires { P<S>::needs_kappa; })  // which takes a step that only the last tier has room for
      tier += std::tuple_size_v<Tiers> > 1;
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return ((tier == I && (static_cast<const P<S>*>(this)->template in<std::tuple_element_t<I, Tiers>>(
                                 subject, input, recorder),
                             true)) ||
              ...);
    }
    (std::make_index_sequence<std::tuple_size_v<Tiers>>());
  }
};

/// Fresh instances of every property, alphabetical by name.
template <class S>
std::vector<std::unique_ptr<Property<S>>> make_properties();

namespace property_detail {
template <class S>
void add(std::unique_ptr<Property<S>> (*make)());
}

/// A static of this type in an invariant's file makes it known, in every scalar.
template <template <class> class P>
struct RegisteredProperty {
  RegisteredProperty() {
    property_detail::add<float>(&make<float>);
    property_detail::add<double>(&make<double>);
    property_detail::add<float128>(&make<float128>);
  }
  template <class S>
  static std::unique_ptr<Property<S>> make() {
    return std::make_unique<P<S>>();
  }
};

/// Reads consecutive groups of an input.
template <class S>
class Reader {
 public:
  explicit Reader(const std::vector<S>& input) : input_(input) {}
  template <int N>
  Vec<S, N> take() {
    Vec<S, N> v;
    for (int i = 0; i < N; ++i) v[i] = input_.at(position_++);
    return v;
  }
  Mat<S, 3> take_matrix() {  // row by row
    Mat<S, 3> m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = input_.at(position_++);
    return m;
  }
  VecX<S> take_dynamic(int n) {
    VecX<S> v(n);
    for (int i = 0; i < n; ++i) v[i] = input_.at(position_++);
    return v;
  }

 private:
  const std::vector<S>& input_;
  std::size_t position_ = 0;
};

template <class S, class Derived>
void append(std::vector<S>& input, const Eigen::MatrixBase<Derived>& m) {
  for (int i = 0; i < m.rows(); ++i)
    for (int j = 0; j < m.cols(); ++j) input.push_back(m(i, j));
}

}  // namespace liecheck::properties
