#include <failures/substitutions.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <conventions/values.hpp>
#include <failures/part_changes.hpp>
#include <failures/relations.hpp>
#include <invariants/tree_laws.hpp>
#include <iterator>
#include <numbers>
#include <optional>
#include <oracles/orientations.hpp>
#include <span>
#include <support/stop.hpp>

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

double apart(std::span<const double> a, std::span<const double> b, double sign = 1) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != sign * b[i]) sum = std::hypot(sum, a[i] - sign * b[i]);
  return sum;
}
double distance(const PartPlace& at, const Numbers& a, const Numbers& b) {
  const double d = apart(at.in(a), at.in(b));
  return is_quaternion(at) ? std::min(d, apart(at.in(a), at.in(b), -1)) : d;
}
double size_of_part(const PartPlace& at, const Numbers& x) {
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
std::vector<PartPlace> results_of(const Operation& operation) {
  static constexpr Part parts[] = {{"the upper left block", 9, ""},
                                   {"the upper right block", 9, ""},
                                   {"the lower left block", 9, ""},
                                   {"the lower right block", 9, ""}};
  if (!is_in_blocks(operation)) return places_of({operation.results.begin(), operation.results.size()});
  std::vector<PartPlace> all;
  for (std::size_t i = 0; i < 4; ++i) all.push_back({operation.results[0], &parts[i], 9 * i, 9});
  return all;
}

/// So many wrong calls tell enough, and 100 changes of each are soon tried.
constexpr std::size_t enough = 12;
/// The wrong calls of an operation, and which parts of their results are wrong by more than a share.
class Wrong {
 public:
  /// Of one part of the results, or of all.
  Wrong(const Operation& operation, const std::vector<JudgedCall>& calls, double least,
        std::optional<std::size_t> only = {})
      : results_(results_of(operation)), only_(only) {
    for (const JudgedCall& c : calls) {
      if (!std::ranges::all_of(c.call.result, [](double x) { return std::isfinite(x); })) continue;
      std::vector<PartPlace> wrong;
      for (const PartPlace& p : results_) {
        if (only_ && p.from != results_[*only_].from) continue;
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
  const std::vector<PartPlace>& results() const { return results_; }

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
  /// By what the right numbers must be multiplied to be those of the first call in which they are large; 0 if there is none.
  double factor(const PartPlace& at) const {
    for (const JudgedCall* c : calls_) {
      double of_both = 0, of_right = 0;
      for (std::size_t k = at.from; k < at.from + at.size; ++k)
        of_both += c->call.result[k] * c->right[k], of_right += c->right[k] * c->right[k];
      if (of_right > 1e-6 * std::pow(apart(c->right, c->right, 0), 2) && std::isfinite(of_both / of_right))
        return of_both / of_right;
    }
    return 0;
  }
  /// The parts that are wrong, in words, if they are the same ones in all calls.
  std::string subject() const {
    for (const auto& parts : parts_)
      if (parts.size() != parts_.front().size() || parts.front().from != parts_.front().front().from)
        return "the result";
    if (!only_ && (results_.size() == 1 || parts_.front().size() > 1)) return "the result";
    return std::string(parts_.front().front().part->name);
  }

 private:
  template <class Other>
  bool gives(std::size_t i, Other other) const try {
    const Numbers& got = calls_[i]->call.result;
    const Numbers alternative = other(*calls_[i]);
    if (alternative.size() != got.size()) return false;
    const Numbers& right = calls_[i]->right;
    return std::ranges::all_of(parts_[i], [&](const PartPlace& p) {
      for (std::size_t k = p.from; k < p.from + p.size; ++k)  // what is said to be 0 is no small number
        if (alternative[k] == 0 && std::fabs(got[k]) > 1e-14 * std::fabs(right[k])) return false;
      return distance(p, got, alternative) < 0.01 * distance(p, got, right);
    });
  } catch (const std::exception&) {  // these arguments are none of the operation
    return false;
  }

  std::vector<PartPlace> results_;
  std::optional<std::size_t> only_;
  std::vector<const JudgedCall*> calls_;
  std::vector<std::vector<PartPlace>> parts_;
};

/// Whether a vector is turned once more, or once too little, by a rotation among the arguments.
std::string of_another_frame(const Operation& operation, const std::vector<PartPlace>& places,
                             const Wrong& wrong) {
  for (const PartPlace& by : places) {
    if (!is_rotation(by)) continue;
    for (const bool back : {false, true}) {
      const std::string R = fmt::format(
          "{}{}", is_quaternion(by) ? fmt::format("R({})", name_of(by, places)) : name_of(by, places),
          back ? "^T" : "");
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

/// The upper right block of a 6 x 6 Jacobian or adjoint with the diagonal block D, or its inverse, as a factor too many or too few.
std::string of_coupling(const Operation& operation, const Wrong& wrong) {
  if (!is_in_blocks(operation)) return "";
  using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  constexpr const char* factors[] = {"", "D", "D^-1"};
  for (int left = 0; left < 3; ++left)
    for (int right = 0; right < 3; ++right) {
      if (left + right == 0 || !wrong.given_by([&](const JudgedCall& c) {
            Numbers x = c.right;
            const Block D(x.data()), D_inverse = D.inverse(), one = Block::Identity();
            const Block* const by[] = {&one, &D, &D_inverse};
            Eigen::Map<Block> coupling(&x[9]);
            coupling = Block(*by[left] * coupling * *by[right]);
            return x;
          }))
        continue;
      return fmt::format(
          "where it fails, the upper right block is{}{} C{}{} in place of C, with D the upper left block: a "
          "factor D is missing, on the wrong side, or one too many",
          left == 0 ? "" : " ", factors[left], right == 0 ? "" : " ", factors[right]);
    }
  return "";
}

/// A factor, the same in all wrong results, of a part of the result or of one of its numbers.
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

std::vector<PartPlace> places_of_arguments(const Operation& operation) {
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
      if (operation.name.starts_with("euler_from") &&
          !are_unique(right, oracles::Order(static_cast<int>(call.arguments[0]))))
        continue;
      call.result = in_blocks(operation, call.result);
      all.push_back({std::move(call), in_blocks(operation, right)});
      if (Wrong(operation, {all.back()}, 1e-6).count() == 0) continue;
      const bool fails = case_fails(series, all.back().call.index, operation);
      if (fails && ++wrong == enough) return all;
      if (!fails) all.pop_back();
    }
  return all;
}

std::string float_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  const std::vector<PartPlace> places = places_of_arguments(operation);
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
  for (const PartPlace& at : places)
    for (std::size_t i = 0; i <= at.size && (i == 0 || at.size <= 4); ++i)  // all numbers, and then each
      if (i == 0 ? given_by_rounded(at.from, at.size) : given_by_rounded(at.from + i - 1, 1))
        return fmt::format("where it fails, {} is what {} rounded to float would give", wrong.subject(),
                           i == 0 ? name_of(at, places) : number_of(at, i - 1, places));
  return "";
}

namespace {
/// The one change that gives the wrong results, in words; or "".
std::string change_of(const Operation& operation, const std::vector<PartPlace>& places, const Wrong& wrong) {
  for (const PartPlace& at : places)
    for (const PartPlace& part : wrong.results())
      if (at.size == part.size && at.size > 1 && wrong.given_by([&](const JudgedCall& c) {
            Numbers x = c.right;
            std::ranges::copy(at.in(c.call.arguments), part.in(x).begin());
            return x;
          }))
        return fmt::format("where it fails, {} is {}, unchanged", wrong.subject(), name_of(at, places));
  for (const PartPlace& part : wrong.results())
    for (std::size_t i = 0; i < part.size && part.size <= 4; ++i)
      for (const PartPlace& at : places)
        for (std::size_t k = 0; k < at.size && at.size <= 4; ++k)
          if (wrong.given_by([&](const JudgedCall& c) {
                Numbers x = c.right;
                part.in(x)[i] = at.in(c.call.arguments)[k];
                return x;
              }))
            return fmt::format("where it fails, {} is right but for {}, which is {}", wrong.subject(),
                               number_of(part, i, wrong.results()),
                               number_of(at, k, places) + " of the arguments");
  std::vector<PartChange> changes;
  for (const PartPlace& p : wrong.results()) add_changes(p, wrong.results(), true, changes);
  add_exchanges(wrong.results(), changes);
  for (const PartChange& change : changes)
    if (wrong.given_by([&](const JudgedCall& c) {
          Numbers x = c.right;
          change.apply(x);
          return x;
        }))
      return fmt::format("where it fails, {} is {}", wrong.subject(), change.text);
  changes.clear();
  for (const PartPlace& p : places) add_changes(p, places, false, changes);
  add_exchanges(places, changes);
  for (const PartChange& change : changes)
    if (wrong.given_by([&](const JudgedCall& c) {
          Numbers x = c.call.arguments;
          change.apply(x);
          return in_blocks(operation, exact(operation.name.data(), x));
        }))
      return fmt::format("where it fails, {} is what {} would give", wrong.subject(), change.text);
  if (std::string text = of_another_frame(operation, places, wrong); !text.empty()) return text;
  return of_coupling(operation, wrong);
}

/// A change of all parts at once, in words; or "".
std::string change_of_all(const Wrong& wrong) {
  for (const auto& [text, factor] : {std::pair("0", 0.0), std::pair("the opposite of the right one", -1.0),
                                     std::pair("twice the right one", 2.0)})
    if (wrong.given_by([factor = factor](const JudgedCall& c) {
          Numbers x = c.right;
          for (double& v : x) v *= factor;
          return x;
        }))
      return fmt::format("where it fails, the result is {}", text);
  return "";
}

/// The calls without arguments so large that results underflow, overflow or lose all digits.
std::vector<JudgedCall> of_ordinary_arguments(std::vector<JudgedCall> calls) {
  std::erase_if(calls, [](const JudgedCall& c) {
    return std::ranges::any_of(c.call.arguments, [](double x) { return !(std::fabs(x) < 1e15); });
  });
  return calls;
}

/// The calls whose results are one number, or have several of like size: of one large number, each error is a factor.
std::vector<JudgedCall> of_several_numbers(const std::vector<JudgedCall>& calls) {
  std::vector<JudgedCall> all;
  std::ranges::copy_if(calls, std::back_inserter(all), [](const JudgedCall& c) {
    double largest = 0;
    for (const double x : c.right) largest = std::max(largest, std::fabs(x));
    return c.right.size() == 1 ||
           std::ranges::count_if(c.right, [&](double x) { return std::fabs(x) > 0.01 * largest; }) > 1;
  });
  return all;
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
    const std::size_t parts = is_in_blocks(operation) ? 1 : wrong.results().size();
    const std::vector<JudgedCall> ordinary = of_ordinary_arguments(calls);
    for (std::size_t part = 0; parts > 1 && part <= parts; ++part) {
      const Wrong some(operation, ordinary, least, part == 0 ? std::nullopt : std::optional(part - 1));
      if (some.count() < 4) continue;
      const std::string text =
          part == 0 ? change_of_all(some) : change_of(operation, places_of_arguments(operation), some);
      if (!text.empty()) return text;
    }
    const std::vector<JudgedCall> several = of_several_numbers(calls);
    const Wrong general(operation, several, least);
    if (general.count() < 4) continue;
    if (std::string text = factor_of(general); !text.empty()) return text;
  }
  return "";
}

}  // namespace liecheck::properties
