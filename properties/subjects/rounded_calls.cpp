// The functions of a subject of the program as the harness calls them, in the types of its scalar: arguments are rounded to the scalar of the subject, the call is
// checked if the thread has a log (call_log.hpp), and the result is exactly what the library returned.

#include <algorithm>
#include <cstring>
#include <new>
#include <subjects/call_log.hpp>
#include <subjects/call_observer.hpp>
#include <subjects/call_twice.hpp>
#include <subjects/number_function.hpp>
#include <subjects/tree.hpp>
#include <subjects/typed.hpp>
#include <support/float_environment.hpp>
#include <tuple>
#include <type_traits>

namespace liecheck::properties {

namespace {

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

/// Appends the bits of a value.
template <class T>
void append_bits(std::string& bits, const T& value) {
  const auto add = [&bits](const void* from, std::size_t n) {
    bits.append(static_cast<const char*>(from), n);
  };
  if constexpr (is_matrix<T>) {
    const Eigen::Index size[] = {value.rows(), value.cols()};
    add(size, sizeof size);
    add(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
  } else if constexpr (requires { value.I_C; }) {
    append_bits(bits, value.mass), append_bits(bits, value.c), append_bits(bits, value.I_C);
  } else if constexpr (requires { value.R; }) {
    append_bits(bits, value.R), append_bits(bits, value.p);
  } else if constexpr (requires { value.second; }) {
    append_bits(bits, value.first), append_bits(bits, value.second);
  } else {
    add(&value, sizeof value);
  }
}

template <class T>
bool same_bits(const T& a, const T& b) {
  if constexpr (is_matrix<T>) {
    return a.rows() == b.rows() && a.cols() == b.cols() &&
           std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof *a.data()) == 0;
  } else if constexpr (requires { a.I_C; }) {
    return same_bits(a.mass, b.mass) && same_bits(a.c, b.c) && same_bits(a.I_C, b.I_C);
  } else if constexpr (requires { a.R; }) {
    return same_bits(a.R, b.R) && same_bits(a.p, b.p);
  } else if constexpr (requires { a.second; }) {
    return same_bits(a.first, b.first) && same_bits(a.second, b.second);
  } else {
    return std::memcmp(&a, &b, sizeof a) == 0;
  }
}
template <class... T>
bool same_bits(const std::tuple<T...>& a, const T&... b) {
  return std::apply([&](const T&... x) { return (same_bits(x, b) && ...); }, a);
}

/// The memory of one result.
template <class R>
class Memory {
 public:
  Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() {
    if (result_) result_->~R();
  }
  /// Fills the memory with a byte and constructs the result of `call` in it.
  template <class F>
  void construct(unsigned char byte, const F& call) {
    std::memset(bytes_, byte, sizeof bytes_);
    // Without this, the compiler drops the bytes, because the call replaces them.
    asm volatile("" : : "r"(bytes_) : "memory");
    result_ = new (bytes_) R(call());
  }
  const R* result() const { return result_; }
  bool keeps(unsigned char byte, std::size_t from, std::size_t size) const {
    return std::all_of(bytes_ + from, bytes_ + from + size, [byte](unsigned char b) { return b == byte; });
  }

 private:
  alignas(R) unsigned char bytes_[sizeof(R)];
  R* result_ = nullptr;
};

/// Calls a function in the scalar S, and checks the call if the thread has a log.
template <class S>
struct CheckedCall {
  int tree = 0;  ///< which of the trees that the case builds the function belongs to, from 1; 0 if to none

  template <class F, class... A>
  auto operator()(const Operation& operation, const F& function, const A&... arguments) const {
    using R = std::invoke_result_t<const F&, const A&...>;
    CallLog* log = CallLog::current();
    if (!log) return function(arguments...);
    std::string given;
    if (log->keeps_results) {
      (append_bits(given, arguments), ...);
      for (const CallLog::Noted& n : log->results)
        if (n.operation == &operation && n.tree == tree && n.arguments == given)
          return R(*static_cast<const R*>(n.result.get()));
    }
    std::tuple<A...> copies(arguments...), again(arguments...);
    const auto call = [&function](const std::tuple<A...>& with) {
      return [&] { return std::apply([&](const A&... a) -> R { return function(a...); }, with); };
    };
    Memory<R> first, second;
    const bool changed = call_twice([&] { first.construct(first_pattern, call(copies)); },
                                    [&] { second.construct(second_pattern, call(again)); });
    note(*log, operation,
         {changed, is_unwritten(first, second),
          second.result() && same_bits(*first.result(), *second.result()), same_bits(copies, arguments...)});
    if (CallObserver* const observer = call_observer(); observer && log->keeps_results) {
      std::string bits;
      append_bits(bits, *first.result());
      (*observer)(operation, given + static_cast<char>(tree), bits);
    }
    if (log->keeps_results)
      log->results.push_back(
          {&operation, tree, std::move(given), std::make_shared<const R>(*first.result())});
    return R(*first.result());
  }

 private:
  /// Whether a number of the result was written by neither call.
  template <class R>
  static bool is_unwritten(const Memory<R>& first, const Memory<R>& second) {
    if constexpr (has_fixed_size<S, R>()) {
      static_assert(sizeof(R) % sizeof(S) == 0);
      for (std::size_t at = 0; at < sizeof(R); at += sizeof(S))
        if (first.keeps(first_pattern, at, sizeof(S)) && second.keeps(second_pattern, at, sizeof(S)))
          return true;
    }
    return false;
  }
};

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

/// A function of doubles that calls one in the scalar S. Operations of one signature share it.
template <class S, class F, class R, class... A>
void fill(std::function<R(const A&...)>& slot, const Operation& operation, const F& function,
          const CheckedCall<S>& call) {
  if (!function) return;
  slot = [call, &operation, function](const A&... arguments) -> R {
    if constexpr (std::is_same_v<S, double>)
      return call(operation, function, arguments...);
    else  // the conversions stand outside the call, which may flush subnormal numbers
      return in_scalar<double>(call(operation, function, in_scalar<S>(arguments)...));
  };
}
template <class S, class To, const auto&... all>
void erase(Slots<To, all...>& to, const Slots<S, all...>& from, const CheckedCall<S>& call) {
  (fill<S>(to[all], all, from[all], call), ...);
}

}  // namespace

template <class S>
Subject erased(const TypedSubject<S>& subject) {
  Subject s{subject.name, subject.version, {}, &oracles::scalar_of<S>};
  const TypedOperations<S>& from = subject.operations;
  erase<S>(static_cast<SpatialSlots<Doubles>&>(s.operations), static_cast<const SpatialSlots<S>&>(from), {});
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
      erase<S>(o, robot(urdf, fixed), {});
      return o;
    };
  if (from.tree)
    s.operations.tree = [build = from.tree](const Tree<double>& tree) {
      TreeOperations<double> o;
      const int number = next_tree();
      if constexpr (std::is_same_v<S, double>)
        erase<S>(o, build(tree), {number});
      else
        erase<S>(o, build(in_scalar<S>(tree)), {number});
      return o;
    };
  return s;
}
template Subject erased(const TypedSubject<float>&);
template Subject erased(const TypedSubject<double>&);

}  // namespace liecheck::properties
