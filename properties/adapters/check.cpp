#include <adapters/check.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <adapters/shapes.hpp>
#include <array>
#include <cmath>
#include <cstring>
#include <subjects/subject.hpp>

namespace liecheck::properties::adapters {
namespace {

constexpr std::size_t samples = 3;

/// Moderate values of each type, which differ with k: rotation angles between 0.5 and 2, lengths about 1.
template <class S>
struct Sample {
  static S number(std::size_t k, int i) { return S(std::sin(double(7 * k + 1) + 1.7 * i)); }
  template <int N>
  static void fill(std::size_t k, Vec<S, N>& v) {
    for (int i = 0; i < N; ++i) v[i] = number(k, i);
    if constexpr (N == 4) v.normalize();
    if constexpr (N == 7) v.template tail<4>().normalize();
  }
  static void fill(std::size_t k, Mat<S, 3>& R) {
    Vec<S, 4> Q;
    fill(k, Q);
    const Vec<S, 3> v = Q.template head<3>();
    R = Mat<S, 3>::Identity() + 2 * Q[3] * hat(v) + 2 * hat(v) * hat(v);
  }
  static void fill(std::size_t k, Pose<S>& X) { fill(k, X.R), fill(k + 1, X.p); }
  static void fill(std::size_t k, Body<S>& I) {
    I.mass = S(2) + S(k);
    fill(k, I.c);
    Vec<S, 3> r;
    fill(k + 1, r);
    I.I_C = I.mass * (r.squaredNorm() * Mat<S, 3>::Identity() - r * r.transpose() / 2);
  }
};

template <class S>
std::string compared(std::span<const S> got, std::span<const S> expected) {
  double size = 0, apart = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    if (!std::isfinite(got[i])) return fmt::format("gives {}", fmt::join(got, " "));
    size = std::max(size, std::fabs(double(expected[i])));
    apart = std::max(apart, std::fabs(double(got[i] - expected[i])));
  }
  if (apart <= 1e-3 * size) return "";
  return fmt::format("gives {:.6g}, but liecheck {:.6g}", fmt::join(got, " "), fmt::join(expected, " "));
}

template <class S, const auto& operation, class R, class... A>
std::string checked(Adapter& adapter, R (*own)(A...)) try {
  constexpr std::size_t in = (Shape<std::remove_cvref_t<A>>::size + ...), out = Shape<R>::size;
  std::array<S, in * samples> inputs;
  std::array<S, out * samples> together{}, single{}, expected{};
  std::array<Status, samples> status{};
  for (std::size_t k = 0; k < samples; ++k) {
    S* at = inputs.data() + k * in;
    std::size_t argument = 2 * k;
    const auto one = [&]<class T>(T x) {
      if constexpr (std::is_floating_point_v<T>)
        x = Sample<S>::number(argument, 0);
      else
        Sample<S>::fill(argument, x);
      argument += 3;
      Shape<T>::put(x, at);
      at += Shape<T>::size;
      return x;
    };
    std::tuple<std::remove_cvref_t<A>...> arguments{one(std::remove_cvref_t<A>())...};
    Shape<R>::put(std::apply(own, arguments), expected.data() + k * out);
  }
  const auto call = [&](std::size_t first, std::size_t n, auto& results) {
    return adapter.call({*sizes_of(operation.name), sizeof(S) == 8, n,
                         std::as_bytes(std::span(inputs).subspan(first * in, n * in)),
                         std::as_writable_bytes(std::span(results).subspan(first * out, n * out)),
                         std::span(status).subspan(first, n)});
  };
  const std::string why = call(0, samples, together);
  for (const Status s : status)
    if (s != Status::done) return in_words(s, why);
  for (std::size_t k = 0; k < samples; ++k) call(k, 1, single);
  if (std::memcmp(together.data(), single.data(), sizeof single) != 0)
    return fmt::format("gives {:.6g} for {} inputs in one batch, and {:.6g} for the same one by one",
                       fmt::join(together, " "), samples, fmt::join(single, " "));
  for (std::size_t k = 0; k < samples; ++k) {
    const std::string wrong =
        compared<S>(std::span(single).subspan(k * out, out), std::span(expected).subspan(k * out, out));
    if (!wrong.empty())
      return fmt::format("{} for {:.6g}", wrong, fmt::join(std::span(inputs).subspan(k * in, in), " "));
  }
  return "";
} catch (const AdapterFailed& e) {
  return e.what();
}

template <class S, const auto&... all>
void check_all(Adapter& adapter, const char* scalar, const Slots<S, all...>& own,
               std::vector<CheckedOperation>& to) {
  const auto one = [&]<const auto & operation>() {
    if (adapter.description().offered.contains({std::string(operation.name), scalar}))
      to.push_back({std::string(operation.name), scalar, checked<S, operation>(adapter, own[operation])});
  };
  (one.template operator()<all>(), ...);
}

template <class S>
const SpatialSlots<S>& of_liecheck() {
  for (const Subject<S>* s : subjects<S>())
    if (s->name == "liecheck") return s->operations;
  throw std::logic_error("no subject liecheck");
}

}  // namespace

std::vector<CheckedOperation> check(Adapter& adapter) {
  std::vector<CheckedOperation> all;
  check_all(adapter, "double", of_liecheck<double>(), all);
  check_all(adapter, "float", of_liecheck<float>(), all);
  return all;
}

}  // namespace liecheck::properties::adapters
