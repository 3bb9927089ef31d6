// The bounds of the polynomials in scalar/stumpff.hpp, proved: how far the polynomial is from the function by Sollya,
// how far what is computed is from the polynomial by Gappa, from the operations that the code itself writes down
// (traced.hpp). The scripts stay in the build's folder `proofs`.

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

/// What a program prints, and how it exits.
std::pair<std::string, int> run(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string text;
  std::array<char, 512> part{};
  while (std::fgets(part.data(), part.size(), pipe)) text += part.data();
  return {text, pclose(pipe)};
}

std::string kept(const std::string& name, const std::string& text) {
  const std::string path = std::string(LIECHECK_PROOFS) + "/" + name;
  std::ofstream file(path);
  file << text << std::flush;
  EXPECT_TRUE(file) << path;
  return path;
}

/// max |p/f - 1| <= bound eps on [0, domain].
template <class S, template <class> class Series>
void approximation(const std::string& name, const char* series, double bound, const char* domain) {
  static constexpr Economised<S, Series<S>> p;
  std::vector<std::string> a;
  for (int j = 0; j < p.terms; ++j) a.push_back(fmt::format("{:a}", p.a[j]));
  std::ostringstream script;
  script << fmt::format("a = [|{}|];\n{}domain = {};\nbound = {} * 2^(-{});\n", fmt::join(a, ", "), series,
                        domain, bound, std::numeric_limits<S>::digits - 1)
         << std::ifstream(std::string(LIECHECK_SOURCE_DIR) + "/tests/proofs/approximation.sollya").rdbuf();
  const auto [text, status] =
      run(LIECHECK_SOLLYA " --flush " + kept(name + ".sollya", script.str()) + " < /dev/null");
  EXPECT_TRUE(text.starts_with("proved:")) << name << ": " << text;
}

/// |computed - exact| <= bound eps of the exact value, for x in [0, domain] of F.
/// Gappa halves the interval until it succeeds, or the time is up.
template <class F, bool FUSED, class Evaluate>
void evaluation(const std::string& name, Evaluate&& evaluate, double bound, const char* domain,
                int seconds = 60) {
  using T = Traced<F, FUSED>;
  program = {};
  const T result = evaluate(T::input("x"));
  const int bits = 8 * sizeof(F);
  const auto [text, status] =
      run(fmt::format("timeout {} {} ", seconds, LIECHECK_GAPPA) +
          kept(fmt::format("{}_{}.gappa", name, FUSED ? "fused" : "separate"),
               fmt::format(
                   "@rnd = float<ieee_{}, ne>;\nx = rnd(X);\n{}{{ x in [0, {}] -> |{} -/ {}| <= {}b-{} }}\n",
                   bits, program.text, domain, result.rounded(), result.exact(), std::lround(bound * 64),
                   std::numeric_limits<F>::digits - 1 + 6)));
  EXPECT_EQ(status, 0) << name << (FUSED ? ", fused: " : ": ") << text;
}

template <class F, class Evaluate>
void evaluations(const std::string& name, Evaluate&& evaluate, double bound, double fused_bound,
                 const char* domain) {
  evaluation<F, false>(name, evaluate, bound, domain);
  evaluation<F, true>(name, evaluate, fused_bound, domain);
}

// (pi/2)^2 and a few ulp of float; 1 - cos h <= 1.
constexpr const char *quarter = "2.467402", *unit = "1";
constexpr const char
    *fourth =
        "first = 1/24;\nratio = proc(j) { return -1 / ((2*j + 3) * (2*j + 4)); };\nterms = 24;\nrest = 1;\n",
    *fifth =
        "first = 1/120;\nratio = proc(j) { return -1 / ((2*j + 4) * (2*j + 5)); };\nterms = 24;\nrest = 1;\n",
    *inverse_sinc = "first = 1;\nratio = proc(j) { return j / (2*j + 1); };\nterms = 64;\nrest = 2;\n";

/// At x = 4 h, exactly.
template <class T>
HalfAngle<T> half(const T& h) {
  return HalfAngle<T>(h * T(4));
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
  const auto code = [](const auto& h) { return evaluate<Fourth>(h); };
  approximation<TypeParam, Fourth>(name, fourth, 0.27, quarter);
  evaluations<TypeParam>(name, code, 0.55, 0.51, quarter);
}

TYPED_TEST(Proofs, TheFifthStumpffFunction) {
  const auto name = this->named("c5");
  const auto code = [](const auto& h) { return evaluate<Fifth>(h); };
  approximation<TypeParam, Fifth>(name, fifth, 0.45, quarter);
  evaluations<TypeParam>(name, code, 0.6, 0.57, quarter);
}

// c_k = 1/k! - h c_{k+2}: what the polynomials are away from c_4 and c_5 adds at most h c_{k+2}/c_k < 1/5 of it, and
// 1/6 as it is rounded 1/6 eps.
TYPED_TEST(Proofs, TheSecondAndThirdFollow) {
  using F = TypeParam;
  evaluations<F>(
      this->named("c2"), [](const auto& h) { return half(h).c2; }, 0.54, 0.45, quarter);
  evaluations<F>(
      this->named("c3"), [](const auto& h) { return half(h).c3; }, 0.58, 0.52, quarter);
}

TYPED_TEST(Proofs, TheAngleOverItsSine) {
  const auto name = this->named("inverse_sinc");
  // As the logarithm takes it: 1 and what is left, whose polynomial is evaluated without its first term.
  const auto code = [](const auto& s) {
    using S = std::decay_t<decltype(s)>;
    return mul_add(evaluate<InverseSincSeries, 1>(s), s, S(1));
  };
  approximation<TypeParam, InverseSincSeries>(name, inverse_sinc, 0.2, unit);
  evaluations<TypeParam>(name, code, 2, 1.5, unit);
}

// A proof that would go through for any figure proves nothing.
TEST(ProofsThatMustFail, ASmallerBoundIsNotProved) {
  EXPECT_NONFATAL_FAILURE((approximation<double, Fourth>("must_fail", fourth, 0.24, quarter)), "not proved");
  EXPECT_NONFATAL_FAILURE(
      (evaluation<double, false>(
          "must_fail", [](const auto& h) { return evaluate<Fourth>(h); }, 0.5, quarter, 3)),
      "must_fail");
}

}  // namespace
}  // namespace liecheck::proofs
