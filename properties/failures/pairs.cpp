#include <failures/pairs.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <conventions/probe.hpp>
#include <conventions/reference.hpp>
#include <conventions/values.hpp>
#include <functional>
#include <limits>
#include <operations/quaternion_poses.hpp>
#include <span>

namespace liecheck::properties {

namespace {

using oracles::Real;

/// The numbers from..to of a result, a part of it. Q and -Q are one rotation, and at pi phi and -phi are, too.
void add_part(std::vector<NumberPair>& to, std::span<const double> got, std::span<const Real> exact,
              const std::function<std::string(std::size_t)>& name, bool either_sign) {
  Real size(0), along(0);
  bool finite = true;
  for (std::size_t i = 0; i < got.size(); ++i) {
    finite = finite && std::isfinite(got[i]);
    size += exact[i] * exact[i];
    if (finite) along += exact[i] * Real(got[i]);
  }
  size = sqrt(size);
  const bool opposite = either_sign && finite && along < 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    NumberPair p{name(i), got[i], opposite ? Real(-exact[i]) : exact[i]};
    p.apart = std::isfinite(got[i])
                  ? static_cast<double>(Real(abs(Real(got[i]) - p.exact) / (size > 0 ? size : 1)))
                  : std::numeric_limits<double>::infinity();
    to.push_back(p);
  }
}

bool is_axis_and_angle(const Layout& layout) {
  return layout.parts.size() == 2 && layout.parts[0].name == "axis" && layout.parts[1].name == "angle";
}

}  // namespace

bool is_judged(const Output& output, const Layout& layout, const Part& part) {
  // A rotation vector is the axis times the angle.
  if (is_axis_and_angle(layout)) return output.block != "norm defect" || part.size == 3;
  const auto with_unit = [&](std::string_view unit) {
    return std::ranges::any_of(layout.parts, [&](const Part& p) { return p.unit == unit; });
  };
  const std::string_view unit = output.definition->unit;
  if (with_unit(unit)) return part.unit == unit;
  return !with_unit("1") || part.unit == "1";
}

namespace {

/// The exact axis and angle, written as the computed ones are: (-n, -theta) and theta + 2 pi k are the same turn.
std::vector<Real> written_as(const std::vector<double>& got, std::vector<Real> exact) {
  if (!std::ranges::all_of(got, [](double x) { return std::isfinite(x); })) return exact;
  Real along(0);
  for (std::size_t i = 0; i < 3; ++i) along += Real(got[i]) * exact[i];
  if (along < 0)
    for (Real& x : exact) x = -x;
  static const Real turn = 2 * acos(Real(-1));
  exact[3] += turn * round(Real((Real(got[3]) - exact[3]) / turn));
  return exact;
}

/// The exact (rho, phi) on the side of pi where the computed phi is: at pi, both axes are right, each with its rho.
std::vector<Real> on_the_side_of(const std::vector<double>& got, std::vector<Real> exact,
                                 const Layout& layout) {
  if (is_axis_and_angle(layout)) return written_as(got, std::move(exact));
  const auto is = [](const Part& part, const char* unit) { return part.unit == unit && part.size == 3; };
  if (layout.parts.size() != 2 || !is(layout.parts[0], "m") || !is(layout.parts[1], "rad")) return exact;
  const auto rho = exact.begin(), phi = rho + 3;
  Real along(0), square(0);
  for (std::size_t i = 3; i < 6; ++i) {
    if (!std::isfinite(got[i])) return exact;
    along += Real(got[i]) * exact[i], square += exact[i] * exact[i];
  }
  if (along >= 0 || square < Real(9.8696)) return exact;
  const auto product = [](const std::vector<Real>& J, auto x) {
    std::vector<Real> y;
    for (std::size_t i = 0; i < 9; i += 3) y.push_back(J[i] * x[0] + J[i + 1] * x[1] + J[i + 2] * x[2]);
    return y;
  };
  const auto jacobian = [&](const char* name) {
    return conventions::exact_result(conventions::operation_named(name), {phi, exact.end()});
  };
  const std::vector<Real> p = product(jacobian("left_jacobian3"), rho);
  for (auto x = phi; x != exact.end(); ++x) *x = -*x;
  std::ranges::copy(product(jacobian("left_jacobian3_inverse"), p.begin()), rho);
  return exact;
}

/// x, y, z, w with the norm whose square is the factor of R, and w >= 0 (Shepperd 1978).
template <class T>
std::vector<Real> quaternion_of(const T& R) {
  Real square(0);
  for (std::size_t i = 0; i < 9; ++i) square += Real(R[i]) * Real(R[i]);
  const Real size = sqrt(Real(square / 3));  // |Q|^2
  const auto at = [&](std::size_t i, std::size_t j) { return Real(R[3 * i + j]); };
  std::vector<Real> four{size + at(0, 0) - at(1, 1) - at(2, 2), size - at(0, 0) + at(1, 1) - at(2, 2),
                         size - at(0, 0) - at(1, 1) + at(2, 2), size + at(0, 0) + at(1, 1) + at(2, 2)};
  const auto most = static_cast<std::size_t>(std::ranges::max_element(four) - four.begin());
  std::vector<Real> Q(4, Real(0));
  Q[most] = four[most];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (most == 3) Q[i] = at(k, j) - at(j, k);
    if (most == i) Q[j] = at(i, j) + at(j, i), Q[k] = at(i, k) + at(k, i), Q[3] = at(k, j) - at(j, k);
  }
  Real norm(0);
  for (const Real& x : Q) norm += x * x;
  const Real factor = sqrt(Real(size / norm)) * (Q[3] < 0 ? -1 : 1);
  for (Real& x : Q) x *= factor;
  return Q;
}

/// The numbers of p, or of Q, or how far |Q|^2 is from 1.
std::vector<NumberPair> pairs_of_pose(const Output& output, const NotedCall& call,
                                      const std::vector<Real>& exact) {
  std::vector<NumberPair> all;
  const bool own = call.operation == output.record;
  if (!own || output.block == "translation")
    add_part(
        all, std::span(call.result).last(3), std::span(exact).last(3),
        [](std::size_t i) { return fmt::format("p[{}]", i); }, false);
  if (own && output.block == "translation") return all;
  const std::vector<Real> Q = quaternion_of(call.result);
  std::vector<double> got;
  for (const Real& x : Q) got.push_back(static_cast<double>(x));
  if (own && output.block.ends_with("defect")) {
    Real square(0);
    for (const Real& x : Q) square += x * x;
    add_part(
        all, std::vector{static_cast<double>(square)}, std::vector{Real(1)},
        [](std::size_t) { return std::string("|Q|^2"); }, false);
  } else {
    add_part(
        all, got, quaternion_of(exact), [](std::size_t i) { return fmt::format("Q.{}", "xyzw"[i]); }, true);
  }
  return all;
}

}  // namespace

bool is_in_block(const Output& output, std::size_t size, std::size_t i) {
  if ((size != 36 && size != 81) || output.operation.starts_with("robot_") ||
      (output.block != "coupling" && output.block != "jacobian"))
    return true;
  const bool upper = size == 81 ? i / 9 < 6 && i % 9 >= 6 : i / 6 < 3 && i % 6 >= 3,
             coupling = output.operation == "coadjoint" ? i / 6 >= 3 && i % 6 < 3 : upper;
  return coupling == (output.block == "coupling");
}

std::vector<NumberPair> pairs_of(const Output& output, const NotedCase& noted, const NotedCall& call,
                                 const std::vector<Real>& one_side) {
  const bool finite = std::ranges::all_of(call.result, [](double x) { return std::isfinite(x); });
  if (noted.quaternion_poses && is_pose(*call.operation->results[0]) && finite && one_side.size() == 12)
    return pairs_of_pose(output, call, one_side);
  const Layout& layout = *call.operation->results[0];
  const std::vector<Real> exact =
      noted.wrong_branch ? one_side : on_the_side_of(call.result, one_side, layout);
  std::vector<NumberPair> all;
  std::size_t from = 0;
  for (const Part& part : layout.parts) {
    const auto size = static_cast<std::size_t>(part.size);
    const auto got = std::span(call.result).subspan(from, size);
    const auto right = std::span(exact).subspan(from, size);
    from += size;
    // A wrong branch may be seen in another part of the result: a rotation vector that is too long, whatever rho is.
    if (call.operation == output.record && !noted.wrong_branch && !is_judged(output, layout, part)) continue;
    Real square(0);
    for (const Real& x : right) square += x * x;
    const bool turned = part.unit == "rad" && size == 3 && part.name != "angles" && !noted.wrong_branch &&
                        square > Real(9.8696);
    add_part(
        all, got, right, [&](std::size_t i) { return conventions::number_name(part, i); },
        (size == 4 && part.unit == "1" && call.operation->name != "normalize") || turned);
  }
  if (call.operation == output.record)
    std::erase_if(all, [&, i = std::size_t(0), size = all.size()](const NumberPair& pair) mutable {
      return !is_in_block(output, size, i++) && std::isfinite(pair.got);  // a NaN makes all blocks one
    });
  return all;
}

const FormedNumbers* formed_numbers(const Output& output) {
  static constexpr FormedNumbers all[] = {
      {"tree_momentum_map", "", "(A_g v)", "v"},          {"frame_jacobian", "", "(J v)", "v"},
      {"frame_jacobian_rate", "", "(J a + dJ v)", "v a"}, {"rnea_derivatives", "by q", "(dtau_dq d)", "d"},
      {"rnea_derivatives", "by v", "(dtau_dv d)", "d"},   {"aba_derivatives", "by q", "(da_dq d)", "d"},
      {"aba_derivatives", "by v", "(da_dv d)", "d"},      {"momentum_conserved", "", "tau_base", ""}};
  const auto* const at = std::ranges::find_if(all, [&](const FormedNumbers& f) {
    return f.operation == output.operation && (f.block.empty() || f.block == output.block);
  });
  return at == std::end(all) ? nullptr : at;
}

std::vector<NumberPair> pairs_of_law(const Output& output, const NotedComparison& compared) {
  std::vector<double> computed;
  for (const Real& x : compared.computed) computed.push_back(static_cast<double>(x));
  const Layout& layout = *output.record->results[0];
  const auto own = std::ranges::find_if(layout.parts, [&](const Part& part) {
    return is_judged(output, layout, part) && static_cast<std::size_t>(part.size) == computed.size();
  });
  const Part& part = own == layout.parts.end() ? layout.parts[0] : *own;
  const FormedNumbers* const formed = formed_numbers(output);
  const std::string_view name = formed ? formed->name : part.name;
  const std::size_t first = formed && output.block == "angular" ? 3 : 0;
  const std::size_t columns =
      part.size == nv_by_nv
          ? static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(computed.size()))))
          : 0;
  std::vector<NumberPair> all;
  add_part(
      all, computed, compared.exact,
      [&](std::size_t i) {
        return columns ? fmt::format("{}[{},{}]", name, i / columns, i % columns)
                       : fmt::format("{}[{}]", name, first + i);
      },
      false);
  return all;
}

}  // namespace liecheck::properties
