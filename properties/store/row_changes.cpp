#include <store/row_changes.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/judge.hpp>
#include <cmath>
#include <failures/blocks.hpp>
#include <store/sampling.hpp>

namespace liecheck::properties {

namespace {

/// Whether an error grew by more than another order of operations or a rounding of the result could explain.
bool grown(double from, double to) {
  return to > from * 1.1 && to > from + 0.5;
}

/// Whether an error grew by more than two, and thereby used up more than a quarter of the limit. Where less than one
/// digit is right, all errors are the same.
bool much_grown(double from, double to, const RowTerms& terms) {
  const double no_digit = 0.1 / terms.eps;
  from = std::min(from, no_digit), to = std::min(to, no_digit);
  return to > 2 * from && to - from > std::max(terms.limit / 4, 0.5);
}

double largest_of(const Row& row, const RowTerms& terms) {
  return terms.rule == Rule::excess ? row.max_excess : row.max_error;
}

/// The cases without an error that can be compared: NaN, on a wrong branch, refused, ...
std::uint64_t without_error(const Row& row) {
  std::uint64_t all = 0;
  for (const auto& [n, name] : outcomes(row)) all += n;
  return all;
}

/// Whether a row's largest excess is known: below half the limit it is an upper bound, since kappa is not computed there.
bool knows_excess(const Row& row, const RowTerms& terms) {
  return terms.limit <= 0 || row.max_excess > std::min(terms.limit, largest_inexact_limit) / 2;
}

std::uint64_t count_of(const char* what, const Row& row) {
  for (const auto& [n, name] : outcomes(row))
    if (std::string_view(name) == what) return n;
  return 0;
}

/// Collects what is worse in one row.
class Worse {
 public:
  Worse(const Row& from, const Row& to, const RowTerms& terms, bool same_inputs, bool to_is_earlier)
      : from_(from), to_(to), terms_(terms), same_(same_inputs), back_(to_is_earlier) {
    for (const auto& [n, what] : outcomes(to)) more(what, count_of(what, from), n, Gravity::broken);
    more("failed", from.failed, to.failed, crossed() ? Gravity::crossed : Gravity::by_little);
    // Where fewer cases lack an error than before, the errors are those of other cases, and none of them is worse than none.
    const std::uint64_t lacked = without_error(from), lack = without_error(to);
    const bool mended = lack < lacked;
    if (same_ && !mended) {
      more("outside the domain", from.outside_domain, to.outside_domain, Gravity::by_little);
      more("unresolved", from.unresolved, to.unresolved, Gravity::by_little);
      more("unmeasured", from.unmeasured, to.unmeasured, Gravity::by_little);
      more("ill-posed", from.ill_posed, to.ill_posed, Gravity::by_little);
      if (to.count < from.count)
        add("measured", fmt::format("{} times", from.count), fmt::format("{} times", to.count),
            Gravity::by_little, 0);
      largest();
    }
    // More than a hundredth of other cases moves the quantile of 99 %.
    if (mended && 100 * (lacked - lack) > from.count) return;
    // What the largest error says already, the others do not say again.
    const bool said =
        same_ && std::ranges::any_of(all, [](const Difference& d) { return d.gravity == Gravity::grown; });
    if (!said && (same_ || shifted(from.errors, to.errors))) quantiles();
    if (!same_ && !mended) above_largest();
  }
  std::vector<Difference> all;

 private:
  void add(const char* what, const std::string& from, const std::string& to, Gravity gravity, double size) {
    if (terms_.expected) gravity = Gravity::by_little;
    all.push_back({before_after(what, from, to, back_), gravity, size});
  }
  static std::string of(std::uint64_t n, std::uint64_t cases) { return fmt::format("{} of {}", n, cases); }

  void more(const char* what, std::uint64_t from, std::uint64_t to, Gravity gravity) {
    const auto of_from = same_ ? from_.count : from_.judged(), of_to = same_ ? to_.count : to_.judged();
    if (same_ ? to > from : too_many(from, of_from, to, of_to))
      add(what, of(from, of_from), of(to, of_to), gravity,
          static_cast<double>(to) / static_cast<double>(std::max<std::uint64_t>(1, of_to)));
  }
  /// Whether there is a failure where there was none. Beside an earlier one, a limit that is crossed by no more than a
  /// rounding is none.
  bool crossed() const {
    return from_.failed == 0 &&
           (!same_ || !terms_.failed_before || grown(largest_of(from_, terms_), largest_of(to_, terms_)));
  }
  double share_of_limit(double error) const { return terms_.limit > 0 ? error / terms_.limit : error; }

  void largest() {
    if (from_.errors.count() == 0) return;
    // Under the excess rule only error / kappa is comparable.
    const bool excess = from_.max_excess > 0 || to_.max_excess > 0;
    if (excess && !knows_excess(to_, terms_)) return;
    const double from = excess ? from_.max_excess : from_.max_error,
                 to = excess ? to_.max_excess : to_.max_error;
    const auto words = [](double error, const Row& row) {
      return fmt::format("{:.4g} (case {})", error, row.worst_index);
    };
    if (grown(from, to))
      add(excess ? "largest excess [eps kappa]" : "largest error [eps]", words(from, from_), words(to, to_),
          much_grown(from, to, terms_) ? Gravity::grown : Gravity::by_little, share_of_limit(to));
  }
  /// The histogram has errors in eps. Under the excess rule they say nothing about the limit: there the largest excess must
  /// have grown, too.
  Gravity gravity_of_growth(double from, double to) const {
    const bool excess = terms_.rule == Rule::excess;
    const bool much = excess ? to > 2 * from && knows_excess(to_, terms_) &&
                                   much_grown(from_.max_excess, to_.max_excess, terms_)
                             : much_grown(from, to, terms_);
    return much ? Gravity::grown : Gravity::by_little;
  }
  void quantiles() {
    for (const double q : {0.5, 0.99}) {
      const double from = from_.errors.quantile(q), to = to_.errors.quantile(q);
      const Gravity gravity = gravity_of_growth(from, to);
      if (from_.errors.count() == 0 || (same_ ? gravity == Gravity::by_little : !grown(from, to))) continue;
      add(q == 0.5 ? "median error [eps]" : "99 % quantile of the error [eps]", fmt::format("{:.4g}", from),
          fmt::format("{:.4g}", to), gravity, share_of_limit(to));
    }
  }
  /// Errors above all of the other sample.
  void above_largest() {
    if (from_.errors.count() == 0) return;
    const double largest = from_.errors.quantile(1);
    std::uint64_t above = 0, far_above = 0;
    for (const auto& [bin, n] : to_.errors.bins()) {
      const double error = std::exp2(bin / 32.0);
      if (grown(largest, error)) above += n;
      if (gravity_of_growth(largest, error) == Gravity::grown) far_above += n;
    }
    const std::uint64_t n = from_.errors.count(), m = to_.errors.count();
    if (!too_many(0, n, above, m)) return;
    const bool far = too_many(0, n, far_above, m);
    add(fmt::format("errors above {:.4g} eps", largest).c_str(), of(0, n), of(above, m),
        far ? Gravity::grown : Gravity::by_little, static_cast<double>(above) / static_cast<double>(m));
  }

  const Row &from_, &to_;
  const RowTerms& terms_;
  const bool same_, back_;
};

}  // namespace

std::string before_after(const char* what, const std::string& from, const std::string& to,
                         bool to_is_earlier) {
  return fmt::format("{}: {} → {}", what, to_is_earlier ? to : from, to_is_earlier ? from : to);
}

std::vector<Difference> worse_rows(const Row& from, const Row& to, const RowTerms& terms, bool same_inputs,
                                   bool to_is_earlier) {
  return Worse(from, to, terms, same_inputs, to_is_earlier).all;
}

}  // namespace liecheck::properties
