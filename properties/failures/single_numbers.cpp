#include <failures/single_numbers.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <conventions/values.hpp>
#include <failures/relations.hpp>
#include <iterator>
#include <oracles/orientations.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

constexpr std::size_t least = 4;  ///< calls, which tell something

/// The error of each number, of a quaternion with the nearer sign; empty of a result that is right to a millionth, or not finite.
Numbers errors_of(const JudgedCall& c) {
  const Numbers &got = c.call.result, &right = c.right;
  if (got.size() != right.size() || !std::ranges::all_of(got, [](double x) { return std::isfinite(x); }))
    return {};
  Numbers errors(got.size()), opposite(got.size());
  double size = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    errors[i] = std::fabs(got[i] - right[i]), opposite[i] = std::fabs(got[i] + right[i]);
    size = std::max(size, std::fabs(right[i]));
  }
  if (got.size() == 4 && std::ranges::max(opposite) < std::ranges::max(errors)) errors = opposite;
  return std::ranges::max(errors) > 1e-6 * size && size > 1e-30 ? errors : Numbers();
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
      const Numbers alternative = other(c);
      if (alternative.size() != errors.size()) continue;
      double apart = 0;
      for (std::size_t i = 0; i < errors.size(); ++i) {
        const double with_sign = std::fabs(c.call.result[i] - alternative[i]),
                     opposite = std::fabs(c.call.result[i] + alternative[i]);
        apart = std::max(apart, errors.size() == 4 ? std::min(with_sign, opposite) : with_sign);
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
  for (int k = 0; k < orders; ++k)
    if (given(calls, [&](const JudgedCall& c) {
          Numbers x = c.call.arguments;
          x[0] = 2 * k + static_cast<int>(x[0]) % 2;
          return exact(operation.name.data(), x);
        }))
      return fmt::format("where it fails, the result is that of the order {}", oracles::Order(2 * k).name());
  return "";
}

std::string in_place_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  if (operation.results.size() != 1) return "";
  struct Vector {
    std::string_view name;
    std::size_t from;
  };
  const auto vectors = [](const auto& layouts) {
    std::vector<Vector> all;
    std::size_t from = 0;
    for (const Layout* l : layouts)
      for (const Part& p : l->parts) {
        if (p.size == 3) all.push_back({p.name, from});
        from += static_cast<std::size_t>(std::max(p.size, 0));
      }
    return all;
  };
  const std::vector<Vector> arguments = vectors(operation.arguments), results = vectors(operation.results);
  for (const Vector& to : results)
    for (const Vector& a : arguments)
      for (std::size_t k = 0; k <= arguments.size();
           ++k) {  // the product alone, or without what is added to it
        if (k < arguments.size() && arguments[k].from == a.from) continue;
        if (given(calls, [&](const JudgedCall& c) {
              Numbers x = c.call.arguments, y = c.right;
              for (std::size_t i = 0; i < 3; ++i) {
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
  std::size_t Q = 0, n = 0;  // where the quaternion starts, and the numbers of all arguments
  const Part* moved = nullptr;
  std::size_t at_moved = 0;
  for (const Layout* l : operation.arguments)
    for (const Part& p : l->parts) {
      if (p.size == 4) Q = n + 1;
      if (p.size == 3) moved = &p, at_moved = n;
      n += static_cast<std::size_t>(std::max(p.size, 0));
    }
  if (Q == 0 || operation.results.size() != 1 || operation.results[0]->parts[0].size != 3) return "";
  const auto norm = [Q](const JudgedCall& c) {
    const double* const q = c.call.arguments.data() + Q - 1;
    return std::hypot(std::hypot(q[0], q[1], q[2]), q[3]);
  };
  std::vector<JudgedCall> ordinary;  // whose |Q|^2 neither overflows nor underflows
  std::ranges::copy_if(calls, std::back_inserter(ordinary),
                       [&](const JudgedCall& c) { return norm(c) > 1e-100 && norm(c) < 1e100; });
  const auto times = [](int power) {
    return power == 1 ? "|Q| times the right one" : fmt::format("|Q|^{} times the right one", power);
  };
  for (const int power : {1, -1, 2, -2})
    for (const bool from_moved : {false, true}) {
      if (from_moved && !moved) continue;
      if (given(ordinary, [&](const JudgedCall& c) {
            const double factor = std::pow(norm(c), power);
            Numbers y = c.right;
            for (std::size_t i = 0; i < 3; ++i) {
              const double origin = from_moved ? c.call.arguments[at_moved + i] : 0;
              y[i] = origin + factor * (y[i] - origin);
            }
            return y;
          }))
        return from_moved ? fmt::format("the change of {} is {}", moved->name, times(power))
                          : fmt::format("where it fails, the result is {}", times(power));
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
    if (20 * wrong[i] > judged.size()) those.push_back(i);
  constexpr std::size_t most_named = 4;
  if (judged.size() < least || those.empty() || 3 * those.size() > names.size() || those.size() > most_named)
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
    const double most = 0.01 * std::ranges::max(errors_of(*c));
    return std::fabs(c->call.result[those[0]] - c->right[those[1]]) < most &&
           std::fabs(c->call.result[those[1]] - c->right[those[0]]) < most;
  };
  if (those.size() == 2 && std::ranges::all_of(judged, exchanged))
    return fmt::format("where it fails, {} and {} are exchanged", text[0], text[1]);
  return fmt::format("a wrong term, factor or sign in {}: the other numbers are right",
                     fmt::join(text, " and "));
}

}  // namespace liecheck::properties
