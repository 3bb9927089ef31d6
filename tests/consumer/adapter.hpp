#pragma once
#include <liecheck_adapter.hpp>

#include "mylib.hpp"

struct MyLib {
  static constexpr const char *name = "mylib", *version = "1.0";
  static mylib::Vector vector(const double* x) { return {x[0], x[1], x[2]}; }
  static mylib::Matrix matrix(const double* x) { return {vector(x), vector(x + 3), vector(x + 6)}; }
  static void put(const mylib::Matrix& M, double* to, std::size_t columns = 3) {
    for (std::size_t i = 0; i < 3; ++i) std::copy_n(M[i].data(), 3, to + columns * i);
  }
  static void exp3_quaternion(std::span<const double, 3> phi, std::span<double, 4> Q) {
    const mylib::Quaternion q = mylib::exp(vector(phi.data()));
    Q[0] = q.x, Q[1] = q.y, Q[2] = q.z, Q[3] = q.w;
  }
  static void exp3_matrix(std::span<const double, 3> phi, std::span<double, 9> R) {
    put(mylib::matrix(vector(phi.data())), R.data());
  }
  static void log3_quaternion(std::span<const double, 4> Q, std::span<double, 3> phi) {
    std::ranges::copy(mylib::log({Q[3], Q[0], Q[1], Q[2]}), phi.begin());
  }
  static void left_jacobian6(std::span<const double, 6> xi, std::span<double, 36> J) {
    const mylib::Jacobian all = mylib::left_jacobian(vector(&xi[0]), vector(&xi[3]));
    put(all.J, &J[0], 6), put(all.coupling, &J[3], 6), put({}, &J[18], 6), put(all.J, &J[21], 6);
  }
  static void inverse(std::span<const double, 12> X, std::span<double, 12> Y) {
    const mylib::Pose pose = mylib::inverse({matrix(&X[0]), vector(&X[9])});
    put(pose.R, &Y[0]), std::ranges::copy(pose.p, &Y[9]);
  }
};
