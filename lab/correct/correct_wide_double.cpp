#include <correct/correct_subject.hpp>

namespace liecheck::properties::correct {

Vec<float128, 4> relative_any_norm(const Vec<double, 4>& Q0, const Vec<double, 4>& Q1) {
  const Vec<float128, 4> a = Q0.cast<float128>(), b = Q1.cast<float128>();
  Vec<float128, 4> turn(0, 0, 0, a.dot(b));
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    turn[i] = (a[3] * b[i] - b[3] * a[i]) - (a[j] * b[k] - a[k] * b[j]);
  }
  return turn / turn.norm();
}

namespace {

const Registered<double> in_double(
    CorrectSubject<double, Quaternions<long double>>::make("wide", "quaternions in more digits"));

}  // namespace
}  // namespace liecheck::properties::correct
