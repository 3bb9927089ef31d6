#include <fmt/format.h>
#include <bounds/bounds.hpp>
#include <bounds/box.hpp>
#include <bounds/hunted.hpp>
#include <budgets/budgets.hpp>
#include <mutex>
#include <optional>
#include <queue>
#include <support/stop.hpp>
#include <support/threads.hpp>

namespace liecheck::properties {

namespace {

/// The error of a result: one column of coefficients for each symbol.
using Columns = std::vector<std::vector<Interval>>;

template <class Results>
Columns columns_of(const Results& results) {
  const auto size = static_cast<std::size_t>(results.size());
  Columns all(static_cast<std::size_t>(BoxFacts::current().symbols), std::vector<Interval>(size));
  for (std::size_t i = 0; i < size; ++i)
    for (const auto& t : results.data()[i].error()) all[static_cast<std::size_t>(t.symbol)][i] = t.c;
  std::erase_if(
      all, [](const auto& c) { return std::all_of(c.begin(), c.end(), [](auto& v) { return v.is(0); }); });
  return all;
}

/// An upper bound of |sum_k e_k c_k| over |e_k| <= 1: with c_k = m_k + r_k, m_k the middle,
///     |sum e_k m_k|^2 = sum_kl e_k e_l m_k . m_l <= sum_kl |m_k . m_l|,
/// and the radii add up entry by entry.
double largest_norm(const Columns& columns) {
  if (columns.empty()) return 0;
  const std::size_t size = columns.front().size();
  std::vector<double> middles(columns.size() * size), radii(size);
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (std::size_t i = 0; i < size; ++i)
      middles[k * size + i] = columns[k][i].middle(), radii[i] += columns[k][i].radius();
  double sum = 0, radius = 0;
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (std::size_t l = 0; l <= k; ++l) {
      double dot = 0;
      for (std::size_t i = 0; i < size; ++i) dot += middles[k * size + i] * middles[l * size + i];
      sum += (l < k ? 2 : 1) * std::fabs(dot);
    }
  for (const double r : radii) radius += r * r;
  return (std::sqrt(sum) + std::sqrt(radius)) * (1 + 0x1p-40);  // and the roundings of these sums
}

/// The columns of the rotation error of a quaternion: 2 |E - Q (Q . E)|.
Columns of_quaternion(const Columns& columns, const std::array<Interval, 4>& Q) {
  Columns out = columns;
  for (auto& c : out) {
    Interval along = 0;
    for (std::size_t i = 0; i < 4; ++i) along = along + Q[i] * c[i];
    for (std::size_t i = 0; i < 4; ++i) c[i] = Interval(2) * (c[i] - Q[i] * along);
  }
  return out;
}
/// The columns of the rotation error of a matrix R with error E, to first order 1/2 sum_j r_j x E_j for its columns. What is left
/// is below |E|^2.
Columns of_matrix(const Columns& columns, const Matrix3<Bounded>& R) {
  Columns out;
  for (const auto& c : columns) {
    std::vector<Interval> v(3);
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        v[i] = v[i] + Interval(0.5) * (R(a, j).exact() * c[3 * j + b] - R(b, j).exact() * c[3 * j + a]);
      }
    out.push_back(v);
  }
  return out;
}

struct Proof {
  std::string operation, block, inputs;
  bool relative = false;                    ///< to theta: its boxes become small with theta
  bool two_signs = false;                   ///< phi and -phi have different errors
  bool second = false;                      ///< the input has a second vector
  std::function<double(const Box&)> bound;  ///< of the error [1]
};

double of_vector(const Columns& c, double norm_squared) {
  if (!(norm_squared > 0)) throw Undecided("the norm of the result");
  return largest_norm(c) / std::sqrt(norm_squared) * (1 + 0x1p-40);
}

double exp3_quaternion_bound(const Box& b) {
  const BoxGeometry g(b);
  const auto Q = quaternion::exp3<Bounded>(g.phi).to_vector();
  std::array<Interval, 4> exact;
  for (int i = 0; i < 4; ++i) exact[i] = Q[i].exact();
  const Columns c = columns_of(Q);
  Columns twice = c;
  for (auto& k : twice)
    for (auto& v : k) v = Interval(2) * v;
  return std::min(largest_norm(of_quaternion(c, exact)), largest_norm(twice)) + 0x1p-100;
}
double exp3_matrix_bound(const Box& b) {
  const BoxGeometry g(b);
  const auto R = exp3<Bounded>(g.phi);
  const Columns c = columns_of(R);
  return std::min(largest_norm(of_matrix(c, R)), largest_norm(c) / std::sqrt(2)) + 0x1p-100;
}
double exp6_bound(const Box& b) {
  const BoxGeometry g(b);
  const auto T = exp6<Bounded>(Motion<Bounded>(g.rho, g.phi));
  const Interval c1 = stumpff_function(1, g.half);
  return of_vector(columns_of(T.translation()), g.mixed(1, square(c1)));
}
double jacobian_bound(const Box& b) {
  const BoxGeometry g(b);
  const Interval c1 = stumpff_function(1, g.half);
  return of_vector(columns_of(leftJacobian<Bounded>(g.phi)), (Interval(1) + Interval(2) * square(c1)).low);
}
double inverse_jacobian_bound(const Box& b) {
  const BoxGeometry g(b);
  const Interval c1 = stumpff_function(1, g.half);
  return of_vector(columns_of(leftJacobianInverse<Bounded>(g.phi)),
                   (Interval(1) + Interval(2) / square(c1)).low);
}
/// The coupling block for rho = m: (c1 - c2) [n] + theta (c2 - c3) [n]^2 along n, and across c2 [m] + c3 theta (n m^T + m n^T).
/// These four are orthogonal, and their squared norms have the factor 2.
double coupling_bound(const Box& b) {
  const BoxGeometry g(b);
  const Matrix6<Bounded> J = leftJacobian<Bounded>(Motion<Bounded>(g.rho, g.phi));
  const Interval c1 = stumpff_function(1, g.x), c2 = stumpff_function(2, g.x), c3 = stumpff_function(3, g.x);
  const Interval along = square(c1 - c2) + g.x * square(c2 - c3), across = square(c2) + g.x * square(c3);
  return of_vector(columns_of(Matrix3<Bounded>(J.topRightCorner<3, 3>())),
                   g.mixed(Interval(2) * along, Interval(2) * across));
}
/// As above: -1/2 [n] + theta c3 / c1(x/4)^2 [n]^2 along n, and across -1/2 [m] + d theta (n m^T + m n^T).
double inverse_coupling_bound(const Box& b) {
  const BoxGeometry g(b);
  const Matrix6<Bounded> J = leftJacobianInverse<Bounded>(Motion<Bounded>(g.rho, g.phi));
  const Interval half1 = stumpff_function(1, g.half), half2 = stumpff_function(2, g.half),
                 half3 = stumpff_function(3, g.half), c3 = stumpff_function(3, g.x),
                 d = (half2 - half3) / (Interval(4) * half1);
  const Interval along = Interval(0.25) + g.x * square(c3 / square(half1)),
                 across = Interval(0.25) + g.x * square(d);
  return of_vector(columns_of(Matrix3<Bounded>(J.topRightCorner<3, 3>())),
                   g.mixed(Interval(2) * along, Interval(2) * across));
}
/// theta is that of the quaternion, sin(theta/2) = theta/2 c_1(theta^2/4), with a norm that is off 1 by up to 8 eps.
double log3_quaternion_bound(const Box& b) {
  const BoxGeometry g(b);
  constexpr double off = 8 * 0x1p-52;
  const Interval norm(1 - off, 1 + off), sine = g.theta / Interval(2) * stumpff_function(1, g.half) * norm,
                                         cosine = intersection(stumpff_function(0, g.half) * norm, {0, 2});
  BoxFacts& facts = BoxFacts::current();
  facts.squares = {{7u, square(sine)}};
  facts.norm_excess = Interval::around_zero(2.1 * off);
  Vector4<Bounded> Q;
  for (int i = 0; i < 3; ++i) Q[i] = Bounded::input(sine * g.n[i], i);
  Q[3] = Bounded::input(cosine, 3);
  return of_vector(columns_of(quaternion::log3<Bounded>(SO3<Bounded>(Q))), square(g.theta).low) + 0x1p-90;
}

const std::vector<Proof>& proofs() {
  static const std::string rotations = "every phi with theta <= pi, and 0",
                           twists = rotations + "; each number of rho 0 or 1e-270 .. 1e270 in magnitude",
                           quaternions = "every quaternion with | |Q| - 1 | <= 8 eps and 1e-270 <= |v|";
  static const std::vector<Proof> all = {
      {"exp3_quaternion", "rotation", rotations, false, false, false, exp3_quaternion_bound},
      {"exp3_matrix", "rotation", rotations, false, false, false, exp3_matrix_bound},
      {"exp6", "translation", twists, false, true, true, exp6_bound},
      {"log3_quaternion", "rotation vector", quaternions, true, false, false, log3_quaternion_bound},
      {"left_jacobian3", "jacobian", rotations, false, false, false, jacobian_bound},
      {"left_jacobian3_inverse", "jacobian", rotations, false, false, false, inverse_jacobian_bound},
      {"left_jacobian6", "coupling", twists, false, true, true, coupling_bound},
      {"left_jacobian6_inverse", "coupling", twists, false, true, true, inverse_coupling_bound},
  };
  return all;
}
constexpr double pi_rounded_up = 0x1.921fb54442d19p1;

/// The first boxes, which cover all inputs. A mirror M with M phi = -phi on one axis pair and the sign of rho change no
/// rounding error, so that one octant of phi (two_signs: and its opposite) and a half space of rho suffice.
std::vector<Box> first_boxes(const Proof& proof) {
  std::vector<double> angles;
  if (proof.relative) {
    // Below 2^-30, all numbers but those that are proportional to phi are the same.
    for (int e = -30; e <= 1; ++e)
      for (int k = 0; k < 4; ++k) angles.push_back(std::ldexp(1 + 0.25 * k, e));
    std::erase_if(angles, [](double a) { return a >= 3; });
  } else {
    angles = {0, 0x1p-20, 0x1p-10, 0x1p-5, 0x1p-2, 0.5, 1, 1.5, 2, 2.5};
  }
  angles.push_back(pi_rounded_up);
  std::vector<Box> all;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i)
    for (int face = 0; face < 3; ++face)
      for (int sign = 1; sign >= (proof.two_signs ? -1 : 1); sign -= 2)
        for (int face2 = 0; face2 < (proof.second ? 3 : 1); ++face2) {
          Box b;
          b.phi = {face, sign}, b.rho = {face2, 1};
          b.p = {Interval(angles[i], angles[i + 1]), Interval(0, 1), Interval(0, 1), 0, 0};
          if (proof.second) b.p[s_rho] = b.p[t_rho] = {-1, 1};
          all.push_back(b);
        }
  return all;
}

/// eps; infinity if the box is too large for a bound.
double bound_of(const Proof& proof, const Box& box) {
  try {
    const double b = proof.bound(box) / 0x1p-52;
    return std::isnan(b) ? std::numeric_limits<double>::infinity() : b;
  } catch (const Undecided&) {
    return std::numeric_limits<double>::infinity();
  }
}

struct BoundedBox {
  double bound;
  Box box;
  bool operator<(const BoundedBox& o) const { return bound < o.bound; }
};

/// The two halves of a box along the parameter that matters most. The bounds grow with the width of a box, at
/// pi about five times as much with the angle, and 2.5 times with the axis, as with the direction of rho.
std::array<BoundedBox, 2> halves(const Proof& proof, const Box& box, std::uint64_t& evaluated) {
  const std::array<double, parameters> weights{5 * (proof.relative ? 3 / box.p[angle].high : 1), 2.5, 2.5, 1,
                                               1};
  std::size_t widest = 0;
  const auto width = [&](std::size_t k) { return weights[k] * (box.p[k].high - box.p[k].low); };
  for (std::size_t k = 1; k < parameters; ++k)
    if (width(k) > width(widest)) widest = k;
  std::array<BoundedBox, 2> two{BoundedBox{0, box}, BoundedBox{0, box}};
  two[0].box.p[widest].high = two[1].box.p[widest].low = box.p[widest].middle();
  for (BoundedBox& b : two) b.bound = bound_of(proof, b.box), ++evaluated;
  return two;
}

const Proof& proof_of(const std::string& operation) {
  const auto at =
      std::find_if(proofs().begin(), proofs().end(), [&](auto& p) { return p.operation == operation; });
  if (at == proofs().end())
    throw std::invalid_argument(fmt::format("--operation: '{}' has no proof; known: {}", operation,
                                            fmt::join(proved_operations(), ", ")));
  return *at;
}

/// `told(boxes, bound)` is called now and then.
ProvedBound prove(const Proof& proof, const BoundOptions& options,
                  const std::function<void(std::uint64_t, double)>& told) {
  ProvedBound result = statement_of(proof.operation);
  std::priority_queue<BoundedBox> queue;
  for (const Box& b : first_boxes(proof)) queue.push({bound_of(proof, b), b}), ++result.boxes;
  while (result.boxes < options.boxes && queue.top().bound > options.wanted && !stop_requested) {
    const Box worst = queue.top().box;
    queue.pop();
    for (const BoundedBox& b : halves(proof, worst, result.boxes)) queue.push(b);
    if (result.boxes % 512 < 2) told(result.boxes, queue.top().bound);
  }
  result.bound = queue.top().bound;
  result.worst = queue.top().box.text();
  return result;
}

}  // namespace

std::vector<std::string> proved_operations() {
  std::vector<std::string> names;
  for (const Proof& p : proofs()) names.push_back(p.operation);
  return names;
}

ProvedBound statement_of(const std::string& operation) {
  const Proof& proof = proof_of(operation);
  ProvedBound b;
  b.operation = proof.operation, b.block = proof.block, b.inputs = proof.inputs;
  b.hunted = largest_error_of_hard_cases(proof.operation, proof.block);
  b.limit = budget_in(budgets("liecheck"), proof.operation, proof.block, Region::to_pi).limit;
  return b;
}

void prove_bounds(const BoundOptions& options, const std::function<void(const ProvedBound&)>& done) {
  std::vector<const Proof*> chosen;
  for (const std::string& name : options.operations.empty() ? proved_operations() : options.operations)
    chosen.push_back(&proof_of(name));
  std::vector<std::optional<ProvedBound>> results(chosen.size());
  std::size_t next = 0, told = 0;
  std::uint64_t evaluated = 0;
  std::mutex mutex;
  run_on_threads(std::min<unsigned>(options.jobs, static_cast<unsigned>(chosen.size())), stop_requested, [&] {
    for (;;) {
      std::unique_lock lock(mutex);
      const std::size_t mine = next++;
      if (mine >= chosen.size() || stop_requested) return;
      lock.unlock();
      std::uint64_t before = 0;
      const ProvedBound bound = prove(*chosen[mine], options, [&](std::uint64_t boxes, double so_far) {
        const std::lock_guard guard(mutex);
        evaluated += boxes - before, before = boxes;
        if (options.progress)
          options.progress(
              static_cast<double>(evaluated) / static_cast<double>(options.boxes * chosen.size()),
              chosen[mine]->operation, so_far);
      });
      lock.lock();
      results[mine] = bound;
      while (told < results.size() && results[told]) done(*results[told++]);
    }
  });
}

double bound_at(const std::string& operation, const std::array<double, 3>& phi,
                const std::array<double, 3>& rho) {
  const auto at =
      std::find_if(proofs().begin(), proofs().end(), [&](auto& p) { return p.operation == operation; });
  const auto cell = [](const std::array<double, 3>& v, Interval& s, Interval& t) {
    int face = 0;
    for (int k = 1; k < 3; ++k)
      if (std::fabs(v[k]) > std::fabs(v[face])) face = k;
    const auto around = [](double x) { return Interval(x - 1e-14, x + 1e-14); };
    s = around(v[(face + 1) % 3] / v[face]), t = around(v[(face + 2) % 3] / v[face]);
    return Directions{face, v[face] < 0 ? -1 : 1};
  };
  Box b;
  b.phi = cell(phi, b.p[s_phi], b.p[t_phi]);
  b.rho = cell(rho, b.p[s_rho], b.p[t_rho]);
  const double theta = std::sqrt(phi[0] * phi[0] + phi[1] * phi[1] + phi[2] * phi[2]);
  b.p[angle] = {theta * (1 - 1e-14), std::min(theta * (1 + 1e-14), pi_rounded_up)};
  return bound_of(*at, b);
}

}  // namespace liecheck::properties
