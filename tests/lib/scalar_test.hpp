#pragma once
// Tests that are compiled for several scalars S, most of them for float and double.

#include <gtest/gtest.h>

/// A suite of such tests, and the scalars.
#define SCALAR_SUITE(suite, ...)                      \
  template <class S>                                  \
  class suite : public testing::Test {};              \
  using suite##Scalars = testing::Types<__VA_ARGS__>; \
  TYPED_TEST_SUITE(suite, suite##Scalars)

/// A test of the suite, in whose body S is the scalar.
#define SCALAR_TEST(suite, name)  \
  template <class S>              \
  void suite##name##In();         \
  TYPED_TEST(suite, name) {       \
    suite##name##In<TypeParam>(); \
  }                               \
  template <class S>              \
  void suite##name##In()
