#pragma once
// Arguments and results of operations as lists of numbers, and back. Matrices are listed row by row, as in
// the layouts of the operations.

#include <operations/values.hpp>
#include <utility>
#include <vector>

namespace liecheck::properties {

/// Calls visit(x) for a reference to each number of a value.
template <class S, int R, int C, class Visit>
void for_each_number(Eigen::Matrix<S, R, C>& m, const Visit& visit) {
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) visit(m(i, j));
}
template <class S, class Visit>
void for_each_number(Pose<S>& X, const Visit& visit) {
  for_each_number(X.R, visit), for_each_number(X.p, visit);
}
template <class S, class Visit>
void for_each_number(Body<S>& I, const Visit& visit) {
  visit(I.mass), for_each_number(I.c, visit), for_each_number(I.I_C, visit);
}
template <class S, class Visit>
void for_each_number(std::pair<MatX<S>, MatX<S>>& both, const Visit& visit) {
  for_each_number(both.first, visit), for_each_number(both.second, visit);
}
/// A scalar, an index, a reference frame, or yes and no.
template <class T, class Visit>
requires(std::is_arithmetic_v<T> || std::is_enum_v<T>)  //
    void for_each_number(T& x, const Visit& visit) {
  visit(x);
}

/// Appends the numbers of a value.
template <class S, class T>
void append_numbers(std::vector<S>& to, const T& value) {
  for_each_number(const_cast<T&>(value), [&to](const auto& x) { to.push_back(static_cast<S>(x)); });
}
/// Sets the numbers of a value.
template <class S, class T>
void set_numbers(T& value, const std::vector<S>& numbers) {
  auto next = numbers.begin();
  for_each_number(value, [&next](auto& x) { x = static_cast<std::remove_cvref_t<decltype(x)>>(*next++); });
}

}  // namespace liecheck::properties
