#include <liecheck/algorithms/aba.hpp>
#include <liecheck/algorithms/rnea.hpp>
#include <rounding/stochastic.hpp>

namespace liecheck {

template decltype(aba<properties::Stochastic>) aba<properties::Stochastic>;
template decltype(rnea<properties::Stochastic>) rnea<properties::Stochastic>;

}  // namespace liecheck
