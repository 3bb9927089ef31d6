// The functions of a subject in the types of its scalar as functions of numbers.

#include <subjects/typed.hpp>

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <subjects/call_log.hpp>
#include <subjects/number_function.hpp>
#include <subjects/tree.hpp>
#include <tuple>

namespace liecheck::properties {
namespace {

/// Whether all numbers of a result lie in its object, so that its memory can be filled before the call.
template <class S, class R>
constexpr bool has_fixed_size() {
  if constexpr (std::is_base_of_v<Eigen::MatrixBase<R>, R>)
    return R::SizeAtCompileTime != Eigen::Dynamic;
  else
    return std::is_same_v<R, Pose<S>> || std::is_same_v<R, Body<S>>;
}

/// Constructs a result in memory that is filled as the numbers behind `results` are (guaranteed copy elision), and writes
/// its numbers there: those that the function leaves unwritten keep their bytes.
template <class S, class R>
void construct(S* results, std::size_t n, const auto& call) {
  S* to = results;
  if constexpr (has_fixed_size<S, R>()) {
    alignas(R) unsigned char bytes[sizeof(R)];
    std::memset(bytes, *reinterpret_cast<const unsigned char*>(results), sizeof bytes);
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

template <class S, class F, class R, class... A>
std::function<void(void*, void*)> computes(const F& function, R (*)(const A&...), const Operation& operation,
                                           ModelSize model) {
  if (!function) return nullptr;
  return [function, &operation, model, n = count_numbers(operation.results, model)](void* in, void* out) {
    const S* from = static_cast<const S*>(in);
    auto next = [layout = operation.arguments.begin()]() mutable -> const Layout& { return **layout++; };
    // The braces of a tuple evaluate the arguments in their order.
    const std::tuple<A...> arguments{take_numbers<A>(from, next(), model)...};
    construct<S, R>(static_cast<S*>(out), n, [&]() -> R { return std::apply(function, arguments); });
    if (!CallLog::current()) return;
    S* back = static_cast<S*>(in);  // where the log sees what the function has written to its arguments
    std::apply([&back](const A&... a) { (put_numbers(a, back), ...); }, arguments);
  };
}
template <class S, class R, class... A>
auto computes_of(R (*function)(const A&...), const Operation& operation, ModelSize model) {
  return computes<S>(function, function, operation, model);
}
template <class S, class R, class... A>
auto computes_of(const std::function<R(const A&...)>& function, const Operation& operation, ModelSize model) {
  return computes<S>(function, static_cast<R (*)(const A&...)>(nullptr), operation, model);
}

/// Finds the functions of these slots, which must outlive the result.
template <class S, const auto&... all>
FindFunction found_in(const Slots<S, all...>& slots, ModelSize model = {}, int tree = 0) {
  return [&slots, model, tree](const Operation& wanted) {
    NumberFunction f{&wanted, &oracles::scalar_of<S>, model, tree};
    const auto look = [&](const auto& one) {
      if (static_cast<const Operation*>(&one) == &wanted) f.compute = computes_of<S>(slots[one], one, model);
    };
    (look(all), ...);
    return f;
  };
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
  if constexpr (std::is_same_v<S, double>) {
    return tree;
  } else {
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
}

template <class S>
void check_with(auto& slot, const auto& check) {
  if (check) slot = [check](const auto& x) { check(x.template cast<S>().eval()); };
}

}  // namespace

template <class S>
Subject erased(const TypedSubject<S>& subject) {
  Subject s{subject.name, subject.version, {}, &oracles::scalar_of<S>};
  const TypedOperations<S>& from = subject.operations;
  fill_slots(s.operations, found_in<S>(from));
  check_with<S>(s.operations.check_quaternion, from.check_quaternion);
  check_with<S>(s.operations.check_rotation, from.check_rotation);
  if (from.robot)
    s.operations.robot = [robot = from.robot](const std::string& urdf, bool fixed) {
      RobotOperations<double> o;
      const auto model = urdf_model(urdf, fixed);
      fill_slots(o, found_in<S>(robot(urdf, fixed), {model->nq, model->nv}));
      return o;
    };
  if (from.tree)
    s.operations.tree = [build = from.tree](const Tree<double>& tree) {
      TreeOperations<double> o;
      const int number = next_tree();
      fill_slots(o, found_in<S>(build(in_scalar<S>(tree)), {tree.nq, tree.nv}, number));
      return o;
    };
  return s;
}
template Subject erased(const TypedSubject<float>&);
template Subject erased(const TypedSubject<double>&);

}  // namespace liecheck::properties
