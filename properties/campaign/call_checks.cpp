#include <campaign/call_checks.hpp>

#include <algorithm>
#include <campaign/call_observer.hpp>
#include <cstring>
#include <new>
#include <subjects/wrapped.hpp>
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

/// The hook of a CheckedSubject.
template <class S>
struct CheckedCall {
  int tree = 0;

  CheckedCall on(const Tree<S>&) const {
    CallLog* log = CallLog::current();
    return {log ? ++log->trees : 0};
  }
  template <class O, class F, class... A>
  auto operator()(const O& operation, const F& function, const A&... arguments) const {
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
    constexpr unsigned char one = 0xa5, other = 0x5a;  // as numbers both are finite and normal
    const auto found = [&](Outcome outcome) { log->findings.push_back({&operation, outcome}); };
    const FloatEnvironment outside;
    if (!mode_of_calls.is_usual()) FloatEnvironment::set(mode_of_calls);
    const FloatEnvironment environment;
    Memory<R> first, second;
    first.construct(one, call(copies));
    bool changed = environment.restore();
    try {
      second.construct(other, call(again));
    } catch (const std::exception&) {  // which the first call did not throw: the call is not repeatable
    }
    changed = environment.restore() || changed;
    outside.restore();
    if (changed) found(Outcome::environment_changed);
    if (is_unwritten(first, second, one, other))
      found(Outcome::output_unwritten);
    else if (!second.result() || !same_bits(*first.result(), *second.result()))
      found(Outcome::not_repeatable);
    if (!same_bits(copies, arguments...)) found(Outcome::argument_written);
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
  static bool is_unwritten(const Memory<R>& first, const Memory<R>& second, unsigned char one,
                           unsigned char other) {
    if constexpr (has_fixed_size<S, R>()) {
      static_assert(sizeof(R) % sizeof(S) == 0);
      for (std::size_t at = 0; at < sizeof(R); at += sizeof(S))
        if (first.keeps(one, at, sizeof(S)) && second.keeps(other, at, sizeof(S))) return true;
    }
    return false;
  }
};

}  // namespace

CallLog*& CallLog::current() {
  thread_local CallLog* log = nullptr;
  return log;
}

CallObserver*& call_observer() {
  thread_local CallObserver* observer = nullptr;
  return observer;
}

template <class S>
struct CheckedSubject<S>::Implementation {
  Wrapped<S, CheckedCall<S>> wrapped;
  Subject<S> subject;
  explicit Implementation(const Subject<S>& tested)
      : wrapped(tested.operations, {}), subject{tested.name, tested.version, wrapped.operations()} {}
};

template <class S>
struct CheckedSubject<S>::Active::Inside {
  typename Wrapped<S, CheckedCall<S>>::Active active;
  CallLog* before;
};

template <class S>
CheckedSubject<S>::CheckedSubject(const Subject<S>& tested)
    : implementation_(std::make_unique<const Implementation>(tested)) {}
template <class S>
CheckedSubject<S>::~CheckedSubject() = default;
template <class S>
const Subject<S>& CheckedSubject<S>::subject() const {
  return implementation_->subject;
}

template <class S>
CheckedSubject<S>::Active::Active(const CheckedSubject& checked, CallLog* log)
    : inside_(new Inside{typename Wrapped<S, CheckedCall<S>>::Active(checked.implementation_->wrapped),
                         std::exchange(CallLog::current(), log)}) {}
template <class S>
CheckedSubject<S>::Active::~Active() {
  CallLog::current() = inside_->before;
}

template <class S>
void CheckedSubject<S>::OfTask::exchange() {
  std::swap(CallLog::current(), log_);
  using W = Wrapped<S, CheckedCall<S>>;
  active_ = W::exchange(static_cast<const W*>(active_));
}

template class CheckedSubject<float>;
template class CheckedSubject<double>;
template class CheckedSubject<float128>;

}  // namespace liecheck::properties
