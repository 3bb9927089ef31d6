#include <integrators/order.hpp>

#include <algorithm>
#include <cmath>

namespace liecheck::properties {

ObservedOrder observe_order(const std::vector<double>& errors, int promised, int wanted, double rounding) {
  ObservedOrder r;
  std::vector<double> rate;
  for (std::size_t k = 0; k + 1 < errors.size(); ++k) rate.push_back(std::log2(errors[k] / errors[k + 1]));
  std::size_t end = errors.size();  // one after the last error that is used
  for (std::size_t k = 0; k + 1 < rate.size(); ++k) {
    const double least = promised / 3.0;
    // If the steps are too long, a halving does not help, but a later one does. At the floor, none helps.
    const bool better =
        std::any_of(rate.begin() + long(k) + 1, rate.end(), [&](double x) { return x > least; });
    if (rate[k] < least && rate[k + 1] < least && !better && errors[k] < 1e-3) {
      r.floor = *std::min_element(errors.begin() + long(k), errors.end());
      break;
    }
  }
  const double least = std::max(1000 * rounding, r.floor ? 100 * *r.floor : 0);
  while (end > 0 && !(errors[end - 1] >= least)) --end;
  while (end > 0 && !(errors[end - 1] > 0 && std::isfinite(errors[end - 1]))) --end;
  std::size_t begin = end;
  while (begin > 0 && end - begin < std::size_t(wanted) + 1 && std::isfinite(errors[begin - 1]) &&
         errors[begin - 1] > 0)
    --begin;
  if (end - begin < 2) return r;
  r.first = begin;
  r.halvings = int(end - begin) - 1;
  r.order = std::log2(errors[begin] / errors[end - 1]) / r.halvings;
  r.local.assign(rate.begin() + long(begin), rate.begin() + long(end) - 1);
  r.settled = r.halvings >= 5 && std::all_of(r.local.begin(), r.local.end(),
                                             [&](double x) { return std::abs(x - r.order) < 0.05; });
  return r;
}

}  // namespace liecheck::properties
