#include <generators/input_classes.hpp>

#include <algorithm>
#include <generators/rotations.hpp>

namespace liecheck::properties {

namespace {

// Each list is in the order of the bits below.
const std::vector<InputClass> vectors = {{"zero", 80},
                                         {"minus zero", 60},
                                         {"along an axis", 60},
                                         {"unit scale", 4},
                                         {"below 1/32", 60},
                                         {"above 32", 60},
                                         {"1e-150, in float 1e-18", 150, Reach::full},
                                         {"1e150, in float 1e18", 150, Reach::full},
                                         {"equal to the previous one", 20, Reach::beside},
                                         {"near the previous one", 20, Reach::beside},
                                         {"squares underflow", 200, Reach::full},
                                         {"squares overflow", 200, Reach::full}};
const std::vector<InputClass> rotation_vectors = {{"zero", 50},
                                                  {"subnormal", 60},
                                                  {"theta^2 underflows", 80},
                                                  {"theta < 1e-3", 8},
                                                  {"within 4 ulp of a cutoff", 15},
                                                  {"generic", 45},
                                                  {"pi - theta < 1e-3", 15},
                                                  {"within 4 ulp of pi", 30},
                                                  {"beyond pi", 10, Reach::full},
                                                  {"near 2 pi k", 30, Reach::full},
                                                  {"huge", 60, Reach::full},
                                                  {"along an axis", 20},
                                                  {"nearly along an axis", 40},
                                                  {"in a coordinate plane", 20}};
const std::vector<InputClass> quaternions = {{"identity", 45},
                                             {"near the identity", 20},
                                             {"theta = pi", 125},
                                             {"near theta = pi", 30},
                                             {"-Q: w < 0", 4},
                                             {"about an axis", 40},
                                             {"off unit by 3 to 8 eps", 30},
                                             {"subnormal part", 1000},
                                             {"equal to the previous one", 20, Reach::beside},
                                             {"minus the previous one", 60, Reach::beside},
                                             {"near the previous one", 6, Reach::beside},
                                             {"relative angle near pi", 15, Reach::beside}};
const std::vector<InputClass> any_quaternions = {{"identity", 45},
                                                 {"near the identity", 20},
                                                 {"theta = pi", 125},
                                                 {"near theta = pi", 30},
                                                 {"-Q: w < 0", 4},
                                                 {"about an axis", 40},
                                                 {"off unit by 3 to 8 eps", 200},
                                                 {"subnormal part", 1000},
                                                 {"equal to the previous one", 60, Reach::beside},
                                                 {"minus the previous one", 200, Reach::beside},
                                                 {"near the previous one", 6, Reach::beside},
                                                 {"relative angle near pi", 20, Reach::beside},
                                                 {"norm 1 +- 1e-6", 30},
                                                 {"norm 0.9 to 1.1", 30},
                                                 {"norm 3 to 30", 30},
                                                 {"norm below 1e-6 or above 1e6", 30},
                                                 {"norm near underflow", 30},
                                                 {"norm near overflow", 30}};
const std::vector<InputClass> matrices = {{"identity", 45},
                                          {"near the identity", 20},
                                          {"theta = pi", 125},
                                          {"near theta = pi", 30},
                                          {"about an axis", 40}};
const std::vector<InputClass> inertias = {
    {"point", 16}, {"sphere", 16}, {"needle", 8}, {"plate", 16}, {"general", 5}};
const std::vector<InputClass> positives = {
    {"simple", 4}, {"ratio below 1e-12, in float 1e-2", 14}, {"ratio above 1e12, in float 1e2", 14}};
const std::vector<InputClass> directions = {{"along an axis", 24},
                                            {"in a coordinate plane", 30},
                                            {"equal to the previous one", 40, Reach::beside},
                                            {"opposite to the previous one", 40, Reach::beside},
                                            {"near the previous one", 12, Reach::beside},
                                            {"nearly opposite to the previous one", 12, Reach::beside},
                                            {"at a right angle to the previous one", 60, Reach::beside}};
const std::vector<InputClass> fractions = {{"0", 16},          {"1", 16},           {"1/2", 30},
                                           {"below 1e-3", 10}, {"above 0.999", 10}, {"between", 3}};
const std::vector<InputClass> plane_angles = {{"one is zero", 16},
                                              {"one within 4 ulp of a multiple of pi/2", 8},
                                              {"one within 1e-3 of a multiple of pi/2", 6},
                                              {"one below 1e-3", 12},
                                              {"all between", 24}};
const std::vector<InputClass> trees = {{"one joint", 10},          {"chain of 3 and more", 10},
                                       {"star of 3 and more", 12}, {"several roots", 6},
                                       {"4 joints deep", 20},      {"3 children of one parent", 10}};
const std::vector<InputClass> joints = {{"revolute", 4},    {"continuous", 4}, {"prismatic", 4},
                                        {"helical", 4},     {"spherical", 4},  {"planar", 4},
                                        {"translation", 4}, {"free-flyer", 4}, {"mimic", 25}};
const std::vector<InputClass> masses = {{"ratio up to 2", 3}, {"ratio above 1e12, in float 100", 50}};
const std::vector<InputClass> none;

constexpr std::uint32_t bit(bool condition, int i) {
  return condition ? 1u << i : 0u;
}

/// double for float, so that squares do not overflow. Other scalars are first divided by a large element.
template <class S>
using Wide = std::conditional_t<std::is_same_v<S, float>, double, S>;

template <class S>
S largest(std::span<const S> x) {
  using std::fabs;
  S m(0);
  for (const S& v : x) m = std::max(m, S(fabs(v)));
  return m;
}
template <class S>
int zeros(std::span<const S> x) {
  return static_cast<int>(std::count(x.begin(), x.end(), S(0)));
}
template <class S>
bool equal(std::span<const S> x, std::span<const S> y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end());
}

template <class S>
std::uint32_t of_vector(std::span<const S> x, std::span<const S> earlier) {
  using std::fabs, std::ldexp, std::signbit;
  static const S small = ldexp(S(1), -5), large = ldexp(S(1), 5), low = ldexp(S(1), 4 - widest<S>),
                 high = ldexp(S(1), widest<S> - 4), sixteenth = ldexp(S(1), -4), sixteen = ldexp(S(1), 4),
                 least_square = ldexp(S(1), std::numeric_limits<S>::min_exponent / 2),
                 largest_square = ldexp(S(1), std::numeric_limits<S>::max_exponent / 2);
  const S m = largest(x);
  const bool minus_zero = std::any_of(x.begin(), x.end(), [](const S& v) { return v == S(0) && signbit(v); });
  std::uint32_t c = bit(m == S(0), 0) | bit(minus_zero, 1) |
                    bit(m > S(0) && zeros(x) + 1 == int(x.size()), 2) |
                    bit(m >= sixteenth && m <= sixteen, 3) | bit(m > S(0) && m < small, 4) |
                    bit(m > large, 5) | bit(m > S(0) && m <= low, 6) | bit(m >= high, 7) |
                    bit(m > S(0) && m < least_square, 10) | bit(m > largest_square, 11);
  if (!earlier.empty()) {
    S d(0);
    for (std::size_t i = 0; i < x.size(); ++i) d = std::max(d, S(fabs(S(x[i] - earlier[i]))));
    c |= bit(equal(x, earlier), 8) | bit(d > S(0) && d < largest(earlier) / S(1000), 9);
  }
  return c;
}

template <class S>
std::uint32_t of_rotation_vector(std::span<const S> x, std::span<const S>) {
  using std::fabs, std::sqrt;
  using W = Wide<S>;
  static const W pi = boost::math::constants::pi<W>(), ulp4 = W(8) * W(std::numeric_limits<S>::epsilon()),
                 thousandth = W(1) / W(1000), tenth = W(1) / W(10);
  static const S smallest = std::numeric_limits<S>::min(), root = S(sqrt(std::numeric_limits<S>::min()));
  static const std::vector<W> cutoffs = [] {
    std::vector<W> all(common_cutoffs<S>().begin(), common_cutoffs<S>().end());
    std::sort(all.begin(), all.end());
    return all;
  }();
  const S m = largest(x);
  if (m == S(0)) return bit(true, 0);
  W sum(0);
  for (const S& v : x) sum += W(v) / W(m) * (W(v) / W(m));
  const W theta = W(m) * W(sqrt(sum));
  const auto near = [&](const W& c) { return W(fabs(W(theta - c))) <= ulp4 * c; };
  const auto above = std::lower_bound(cutoffs.begin(), cutoffs.end(), theta);
  const bool beside =
      (above != cutoffs.end() && near(*above)) || (above != cutoffs.begin() && near(*(above - 1)));
  bool near_2pi_k = false;
  if (theta > W(6) && theta < W(100)) {
    const W periods = theta / (W(2) * pi);
    near_2pi_k = W(fabs(W(periods - W(static_cast<int>(periods + W(1) / W(2)))))) * W(6) < tenth;
  }
  int tiny = 0;
  for (const S& v : x) tiny += S(fabs(v)) < m / S(1 << 10);
  return bit(m < smallest, 1) | bit(m >= smallest && m < root, 2) | bit(theta < thousandth, 3) |
         bit(beside, 4) | bit(theta > W(1) && theta < W(2), 5) |
         bit(theta < pi && pi - theta < thousandth, 6) | bit(near(pi), 7) | bit(theta > pi + tenth, 8) |
         bit(near_2pi_k, 9) | bit(theta > W(100), 10) | bit(zeros(x) == 2, 11) |
         bit(zeros(x) < 2 && tiny == 2, 12) | bit(zeros(x) == 1, 13);
}

template <class S>
std::uint32_t of_quaternion(std::span<const S> q, std::span<const S> earlier) {
  using std::fabs;
  using W = long double;
  static const S millionth = S(1) / S(1000000), thousandth = S(1) / S(1000);
  static const W eps = W(std::numeric_limits<S>::epsilon());
  const auto v = q.template first<3>();
  const S m = largest<S>(v), w = S(fabs(q[3]));
  W norm2(0);
  for (const S& c : q) norm2 += W(c) * W(c);
  const W defect = W(fabs(W(norm2 - W(1))));
  const bool subnormal = std::any_of(q.begin(), q.end(), [](const S& c) {
    return c != S(0) && S(fabs(c)) < std::numeric_limits<S>::min() * S(16);
  });
  std::uint32_t c = bit(m == S(0), 0) | bit(m > S(0) && m < millionth, 1) | bit(w == S(0), 2) |
                    bit(w > S(0) && w < millionth, 3) | bit(q[3] < S(0), 4) | bit(zeros<S>(v) == 2, 5) |
                    bit(defect > W(3) * eps && defect <= W(8) * eps, 6) | bit(subnormal, 7);
  if (!earlier.empty()) {
    S minus(0), plus(0), dot(0);
    for (std::size_t i = 0; i < 4; ++i) {
      minus = std::max(minus, S(fabs(S(q[i] - earlier[i]))));
      plus = std::max(plus, S(fabs(S(q[i] + earlier[i]))));
      dot += q[i] * earlier[i];
    }
    const S d = std::min(minus, plus);
    c |= bit(minus == S(0), 8) | bit(plus == S(0), 9) | bit(d > S(0) && d < thousandth, 10) |
         bit(S(fabs(dot)) < thousandth, 11);
  }
  return c;
}

/// The classes of Q/|Q|, and those of |Q|.
template <class S>
std::uint32_t of_any_quaternion(std::span<const S> q, std::span<const S> earlier) {
  using std::fabs, std::ldexp, std::sqrt;
  constexpr int least = std::numeric_limits<S>::min_exponent, most = std::numeric_limits<S>::max_exponent;
  static const S low = S(ldexp(S(1), least + 6)), high = S(ldexp(S(1), most - 12)), million = S(1000000);
  std::array<S, 8> unit;
  std::array<S, 2> norm{};  // of q and of the earlier one, at most the largest number of S
  for (std::size_t k = 0; k < (earlier.empty() ? 1 : 2); ++k) {
    const std::span<const S> x = k == 0 ? q : earlier;
    const S m = largest(x);
    S sum(0);
    for (const S& v : x) sum += v / m * (v / m);
    const S root = S(sqrt(sum));
    norm[k] = S(m / S(2)) * root > std::numeric_limits<S>::max() / S(2) ? m : S(m * root);
    for (std::size_t i = 0; i < 4; ++i) unit[4 * k + i] = S(x[i] / m / root);
  }
  const std::span<const S> units(unit);
  const std::uint32_t off = bit(true, 6),
                      c = of_quaternion<S>(units.template first<4>(),
                                           earlier.empty() ? earlier : units.template last<4>());
  const S n = norm[0], apart = S(fabs(S(n - S(1))));
  const bool moderate = n > low && n < high;
  return (c & ~off) | (of_quaternion<S>(q, {}) & off) |
         bit(apart <= S(1) / million && apart > S(4) * std::numeric_limits<S>::epsilon(), 12) |
         bit(apart <= S(1) / S(10) && apart > S(10) / million, 13) | bit(n >= S(3) && n <= S(30), 14) |
         bit(moderate && (n < S(1) / million || n > million), 15) | bit(n <= low, 16) | bit(n >= high, 17);
}

template <class S>
std::uint32_t of_matrix(std::span<const S> R, std::span<const S>) {
  using std::fabs;
  static const S thousandth = S(1) / S(1000);
  S off(0);
  for (std::size_t k : {1, 2, 3, 5, 6, 7}) off = std::max(off, S(fabs(R[k])));
  const S trace = R[0] + R[4] + R[8];
  const bool symmetric = R[1] == R[3] && R[2] == R[6] && R[5] == R[7];
  const bool axis = R[0] == S(1) || R[4] == S(1) || R[8] == S(1);
  return bit(off == S(0) && trace == S(3), 0) | bit(off > S(0) && off < thousandth, 1) |
         bit(symmetric && trace < S(0), 2) | bit(!symmetric && S(trace + S(1)) < thousandth, 3) |
         bit(axis && trace < S(3), 4);
}

/// The class follows from the rank, 0 to 3, of the second moment of mass tr(I)/2 - I. I: xx xy yy xz yz zz.
template <class S>
std::uint32_t of_inertia(std::span<const S> I, std::span<const S>) {
  using std::fabs;
  using W = Wide<S>;
  const W trace = W(I[0]) + W(I[2]) + W(I[5]);
  if (trace == W(0)) return bit(true, 0);
  const W tolerance = W(64) * W(std::numeric_limits<S>::epsilon());
  const auto second = [&](int k, bool diagonal) {
    return (diagonal ? W(1) / W(2) : W(0)) - W(I[static_cast<std::size_t>(k)]) / trace;
  };
  const W xx = second(0, true), yy = second(2, true), zz = second(5, true);
  const W xy = second(1, false), xz = second(3, false), yz = second(4, false);
  const W minors = xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz;
  const W determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  const bool sphere = I[0] == I[2] && I[2] == I[5] && I[1] == S(0) && I[3] == S(0) && I[4] == S(0);
  const bool needle = W(fabs(minors)) <= tolerance, plate = !needle && W(fabs(determinant)) <= tolerance;
  return bit(sphere || W(fabs(W(minors - W(1) / W(12)))) <= tolerance, 1) | bit(needle, 2) | bit(plate, 3) |
         bit(!needle && !plate, 4);
}

template <class S>
std::uint32_t of_positive(std::span<const S> number, std::span<const S>) {
  const S& x = number[0];
  static const S low = std::is_same_v<S, float> ? S(1) / S(100) : S(1) / S(1000000000000ll);
  return bit(x >= S(1) && x <= S(16) && x == S(static_cast<int>(x)), 0) | bit(x < low, 1) |
         bit(x > S(1) / low, 2);
}

template <class S>
std::uint32_t of_parents(std::span<const S> parents, std::span<const S>) {
  int joints = 0, deepest = 0, widest_of = 0, roots = 0;
  std::array<int, 64> depth{}, children{};
  for (const S& p : parents) {
    const int parent = static_cast<int>(p), i = joints;
    if (parent < -1 || i >= 64) break;
    ++joints;
    depth[static_cast<std::size_t>(i)] = parent < 0 ? 1 : depth[static_cast<std::size_t>(parent)] + 1;
    deepest = std::max(deepest, depth[static_cast<std::size_t>(i)]);
    if (parent < 0)
      ++roots;
    else
      widest_of = std::max(widest_of, ++children[static_cast<std::size_t>(parent)]);
  }
  const bool star = joints >= 3 && roots == 1 && deepest == 2;
  return bit(joints == 1, 0) | bit(joints >= 3 && deepest == joints, 1) | bit(star, 2) | bit(roots > 1, 3) |
         bit(deepest >= 4, 4) | bit(widest_of >= 3 || roots >= 3, 5);
}
template <class S>
std::uint32_t of_direction(std::span<const S> x, std::span<const S> earlier) {
  using std::fabs;
  static const S near = S(1) / S(1000), rounding = S(8) * std::numeric_limits<S>::epsilon();
  const int others = static_cast<int>(x.size()) - zeros(x);
  const std::uint32_t c = bit(others == 1, 0) | bit(others == 2, 1);
  if (earlier.empty()) return c;
  S minus(0), plus(0), dot(0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    minus = std::max(minus, S(fabs(S(x[i] - earlier[i]))));
    plus = std::max(plus, S(fabs(S(x[i] + earlier[i]))));
    dot += x[i] * earlier[i];
  }
  return c | bit(minus == S(0), 2) | bit(plus == S(0), 3) | bit(minus > S(0) && minus < near, 4) |
         bit(plus > S(0) && plus < near, 5) | bit(S(fabs(dot)) < rounding, 6);
}
template <class S>
std::uint32_t of_fraction(std::span<const S> x, std::span<const S>) {
  static const S small = S(1) / S(1000);
  const S t = x[0], rest = S(1) - t;
  return bit(t == S(0), 0) | bit(t == S(1), 1) | bit(t + t == S(1), 2) | bit(t > S(0) && t < small, 3) |
         bit(rest > S(0) && rest < small, 4) | bit(t > small && rest > small, 5);
}
template <class S>
std::uint32_t of_angle(std::span<const S> x, std::span<const S>) {
  using std::fabs;
  using W = long double;
  static const W quarter = boost::math::constants::half_pi<W>(), small = W(1) / W(1000),
                 ulps = W(16) * W(std::numeric_limits<S>::epsilon());
  std::uint32_t c = 0;
  bool between = true;
  for (const S& angle : x) {
    const W size = W(fabs(angle)),
            beside = std::min(W(fabs(W(size - quarter))), W(fabs(W(size - 2 * quarter))));
    c |= bit(angle == S(0), 0) | bit(beside < ulps, 1) | bit(beside >= ulps && beside < small, 2) |
         bit(size > W(0) && size < small, 3);
    between = between && size > small && beside > small;
  }
  return c | bit(between, 4);
}
/// x: the kinds of all joints, then their primaries.
template <class S>
std::uint32_t of_joints(std::span<const S> x, std::span<const S>) {
  std::uint32_t c = 0;
  for (std::size_t i = 0; i < x.size() / 2; ++i) {
    const int kind = static_cast<int>(x[i]);
    if (kind >= 0) c |= bit(true, x[x.size() / 2 + i] >= S(0) ? 8 : kind);
  }
  return c;
}
template <class S>
std::uint32_t of_masses(std::span<const S> x, std::span<const S>) {
  static const S large = std::is_same_v<S, float> ? S(100) : S(1000000000000ll);
  S low(0), high(0);
  for (const S& m : x)
    if (m > S(0)) low = low > S(0) ? std::min(low, m) : m, high = std::max(high, m);
  return bit(high <= S(2) * low, 0) | bit(high / large > low, 1);
}

}  // namespace

const std::vector<InputClass>& classes_of(Kind kind) {
  static const std::vector<InputClass>* const in_the_order_of_kinds[] = {
      &vectors, &rotation_vectors, &quaternions, &any_quaternions, &matrices, &inertias, &positives, &none,
      &none,    &directions,       &fractions,   &plane_angles,    &trees,    &joints,   &masses,
      &none,    &none};
  static_assert(std::size(in_the_order_of_kinds) == kind_count);
  return *in_the_order_of_kinds[static_cast<std::size_t>(kind)];
}

bool requires_class(const Field& field, const InputClass& c) {
  return field.reach != Reach::any && (c.reach == Reach::limited || c.reach == field.reach) &&
         !(field.without >> (&c - classes_of(field.kind).data()) & 1);
}

template <class S>
std::uint32_t classify(Kind kind, std::span<const S> x, std::span<const S> earlier) {
  using Classifier = std::uint32_t(std::span<const S>, std::span<const S>);
  static constexpr Classifier* in_the_order_of_kinds[] = {
      of_vector,   of_rotation_vector, of_quaternion, of_any_quaternion, of_matrix,
      of_inertia,  of_positive,        nullptr,       nullptr,           of_direction,
      of_fraction, of_angle,           of_parents,    of_joints,         of_masses,
      nullptr,     nullptr};
  static_assert(std::size(in_the_order_of_kinds) == kind_count);
  Classifier* const of = in_the_order_of_kinds[static_cast<std::size_t>(kind)];
  return of ? of(x, earlier) : 0;
}

template std::uint32_t classify(Kind, std::span<const float>, std::span<const float>);
template std::uint32_t classify(Kind, std::span<const double>, std::span<const double>);

}  // namespace liecheck::properties
