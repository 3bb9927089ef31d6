#pragma once
// liecheck's laws in your own GoogleTest or RapidCheck program, one line each:
//
//     #include <liecheck_laws.hpp>
//     struct MyLib { ... };                                    // as for an adapter: docs/start.md
//     LIECHECK_SUBJECT(MyLib, exp3_quaternion, log3_quaternion)
//
//     LIECHECK_PROPERTY(MyLib, exp_oracle)                     // RapidCheck: MyLibProperties.exp_oracle
//     LIECHECK_TEST(MyLib, log_oracle)                         // GoogleTest: MyLib.log_oracle
//     LIECHECK_TESTS(MyLib)                                    // GoogleTest: every law that MyLib offers
//
// A property draws from RapidCheck's own seed and runs as often as RC_PARAMS says (default: 100 inputs). A test is
// a campaign of 1000 cases with a fixed seed, and the law's hard cases. Both shrink failures.
// docs/adapters.md

#include <gtest/gtest.h>

#include <liecheck_adapter.hpp>
#include <liecheck_law.hpp>
#if __has_include(<rapidcheck/gtest.h>)
#include <rapidcheck/gtest.h>
#endif

namespace liecheck::laws {

template <class Subject>
const liecheck_adapter& library_of() {
  return liecheck_subject(static_cast<const Subject*>(nullptr));
}
template <class Subject>
void pass(const std::string& law) {
  const std::string failure = Law(library_of<Subject>(), law).campaign();
  if (!failure.empty()) FAIL() << failure;
}

#if __has_include(<rapidcheck/gtest.h>)
/// At most `depth` steps of shrinking: rounding can turn a simpler value back into an earlier one.
inline rc::Shrinkable<Input> shrinkable(const Law& law, const Input& input, int depth = 64) {
  if (depth == 0) return rc::shrinkable::just(input);
  return rc::shrinkable::shrink(rc::fn::constant(input), [&law, depth](const Input& value) {
    return rc::seq::map(rc::seq::fromContainer(law.simpler(value)),
                        [&law, depth](const Input& x) { return shrinkable(law, x, depth - 1); });
  });
}
/// The inputs of the law, which must outlive the generator.
inline rc::Gen<Input> inputs(const Law& law) {
  return rc::Gen<Input>([&law](const rc::Random& random, int) {
    rc::Random r = random;
    return shrinkable(law, law.generate({r.next(), r.next(), r.next(), r.next()}));
  });
}
/// The body of a property: the law holds for one input.
inline void hold(const Law& law) {
  const Input input = *inputs(law);
  const Judgement judgement = law.judge(input);
  if (judgement.band != "all") RC_TAG(judgement.band);
  if (!judgement.failure.empty()) RC_FAIL(judgement.failure);
}
#endif

}  // namespace liecheck::laws

#define LIECHECK_PROPERTY(Subject, law)                                                \
  RC_GTEST_PROP(Subject##Properties, law, ()) {                                        \
    static const liecheck::laws::Law its(liecheck::laws::library_of<Subject>(), #law); \
    liecheck::laws::hold(its);                                                         \
  }
#define LIECHECK_TEST(Subject, law)      \
  TEST(Subject, law) {                   \
    liecheck::laws::pass<Subject>(#law); \
  }
#define LIECHECK_TESTS(Subject)                                                          \
  class Subject##Laws : public testing::TestWithParam<std::string> {};                   \
  TEST_P(Subject##Laws, Holds) {                                                         \
    liecheck::laws::pass<Subject>(GetParam());                                           \
  }                                                                                      \
  INSTANTIATE_TEST_SUITE_P(                                                              \
      Every, Subject##Laws,                                                              \
      testing::ValuesIn(liecheck::laws::offered(liecheck::laws::library_of<Subject>())), \
      [](const auto& law) { return law.param; });
