// Measures the machine: tests/house/build_times_test.cpp divides the time of every other file by the time that this one
// takes to compile. It therefore uses no header of liecheck and no precompiled header, and never changes.
#include <Eigen/Dense>
#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

double reference_of_compile_times(const Eigen::Matrix<double, 6, 6>& a,
                                  const Eigen::Matrix<double, 6, 1>& b) {
  const Eigen::Matrix<double, 6, 6> square = a * a.transpose();
  const Eigen::Matrix<double, 6, 1> x = square.ldlt().solve(b);
  std::map<std::string, std::function<double(double)>> functions;
  functions["norm"] = [&](double s) { return s * x.norm(); };
  std::vector<double> values(x.data(), x.data() + x.size());
  std::sort(values.begin(), values.end());
  for (const auto& [name, f] : functions) values.push_back(f(values.front()));
  return values.back();
}
