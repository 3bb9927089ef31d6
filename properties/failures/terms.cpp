#include <failures/terms.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <failures/part_changes.hpp>
#include <failures/relations.hpp>
#include <utility>

namespace liecheck::properties {

namespace {

using Values = Eigen::VectorXd;
using V3 = Eigen::Vector3d;
using M3 = Eigen::Matrix3d;
using Terms = std::vector<std::pair<const char*, Values>>;

V3 vector_at(const Numbers& x, std::size_t from) {
  return V3(&x.at(from));
}
M3 matrix_at(const Numbers& x, std::size_t from) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&x.at(from));
}
M3 hat(const V3& a) {
  M3 m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}
Values by_rows(const M3& m) {
  return m.transpose().reshaped();
}

/// The coefficients of the series in phi by their closed forms. At 0.01 rad F, which cancels most, keeps five digits in double,
/// where causes need two; D is infinite at 2 pi.
struct Coefficients {
  explicit Coefficients(const V3& phi)
      : theta(phi.norm()),
        A(std::sin(theta) / theta),
        B((1 - std::cos(theta)) / (theta * theta)),
        C((theta - std::sin(theta)) / std::pow(theta, 3)),
        D((1 - theta / 2 / std::tan(theta / 2)) / (theta * theta)),
        E((theta * theta + 2 * std::cos(theta) - 2) / (2 * std::pow(theta, 4))),
        F((2 * theta - 3 * std::sin(theta) + theta * std::cos(theta)) / (2 * std::pow(theta, 5))) {}
  bool known() const { return theta > 0.01 && theta < 6; }
  double theta, A, B, C, D, E, F;
};

/// V d for V = 1 + B [phi] + C [phi]^2, turned by R; and V^-1 d.
Terms of_V(const V3& phi, const V3& d, const M3& R = M3::Identity()) {
  const Coefficients k(phi);
  if (!k.known()) return {};
  return {{"rho", R * d},
          {"(1 - cos(theta))/theta^2 phi x rho", R * (k.B * phi.cross(d))},
          {"(theta - sin(theta))/theta^3 phi x (phi x rho)", R * (k.C * phi.cross(phi.cross(d)))}};
}
Terms of_V_inverse(const V3& phi, const V3& d) {
  const Coefficients k(phi);
  if (!k.known()) return {};
  return {{"p", d},
          {"-1/2 phi x p", -0.5 * phi.cross(d)},
          {"(1/theta^2 - cot(theta/2)/(2 theta)) phi x (phi x p)", k.D * phi.cross(phi.cross(d))}};
}
Terms of_jacobian(const Numbers& x, double sign) {
  const V3 phi = vector_at(x, 0);
  const Coefficients k(phi);
  if (!k.known()) return {};
  return {{"1", by_rows(M3::Identity())},
          {"(1 - cos(theta))/theta^2 [phi]", by_rows(sign * k.B * hat(phi))},
          {"(theta - sin(theta))/theta^3 [phi]^2", by_rows(k.C * hat(phi) * hat(phi))}};
}
Terms of_inverse_jacobian(const Numbers& x, double sign) {
  const V3 phi = vector_at(x, 0);
  const Coefficients k(phi);
  if (!k.known()) return {};
  return {{"1", by_rows(M3::Identity())},
          {"1/2 [phi]", by_rows(-0.5 * sign * hat(phi))},
          {"(1/theta^2 - cot(theta/2)/(2 theta)) [phi]^2", by_rows(k.D * hat(phi) * hat(phi))}};
}
/// The upper right block of the Jacobian of exp6; Barfoot 2017, eq. 7.86.
Terms of_coupling_block(const Numbers& x, double sign) {
  const V3 phi = sign * vector_at(x, 3);
  const Coefficients k(phi);
  if (!k.known()) return {};
  const M3 F = hat(phi), P = hat(sign * vector_at(x, 0));
  return {{"1/2 [rho]", by_rows(0.5 * P)},
          {"(theta - sin(theta))/theta^3 [phi][rho]", by_rows(k.C * F * P)},
          {"(theta - sin(theta))/theta^3 [rho][phi]", by_rows(k.C * P * F)},
          {"(theta - sin(theta))/theta^3 [phi][rho][phi]", by_rows(k.C * F * P * F)},
          {"(theta^2 + 2 cos(theta) - 2)/(2 theta^4) [phi]^2 [rho]", by_rows(k.E * F * F * P)},
          {"(theta^2 + 2 cos(theta) - 2)/(2 theta^4) [rho] [phi]^2", by_rows(k.E * P * F * F)},
          {"-3 (theta^2 + 2 cos(theta) - 2)/(2 theta^4) [phi][rho][phi]", by_rows(-3 * k.E * F * P * F)},
          {"(2 theta - 3 sin(theta) + theta cos(theta))/(2 theta^5) [phi][rho][phi]^2",
           by_rows(k.F * F * P * F * F)},
          {"(2 theta - 3 sin(theta) + theta cos(theta))/(2 theta^5) [phi]^2 [rho][phi]",
           by_rows(k.F * F * F * P * F)}};
}

/// The same block as the derivative of J_l(phi) by phi in the direction of rho: with d theta = (phi . rho) / theta.
Terms of_coupling_as_derivative(const Numbers& x, double sign) {
  const V3 phi = sign * vector_at(x, 3), rho = sign * vector_at(x, 0);
  const Coefficients k(phi);
  if (!k.known()) return {};
  const M3 F = hat(phi), P = hat(rho);
  const double along = phi.dot(rho) / (k.theta * k.theta);
  return {{"(1 - cos(theta))/theta^2 [rho]", by_rows(k.B * P)},
          {"(theta - sin(theta))/theta^3 [phi][rho]", by_rows(k.C * F * P)},
          {"(theta - sin(theta))/theta^3 [rho][phi]", by_rows(k.C * P * F)},
          {"(phi . rho) (A - 2 B)/theta^2 [phi], A = sin(theta)/theta, B = (1 - cos(theta))/theta^2,",
           by_rows(along * (k.A - 2 * k.B) * F)},
          {"(phi . rho) (B - 3 C)/theta^2 [phi]^2, B = (1 - cos(theta))/theta^2, C = (theta - "
           "sin(theta))/theta^3,",
           by_rows(along * (k.B - 3 * k.C) * F * F)}};
}
/// Those of -J^-1 C J^-1 for the terms of C, with J = J_l(sign phi).
Terms of_inverse_coupling(const Numbers& x, double sign, Terms terms) {
  const V3 phi = sign * vector_at(x, 3);
  const M3 F = hat(phi), inverse = M3::Identity() - 0.5 * F + Coefficients(phi).D * F * F;
  for (auto& [name, value] : terms) value = by_rows(-inverse * value.reshaped(3, 3).transpose() * inverse);
  return terms;
}

/// The increment of position over three measurements.
Terms of_increments(const Numbers& x) {
  M3 R = M3::Identity();
  V3 v = V3::Zero();
  V3 of_v = v, of_a = v;
  for (std::size_t k = 0; k < 3; ++k) {
    const double dt = x.at(18);
    const V3 turn = dt * vector_at(x, 3 * k), a = R * vector_at(x, 9 + 3 * k);
    of_v += v * dt, of_a += a * (dt * dt / 2), v += a * dt;
    const double angle = turn.norm();
    if (angle > 0) R = R * Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  }
  return {{"dv dt", of_v}, {"1/2 dR a dt^2", of_a}};
}

/// The terms whose sum some numbers of a result are.
struct Formula {
  const char* operation;
  Eigen::Index from, size;
  Terms (*terms)(const Numbers& arguments);
  /// What may stand in place of one of them.
  Terms (*others)(const Numbers& arguments) = nullptr;
};

/// The coupling block of Ad(exp(-delta)) for the pose (R, p) of exp(delta), and what may stand in its place.
Terms adjoint_terms(const Numbers& x) {
  if (!Coefficients(vector_at(x, 10)).known()) return {};
  const Numbers X = exact("exp6", {x.begin() + 7, x.begin() + 13});
  return {{"-R^T [p]", by_rows(-matrix_at(X, 0).transpose() * hat(vector_at(X, 9)))}};
}
Terms other_adjoints(const Numbers& x) {
  const Numbers X = exact("exp6", {x.begin() + 7, x.begin() + 13});
  const M3 R = matrix_at(X, 0), T = R.transpose(), p = hat(vector_at(X, 9)), rho = hat(vector_at(x, 7));
  return {
      {"[p] R^T", by_rows(p * T)},     {"-[p] R^T", by_rows(-p * T)},     {"R^T [p]", by_rows(T * p)},
      {"[p] R", by_rows(p * R)},       {"-[p] R", by_rows(-p * R)},       {"R [p]", by_rows(R * p)},
      {"-R [p]", by_rows(-R * p)},     {"-R^T [rho]", by_rows(-T * rho)}, {"-[rho] R^T", by_rows(-rho * T)},
      {"[rho] R^T", by_rows(rho * T)}, {"R^T [rho]", by_rows(T * rho)}};
}

const Formula formulas[] = {
    {"rotate_point", 0, 3,
     [](const Numbers& x) -> Terms {
       const V3 v = vector_at(x, 0), p = vector_at(x, 4);
       return {{"x", p}, {"2 w (v x x)", 2 * x[3] * v.cross(p)}, {"2 v x (v x x)", 2 * v.cross(v.cross(p))}};
     }},
    {"exp3_matrix", 0, 9,
     [](const Numbers& x) -> Terms {
       const V3 phi = vector_at(x, 0);
       const Coefficients k(phi);
       if (!k.known()) return {};
       return {{"1", by_rows(M3::Identity())},
               {"sin(theta)/theta [phi]", by_rows(k.A * hat(phi))},
               {"(1 - cos(theta))/theta^2 [phi]^2", by_rows(k.B * hat(phi) * hat(phi))}};
     }},
    {"left_jacobian3", 0, 9, [](const Numbers& x) { return of_jacobian(x, 1); }},
    {"right_jacobian3", 0, 9, [](const Numbers& x) { return of_jacobian(x, -1); }},
    {"left_jacobian3_inverse", 0, 9, [](const Numbers& x) { return of_inverse_jacobian(x, 1); }},
    {"right_jacobian3_inverse", 0, 9, [](const Numbers& x) { return of_inverse_jacobian(x, -1); }},
    {"exp6", 9, 3, [](const Numbers& x) { return of_V(vector_at(x, 3), vector_at(x, 0)); }},
    {"log6", 0, 3,
     [](const Numbers& x) {
       const Numbers phi = exact("log3_matrix", {x.begin(), x.begin() + 9});
       return of_V_inverse(vector_at(phi, 0), vector_at(x, 9));
     }},
    {"integrate", 0, 3,
     [](const Numbers& x) {
       Terms all = of_V(vector_at(x, 10), vector_at(x, 7),
                        Eigen::Quaterniond(&x.at(3)).normalized().toRotationMatrix());
       if (!all.empty()) all.push_back({"p0", vector_at(x, 0)});
       return all;
     }},
    {"difference", 0, 3,
     [](const Numbers& x) {
       const Numbers pose = relative_pose(x), phi = exact("log3_matrix", {pose.begin(), pose.begin() + 9});
       return of_V_inverse(vector_at(phi, 0), vector_at(pose, 9));
     }},
    {"left_jacobian6", 9, 9, [](const Numbers& x) { return of_coupling_block(x, 1); }},
    {"right_jacobian6", 9, 9, [](const Numbers& x) { return of_coupling_block(x, -1); }},
    {"left_jacobian6", 9, 9, [](const Numbers& x) { return of_coupling_as_derivative(x, 1); }},
    {"right_jacobian6", 9, 9, [](const Numbers& x) { return of_coupling_as_derivative(x, -1); }},
    {"left_jacobian6_inverse", 9, 9,
     [](const Numbers& x) { return of_inverse_coupling(x, 1, of_coupling_block(x, 1)); }},
    {"right_jacobian6_inverse", 9, 9,
     [](const Numbers& x) { return of_inverse_coupling(x, -1, of_coupling_block(x, -1)); }},
    {"left_jacobian6_inverse", 9, 9,
     [](const Numbers& x) { return of_inverse_coupling(x, 1, of_coupling_as_derivative(x, 1)); }},
    {"right_jacobian6_inverse", 9, 9,
     [](const Numbers& x) { return of_inverse_coupling(x, -1, of_coupling_as_derivative(x, -1)); }},
    {"preintegrate_forster", 9, 3, of_increments},
    {"d_integrate_arg0", 9, 9, adjoint_terms, other_adjoints},
    {"compose", 9, 3,
     [](const Numbers& x) -> Terms {
       return {{"p", vector_at(x, 9)}, {"R p_Y", matrix_at(x, 0) * vector_at(x, 21)}};
     }},
    {"act_point", 0, 3,
     [](const Numbers& x) -> Terms {
       return {{"p", vector_at(x, 9)}, {"R p_Y", matrix_at(x, 0) * vector_at(x, 12)}};
     }},
    {"act_motion", 0, 3,
     [](const Numbers& x) -> Terms {
       const M3 R = matrix_at(x, 0);
       return {{"R u", R * vector_at(x, 12)}, {"p x R omega", vector_at(x, 9).cross(R * vector_at(x, 15))}};
     }},
    {"act_inverse_motion", 0, 3,
     [](const Numbers& x) -> Terms {
       const M3 R = matrix_at(x, 0).transpose();
       return {{"R^T u", R * vector_at(x, 12)},
               {"-R^T (p x omega)", -R * vector_at(x, 9).cross(vector_at(x, 15))}};
     }},
    {"act_force", 3, 3,
     [](const Numbers& x) -> Terms {
       const M3 R = matrix_at(x, 0);
       return {{"R n", R * vector_at(x, 15)}, {"p x R f", vector_at(x, 9).cross(R * vector_at(x, 12))}};
     }},
    {"act_inverse_force", 3, 3,
     [](const Numbers& x) -> Terms {
       const M3 R = matrix_at(x, 0).transpose();
       return {{"R^T n", R * vector_at(x, 15)},
               {"-R^T (p x f)", -R * vector_at(x, 9).cross(vector_at(x, 12))}};
     }},
    {"cross_motion", 0, 3,
     [](const Numbers& x) -> Terms {
       return {{"omega x u_W", vector_at(x, 3).cross(vector_at(x, 6))},
               {"u x omega_W", vector_at(x, 0).cross(vector_at(x, 9))}};
     }},
    {"cross_force", 3, 3,
     [](const Numbers& x) -> Terms {
       return {{"omega x n", vector_at(x, 3).cross(vector_at(x, 9))},
               {"u x f", vector_at(x, 0).cross(vector_at(x, 6))}};
     }},
    {"momentum", 0, 3,
     [](const Numbers& x) -> Terms {
       return {{"m u", x[0] * vector_at(x, 13)},
               {"m omega x c", x[0] * vector_at(x, 16).cross(vector_at(x, 1))}};
     }},
    {"momentum", 3, 3,
     [](const Numbers& x) -> Terms {
       const V3 c = vector_at(x, 1), w = vector_at(x, 16);
       return {{"I_C omega", matrix_at(x, 4) * w},
               {"m c x u", x[0] * c.cross(vector_at(x, 13))},
               {"m c x (omega x c)", x[0] * c.cross(w.cross(c))}};
     }},
    {"inertia_matrix", 27, 9,
     [](const Numbers& x) -> Terms {
       const V3 c = vector_at(x, 1);
       return {{"I_C", by_rows(matrix_at(x, 4))},
               {"m |c|^2 1", by_rows(x[0] * c.squaredNorm() * M3::Identity())},
               {"-m c c^T", by_rows(-x[0] * c * c.transpose())}};
     }},
    {"kinetic_energy", 0, 1, [](const Numbers& x) -> Terms {
       const V3 c = vector_at(x, 1), u = vector_at(x, 13), w = vector_at(x, 16);
       return {{"1/2 m |u|^2", Values::Constant(1, x[0] * u.squaredNorm() / 2)},
               {"m u . (omega x c)", Values::Constant(1, x[0] * u.dot(w.cross(c)))},
               {"1/2 m |omega x c|^2", Values::Constant(1, x[0] * w.cross(c).squaredNorm() / 2)},
               {"1/2 omega . I_C omega", Values::Constant(1, w.dot(matrix_at(x, 4) * w) / 2)}};
     }}};

/// The errors of wrong results, and the terms there.
struct WrongSums {
  std::vector<Values> errors;
  std::vector<Terms> terms, others;
  std::vector<double> theta;  ///< |phi| of the arguments, or 0
};
WrongSums wrong_sums(const Formula& f, const Operation& operation, const std::vector<JudgedCall>& calls) {
  WrongSums all;
  const std::vector<PartPlace> places = places_of({operation.arguments.begin(), operation.arguments.size()});
  const auto phi = std::ranges::find(places, "phi", [](const PartPlace& p) { return p.part->name; });
  for (const JudgedCall& c : calls) {
    const auto part = [&](const Numbers& x) {
      return Values(Eigen::Map<const Values>(x.data(), std::ssize(x)).segment(f.from, f.size));
    };
    if (std::ssize(c.right) < f.from + f.size || c.call.result.size() != c.right.size()) continue;
    const Values right = part(c.right), error = part(c.call.result) - right;
    // What cancels in the sum, or is tiny beside other terms, tells nothing.
    if (!error.allFinite() || !(error.norm() > 1e-6 * right.norm())) continue;
    Terms terms = f.terms(c.call.arguments);
    double largest = 0;
    for (const auto& [name, value] : terms) largest = std::max(largest, value.norm());
    if (terms.empty() || !(error.norm() > 1e-9 * largest) || !(largest < 1e100)) continue;
    all.errors.push_back(error), all.terms.push_back(std::move(terms));
    all.others.push_back(f.others ? f.others(c.call.arguments) : Terms());
    all.theta.push_back(phi == places.end() ? 0 : vector_at(c.call.arguments, phi->from).norm());
  }
  return all;
}

/// The factor by which a term must be multiplied to be the error of four of five results, and of four at least, and by which
/// share these factors differ; 0 if there is none.
std::pair<double, double> factor_of(const WrongSums& wrong, std::size_t term) {
  std::vector<double> factors;
  for (std::size_t i = 0; i < wrong.errors.size(); ++i) {
    const Values &error = wrong.errors[i], &T = wrong.terms[i][term].second;
    const double factor = error.dot(T) / T.squaredNorm();
    if ((error - factor * T).norm() < 0.01 * error.norm()) factors.push_back(factor);
  }
  const std::size_t most = (4 * wrong.errors.size() + 4) / 5;
  if (factors.size() < std::max<std::size_t>(most, 4)) return {};
  std::ranges::sort(factors);
  const double middle = factors[factors.size() / 2];
  std::ranges::sort(factors, {}, [&](double x) { return std::fabs(x - middle); });
  const double apart = std::fabs(factors[most - 1] / middle - 1);
  return apart < 0.01 ? std::pair(middle, apart) : std::pair(0.0, 0.0);
}
/// Whether a term is multiplied by a power of theta.
bool has_power(const WrongSums& wrong, std::size_t term, int power) {
  std::size_t given = 0;
  for (std::size_t i = 0; i < wrong.errors.size(); ++i) {
    const Values change = (std::pow(wrong.theta[i], power) - 1) * wrong.terms[i][term].second;
    given += (wrong.errors[i] - change).norm() < 0.01 * wrong.errors[i].norm();
  }
  return given >= 4 && 5 * given >= 4 * wrong.errors.size();
}
/// Whether another term stands in place of one.
bool replaced(const WrongSums& wrong, std::size_t term, const std::vector<Terms>& by, std::size_t other) {
  std::size_t given = 0;
  for (std::size_t i = 0; i < wrong.errors.size(); ++i) {
    const Values change = by[i][other].second - wrong.terms[i][term].second;
    given += (wrong.errors[i] - change).norm() < 0.01 * wrong.errors[i].norm();
  }
  return given >= 4 && 5 * given >= 4 * wrong.errors.size();
}

/// The term of which the errors are a multiple, and the factor; 0 if they are one of none. Of terms that are nearly proportional, that whose factors
/// differ least.
std::pair<std::size_t, double> multiple_of_term(const WrongSums& wrong) {
  std::size_t term = 0;
  double k = 0, least = 1;
  for (std::size_t t = 0; t < wrong.terms.front().size(); ++t)
    if (const auto [factor, apart] = factor_of(wrong, t); factor != 0 && apart < least)
      term = t, k = factor, least = apart;
  return {term, k};
}
/// The term that a power of theta multiplies, or in whose place another one stands, in words; or "".
std::string exchanged_term(const WrongSums& wrong) {
  const Terms& terms = wrong.terms.front();
  for (std::size_t t = 0; t < terms.size(); ++t)
    for (const int power : {1, -1, 2, -2})
      if (has_power(wrong, t, power))
        return fmt::format("where it fails, the term {} is theta{} times the right one", terms[t].first,
                           power == 1 ? "" : fmt::format("^{}", power));
  for (std::size_t t = 0; t < terms.size(); ++t)
    for (const auto* by : {&wrong.terms, &wrong.others})
      for (std::size_t o = 0; o < by->front().size(); ++o)
        if ((by != &wrong.terms || o != t) && replaced(wrong, t, *by, o))
          return fmt::format("where it fails, {} stands in place of {}", by->front()[o].first,
                             terms[t].first);
  return "";
}

}  // namespace

std::string wrong_term_of(const Operation& operation, const std::vector<JudgedCall>& calls) try {
  std::vector<WrongSums> sums;  // one for each way to write the formula
  for (const Formula& f : formulas)
    if (operation.name == f.operation)
      if (WrongSums wrong = wrong_sums(f, operation, calls); wrong.errors.size() >= 4)
        sums.push_back(std::move(wrong));
  // Errors may be a multiple of a term in several of them; a simple factor tells in which.
  constexpr std::pair<double, const char*> simple[] = {
      {-1, "is left out"}, {-2, "has the opposite sign"}, {1, "is counted twice"}};
  for (const auto& [factor, text] : simple)
    for (const WrongSums& wrong : sums)
      if (const auto [term, k] = multiple_of_term(wrong); std::fabs(k - factor) < 0.01)
        return fmt::format("where it fails, the term {} {}", wrong.terms.front()[term].first, text);
  for (const WrongSums& wrong : sums)
    if (const auto [term, k] = multiple_of_term(wrong); k != 0)
      return fmt::format("where it fails, the term {} has {:.3g} times its factor",
                         wrong.terms.front()[term].first, 1 + k);
  for (const WrongSums& wrong : sums)
    if (std::string text = exchanged_term(wrong); !text.empty()) return text;
  return "";
} catch (const std::exception&) {  // the oracle does not know these arguments
  return "";
}

}  // namespace liecheck::properties
