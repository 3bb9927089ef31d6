#include <failures/single_numbers.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <conventions/values.hpp>
#include <failures/relations.hpp>
#include <iterator>
#include <numbers>
#include <oracles/orientations.hpp>
#include <oracles/scalar.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

constexpr std::size_t least = 4;  ///< calls, which tell something

/// For each number of a result the largest number of its part: of a pose (R, p), (p, Q) or of a block of 3 x 3 numbers.
Numbers sizes_of(const Numbers& right) {
  const std::size_t n = right.size();
  std::vector<std::size_t> parts = n == 12  ? std::vector<std::size_t>{9, 3}
                                   : n == 7 ? std::vector<std::size_t>{3, 4}
                                            : std::vector<std::size_t>{n};
  if (n == 36) parts = {9, 9, 9, 9};
  Numbers sizes;
  for (const std::size_t part : parts) {
    double largest = 0;
    for (std::size_t i = 0; i < part; ++i) largest = std::max(largest, std::fabs(right[sizes.size() + i]));
    sizes.insert(sizes.end(), part, largest);
  }
  return sizes;
}

/// The error of each number by the size of its part, of a quaternion with the nearer sign; empty of a result that is right to a
/// millionth, or not finite.
Numbers errors_of(const JudgedCall& c) {
  const Numbers &got = c.call.result, &right = c.right;
  if (got.size() != right.size() || !std::ranges::all_of(got, [](double x) { return std::isfinite(x); }))
    return {};
  const Numbers sizes = sizes_of(right);
  Numbers errors(got.size()), opposite(got.size());
  for (std::size_t i = 0; i < got.size(); ++i)
    if (sizes[i] > 1e-30)
      errors[i] = std::fabs(got[i] - right[i]) / sizes[i],
      opposite[i] = std::fabs(got[i] + right[i]) / sizes[i];
  // Either sign of a quaternion is right: the one with which more of its numbers are, or else the nearer one.
  const auto right_numbers = [](const Numbers& e) {
    return std::ranges::count_if(e, [](double x) { return x < 1e-9; });
  };
  if (got.size() == 4 && std::pair(right_numbers(opposite), -std::ranges::max(opposite)) >
                             std::pair(right_numbers(errors), -std::ranges::max(errors)))
    errors = opposite;
  return std::ranges::max(errors) > 1e-6 ? errors : Numbers();
}

/// The names of the numbers of a result.
std::vector<std::string> names_of(const Operation& operation) {
  std::vector<std::string> all;
  if (operation.results.size() != 1) return all;
  for (const Part& part : operation.results[0]->parts)
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::max(part.size, 0)); ++i)
      all.push_back(conventions::number_name(part, i));
  if (all.size() != 36) return all;
  std::vector<std::string> in_blocks;  // as calls have them
  for (const std::size_t corner : {0, 3, 18, 21})
    for (std::size_t i = 0; i < 9; ++i) in_blocks.push_back(all[corner + i / 3 * 6 + i % 3]);
  return in_blocks;
}

/// Whether nine of ten wrong results are those of `other`, and four at least.
template <class Other>
bool given(const std::vector<JudgedCall>& calls, Other other) {
  std::size_t wrong = 0, same = 0;
  for (const JudgedCall& c : calls) {
    if (stop_requested) return false;
    const Numbers errors = errors_of(c);
    if (errors.empty()) continue;
    ++wrong;
    try {
      const Numbers alternative = other(c), sizes = sizes_of(c.right);
      if (alternative.size() != errors.size()) continue;
      double apart = 0;
      for (std::size_t i = 0; i < errors.size(); ++i) {
        const double with_sign = std::fabs(c.call.result[i] - alternative[i]),
                     opposite = std::fabs(c.call.result[i] + alternative[i]);
        if (sizes[i] > 1e-30)
          apart =
              std::max(apart, (errors.size() == 4 ? std::min(with_sign, opposite) : with_sign) / sizes[i]);
      }
      same += apart < 0.01 * std::ranges::max(errors);
    } catch (const std::exception&) {  // these arguments are none of the operation
    }
    if (10 * (wrong - same) > std::max<std::size_t>(wrong, 30)) return false;
  }
  return wrong >= least && 10 * same >= 9 * wrong;
}

}  // namespace

std::string other_order_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  if (operation.arguments[0]->name != "order") return "";
  constexpr int orders = 12;
  bool one_kind = false;
  std::string orders_of[2];  // of angles about axes that stay, and about turned ones
  for (const int kind : {0, 1}) {
    const std::vector<JudgedCall> some = calls_of_kind(calls, kind);
    one_kind = one_kind || some.size() == calls.size();
    for (int k = 0; k < orders && orders_of[kind].empty(); ++k)
      if (given(some, [&](const JudgedCall& c) {
            Numbers x = c.call.arguments;
            x[0] = 2 * k + kind;
            return exact(operation.name.data(), x);
          }))
        orders_of[kind] = oracles::Order(2 * k).name();
  }
  const auto& [fixed, rotating] = orders_of;
  if (rotating.empty() && fixed.empty()) return "";
  return fmt::format("where it fails, the result is that of the order {}",
                     one_kind || rotating == fixed ? fixed + (fixed.empty() ? rotating : "")
                     : fixed.empty()               ? rotating + ", rotating"
                     : rotating.empty()            ? fixed + ", static"
                                        : fmt::format("{}, rotating, or {}, static", rotating, fixed));
}

namespace {
/// A product of two rotations that overwrites one of them, number by number.
std::string matrix_in_place_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  if (operation.name != "compose") return "";
  constexpr std::size_t of_Y = 12;
  for (const std::size_t overwritten : {std::size_t(0), of_Y})
    if (given(calls, [&](const JudgedCall& c) {
          Numbers x = c.call.arguments, y = c.right;
          for (std::size_t i = 0; i < 9; ++i) {
            y[i] = 0;
            for (std::size_t k = 0; k < 3; ++k) y[i] += x[i / 3 * 3 + k] * x[of_Y + 3 * k + i % 3];
            x[overwritten + i] = y[i];
          }
          return y;
        }))
      return fmt::format(
          "the product of rotations is computed in place (aliasing): its first numbers overwrite those of "
          "the {} factor that the others need",
          overwritten == 0 ? "first" : "second");
  return "";
}
}  // namespace

std::string in_place_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  if (operation.results.size() != 1) return "";
  if (std::string text = matrix_in_place_of(operation, calls); !text.empty()) return text;
  struct Vector {
    std::string_view name;
    std::size_t from, size;
  };
  const auto vectors = [](const auto& layouts) {
    std::vector<Vector> all;
    std::size_t from = 0;
    for (const Layout* l : layouts)
      for (const Part& p : l->parts) {
        if (p.size == 3 || p.size == 4) all.push_back({p.name, from, static_cast<std::size_t>(p.size)});
        from += static_cast<std::size_t>(std::max(p.size, 0));
      }
    return all;
  };
  const std::vector<Vector> arguments = vectors(operation.arguments), results = vectors(operation.results);
  for (const Vector& to : results)
    for (const Vector& a : arguments)
      for (std::size_t k = 0; k <= arguments.size();
           ++k) {  // the product alone, or without what is added to it
        if (to.size != a.size ||
            (k < arguments.size() && (arguments[k].from == a.from || arguments[k].size != a.size)))
          continue;
        if (given(calls, [&](const JudgedCall& c) {
              Numbers x = c.call.arguments, y = c.right;
              for (std::size_t i = 0; i < to.size; ++i) {
                y[to.from + i] = exact(operation.name.data(), x).at(to.from + i);
                x[a.from + i] = y[to.from + i] - (k < arguments.size() ? x[arguments[k].from + i] : 0);
              }
              return y;
            }))
          return fmt::format(
              "{} is computed in place (aliasing): its first numbers overwrite those of {} that the others "
              "need",
              to.name, a.name);
      }
  return "";
}

std::string norm_power_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  struct Place {
    std::string name;
    std::size_t from;
  };
  std::vector<Place> quaternions, origins;  // what does not change with |Q|
  std::size_t n = 0;
  for (const Layout* l : operation.arguments)
    for (const Part& p : l->parts) {
      const std::string name(p.name == "Q" && l->parts.size() > 1 ? fmt::format("{}.Q", l->name) : p.name);
      if (p.size == 4) quaternions.push_back({name, n});
      if (p.size == 3) origins.push_back({name, n});
      n += static_cast<std::size_t>(std::max(p.size, 0));
    }
  const auto size = static_cast<std::size_t>(std::max(operation.results[0]->parts[0].size, 0));
  if (operation.results.size() != 1 || (size != 3 && size != 9)) return "";
  if (size == 9) origins = {{"R - 1", 0}};
  for (const Place& Q : quaternions) {
    const auto norm = [&Q](const JudgedCall& c) {
      const double* const q = c.call.arguments.data() + Q.from;
      return std::hypot(std::hypot(q[0], q[1], q[2]), q[3]);
    };
    std::vector<JudgedCall> ordinary;  // whose |Q|^2 neither overflows nor underflows
    std::ranges::copy_if(calls, std::back_inserter(ordinary),
                         [&](const JudgedCall& c) { return norm(c) > 1e-100 && norm(c) < 1e100; });
    for (const int power : {1, -1, 2, -2})
      for (std::size_t k = 0; k <= origins.size();
           ++k) {  // all of the result, and then its change of each origin
        if (!given(ordinary, [&](const JudgedCall& c) {
              const double factor = std::pow(norm(c), power);
              Numbers y = c.right;
              for (std::size_t i = 0; i < size; ++i) {
                const double origin = k == 0      ? 0
                                      : size == 3 ? c.call.arguments[origins[k - 1].from + i]
                                                  : static_cast<double>(i % 4 == 0);
                y[i] = origin + factor * (y[i] - origin);
              }
              return y;
            }))
          continue;
        const std::string times =
            fmt::format("|{}|{} times the right one", Q.name, power == 1 ? "" : fmt::format("^{}", power));
        if (k == 0) return fmt::format("where it fails, the result is {}", times);
        return size == 9 ? fmt::format("where it fails, R - 1 is {}: {} is not normalised", times, Q.name)
                         : fmt::format("the change of {} is {}", origins[k - 1].name, times);
      }
  }
  return "";
}

std::string wrong_numbers_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  const std::vector<std::string> names = names_of(operation);
  std::vector<std::size_t> wrong(names.size());
  std::vector<const JudgedCall*> judged;
  for (const JudgedCall& c : calls) {
    const Numbers errors = errors_of(c);
    if (errors.size() != names.size() || errors.empty()) continue;
    judged.push_back(&c);
    for (std::size_t i = 0; i < errors.size(); ++i) wrong[i] += errors[i] > 1e-3 * std::ranges::max(errors);
  }
  std::vector<std::size_t> those;
  for (std::size_t i = 0; i < wrong.size(); ++i)
    if (10 * wrong[i] > judged.size()) those.push_back(i);
  constexpr std::size_t most_named = 4, most_opposite = 8;
  if (judged.size() < least || those.empty() || 3 * those.size() > names.size() ||
      those.size() > most_opposite)
    return "";
  std::size_t from = 0;
  for (const Part& part : operation.results[0]->parts) {  // the block is named already
    const auto end = from + static_cast<std::size_t>(part.size);
    if (those.front() == from && those.size() == end - from && those.back() == end - 1) return "";
    from = end;
  }
  std::vector<std::string> text;
  for (const std::size_t i : those) text.push_back(names[i]);
  const auto exchanged = [&](const JudgedCall* c) {
    const double most = 0.01 * std::ranges::max(errors_of(*c)) * sizes_of(c->right)[those[0]];
    return std::fabs(c->call.result[those[0]] - c->right[those[1]]) < most &&
           std::fabs(c->call.result[those[1]] - c->right[those[0]]) < most;
  };
  if (those.size() == 2 && std::ranges::all_of(judged, exchanged))
    return fmt::format("where it fails, {} and {} are exchanged", text[0], text[1]);
  const auto opposite = [&](const JudgedCall* c) {
    const Numbers sizes = sizes_of(c->right);
    const double error = std::ranges::max(errors_of(*c));
    return std::ranges::all_of(those, [&](std::size_t i) {
      return std::fabs(c->call.result[i] + c->right[i]) < 0.01 * error * sizes[i];
    });
  };
  if (those.size() > 1 && std::ranges::all_of(judged, opposite))
    return fmt::format("where it fails, {} are of the opposite sign", fmt::join(text, ", "));
  if (those.size() > most_named) return "";
  return fmt::format("a wrong term, factor or sign in {}: the other numbers are right, or err far less",
                     fmt::join(text, " and "));
}

std::string constant_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  if (operation.results.size() != 1) return "";
  std::size_t from = 0;
  for (const Part& part : operation.results[0]->parts) {
    const auto size = static_cast<std::size_t>(std::max(part.size, 0));
    Numbers more;
    for (const JudgedCall& c : calls) {
      if (part.unit != "rad" || (size != 1 && size != 3) || c.call.result.size() < from + size) continue;
      double of_got = 0, of_right = 0, apart = 0;
      for (std::size_t i = from; i < from + size; ++i) {
        of_got = std::hypot(of_got, c.call.result[i]), of_right = std::hypot(of_right, c.right[i]);
        apart = std::hypot(apart, c.call.result[i] - c.right[i]);
      }
      // Rounding leaves less than 1e-12; a constant with two digits or more is off by less than a hundredth.
      if (!(apart > 1e-12 * std::max(of_right, 1.0)) || !(apart < 0.01)) continue;
      // Another direction is no other angle.
      if (std::fabs(of_got - of_right) < 0.99 * apart) return "";
      more.push_back(of_got - of_right);
    }
    from += size;
    if (more.size() < least) continue;
    std::ranges::sort(more);
    const double middle = more[more.size() / 2];
    const auto like = std::ranges::count_if(more, [&](double d) { return std::fabs(d / middle - 1) < 0.02; });
    if (10 * like < 9 * std::ssize(more)) continue;
    constexpr double pi = std::numbers::pi;
    const double pi_in_float = oracles::rounded_to_float(pi);
    std::string of;
    for (const double times : {0.5, 1.0, 2.0})
      for (int digits = 2; digits <= 11 && of.empty(); ++digits) {
        const double exact_number = times * pi, power = std::pow(10, digits);
        for (const double cut :
             {std::round(exact_number * power) / power, std::trunc(exact_number * power) / power})
          if (std::fabs(std::fabs(middle) / std::fabs(cut - exact_number) - 1) < 0.02)
            of = fmt::format(": {} in place of {}", cut, times == 1 ? "pi" : fmt::format("{} pi", times));
        if (std::fabs(std::fabs(middle) / (times * std::fabs(pi_in_float - pi)) - 1) < 0.02)
          of = fmt::format(": {} in float", times == 1 ? "pi" : fmt::format("{} pi", times));
      }
    return fmt::format("where it fails, the angle is {:.2g} rad too {}{}", std::fabs(middle),
                       middle > 0 ? "large" : "small", of);
  }
  return "";
}

std::string approximation_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  Numbers errors;
  for (const JudgedCall& c : calls) {
    if (c.call.result.size() != c.right.size()) continue;
    double size = 0, error = 0, opposite = 0;
    for (std::size_t i = 0; i < c.right.size(); ++i)
      size = std::max(size, std::fabs(c.right[i])),
      error = std::max(error, std::fabs(c.call.result[i] - c.right[i])),
      opposite = std::max(opposite, std::fabs(c.call.result[i] + c.right[i]));
    if (c.right.size() == 4) error = std::min(error, opposite);
    if (error > 1e-13 * size) errors.push_back(error / size);
  }
  constexpr std::size_t enough = 10;
  if (errors.size() < enough || operation.results.size() != 1) return "";
  std::ranges::sort(errors);
  const double most = errors[errors.size() * 9 / 10];
  if (!(most < 0.01)) return "";  // a wrong term or sign leaves less than two digits
  const auto digits = static_cast<int>(-std::log10(most));
  // A float rounds by 6e-8, and a dozen times in a formula: no result errs by more.
  return fmt::format(
      "an approximation: most results are right to {} digits, as those of {}", digits,
      most > 2e-9 && errors.back() < 1e-6
          ? "a step in float, of a series or an iteration that ends too early, or of a numerical derivative"
          : "a series or an iteration that ends too early, a numerical derivative, or a constant with few "
            "digits");
}

}  // namespace liecheck::properties
