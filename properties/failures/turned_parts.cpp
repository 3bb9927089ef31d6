#include <failures/turned_parts.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace liecheck::properties {

namespace {

/// R of a part that is a rotation.
Eigen::Matrix3d rotation_in(std::span<const double> x) {
  if (x.size() == 9) return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(x.data());
  return Eigen::Quaterniond(x.data()).normalized().toRotationMatrix();
}
/// Turns a vector from B to A by R, or back.
void turn(Span v, const Eigen::Matrix3d& R, bool back) {
  Eigen::Map<Eigen::Vector3d> x(v.data());
  x = back ? Eigen::Vector3d(R.transpose() * x) : Eigen::Vector3d(R * x);
}
bool is_rotation(const PartPlace& p) {
  return is_quaternion(p) || (p.size == 9 && p.part->name.starts_with("R"));
}

}  // namespace

std::string of_another_frame(const Operation& operation, const std::vector<PartPlace>& places,
                             const Wrong& wrong) {
  for (const PartPlace& by : places) {
    if (!is_rotation(by)) continue;
    for (const bool back : {false, true}) {
      const std::string R = fmt::format(
          "{}{}", is_quaternion(by) ? fmt::format("R({})", name_of(by, places)) : name_of(by, places),
          back ? "^T" : "");
      for (const PartPlace& at : places)
        for (const PartPlace& part : wrong.results())
          if (at.size == 3 && part.size == 3 && wrong.given_by([&](const JudgedCall& c) {
                Numbers x = c.right, v(at.in(c.call.arguments).begin(), at.in(c.call.arguments).end());
                turn(v, rotation_in(by.in(c.call.arguments)), back);
                std::ranges::copy(v, part.in(x).begin());
                return x;
              }))
            return fmt::format("where it fails, {} is {} {}", wrong.subject(), R, name_of(at, places));
      for (const PartPlace& at : places)
        if (at.size == 3 && wrong.given_by([&](const JudgedCall& c) {
              Numbers x = c.call.arguments;
              turn(at.in(x), rotation_in(by.in(c.call.arguments)), back);
              return in_blocks(operation, exact(operation.name.data(), x));
            }))
          return fmt::format(
              "where it fails, {} is what {} {} in place of {} would give: it is taken in another frame",
              wrong.subject(), R, name_of(at, places), name_of(at, places));
      for (const PartPlace& part : wrong.results())
        if (part.size == 3 && wrong.given_by([&](const JudgedCall& c) {
              Numbers x = c.right;
              turn(part.in(x), rotation_in(by.in(c.call.arguments)), back);
              return x;
            }))
          return fmt::format("where it fails, {} is {} times the right one: it is given in another frame",
                             wrong.subject(), R);
    }
  }
  return "";
}

std::string of_coupling(const Operation& operation, const Wrong& wrong) {
  if (!is_in_blocks(operation)) return "";
  using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  constexpr const char* lefts[] = {"", "D ", "D^-1 ", "D^T D^-1 "};
  constexpr const char* rights[] = {"", " D", " D^-1", " D^-1 D^T"};
  constexpr std::size_t transposed = 3;
  for (std::size_t left = 0; left <= transposed; ++left)
    for (std::size_t right = 0; right <= transposed; ++right) {
      if (left + right == 0 || !wrong.given_by([&](const JudgedCall& c) {
            Numbers x = c.right;
            const Block D(x.data()), D_inverse = D.inverse(), one = Block::Identity();
            const Block before = D.transpose() * D_inverse, after = D_inverse * D.transpose();
            const Block *const by_left[] = {&one, &D, &D_inverse, &before}, *const by_right[] = {
                                                                                &one, &D, &D_inverse, &after};
            Eigen::Map<Block> coupling(&x[9]);
            coupling = Block(*by_left[left] * coupling * *by_right[right]);
            return x;
          }))
        continue;
      return fmt::format(
          "where it fails, the upper right block is {}C{} in place of C, with D the upper left block: a "
          "factor D is {}",
          lefts[left], rights[right],
          left == transposed || right == transposed ? "transposed"
                                                    : "missing, on the wrong side, or one too many");
    }
  return "";
}

std::string length_of(const Wrong& wrong, const std::vector<PartPlace>& places) {
  for (const PartPlace& part : wrong.results()) {
    const auto times_norm = [&](const PartPlace& by, int power) {
      return wrong.given_by([&](const JudgedCall& c) {
        Numbers x = c.right;
        const double factor = std::pow(size_of_part(by, c.call.arguments), power);
        for (double& v : part.in(x)) v *= factor;
        return x;
      });
    };
    for (const PartPlace& by : places)
      for (const int power : {1, -1, 2, -2})
        if (by.size == 3 && times_norm(by, power))
          return fmt::format("where it fails, {} is the right one times |{}|{}", part.part->name,
                             name_of(by, places), power == 1 ? "" : fmt::format("^{}", power));
    const std::size_t columns = part.size == 9 ? 3 : 1;
    Numbers lengths;
    if (part.size < 3 || part.size > 9 || !wrong.given_by([&](const JudgedCall& c) {
          Numbers x = c.right;
          const Span right = part.in(x);
          bool longer = false;  // by a hundredth: rounding or a constant leave less
          for (std::size_t k = 0; k < columns; ++k) {
            double of_got = 0, of_right = 0;
            for (std::size_t i = k; i < part.size; i += columns)
              of_got = std::hypot(of_got, part.in(c.call.result)[i]),
              of_right = std::hypot(of_right, right[i]);
            for (std::size_t i = k; i < part.size; i += columns) right[i] *= of_got / of_right;
            longer |= std::fabs(of_got / of_right - 1) > 0.01;
            lengths.push_back(of_got);
          }
          if (!longer) return Numbers();
          return x;
        }))
      continue;
    if (columns == 3)
      return fmt::format(
          "where it fails, the columns of {} are right but for their lengths: they are not normalised",
          part.part->name);
    const auto [shortest, longest] = std::ranges::minmax(lengths);
    return fmt::format("where it fails, {} is right but for its length{}", part.part->name,
                       is_quaternion(part)          ? ": it is not normalised"
                       : longest < 1.001 * shortest ? fmt::format(", which is {:.3g} in all of them: a limit "
                                                                  "of it, or of what it is divided by",
                                                                  longest)
                                                    : "");
  }
  return "";
}

std::string factor_of(const Wrong& wrong) {
  for (const PartPlace& part : wrong.results())
    for (std::size_t i = 0; i <= part.size && (i == 0 || part.size <= 9);
         ++i) {  // all numbers, and then each
      const PartPlace at{part.layout, part.part, part.from + (i == 0 ? 0 : i - 1), i == 0 ? part.size : 1};
      const double factor = wrong.factor(at);
      // One nearer to 1 is that of a constant with few digits, which errors tell.
      if (factor == 0 || std::fabs(factor - 1) < 1e-2 || !wrong.given_by([&](const JudgedCall& c) {
            Numbers x = c.right;
            for (double& v : at.in(x)) v *= factor;
            // A small result agrees with any small factor to a hundredth of the error.
            return distance(at, x, c.call.result) < 0.01 * size_of_part(at, x) ? x : Numbers();
          }))
        continue;
      return i == 0
                 ? fmt::format("where it fails, {} is the right one times {:.4g}", wrong.subject(), factor)
                 : fmt::format("where it fails, {} is right but for {}, which is the right one times {:.4g}",
                               wrong.subject(), number_of(part, i - 1, wrong.results()), factor);
    }
  return "";
}

}  // namespace liecheck::properties
