#include <failures/wrong_parts.hpp>

#include <algorithm>
#include <cmath>
#include <conventions/values.hpp>
#include <numbers>
#include <oracles/scalar.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

double apart(std::span<const double> a, std::span<const double> b, double sign = 1) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != sign * b[i]) sum = std::hypot(sum, a[i] - sign * b[i]);
  return sum;
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

}  // namespace

double distance(const PartPlace& at, const Numbers& a, const Numbers& b) {
  const double d = apart(at.in(a), at.in(b));
  return is_quaternion(at) ? std::min(d, apart(at.in(a), at.in(b), -1)) : d;
}
double size_of_part(const PartPlace& at, const Numbers& x) {
  return apart(at.in(x), at.in(x), 0);
}

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

Wrong::Wrong(const Operation& operation, const std::vector<JudgedCall>& calls, double least,
             std::optional<std::size_t> only)
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
    if (!wrong.empty() && calls_.size() < enough_calls)
      calls_.push_back(&c), parts_.push_back(std::move(wrong));
  }
}

bool Wrong::given_by(const std::function<Numbers(const JudgedCall&)>& other) const {
  if (stop_requested) return false;
  const std::size_t allowed = of_all ? 0 : count() / 5;
  std::size_t missed = 0;
  for (std::size_t i = 0; i < count(); ++i)
    if (!gives(i, other) && ++missed > allowed) return false;
  return true;
}

bool Wrong::has_floats() const {
  const auto is_float = [](double x) { return x == oracles::rounded_to_float(x); };
  const auto is_short = [](double x) {  // such as 0 and 1, which are floats by chance
    int exponent;
    return std::fmod(0x1p12 * std::frexp(x, &exponent), 1) == 0;
  };
  std::size_t given = 0, missed = 0;
  for (std::size_t i = 0; i < count(); ++i) {
    const Numbers &got = calls_[i]->call.result, &right = calls_[i]->right;
    bool finite = true, floats = true, general = false;
    for (const PartPlace& p : parts_[i])
      for (std::size_t k = p.from; k < p.from + p.size; ++k)
        finite = finite && std::isfinite(got[k]), floats = floats && is_float(got[k]),
        general = general || !(is_short(got[k]) || is_float(right[k]));
    if (finite) (floats && general ? given : missed) += 1;
  }
  return given >= 4 && missed == 0;
}

double Wrong::factor(const PartPlace& at) const {
  for (const JudgedCall* c : calls_) {
    double of_both = 0, of_right = 0;
    for (std::size_t k = at.from; k < at.from + at.size; ++k)
      of_both += c->call.result[k] * c->right[k], of_right += c->right[k] * c->right[k];
    if (of_right > 1e-6 * std::pow(apart(c->right, c->right, 0), 2) && std::isfinite(of_both / of_right))
      return of_both / of_right;
  }
  return 0;
}

std::string Wrong::subject() const {
  for (const auto& parts : parts_)
    if (parts.size() != parts_.front().size() || parts.front().from != parts_.front().front().from)
      return "the result";
  if (!only_ && (results_.size() == 1 || parts_.front().size() > 1)) return "the result";
  return std::string(parts_.front().front().part->name);
}

bool Wrong::gives(std::size_t i, const std::function<Numbers(const JudgedCall&)>& other) const try {
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

}  // namespace liecheck::properties
