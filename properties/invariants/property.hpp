#pragma once
// An invariant is a class derived from Property. It states a law in words and as an equation, and gives a
// generator of inputs and `measure`, which records the error and kappa of each block. It does not decide
// whether a case passes: campaign/judge.hpp compares the errors with the budget table.
//
// Every case must record each output that the law measures of a subject (`measures`), with an error or with
// an outcome. An output that nothing was recorded for counts as unmeasured, and its series is incomplete.
//
// A law does not depend on the type of the subject's scalar: the numbers of a case are doubles, which hold those of a
// float exactly, and scalar() says what they are rounded to. Only its generator is a template, so that the same random
// bits give the same bits of the scalar.
//
// A new invariant needs one new file: derive a class P from Law<P> and register it with RegisteredProperty.

#include <functional>
#include <generators/angle_bands.hpp>
#include <generators/input_layout.hpp>
#include <generators/random_bits.hpp>
#include <invariants/measurement.hpp>
#include <memory>
#include <oracles/number.hpp>
#include <string>
#include <string_view>
#include <subjects/subject.hpp>
#include <vector>

namespace liecheck::properties {

/// A Field with constant names.
struct ConstantField {
  const char* name = "";
  Kind kind = Kind::vector;
  int size = 0;
  const char* unit = "";
  Reach reach = Reach::limited;
};

/// The operations from whose results a law forms a quantity. Any other output needs its own operation alone.
struct Formed {
  const Operation* quantity = nullptr;
  Few<const Operation*, 3> from;
};

/// What a law says, which blocks it measures and which numbers it needs.
struct Statement {
  const char* name;
  const char* law;       ///< in words
  const char* equation;  ///< as an equation
  const char* source;    ///< author, year, equation
  Few<Output, 14> outputs;
  Few<ConstantField, 9> fields = {};
  Few<Formed, 3> formed = {};
};

/// A law on subjects of one scalar.
class Property {
 public:
  /// The numbers in which measure_fast measures, by tier.
  using Tiers = oracles::BallTiers;
  static std::size_t first_tier(const oracles::Scalar& scalar, bool needs_kappa) {
    return scalar.is_float() && !needs_kappa ? 0 : 1;  // differences for kappa need the last tier
  }
  virtual ~Property() = default;
  const oracles::Scalar& scalar() const { return *scalar_; }
  virtual const Statement& statement() const = 0;
  std::string name() const { return statement().name; }
  std::vector<Output> outputs() const { return {statement().outputs.begin(), statement().outputs.end()}; }
  virtual std::vector<Field> fields() const;  ///< by default, those of the statement
  /// Whether the subject offers every operation that the output needs.
  bool offers(const Subject& subject, const Output& output) const;
  /// Whether the subject offers at least one output of the law.
  bool offered(const Subject& subject) const;
  /// Whether each case must record this output of the subject. May be called only after prepare.
  bool measures(const Subject& subject, const Output& output) const {
    return offers(subject, output) && exists(output);
  }
  /// Whether an input of so many numbers is one of the law. By default: as many as its fields have.
  virtual bool takes(std::size_t numbers) const;
  virtual bool needs_robot() const { return false; }  ///< may be called only after prepare
  /// Whether subjects are given the URDF of the robot. May be called only after prepare.
  virtual bool gives_urdf() const { return needs_robot(); }
  /// Sets up what depends on the robot. Called once, before any case.
  virtual void prepare(const Robot&) {}
  /// Draws the inputs from what the subject takes. Called at most once, after prepare. Returns what they are drawn from,
  /// without a '.', which is part of the address of a case; "" if the subject takes everything.
  virtual std::string draw_for(const Subject&) { return ""; }
  /// Generates a valid input, numbers of the scalar, from random bits alone.
  virtual std::vector<double> generate(Source& source) const = 0;
  /// Whether a shrunk or typed input meets the assumptions of the law. Default: every number is finite, and each group is
  /// of its kind: quaternions and rotation matrices are unit up to 8 eps, those of any norm are not zero, fractions are in
  /// [0, 1], angles are up to pi in size.
  virtual bool valid(const std::vector<double>& input) const;
  /// Simpler inputs that differ in more than one field. Some of them may be invalid.
  virtual std::vector<std::vector<double>> simpler(const std::vector<double>&) const { return {}; }
  /// A C++ program that computes the output with liecheck's own functions. If it is empty,
  /// failures/program.cpp writes the program from the fields and the operation.
  virtual std::string program(const Output&, const std::vector<double>&) const { return ""; }
  /// Measures with the oracles at 50 and 100 digits.
  virtual void measure(const Subject& subject, const std::vector<double>& input,
                       Recorder& recorder) const = 0;
  /// Measures with the oracles in ball arithmetic; tier 0 is the cheapest. Returns false if there is no such
  /// tier. Throws oracles::Undecided if an error bound is too wide; the recorded errors are then void.
  virtual bool measure_fast(const Subject&, const std::vector<double>&, Recorder&,
                            std::size_t /*tier*/) const {
    return false;
  }

 protected:
  /// Whether the subject offers the operation. By default: whether its slot is filled.
  virtual bool has(const Subject& subject, const Operation& operation) const {
    return subject.operations.has(operation);
  }
  /// Whether the robot has what the output belongs to, such as a continuous joint. Called after prepare.
  virtual bool exists(const Output&) const { return true; }

 private:
  friend std::vector<std::unique_ptr<Property>> make_properties(const oracles::Scalar& scalar);
  const oracles::Scalar* scalar_ = &oracles::scalar_of<double>;
};

/// What the laws share that have their own statement and generator. P has
///   static constexpr Statement stated;
///   template <class S> std::vector<S> draw(Source&) const;  // a valid input in the scalar S
template <class P, class Base>
class Stated : public Base {
 public:
  const Statement& statement() const override { return P::stated; }
  std::vector<double> generate(Source& source) const override {
    return this->scalar().with([&]<class S>() {
      return oracles::as_doubles<S>(static_cast<const P*>(this)->template draw<S>(source));
    });
  }
};

/// A law that is written once for every number type of the oracles. P has what Stated needs, and
///   template <class Real> void in(const Subject&, const std::vector<double>&, Recorder&) const.
template <class P, class Base = Property>
class Law : public Stated<P, Base> {
 public:
  static constexpr bool needs_kappa = false;  ///< a law may set this to true
  void measure(const Subject& subject, const std::vector<double>& input, Recorder& recorder) const override {
    static_cast<const P*>(this)->template in<oracles::Real>(subject, input, recorder);
  }
  bool measure_fast(const Subject& subject, const std::vector<double>& input, Recorder& recorder,
                    std::size_t tier) const override {
    using Tiers = typename Base::Tiers;
    tier += Base::first_tier(this->scalar(), P::needs_kappa);
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return ((tier == I && (static_cast<const P*>(this)->template in<std::tuple_element_t<I, Tiers>>(
                                 subject, input, recorder),
                             true)) ||
              ...);
    }
    (std::make_index_sequence<std::tuple_size_v<Tiers>>());
  }
};

/// A law that measures with the oracles at 50 and 100 digits only. P has what Stated needs, and
///   void in(const Subject&, const std::vector<double>&, Recorder&) const.
template <class P>
class SlowLaw : public Stated<P, Property> {
 public:
  void measure(const Subject& subject, const std::vector<double>& input, Recorder& recorder) const override {
    static_cast<const P*>(this)->in(subject, input, recorder);
  }
};

/// Fresh instances of every property for a scalar, alphabetical by name.
std::vector<std::unique_ptr<Property>> make_properties(const oracles::Scalar& scalar);

/// Functions that make the registered properties, in any order.
inline constinit std::vector<std::unique_ptr<Property> (*)()> property_makers;

/// A static object of this type in an invariant's file registers the invariant.
template <class P>
struct RegisteredProperty {
  RegisteredProperty() {
    property_makers.push_back([]() -> std::unique_ptr<Property> { return std::make_unique<P>(); });
  }
};

/// Reads consecutive groups of an input.
class Reader {
 public:
  explicit Reader(const std::vector<double>& input) : input_(input) {}
  template <int N>
  Vec<double, N> take() {
    Vec<double, N> v;
    for (int i = 0; i < N; ++i) v[i] = input_.at(position_++);
    return v;
  }
  Mat<double, 3> take_matrix() {  // row by row
    Mat<double, 3> m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = input_.at(position_++);
    return m;
  }
  Pose<double> take_pose() { return {take_matrix(), take<3>()}; }  // R, p
  VecX<double> take_dynamic(int n) {
    VecX<double> v(n);
    for (int i = 0; i < n; ++i) v[i] = input_.at(position_++);
    return v;
  }

 private:
  const std::vector<double>& input_;
  std::size_t position_ = 0;
};

template <class S, class Derived>
void append(std::vector<S>& input, const Eigen::MatrixBase<Derived>& m) {
  for (int i = 0; i < m.rows(); ++i)
    for (int j = 0; j < m.cols(); ++j) input.push_back(m(i, j));
}

/// The numbers of several groups. Because of its braces, Joined<S>{a, b, c} evaluates a, b and c in this
/// order. So a, b and c may draw random numbers.
template <class S>
struct Joined : std::vector<S> {
  template <class... M>
  explicit Joined(const Eigen::MatrixBase<M>&... groups) {
    this->reserve(static_cast<std::size_t>((groups.size() + ...)));
    (append(*this, groups), ...);
  }
};

}  // namespace liecheck::properties
