#include <failures/part_changes.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <conventions/values.hpp>
#include <numbers>

namespace liecheck::properties {

namespace {

void transpose(Span m) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(m.size())));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < i; ++k) std::swap(m[i * n + k], m[k * n + i]);
}

}  // namespace

std::vector<PartPlace> places_of(std::span<const Layout* const> layouts) {
  std::vector<PartPlace> all;
  std::size_t from = 0;
  for (const Layout* l : layouts)
    for (const Part& p : l->parts) {
      const auto size = static_cast<std::size_t>(std::max(p.size, 0));
      all.push_back({l, &p, from, size});
      from += size;
    }
  return all;
}

std::string name_of(const PartPlace& place, const std::vector<PartPlace>& all) {
  const auto alike =
      std::ranges::count(all, place.part->name, [](const PartPlace& p) { return p.part->name; });
  return alike > 1 ? fmt::format("{} of {}", place.part->name, place.layout->name)
                   : std::string(place.part->name);
}
std::string number_of(const PartPlace& place, std::size_t i, const std::vector<PartPlace>& all) {
  const std::string name = conventions::number_name(*place.part, i), part(place.part->name);
  return name + name_of(place, all).substr(part.size());
}
bool is_quaternion(const PartPlace& p) {
  return p.size == 4 && p.part->name.starts_with("Q");
}

namespace {
template <class Whole>
void add_changes_of_vector(const PartPlace& at, const std::string& name, const Whole& whole) {
  const auto length = [](Span x) { return std::hypot(x[0], x[1], x[2]); };
  if (at.part->unit == "rad") {
    whole("the right one with its angle brought into [-pi, pi]",
          name + " with its angle brought into [-pi, pi]", [length](Span x) {
            const double angle = length(x), wrapped = std::remainder(angle, 2 * std::numbers::pi);
            for (double& v : x) v = angle == 0 ? v : v * (wrapped / angle);
          });
    whole("the right one with its angle cut off at pi", name + " with its angle cut off at pi",
          [length](Span x) {
            const double angle = length(x);
            for (double& v : x) v = angle > std::numbers::pi ? v * (std::numbers::pi / angle) : v;
          });
    whole("the right one with pi, not 2 pi, taken from an angle above pi",
          name + " with pi, not 2 pi, taken from an angle above pi", [length](Span x) {
            const double angle = length(x);
            for (double& v : x) v = angle > std::numbers::pi ? v * (1 - std::numbers::pi / angle) : v;
          });
  }
  whole("right but for the signs of its numbers, which are lost",
        name + " with the absolute values of its numbers", [](Span x) {
          for (double& v : x) v = std::fabs(v);
        });
  whole("in the opposite order", name + " in the opposite order", [](Span x) { std::ranges::reverse(x); });
}
template <class Whole>
void add_changes_of_matrix(const std::string& name, const Whole& whole) {
  const auto add = [&](const char* as_result, const std::string& as_argument, double factor) {
    whole(as_result, as_argument, [factor](Span x) {
      for (std::size_t i = 0; i < 9; ++i) x[i] *= i % 4 == 0 ? 1 : factor;
    });
  };
  add("right but for the numbers beside the diagonal, which are 0",
      name + " without what is beside its diagonal", 0);
  add("right but for the numbers beside the diagonal, which are of the opposite sign",
      name + " with what is beside its diagonal of the opposite sign", -1);
}
}  // namespace

void add_changes(const PartPlace& at, const std::vector<PartPlace>& all, bool of_result,
                 std::vector<PartChange>& changes) {
  const std::string name = name_of(at, all);
  const auto add = [&](std::string text, auto change) {
    changes.push_back({std::move(text), [at, change](Numbers& x) { change(at.in(x)); }});
  };
  const auto whole = [&](const std::string& as_result, const std::string& as_argument, auto change) {
    add(of_result ? as_result : as_argument, change);
  };
  const auto number = [&](std::size_t i, const std::string& as_result, const std::string& as_argument,
                          auto change) {
    const std::string one = number_of(at, i, all);
    add(of_result ? fmt::format("right but for {}, which is {}", one, as_result)
                  : fmt::format(fmt::runtime(as_argument), one),
        change);
  };
  if (at.part->name == "order")
    return add("the same axes, static for rotating or rotating for static,",
               [](Span x) { x[0] += static_cast<int>(x[0]) % 2 == 0 ? 1 : -1; });
  if (at.size == 9 || at.size == 36) whole("the transposed one", name + " transposed", transpose);
  if (is_quaternion(at)) {
    number(3, "its absolute value", "|{0}| in place of {0}", [](Span x) { x[3] = std::fabs(x[3]); });
    whole("the identity (0, 0, 0, 1)", name + " = (0, 0, 0, 1)",
          [](Span x) { std::ranges::fill(x, 0.0), x[3] = 1; });
    whole("the conjugate of the right one", name + " conjugated, which is the inverse rotation,",
          [](Span x) { x[0] = -x[0], x[1] = -x[1], x[2] = -x[2]; });
    whole("in the order w, x, y, z", name + " in the order w, x, y, z",
          [](Span x) { std::ranges::rotate(x, x.end() - 1); });
  }
  whole("0", name + " = 0", [](Span x) { std::ranges::fill(x, 0.0); });
  if (at.size == 1 && of_result) {  // more than the opposite, which it is where it is wrong
    whole("the absolute value of the right one", name, [](Span x) { x[0] = std::fabs(x[0]); });
    whole("minus the absolute value of the right one", name, [](Span x) { x[0] = -std::fabs(x[0]); });
  }
  whole("the opposite of the right one", "-" + name, [](Span x) {
    for (double& v : x) v = -v;
  });
  if (at.size == 1) {
    if (at.part->unit == "rad")
      whole("2 pi more or less than the right one: it is not brought into [-pi, pi]",
            name + " beyond [-pi, pi]",
            [](Span x) { x[0] += x[0] > 0 ? -2 * std::numbers::pi : 2 * std::numbers::pi; });
    if (at.part->unit == "rad")
      whole("off by pi", name + " with pi, not 2 pi, taken from it beyond [-pi, pi]", [of_result](Span x) {
        if (of_result || std::fabs(x[0]) > std::numbers::pi)
          x[0] += x[0] > 0 ? -std::numbers::pi : std::numbers::pi;
      });
    whole("its absolute value", "|" + name + "|", [](Span x) { x[0] = std::fabs(x[0]); });
    whole("1", name + " = 1", [](Span x) { x[0] = 1; });
    for (const double factor : {2.0, 0.5})
      whole(fmt::format("{} times the right one", factor), fmt::format("{} {}", factor, name),
            [factor](Span x) { x[0] *= factor; });
    return;
  }
  for (const double factor : {2.0, 0.5})
    whole(factor == 2 ? "twice the right one" : "half of the right one",
          fmt::format("{} {}", factor == 2 ? "2" : "1/2", name), [factor](Span x) {
            for (double& v : x) v *= factor;
          });
  if (at.size == 3) add_changes_of_vector(at, name, whole);
  if (at.size == 9) add_changes_of_matrix(name, whole);
  for (std::size_t i = 0; i < at.size; ++i) {
    number(i, "0", "{} = 0", [i](Span x) { x[i] = 0; });
    number(i, "its absolute value", "|{0}| in place of {0}", [i](Span x) { x[i] = std::fabs(x[i]); });
    if (of_result && at.part->name == "angles")
      number(i, "off by pi, as atan(y / x) is in place of atan2(y, x)", "",
             [i](Span x) { x[i] += x[i] > 0 ? -std::numbers::pi : std::numbers::pi; });
    number(i, "of the opposite sign", "{} of the opposite sign", [i](Span x) { x[i] = -x[i]; });
    if (at.size > 9) continue;
    for (std::size_t k = 0; k < at.size; ++k) {
      if (k == i) continue;
      const std::string other = number_of(at, k, all);
      number(i, "the right " + other, other + " in place of {}", [i, k](Span x) { x[i] = x[k]; });
      if (of_result) number(i, "-" + other, "", [i, k](Span x) { x[i] = -x[k]; });
      if (k < i)
        number(i, fmt::format("exchanged with {}", other), other + " and {} exchanged",
               [i, k](Span x) { std::swap(x[i], x[k]); });
    }
  }
}
void add_exchanges(const std::vector<PartPlace>& all, std::vector<PartChange>& changes) {
  // Arguments of several parts, such as two poses.
  for (std::size_t i = 0; i < all.size();) {
    std::size_t next = i, size = 0;
    for (; next < all.size() && all[next].layout == all[i].layout; ++next) size += all[next].size;
    std::size_t of_next = 0;
    for (std::size_t k = next; k < all.size() && all[k].layout == all[next].layout; ++k)
      of_next += all[k].size;
    if (next - i > 1 && size == of_next)
      changes.push_back({fmt::format("{} and {} exchanged", all[i].layout->name, all[next].layout->name),
                         [from = all[i].from, size](Numbers& x) {
                           const Span both = Span(x).subspan(from, 2 * size);
                           std::ranges::swap_ranges(both.first(size), both.last(size));
                         }});
    const bool of_vectors = std::all_of(all.begin() + static_cast<std::ptrdiff_t>(i),
                                        all.begin() + static_cast<std::ptrdiff_t>(next),
                                        [](const PartPlace& p) { return p.size <= 3; });
    if (next - i > 1 && of_vectors)  // a tangent of two parts
      changes.push_back({fmt::format("-{}", all[i].layout->name), [from = all[i].from, size](Numbers& x) {
                           for (double& v : Span(x).subspan(from, size)) v = -v;
                         }});
    i = next;
  }
  for (const PartPlace& a : all)
    for (const PartPlace& b : all) {
      if (a.from == b.from || a.size != b.size) continue;
      const std::string one = name_of(a, all), other = name_of(b, all);
      if (a.from < b.from)
        changes.push_back({fmt::format("{} and {} exchanged", one, other),
                           [a, b](Numbers& x) { std::ranges::swap_ranges(a.in(x), b.in(x)); }});
      changes.push_back({fmt::format("{} in place of {}", other, one),
                         [a, b](Numbers& x) { std::ranges::copy(b.in(x), a.in(x).begin()); }});
    }
}

}  // namespace liecheck::properties
