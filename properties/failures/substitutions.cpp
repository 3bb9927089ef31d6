#include <failures/substitutions.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <conventions/values.hpp>
#include <failures/relations.hpp>
#include <functional>
#include <invariants/tree_laws.hpp>
#include <numbers>
#include <span>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

using Span = std::span<double>;

/// A part of the arguments or of the result: its numbers start at `from`.
struct Place {
  const Layout* layout;
  const Part* part;
  std::size_t from, size;
  Span in(Numbers& x) const { return Span(x).subspan(from, size); }
  std::span<const double> in(const Numbers& x) const { return std::span(x).subspan(from, size); }
};
std::vector<Place> places_of(std::span<const Layout* const> layouts) {
  std::vector<Place> all;
  std::size_t from = 0;
  for (const Layout* l : layouts)
    for (const Part& p : l->parts) {
      const auto size = static_cast<std::size_t>(std::max(p.size, 0));
      all.push_back({l, &p, from, size});
      from += size;
    }
  return all;
}

/// A change of some numbers, in words.
struct Change {
  std::string text;
  std::function<void(Numbers&)> apply;
};

/// The name of a part among all: with its argument's name if another argument has a part of this name.
std::string name_of(const Place& place, const std::vector<Place>& all) {
  const auto alike = std::ranges::count(all, place.part->name, [](const Place& p) { return p.part->name; });
  return alike > 1 ? fmt::format("{} of {}", place.part->name, place.layout->name)
                   : std::string(place.part->name);
}
std::string number_of(const Place& place, std::size_t i, const std::vector<Place>& all) {
  const std::string name = conventions::number_name(*place.part, i), part(place.part->name);
  return name + name_of(place, all).substr(part.size());
}
bool is_quaternion(const Place& p) {
  return p.size == 4 && p.part->name.starts_with("Q");
}
void transpose(Span m) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(m.size())));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < i; ++k) std::swap(m[i * n + k], m[k * n + i]);
}

/// The changes of one part alone. Of a result, the text says what the part is; of an argument, what takes its place.
void add_changes(const Place& at, const std::vector<Place>& all, bool of_result,
                 std::vector<Change>& changes) {
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
    whole("the conjugate of the right one", name + " conjugated, which is the inverse rotation,",
          [](Span x) { x[0] = -x[0], x[1] = -x[1], x[2] = -x[2]; });
    whole("in the order w, x, y, z", name + " in the order w, x, y, z",
          [](Span x) { std::ranges::rotate(x, x.end() - 1); });
  }
  whole("0", name + " = 0", [](Span x) { std::ranges::fill(x, 0.0); });
  whole("the opposite of the right one", "-" + name, [](Span x) {
    for (double& v : x) v = -v;
  });
  if (at.size == 1) {
    whole("its absolute value", "|" + name + "|", [](Span x) { x[0] = std::fabs(x[0]); });
    for (const double factor : {2.0, 0.5})
      whole(fmt::format("{} times the right one", factor), fmt::format("{} {}", factor, name),
            [factor](Span x) { x[0] *= factor; });
    return;
  }
  if (at.size == 3)
    whole("in the opposite order", name + " in the opposite order", [](Span x) { std::ranges::reverse(x); });
  if (at.size == 9)
    whole("right but for the numbers beside the diagonal, which are 0",
          name + " without what is beside its diagonal", [](Span x) {
            for (std::size_t i = 0; i < 9; ++i) x[i] = i % 4 == 0 ? x[i] : 0;
          });
  for (std::size_t i = 0; i < at.size; ++i) {
    number(i, "0", "{} = 0", [i](Span x) { x[i] = 0; });
    number(i, "of the opposite sign", "{} of the opposite sign", [i](Span x) { x[i] = -x[i]; });
    if (at.size > 4) continue;
    for (std::size_t k = 0; k < at.size; ++k) {
      if (k == i) continue;
      const std::string other = number_of(at, k, all);
      number(i, "the right " + other, other + " in place of {}", [i, k](Span x) { x[i] = x[k]; });
      if (k < i)
        number(i, fmt::format("exchanged with {}", other), other + " and {} exchanged",
               [i, k](Span x) { std::swap(x[i], x[k]); });
    }
  }
}
/// Those of two parts of one size.
void add_exchanges(const std::vector<Place>& all, std::vector<Change>& changes) {
  for (const Place& a : all)
    for (const Place& b : all) {
      if (a.from == b.from || a.size != b.size) continue;
      const std::string one = name_of(a, all), other = name_of(b, all);
      if (a.from < b.from)
        changes.push_back({fmt::format("{} and {} exchanged", one, other),
                           [a, b](Numbers& x) { std::ranges::swap_ranges(a.in(x), b.in(x)); }});
      changes.push_back({fmt::format("{} in place of {}", other, one),
                         [a, b](Numbers& x) { std::ranges::copy(b.in(x), a.in(x).begin()); }});
    }
}

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
bool is_rotation(const Place& p) {
  return is_quaternion(p) || (p.size == 9 && p.part->name.starts_with("R"));
}

double apart(std::span<const double> a, std::span<const double> b, double sign = 1) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != sign * b[i]) sum = std::hypot(sum, a[i] - sign * b[i]);
  return sum;
}
double distance(const Place& at, const Numbers& a, const Numbers& b) {
  const double d = apart(at.in(a), at.in(b));
  return is_quaternion(at) ? std::min(d, apart(at.in(a), at.in(b), -1)) : d;
}
double size_of_part(const Place& at, const Numbers& x) {
  return apart(at.in(x), at.in(x), 0);
}

/// The result of 6x6 numbers as its four 3x3 blocks, one after another, since one may be far smaller than the others; else itself.
bool is_in_blocks(const Operation& operation) {
  return operation.results.size() == 1 && conventions::size_of(*operation.results[0]) == 36;
}
Numbers in_blocks(const Operation& operation, const Numbers& x) {
  if (!is_in_blocks(operation) || x.size() != 36) return x;
  Numbers all;
  for (const std::size_t corner : {0, 3, 18, 21})
    for (std::size_t i = 0; i < 9; ++i) all.push_back(x[corner + i / 3 * 6 + i % 3]);
  return all;
}
std::vector<Place> results_of(const Operation& operation) {
  static constexpr Part parts[] = {{"the upper left block", 9, ""},
                                   {"the upper right block", 9, ""},
                                   {"the lower left block", 9, ""},
                                   {"the lower right block", 9, ""}};
  if (!is_in_blocks(operation)) return places_of({operation.results.begin(), operation.results.size()});
  std::vector<Place> all;
  for (std::size_t i = 0; i < 4; ++i) all.push_back({operation.results[0], &parts[i], 9 * i, 9});
  return all;
}

/// So many wrong calls tell enough, and 100 changes of each are soon tried.
constexpr std::size_t enough = 12;

/// The wrong calls of an operation, and which parts of their results are wrong by more than a share.
class Wrong {
 public:
  Wrong(const Operation& operation, const std::vector<JudgedCall>& calls, double least)
      : results_(results_of(operation)) {
    for (const JudgedCall& c : calls) {
      if (!std::ranges::all_of(c.call.result, [](double x) { return std::isfinite(x); })) continue;
      std::vector<Place> wrong;
      for (const Place& p : results_) {
        const double scale = size_of_part(p, c.right);
        // Of a rotation nearer to pi than results must err to count, either sign is right.
        if (p.part->unit == "rad" && std::fabs(scale - std::numbers::pi) < least * std::numbers::pi) continue;
        // Numbers so small underflow in float, and in products, whatever else is wrong.
        if (scale < 1e-30 && size_of_part(p, c.call.result) < 1e-30) continue;
        // Of a tiny angle, a right formula may lose digits that are far below a millionth of a rad.
        if (!(distance(p, c.call.result, c.right) <= least * (p.size == 1 ? std::max(scale, 1.0) : scale)))
          wrong.push_back(p);
      }
      if (!wrong.empty() && calls_.size() < enough) calls_.push_back(&c), parts_.push_back(std::move(wrong));
    }
  }
  std::size_t count() const { return calls_.size(); }
  const std::vector<Place>& results() const { return results_; }

  /// Whether the results are those that `other` gives for all calls, or for four of five.
  bool of_all = true;
  template <class Other>
  bool given_by(Other other) const {
    if (stop_requested) return false;
    const std::size_t allowed = of_all ? 0 : count() / 5;
    std::size_t missed = 0;
    for (std::size_t i = 0; i < count(); ++i)
      if (!gives(i, other) && ++missed > allowed) return false;
    return true;
  }
  /// The parts that are wrong, in words, if they are the same ones in all calls.
  std::string subject() const {
    for (const auto& parts : parts_)
      if (parts.size() != parts_.front().size() || parts.front().from != parts_.front().front().from)
        return "the result";
    if (results_.size() == 1 || parts_.front().size() > 1) return "the result";
    return std::string(parts_.front().front().part->name);
  }

 private:
  template <class Other>
  bool gives(std::size_t i, Other other) const try {
    const Numbers& got = calls_[i]->call.result;
    const Numbers alternative = other(*calls_[i]);
    if (alternative.size() != got.size()) return false;
    const Numbers& right = calls_[i]->right;
    return std::ranges::all_of(parts_[i], [&](const Place& p) {
      for (std::size_t k = p.from; k < p.from + p.size; ++k)  // what is said to be 0 is no small number
        if (alternative[k] == 0 && std::fabs(got[k]) > 1e-14 * std::fabs(right[k])) return false;
      return distance(p, got, alternative) < 0.01 * distance(p, got, right);
    });
  } catch (const std::exception&) {  // these arguments are none of the operation
    return false;
  }

  std::vector<Place> results_;
  std::vector<const JudgedCall*> calls_;
  std::vector<std::vector<Place>> parts_;
};

/// Whether a vector is turned once more, or once too little, by a rotation among the arguments.
std::string of_another_frame(const Operation& operation, const std::vector<Place>& places,
                             const Wrong& wrong) {
  for (const Place& by : places) {
    if (!is_rotation(by)) continue;
    for (const bool back : {false, true}) {
      const std::string R = fmt::format(
          "{}{}", is_quaternion(by) ? fmt::format("R({})", name_of(by, places)) : name_of(by, places),
          back ? "^T" : "");
      for (const Place& at : places)
        if (at.size == 3 && wrong.given_by([&](const JudgedCall& c) {
              Numbers x = c.call.arguments;
              turn(at.in(x), rotation_in(by.in(c.call.arguments)), back);
              return in_blocks(operation, exact(operation.name.data(), x));
            }))
          return fmt::format(
              "where it fails, {} is what {} {} in place of {} would give: it is taken in another frame",
              wrong.subject(), R, name_of(at, places), name_of(at, places));
      for (const Place& part : wrong.results())
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

std::vector<Place> places_of_arguments(const Operation& operation) {
  return places_of({operation.arguments.begin(), operation.arguments.size()});
}

}  // namespace

std::vector<JudgedCall> judged_calls(const Series& series, std::size_t output) {
  std::vector<JudgedCall> all;
  if (series.on_robot || is_tree_law(series.property)) return all;
  std::size_t wrong = 0;
  for (std::uint64_t from = 0; from < (wrong > 0 ? 1000 : 300); from += 20)
    for (NotedCall& call : sampled_calls(series, output, from, from + 20)) {
      if (stop_requested) return {};
      const Operation& operation = *call.operation;
      Numbers right;
      for (const oracles::Real& x : expected_of(call)) right.push_back(static_cast<double>(x));
      if (right.size() != call.result.size()) continue;
      call.result = in_blocks(operation, call.result);
      all.push_back({std::move(call), in_blocks(operation, right)});
      if ((wrong += Wrong(operation, {all.back()}, 1e-6).count()) == enough) return all;
    }
  return all;
}

std::string float_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  const std::vector<Place> places = places_of_arguments(operation);
  Wrong wrong(operation, calls, 1e-10);
  wrong.of_all = false;  // some may be wrong for another reason
  if (wrong.count() < 4) return "";
  const auto rounded = [](Numbers x) {
    for (double& v : x) v = oracles::rounded_to_float(v) != 0 ? oracles::rounded_to_float(v) : v;
    return x;
  };
  if (wrong.given_by([&](const JudgedCall& c) { return rounded(c.right); }))
    return fmt::format("where it fails, {} is rounded to float", wrong.subject());
  const auto given_by_rounded = [&](std::size_t from, std::size_t n) {
    return wrong.given_by([&](const JudgedCall& c) {
      Numbers x = c.call.arguments;
      const Span part = Span(x).subspan(from, n);
      std::ranges::copy(rounded(Numbers(part.begin(), part.end())), part.begin());
      return in_blocks(operation, exact(operation.name.data(), x));
    });
  };
  for (const Place& at : places)
    for (std::size_t i = 0; i <= at.size && (i == 0 || at.size <= 4); ++i)  // all numbers, and then each
      if (i == 0 ? given_by_rounded(at.from, at.size) : given_by_rounded(at.from + i - 1, 1))
        return fmt::format("where it fails, {} is what {} rounded to float would give", wrong.subject(),
                           i == 0 ? name_of(at, places) : number_of(at, i - 1, places));
  return "";
}

namespace {
/// The one change that gives the wrong results, in words; or "".
std::string change_of(const Operation& operation, const std::vector<Place>& places, const Wrong& wrong) {
  for (const Place& at : places)
    for (const Place& part : wrong.results())
      if (at.size == part.size && at.size > 1 && wrong.given_by([&](const JudgedCall& c) {
            Numbers x = c.right;
            std::ranges::copy(at.in(c.call.arguments), part.in(x).begin());
            return x;
          }))
        return fmt::format("where it fails, {} is {}, unchanged", wrong.subject(), name_of(at, places));
  for (const Place& part : wrong.results())
    for (std::size_t i = 0; i < part.size && part.size <= 4; ++i)
      for (const Place& at : places)
        for (std::size_t k = 0; k < at.size && at.size <= 4; ++k)
          if (wrong.given_by([&](const JudgedCall& c) {
                Numbers x = c.right;
                part.in(x)[i] = at.in(c.call.arguments)[k];
                return x;
              }))
            return fmt::format("where it fails, {} is right but for {}, which is {}", wrong.subject(),
                               number_of(part, i, wrong.results()),
                               number_of(at, k, places) + " of the arguments");
  std::vector<Change> changes;
  for (const Place& p : wrong.results()) add_changes(p, wrong.results(), true, changes);
  add_exchanges(wrong.results(), changes);
  for (const Change& change : changes)
    if (wrong.given_by([&](const JudgedCall& c) {
          Numbers x = c.right;
          change.apply(x);
          return x;
        }))
      return fmt::format("where it fails, {} is {}", wrong.subject(), change.text);
  changes.clear();
  for (const Place& p : places) add_changes(p, places, false, changes);
  add_exchanges(places, changes);
  for (const Change& change : changes)
    if (wrong.given_by([&](const JudgedCall& c) {
          Numbers x = c.call.arguments;
          change.apply(x);
          return in_blocks(operation, exact(operation.name.data(), x));
        }))
      return fmt::format("where it fails, {} is what {} would give", wrong.subject(), change.text);
  return of_another_frame(operation, places, wrong);
}

}  // namespace

std::string substitution_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  for (const double least : {1e-6, 1e-10}) {
    Wrong wrong(operation, calls, least);
    if (wrong.count() < 4) continue;
    for (const bool of_all : {true, false}) {
      wrong.of_all = of_all;
      if (std::string text = change_of(operation, places_of_arguments(operation), wrong); !text.empty())
        return text;
    }
  }
  return "";
}

}  // namespace liecheck::properties
