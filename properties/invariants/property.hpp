#pragma once
// An invariant is a class derived from Property. It states a law in words and as an equation, and gives a
// generator of inputs and `measure`, which records the error and kappa of each block. It does not decide
// whether a case passes: campaign/judge.hpp compares the errors with the budget table.
//
// Every case must record each output that the law measures of a subject (`measures`), with an error or with
// an outcome. An output that nothing was recorded for counts as unmeasured, and its series is incomplete.
//
// A new invariant needs one new file: derive a template P from Law<P, S> and register it with
// RegisteredProperty.

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

/// A law records ill_posed if the input does not determine the result, or if its equation does not hold for
/// the input. Only the judge records unmeasured.
enum class Outcome : std::uint8_t {
  measured,
  not_finite,
  wrong_branch,
  unresolved,
  refused,
  ill_posed,
  unmeasured,
  not_repeatable,       ///< another call with the same arguments gave another result
  argument_written,     ///< the call changed one of its arguments
  output_unwritten,     ///< the call left a number of its result unwritten
  outside_domain,       ///< the subject does not promise a result for the input: nothing was called
  crashed,              ///< the subject's process crashed, did not answer in time, or broke the protocol
  environment_changed,  ///< the call changed the rounding mode or the treatment of subnormals
  printed               ///< the call wrote to standard output, which belongs to the answers
};
/// For messages, in the order of Outcome.
inline constexpr const char* outcome_words[] = {"",
                                                "NaN or Inf",
                                                "wrong branch",
                                                "unresolved",
                                                "refused",
                                                "ill-posed",
                                                "unmeasured",
                                                "not repeatable",
                                                "argument written",
                                                "output unwritten",
                                                "outside the domain",
                                                "crashed",
                                                "environment changed",
                                                "printed"};
static_assert(std::size(outcome_words) == static_cast<std::size_t>(Outcome::printed) + 1);
/// Whether the outcome leaves the verdict on a case open, so that the campaign is incomplete.
constexpr bool leaves_open(Outcome o) {
  return o == Outcome::unresolved || o == Outcome::unmeasured;
}
/// Whether the outcome concerns the call, not its result.
constexpr bool is_misuse(Outcome o) {
  return o == Outcome::not_repeatable || o == Outcome::argument_written || o == Outcome::output_unwritten ||
         o == Outcome::crashed || o == Outcome::environment_changed || o == Outcome::printed;
}
/// A call without a result, which `outcome` describes.
struct CallFailed : std::runtime_error {
  CallFailed(const std::string& reason, std::string_view its_operation, Outcome its_outcome)
      : std::runtime_error(reason), operation(its_operation), outcome(its_outcome) {}
  std::string_view operation;
  Outcome outcome;
};

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
  virtual ~Recorder() = default;
  virtual void record(const Output& output, std::size_t band, double error_eps, Kappa kappa = nullptr) = 0;
  virtual void outcome(const Output& output, std::size_t band, Outcome outcome) = 0;
  /// The error or excess in eps up to which the output passes in the band; infinity if nothing is judged.
  virtual double limit(const Output&, std::size_t /*band*/) const {
    return std::numeric_limits<double>::infinity();
  }
};

/// The robot that configuration properties run on.
struct Robot {
  std::string name;    ///< the name in its <robot> element
  std::string urdf;    ///< the text of the URDF
  std::string path;    ///< the path that the user gave; empty for the built-in robot
  bool fixed = false;  ///< its root is fixed to the world; otherwise it floats
  std::string hash;    ///< 16 hexadecimal digits of a SHA-256 of `urdf` and `fixed`
};

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

template <class S>
class Property {
 public:
  /// The numbers in which measure_fast measures, by tier.
  using Tiers = typename oracles::BallTiers<S>::type;
  virtual ~Property() = default;
  virtual const Statement& statement() const = 0;
  std::string name() const { return statement().name; }
  std::vector<Output> outputs() const { return {statement().outputs.begin(), statement().outputs.end()}; }
  virtual std::vector<Field> fields() const;  ///< by default, those of the statement
  /// Whether the subject offers every operation that the output needs.
  bool offers(const Subject<S>& subject, const Output& output) const;
  /// Whether the subject offers at least one output of the law.
  bool offered(const Subject<S>& subject) const;
  /// Whether each case must record this output of the subject. May be called only after prepare.
  bool measures(const Subject<S>& subject, const Output& output) const {
    return offers(subject, output) && exists(output);
  }
  /// Whether an input of so many numbers is one of the law. By default: as many as its fields have.
  virtual bool takes(std::size_t numbers) const;
  virtual bool needs_robot() const { return false; }  ///< may be called only after prepare
  /// Sets up what depends on the robot. Called once, before any case.
  virtual void prepare(const Robot&) {}
  /// Generates a valid input from random bits alone.
  virtual std::vector<S> generate(Source& source) const = 0;
  /// Whether a shrunk or typed input meets the assumptions of the law. Default: every number is finite.
  virtual bool valid(const std::vector<S>& input) const;
  /// Simpler inputs that differ in more than one field. Some of them may be invalid.
  virtual std::vector<std::vector<S>> simpler(const std::vector<S>&) const { return {}; }
  /// A C++ program that computes the output with liecheck's own functions. If it is empty,
  /// failures/program.cpp writes the program from the fields and the operation.
  virtual std::string program(const Output&, const std::vector<S>&) const { return ""; }
  /// Measures with the oracles at 50 and 100 digits.
  virtual void measure(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder) const = 0;
  /// Measures with the oracles in ball arithmetic; tier 0 is the cheapest. Returns false if there is no such
  /// tier. Throws oracles::Undecided if an error bound is too wide; the recorded errors are then void.
  virtual bool measure_fast(const Subject<S>&, const std::vector<S>&, Recorder&, std::size_t /*tier*/) const {
    return false;
  }

 protected:
  /// Whether the subject offers the operation. By default: whether its slot is filled.
  virtual bool has(const Subject<S>& subject, const Operation& operation) const {
    return subject.operations.has(operation);
  }
  /// Whether the robot has what the output belongs to, such as a continuous joint. Called after prepare.
  virtual bool exists(const Output&) const { return true; }
};

// property.cpp instantiates these.
extern template class Property<float>;
extern template class Property<double>;
extern template class Property<float128>;

/// A law that is written once for every number type of the oracles. P<S> has
///   static constexpr Statement stated;
///   template <class Real> void in(const Subject<S>&, const std::vector<S>&, Recorder&) const.
template <template <class> class P, class S, class Base = Property<S>>
class Law : public Base {
 public:
  static constexpr bool needs_kappa = false;  ///< a law may set this to true
  const Statement& statement() const override { return P<S>::stated; }
  void measure(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder) const override {
    static_cast<const P<S>*>(this)->template in<oracles::Real>(subject, input, recorder);
  }
  bool measure_fast(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder,
                    std::size_t tier) const override {
    using Tiers = typename Base::Tiers;
    tier += P<S>::needs_kappa && std::tuple_size_v<Tiers> > 1;  // differences for kappa need the last tier
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return ((tier == I && (static_cast<const P<S>*>(this)->template in<std::tuple_element_t<I, Tiers>>(
                                 subject, input, recorder),
                             true)) ||
              ...);
    }
    (std::make_index_sequence<std::tuple_size_v<Tiers>>());
  }
};

/// A law that measures with the oracles at 50 and 100 digits only. P<S> has the `stated` of a Law, and
///   void in(const Subject<S>&, const std::vector<S>&, Recorder&) const.
template <template <class> class P, class S>
class SlowLaw : public Property<S> {
 public:
  const Statement& statement() const override { return P<S>::stated; }
  void measure(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder) const override {
    static_cast<const P<S>*>(this)->in(subject, input, recorder);
  }
};

/// Fresh instances of every property, alphabetical by name.
template <class S>
std::vector<std::unique_ptr<Property<S>>> make_properties();

/// Functions that make the registered properties, in any order.
template <class S>
inline constinit std::vector<std::unique_ptr<Property<S>> (*)()> property_makers;

/// A static object of this type in an invariant's file registers the invariant for every scalar.
template <template <class> class P>
struct RegisteredProperty {
  RegisteredProperty() {
    property_makers<float>.push_back(&make<float>);
    property_makers<double>.push_back(&make<double>);
    property_makers<float128>.push_back(&make<float128>);
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
  Pose<S> take_pose() { return {take_matrix(), take<3>()}; }  // R, p
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
