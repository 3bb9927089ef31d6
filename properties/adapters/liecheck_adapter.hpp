#pragma once
// An adapter in C++20: a struct whose static functions have the names of operations.
//
//     struct MyLib {
//       static constexpr const char *name = "mylib", *version = "2.1";
//       static void exp3_quaternion(std::span<const double, 3> phi, std::span<double, 4> Q);
//       static void exp3_quaternion(std::span<const float, 3> phi, std::span<float, 4> Q);
//       static void rotate_point(std::span<const double, 7> Q_and_p, std::span<double, 3> p_A);
//     };
//     LIECHECK_ADAPTER(MyLib, exp3_quaternion, rotate_point)
//
// All arguments of an operation are in one span, one after the other, and so are all numbers of its result.
// It may also have
//     static constexpr const char* conventions = "quaternion: wxyz, twist: angular first";  // docs/adapters.md has all
//     static constexpr bool thread_safe = true;           // several threads may call its functions at the same time
//     static const char* source(std::string_view operation);                          // see liecheck_get_source()
//
// docs/adapters.md has the numbers of each operation. A function that throws refuses its input, and the message
// of the exception is the reason.

#include <liecheck_adapter.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <span>
#include <string>
#include <string_view>

namespace liecheck::adapter {

struct Sizes {
  std::string_view operation;
  std::size_t inputs, results;  ///< how many numbers it takes and gives
};
inline constexpr Sizes all_sizes[] = {
#define LIECHECK_OPERATION(name, inputs, results) {#name, inputs, results},
#include <liecheck_operations.inc>
#undef LIECHECK_OPERATION
};
/// Null if there is no such operation. A loop, because libc++ 14 has no std::ranges::find.
constexpr const Sizes* find_sizes(std::string_view name) {
  for (const Sizes& sizes : all_sizes)
    if (sizes.operation == name) return &sizes;
  return nullptr;
}
constexpr bool is_operation(std::string_view name) {
  return find_sizes(name) != nullptr;
}
constexpr Sizes sizes_of(std::string_view name) {
  return *find_sizes(name);
}

/// F takes I numbers of S and writes R numbers of S.
template <class F, class S, std::size_t I, std::size_t R>
concept Computes = requires(const F& f, std::span<const S, I> in, std::span<S, R> out) {
  f(in, out);
};

inline std::string& last_reason() {
  thread_local std::string text;
  return text;
}
inline const char* reason() {
  return last_reason().c_str();
}

/// The C function for F, or null if F does not take numbers of S.
template <class F, class S, std::size_t I, std::size_t R>
liecheck_function function_in() {
  if constexpr (Computes<F, S, I, R>)
    return [](std::size_t n, const void* inputs, void* results, unsigned char* status) {
      for (std::size_t i = 0; i < n; ++i) try {
          F()
          (std::span<const S, I>(static_cast<const S*>(inputs) + I * i, I),
           std::span<S, R>(static_cast<S*>(results) + R * i, R));
        } catch (const std::exception& e) {
          status[i] = liecheck_refused;
          last_reason() = e.what();
        }
    };
  else
    return nullptr;
}

/// Subject::conventions, or null if there are none.
template <class Subject>
constexpr const char* conventions_of() {
  if constexpr (requires { Subject::conventions; })
    return Subject::conventions;
  else
    return nullptr;
}
template <class Subject>
constexpr bool is_thread_safe() {
  if constexpr (requires { Subject::thread_safe; })
    return Subject::thread_safe;
  else
    return false;
}

/// What Subject::source() returns, or null if there is no such function.
template <class Subject>
const char* source_of(const char* operation) {
  if constexpr (requires { Subject::source(operation); })
    return Subject::source(operation);
  else
    return nullptr;
}

/// Whether F takes I numbers and writes R, of float or double: checked when the adapter is compiled.
template <class F, std::size_t I, std::size_t R>
inline constexpr bool offered = Computes<F, float, I, R> || Computes<F, double, I, R>;

}  // namespace liecheck::adapter

// Calls macro(subject, operation) for each of up to 64 operations.
#define LIECHECK_PARENTHESES ()
#define LIECHECK_REPEAT(...) LIECHECK_REPEAT1(LIECHECK_REPEAT1(LIECHECK_REPEAT1(__VA_ARGS__)))
#define LIECHECK_REPEAT1(...) LIECHECK_REPEAT2(LIECHECK_REPEAT2(LIECHECK_REPEAT2(__VA_ARGS__)))
#define LIECHECK_REPEAT2(...) LIECHECK_REPEAT3(LIECHECK_REPEAT3(LIECHECK_REPEAT3(__VA_ARGS__)))
#define LIECHECK_REPEAT3(...) LIECHECK_REPEAT4(LIECHECK_REPEAT4(LIECHECK_REPEAT4(__VA_ARGS__)))
#define LIECHECK_REPEAT4(...) __VA_ARGS__
#define LIECHECK_EACH(macro, subject, ...) \
  __VA_OPT__(LIECHECK_REPEAT(LIECHECK_NEXT(macro, subject, __VA_ARGS__)))
#define LIECHECK_NEXT(macro, subject, operation, ...) \
  macro(subject, operation) __VA_OPT__(LIECHECK_AGAIN LIECHECK_PARENTHESES(macro, subject, __VA_ARGS__))
#define LIECHECK_AGAIN() LIECHECK_NEXT

#define LIECHECK_FIND(Subject, name)                                                                       \
  static_assert(liecheck::adapter::is_operation(#name), #name " is no operation: see docs/operations.md"); \
  if (operation == #name) {                                                                                \
    constexpr auto sizes = liecheck::adapter::sizes_of(#name);                                             \
    constexpr auto call = [](auto in, auto out) requires requires {                                        \
      Subject::name(in, out);                                                                              \
    }                                                                                                      \
    { Subject::name(in, out); };                                                                           \
    using F = decltype(call);                                                                              \
    static_assert(liecheck::adapter::offered<F, sizes.inputs, sizes.results>, #name                        \
                  " must be static void " #name "(std::span<const S, I> arguments, std::span<S, R> result), "\
                  "S float or double, all arguments in one span; I and R are in liecheck_operations.inc");  \
    return scalar == "float" ? liecheck::adapter::function_in<F, float, sizes.inputs, sizes.results>()     \
                             : liecheck::adapter::function_in<F, double, sizes.inputs, sizes.results>();   \
  }

/// Describes a library to liecheck: the struct, in its own namespace, then the operations that it offers.
#define LIECHECK_SUBJECT(Subject, ...)                                                      \
  inline const liecheck_adapter& liecheck_subject(const Subject*) {                         \
    static constexpr auto find = [](const char* operation_name, const char* scalar_name) {  \
      const std::string_view operation = operation_name, scalar = scalar_name;              \
      LIECHECK_EACH(LIECHECK_FIND, Subject, __VA_ARGS__)                                    \
      return static_cast<liecheck_function>(nullptr);                                       \
    };                                                                                      \
    static const liecheck_adapter adapter = {LIECHECK_ADAPTER_VERSION,                      \
                                             Subject::name,                                 \
                                             Subject::version,                              \
                                             liecheck::adapter::is_thread_safe<Subject>(),  \
                                             find,                                          \
                                             liecheck::adapter::reason,                     \
                                             liecheck::adapter::conventions_of<Subject>()}; \
    return adapter;                                                                         \
  }

/// The same, and exports it, once in a shared library.
#define LIECHECK_ADAPTER(Subject, ...)                                \
  LIECHECK_SUBJECT(Subject, __VA_ARGS__)                              \
  extern "C" const liecheck_adapter* liecheck_get_adapter() {         \
    return &liecheck_subject(static_cast<const Subject*>(nullptr));   \
  }                                                                   \
  extern "C" const char* liecheck_get_source(const char* operation) { \
    return liecheck::adapter::source_of<Subject>(operation);          \
  }
