// Tasks that wait for answers together.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <support/together.hpp>
#include <vector>

namespace liecheck::properties {
namespace {

struct Doubled : Question {
  explicit Doubled(int x) : Question{answer_all}, in(x) {}
  int in, out = 0;
  static inline std::vector<std::size_t> sizes = {};
  static void answer_all(std::span<Question* const> all) {
    sizes.push_back(all.size());
    for (Question* q : all) static_cast<Doubled*>(q)->out = 2 * static_cast<Doubled*>(q)->in;
  }
};
int doubled(int x) {
  Doubled q(x);
  if (!can_wait()) return 2 * x;
  wait_for_answer(q);
  return q.out;
}
const auto nothing = [](std::size_t) {};

class Together : public testing::Test {
 protected:
  void SetUp() override {
    Doubled::sizes.clear();
    bool here = false;
    run_together(
        1, [&](std::size_t) { here = can_wait(); }, nothing);
    if (!here) GTEST_SKIP() << "a sanitizer does not know of other stacks";
  }
};

TEST_F(Together, AskAsManyQuestionsAtOnceAsThereAre) {
  std::vector<int> results(100);
  run_together(
      100,
      [&](std::size_t k) {
        int x = doubled(static_cast<int>(k));
        if (k < 30) x = doubled(x);
        results[k] = x;
      },
      nothing);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(results[static_cast<std::size_t>(k)], k < 30 ? 4 * k : 2 * k);
  EXPECT_EQ(Doubled::sizes, (std::vector<std::size_t>{100, 30}));
  EXPECT_FALSE(can_wait());
}

TEST_F(Together, HaveTheirOwnPointersOfTheThread) {
  int thread = -1;
  std::vector<int> own(20, -1);
  run_together(
      20,
      [&](std::size_t k) {
        thread = static_cast<int>(k);
        doubled(1);
        EXPECT_EQ(thread, static_cast<int>(k));
        thread = -1;
      },
      [&](std::size_t k) { std::swap(thread, own[k]); });
  EXPECT_EQ(thread, -1);
}

TEST_F(Together, ThrowTheFirstExceptionAfterAllHaveEnded) {
  int ended = 0;
  try {
    run_together(
        10,
        [&](std::size_t k) {
          doubled(1);
          if (k == 3 || k == 5) throw std::runtime_error(std::to_string(k));
          ++ended;
        },
        nothing);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "3");
  }
  EXPECT_EQ(ended, 8);
}

TEST_F(Together, DoNotWaitWhileTheyHandleAnException) {
  run_together(
      2,
      [](std::size_t) {
        try {
          throw std::runtime_error("");
        } catch (const std::runtime_error&) {
          EXPECT_FALSE(can_wait());
          EXPECT_EQ(doubled(3), 6);
        }
        EXPECT_EQ(doubled(4), 8);
      },
      nothing);
  EXPECT_EQ(Doubled::sizes, (std::vector<std::size_t>{2}));
}

TEST_F(Together, RunInsideATaskOneAfterTheOther) {
  int sum = 0;
  run_together(
      3,
      [&](std::size_t k) {
        run_together(
            2, [&](std::size_t i) { sum += doubled(static_cast<int>(2 * k + i)); }, nothing);
      },
      nothing);
  EXPECT_EQ(sum, 30);
  EXPECT_EQ(Doubled::sizes, (std::vector<std::size_t>{3, 3}));
}

}  // namespace
}  // namespace liecheck::properties
