#pragma once
// The functions of a subject of the program as the harness calls them. A call that is checked goes through numbers
// (number_function.hpp). The others round the arguments to the scalar of the subject and call its function in its own types,
// which is up to a fifth faster for the cheapest laws.

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <subjects/call_log.hpp>
#include <subjects/number_function.hpp>
#include <subjects/tree.hpp>
#include <subjects/typed.hpp>
#include <tuple>
#include <type_traits>

namespace liecheck::properties {

namespace rounded_calls_detail {

template <class T>
constexpr bool is_matrix = std::is_base_of_v<Eigen::MatrixBase<T>, T>;

/// Whether all numbers of a result lie in its object, so that its memory can be filled before the call.
template <class S, class R>
constexpr bool has_fixed_size() {
  if constexpr (is_matrix<R>)
    return R::SizeAtCompileTime != Eigen::Dynamic;
  else
    return std::is_same_v<R, Pose<S>> || std::is_same_v<R, Body<S>>;
}

/// Constructs a result in memory with the bytes of the `n` numbers behind `results`, and writes its numbers there: those
/// that the function leaves unwritten keep their bytes.
template <class S, class R, class F>
void construct(S* results, std::size_t n, const F& call) {
  S* to = results;
  if constexpr (has_fixed_size<S, R>()) {
    alignas(R) unsigned char bytes[sizeof(R)];
    std::memcpy(bytes, results, n * sizeof(S));
    // Without this, the compiler drops the bytes, because the call replaces them.
    asm volatile("" : : "r"(bytes) : "memory");
    put_numbers(*new (bytes) R(call()), to);
  } else {
    const R result = call();
    std::size_t given = 0;
    for_each_number(result, [&given](const auto&) { ++given; });
    if (given != n)
      throw std::length_error("the result has " + std::to_string(given) + " numbers, and not " +
                              std::to_string(n));
    put_numbers(result, to);
  }
}

/// Calls a function in the types of S with numbers, and writes the arguments back, where a check sees what the function has
/// written to them.
template <class S, class F, class R, class... A>
void call_with_numbers(const F& function, R (*)(const A&...), const Operation& operation, ModelSize model,
                       void* in, void* out, std::size_t results) {
  const S* from = static_cast<const S*>(in);
  auto next = [layout = operation.arguments.begin()]() mutable -> const Layout& { return **layout++; };
  // The braces of a tuple evaluate the arguments in their order.
  const std::tuple<A...> arguments{take_numbers<A>(from, next(), model)...};
  construct<S, R>(static_cast<S*>(out), results, [&]() -> R { return std::apply(function, arguments); });
  S* back = static_cast<S*>(in);
  std::apply([&back](const A&... a) { (put_numbers(a, back), ...); }, arguments);
}

/// A value with its numbers in S: rounded, or exactly.
template <class S, class T>
auto in_scalar(const T& value) {
  if constexpr (is_matrix<T>)
    return Eigen::Matrix<S, T::RowsAtCompileTime, T::ColsAtCompileTime>(value.template cast<S>());
  else if constexpr (requires { value.I_C; })
    return Body<S>{static_cast<S>(value.mass), in_scalar<S>(value.c), in_scalar<S>(value.I_C)};
  else if constexpr (requires { value.R; })
    return Pose<S>{in_scalar<S>(value.R), in_scalar<S>(value.p)};
  else if constexpr (requires { value.second; })
    return std::pair(in_scalar<S>(value.first), in_scalar<S>(value.second));
  else if constexpr (std::is_floating_point_v<T>)
    return static_cast<S>(value);
  else
    return value;  // an index, a reference frame or a truth value
}

template <class S, int R, int C>
oracles::Mat<R, C, S> in_scalar(const oracles::Mat<R, C, double>& value) {
  oracles::Mat<R, C, S> m;
  std::copy(value.x.begin(), value.x.end(), m.x.begin());
  return m;
}
template <class S>
oracles::BodyOf<S> in_scalar(const oracles::BodyOf<double>& body) {
  return {static_cast<S>(body.mass), in_scalar<S>(body.c), in_scalar<S>(body.I_C)};
}
template <class S>
Tree<S> in_scalar(const Tree<double>& tree) {
  Tree<S> t;
  for (const oracles::JointOf<double>& j : tree.joints) {
    oracles::JointOf<S>& to = t.joints.emplace_back();
    to.kind = j.kind, to.parent = j.parent, to.primary = j.primary;
    to.Q = in_scalar<S>(j.Q), to.p = in_scalar<S>(j.p), to.axis = in_scalar<S>(j.axis);
    to.pitch = static_cast<S>(j.pitch), to.multiplier = static_cast<S>(j.multiplier);
    to.offset = static_cast<S>(j.offset), to.armature = static_cast<S>(j.armature);
    to.body = in_scalar<S>(j.body);
  }
  t.gravity = in_scalar<S>(tree.gravity);
  t.index();
  for (const FixedBody<double>& f : tree.fixed)
    t.fixed.push_back({f.joint, in_scalar<S>(f.body), in_scalar<S>(f.Q), in_scalar<S>(f.p)});
  t.frame_joint = tree.frame_joint, t.frame_Q = in_scalar<S>(tree.frame_Q);
  t.frame_p = in_scalar<S>(tree.frame_p), t.urdf = tree.urdf;
  return t;
}

/// The functions of a subject, of one of its robots or of one of its trees.
template <class From>
struct Functions {
  From functions;
  ModelSize model;
  int tree;
};

/// Calls that are neither checked nor hooked take the short way.
template <class S, class Typed, class Of, class R, class... A>
void fill(std::function<R(const A&...)>& slot, const Operation& operation, Typed* signature,
          const auto& function, const std::shared_ptr<const Of>& of) {
  if (!function) return;
  slot = [of, &operation, &function, signature](const A&... arguments) -> R {
    if (CallLog::current() || call_hook()) {
      const std::size_t n = count_numbers(operation.arguments, of->model),
                        m = count_numbers(operation.results, of->model);
      const auto compute = [&](void* in, void* out) {
        call_with_numbers<S>(function, signature, operation, of->model, in, out, m);
      };
      return by_numbers<R>({&operation, &oracles::scalar_of<S>, of->model, of->tree, std::ref(compute)}, n, m,
                           arguments...);
    }
    if constexpr (std::is_same_v<S, double>)
      return function(arguments...);
    else
      return in_scalar<double>(function(in_scalar<S>(arguments)...));
  };
}
/// Fills the slots with the functions of a subject, which they share: a tree is built for each case.
template <class S, class To, const auto&... all>
void erase(Slots<To, all...>& to, const Slots<S, all...>& from, ModelSize model = {}, int tree = 0) {
  using Of = Functions<Slots<S, all...>>;
  const auto of = std::make_shared<const Of>(from, model, tree);
  const auto one = [&]<class O>(const O& operation) {
    fill<S>(to[operation], operation, static_cast<typename O::template Plain<S>*>(nullptr),
            of->functions[operation], of);
  };
  (one(all), ...);
}

}  // namespace rounded_calls_detail

template <class S>
Subject erased(const TypedSubject<S>& subject) {
  using namespace rounded_calls_detail;
  Subject s{subject.name, subject.version, {}, &oracles::scalar_of<S>};
  const TypedOperations<S>& from = subject.operations;
  erase<S>(static_cast<SpatialSlots<Doubles>&>(s.operations), static_cast<const SpatialSlots<S>&>(from));
  if (from.check_quaternion)
    s.operations.check_quaternion = [check = from.check_quaternion](const Vec<double, 4>& Q) {
      check(in_scalar<S>(Q));
    };
  if (from.check_rotation)
    s.operations.check_rotation = [check = from.check_rotation](const Mat<double, 3>& R) {
      check(in_scalar<S>(R));
    };
  if (from.robot)
    s.operations.robot = [robot = from.robot](const std::string& urdf, bool fixed) {
      RobotOperations<double> o;
      const auto model = urdf_model(urdf, fixed);
      erase<S>(o, robot(urdf, fixed), {model->nq, model->nv});
      return o;
    };
  if (from.tree)
    s.operations.tree = [build = from.tree](const Tree<double>& tree) {
      TreeOperations<double> o;
      const int number = next_tree();
      const ModelSize model{tree.nq, tree.nv};
      if constexpr (std::is_same_v<S, double>)
        erase<S>(o, build(tree), model, number);
      else
        erase<S>(o, build(in_scalar<S>(tree)), model, number);
      return o;
    };
  return s;
}
}  // namespace liecheck::properties
