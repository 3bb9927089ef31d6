// Proofs of the error bounds of the polynomials in scalar/stumpff.hpp. Sollya proves the approximation
// errors. Gappa proves the rounding errors of the operations that the code records when it runs on the scalar
// Traced (traced.hpp). The scripts stay in the build's folder `proofs`.

#include <fmt/format.h>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <array>
#include <cstdio>
#include <fstream>
#include <liecheck/scalar/stumpff.hpp>
#include <proofs/traced.hpp>
#include <sstream>

namespace liecheck::proofs {
namespace {

using namespace stumpff_detail;

/// The output of a program and its exit status.
std::pair<std::string, int> run(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string text;
  std::array<char, 512> part{};
  while (std::fgets(part.data(), part.size(), pipe)) text += part.data();
  return {text, pclose(pipe)};
}

std::string script_file(const std::string& name, const std::string& text) {
  const std::string path = std::string(LIECHECK_PROOFS) + "/" + name;
  std::ofstream file(path);
  file << text << std::flush;
  EXPECT_TRUE(file) << path;
  return path;
}

/// Proves max |p/f - 1| <= bound eps on [0, domain].
template <class S, template <class> class Series, int FROM = 0>
void approximation(const std::string& name, const char* series, double bound, const char* domain) {
  static constexpr Economised<S, Series<S>> p;
  std::vector<std::string> a;
  for (int j = FROM; j < p.terms; ++j) a.push_back(fmt::format("{:a}", p.a[j]));
  std::ostringstream script;
  script << fmt::format("a = [|{}|];\n{}domain = {};\nbound = {} * 2^(-{});\n", fmt::join(a, ", "), series,
                        domain, bound, std::numeric_limits<S>::digits - 1)
         << std::ifstream(std::string(LIECHECK_SOURCE_DIR) + "/tests/proofs/approximation.sollya").rdbuf();
  const auto [text, status] =
      run(LIECHECK_SOLLYA " --flush " + script_file(name + ".sollya", script.str()) + " < /dev/null");
  EXPECT_TRUE(text.starts_with("proved:")) << name << ": " << text;
}

/// Proves |goal| <= bound eps for x in [0, domain] of F, from the operations recorded so far.
template <class F>
void proof(const std::string& name, const std::string& goal, double bound, const char* domain,
           const std::string& hints, int seconds) {
  const auto [text, status] = run(
      fmt::format("timeout {} {} ", seconds, LIECHECK_GAPPA) +
      script_file(
          name + ".gappa",
          fmt::format("@rnd = float<ieee_{}, ne>;\nx = rnd(X);\n{}{{ x in [0, {}] -> |{}| <= {}b-{} }}\n{}",
                      8 * sizeof(F), program.text, domain, goal, std::lround(bound * 64),
                      std::numeric_limits<F>::digits - 1 + 6, hints)));
  EXPECT_EQ(status, 0) << name << ": " << text;
  EXPECT_EQ(text.find("not trivially equal"), std::string::npos) << name << ": " << text;
}

/// Proves |computed - exact| <= bound eps |exact| for x in [0, domain] of F.
/// Gappa bisects the interval until it succeeds or `seconds` are over.
template <class F, bool FUSED, class Evaluate>
void evaluation(const std::string& name, Evaluate&& evaluate, double bound, const char* domain,
                int seconds = 60) {
  program = {};
  const auto result = evaluate(Traced<F, FUSED>::input("x"));
  proof<F>(name + (FUSED ? "_fused" : "_separate"), result.rounded() + " -/ " + result.exact(), bound, domain,
           "", seconds);
}

/// Proves |computed - exact| <= bound eps for 1 - linear + small, which HalfAngle sums as a double word:
///     head = 1 - linear, other = 1 - head, rest = other - linear, tail = rest + small, value = head + tail.
/// The hints are the identities that make rest the rounding error of head; Gappa checks them.
template <class F, bool FUSED, class Evaluate>
void sum_of_parts(const std::string& name, Evaluate&& evaluate, double bound, const char* domain) {
  program = {};
  const auto result = evaluate(Traced<F, FUSED>::input("x"));
  const int n = std::stoi(result.rounded().substr(1));
  const std::string sum = fmt::format("t{} = rnd(t{} + t", n - 1, n - 2);
  const std::size_t at = program.text.find(sum);
  ASSERT_NE(at, std::string::npos) << program.text;
  const int small = std::stoi(program.text.substr(at + sum.size()));
  using fmt::arg;
  proof<F>(name + (FUSED ? "_fused" : "_separate"), fmt::format("t{0} - T{0}", n), bound, domain,
           fmt::format(
               "t{value} - T{value} -> (t{value} - (t{head} + t{tail})) + (t{tail} - (t{rest} + t{small})) + "
               "(t{rest} - (t{other} - t{linear})) + (t{other} - (1 - t{head})) + (t{small} - T{small});\n"
               "t{other} - t{linear} -> (t{other} - (1 - t{head})) - (t{head} - (1 - t{linear}));\n"
               "$ x in (4, 8);\n",
               arg("value", n), arg("tail", n - 1), arg("rest", n - 2), arg("other", n - 3),
               arg("head", n - 4), arg("linear", n - 5), arg("small", small)),
           60);
}

template <class F, class Evaluate>
void evaluations(const std::string& name, Evaluate&& evaluate, double bound, double fused_bound,
                 const char* domain) {
  evaluation<F, false>(name, evaluate, bound, domain);
  evaluation<F, true>(name, evaluate, fused_bound, domain);
}

// Ends of domains: pi^2 plus a few ulp of float for x, and 1 for s = 1 - cos h.
constexpr const char *pi_squared = "9.869608", *unit = "1", *near = "1/256";
constexpr const char* fourth =
    "first = 1/24;\nratio = proc(j) { return -1 / (4*(2*j + 3)*(2*j + 4)); };\nterms = 24;\nrest = 1;\n";
constexpr const char* fifth =
    "first = 1/120;\nratio = proc(j) { return -1 / (4*(2*j + 4)*(2*j + 5)); };\nterms = 24;\nrest = 1;\n";
constexpr const char* inverse_sinc_rest =
    "first = 1/3;\nratio = proc(j) { return (j + 1) / (2*j + 3); };\nterms = 64;\nrest = 2;\n";
constexpr const char* inverse_sinc =
    "first = 1;\nratio = proc(j) { return j / (2*j + 1); };\nterms = 64;\nrest = 2;\n";
constexpr const char* near_inverse_sinc =
    "first = 1;\nratio = proc(j) { return (2*j - 1)^2 / (2*j*(2*j + 1)); };\nterms = 16;\nrest = 2;\n";
constexpr const char* near_along =
    "first = 1/3;\nratio = proc(j) { return 2*j / (2*j + 3); };\nterms = 16;\nrest = 2;\n";

template <class T>
HalfAngle<T> half(const T& x) {
  return HalfAngle<T>(x);
}

template <class F>
class Proofs : public testing::Test {
 public:
  static std::string named(const char* kernel) {
    return fmt::format("{}_{}", kernel, std::is_same_v<F, float> ? "float" : "double");
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Proofs, Scalars);

TYPED_TEST(Proofs, TheFourthStumpffFunction) {
  const auto name = this->named("c4");
  const auto code = [](const auto& x) { return evaluate<Fourth>(x); };
  approximation<TypeParam, Fourth>(name, fourth, 0.27, pi_squared);
  evaluations<TypeParam>(name, code, 0.55, 0.51, pi_squared);
}

TYPED_TEST(Proofs, TheFifthStumpffFunction) {
  const auto name = this->named("c5");
  const auto code = [](const auto& x) { return evaluate<Fifth>(x); };
  approximation<TypeParam, Fifth>(name, fifth, 0.45, pi_squared);
  evaluations<TypeParam>(name, code, 0.6, 0.57, pi_squared);
}

// c_k = 1/k! - h c_{k+2}. The approximation error of c_{k+2} enters c_k with the factor h c_{k+2}/c_k < 1/5.
// The rounding of 1/6 adds 1/6 eps.
TYPED_TEST(Proofs, TheSecondAndThirdStumpffFunctions) {
  using F = TypeParam;
  evaluations<F>(
      this->named("c2"), [](const auto& x) { return half(x).c2; }, 0.54, 0.45, pi_squared);
  evaluations<F>(
      this->named("c3"), [](const auto& x) { return half(x).c3; }, 0.58, 0.52, pi_squared);
}

// Absolute errors of 1 - h/2 + h^2 c_4 and 1 - h/6 + h^2 c_5. The approximation errors of the polynomials and
// the rounding of 1/24 add at most 0.07 eps to the first and 0.06 eps to the second.
TYPED_TEST(Proofs, CosineAndSineOfHalfTheAngle) {
  using F = TypeParam;
  const auto cosine = [](const auto& x) { return half(x).c0; };
  const auto sine = [](const auto& x) { return half(x).c1; };
  sum_of_parts<F, false>(this->named("c0"), cosine, 0.57, pi_squared);
  sum_of_parts<F, true>(this->named("c0"), cosine, 0.57, pi_squared);
  sum_of_parts<F, false>(this->named("c1"), sine, 0.39, pi_squared);
  sum_of_parts<F, true>(this->named("c1"), sine, 0.34, pi_squared);
}

TYPED_TEST(Proofs, TheAngleOverItsSine) {
  const auto name = this->named("inverse_sinc");
  // As LogarithmCoefficients computes it: 1 plus the polynomial without its first term.
  const auto code = [](const auto& s) {
    using S = std::decay_t<decltype(s)>;
    return mul_add(evaluate<InverseSincSeries, 1>(s), s, S(1));
  };
  approximation<TypeParam, InverseSincSeries>(name, inverse_sinc, 0.2, unit);
  // (h / sin h - 1) / s, which the proofs of whole operations use (lab/bounds).
  approximation<TypeParam, InverseSincSeries, 1>(name + "_rest", inverse_sinc_rest, 13.5, unit);
  evaluations<TypeParam>(name, code, 2, 1.5, unit);
  approximation<TypeParam, NearInverseSincSeries>(this->named("near_inverse_sinc"), near_inverse_sinc, 0.002,
                                                  near);
  approximation<TypeParam, NearAlongSeries>(this->named("near_along"), near_along, 0.3, near);
}

// A smaller bound must fail: a check that accepts any bound proves nothing.
TEST(ProofsThatMustFail, ASmallerBoundIsNotProved) {
  EXPECT_NONFATAL_FAILURE((approximation<double, Fourth>("must_fail", fourth, 0.24, pi_squared)),
                          "not proved");
  EXPECT_NONFATAL_FAILURE(
      (evaluation<double, false>(
          "must_fail", [](const auto& x) { return evaluate<Fourth>(x); }, 0.5, pi_squared, 3)),
      "must_fail");
  EXPECT_NONFATAL_FAILURE((sum_of_parts<double, false>(
                              "must_fail", [](const auto& x) { return half(x).c1; }, 0.25, pi_squared)),
                          "must_fail");
}

}  // namespace
}  // namespace liecheck::proofs
