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
// Functions that are not static belong to one object of the struct, which must have a default constructor. It may also have
//     static constexpr const char* conventions = "quaternion: wxyz, twist: angular first";  // docs/conventions.md has all
//                                       // with "pose form: quaternion", a pose is p, then Q: std::span<const double, 7>
//     static constexpr bool thread_safe = true;           // several threads may call its functions at the same time
//     static const char* source(std::string_view operation);                          // see liecheck_get_source()
//     static void check_quaternion(std::span<const double, 4> Q);  // throws for what its operations do not accept
//     static void check_rotation(std::span<const double, 9> R);
// and a struct Model, whose functions are operations on a tree of bodies or a robot (docs/adapters.md). Those that it has
// are offered:
//     struct Model {
//       explicit Model(const liecheck_model& model);         // throws std::exception for a model that is refused
//       void tree_rnea(std::span<const double> arguments, std::span<double> tau);
//     };
//     static constexpr const char *models = "joints, urdf", *joints = "revolute, prismatic";   // by default joints, of all kinds
//     static constexpr const char* references = "local";                              // of frames; by default world, local, aligned
//
// An operation may also be a function of one argument. It returns a call, with the arguments converted to the library's own
// types, and `write` puts the result of the call into numbers. `liecheck cost` then times the call without conversions:
//     static auto rotate_point(std::span<const double, 7> x) {
//       return [q = mylib::Quaternion(x[3], x[0], x[1], x[2]), p = mylib::Vector(x[4], x[5], x[6])] { return q.rotate(p); };
//     }
//     static void write(const mylib::Vector& p, std::span<double, 3> out);
//
// docs/conventions.md has the numbers of each operation. A function that throws refuses its input, and the message
// of the exception is the reason.

// Unlike #error, a header that is missing ends the compilation with this one line.
#if __cplusplus < 201709L  // gcc 10, whose -std=c++20 has what this file needs
#include <liecheck_adapter.hpp needs C++20: compile with -std=c++20>
#endif

#include <liecheck_adapter.h>
#include <liecheck_loops.hpp>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

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
/// The poses that an operation takes and gives.
struct Poses {
  std::string_view operation;
  std::size_t inputs, results;
};
inline constexpr Poses all_poses[] = {{"exp6", 0, 1},
                                      {"log6", 1, 0},
                                      {"compose", 2, 1},
                                      {"inverse", 1, 1},
                                      {"act_point", 1, 0},
                                      {"act_motion", 1, 0},
                                      {"act_inverse_motion", 1, 0},
                                      {"act_force", 1, 0},
                                      {"act_inverse_force", 1, 0},
                                      {"act_inertia", 1, 0},
                                      {"act_inverse_inertia", 1, 0},
                                      {"adjoint", 1, 0},
                                      {"coadjoint", 1, 0},
                                      {"transport_covariance", 1, 0}};
/// As (p, Q), a pose has 7 numbers in place of 12.
constexpr Sizes sizes_of(std::string_view name, bool in_quaternions = false) {
  Sizes sizes = *find_sizes(name);
  for (const Poses& poses : all_poses)
    if (in_quaternions && poses.operation == name)
      sizes.inputs -= 5 * poses.inputs, sizes.results -= 5 * poses.results;
  return sizes;
}

LIECHECK_HIDDEN inline std::string& last_reason() {
  thread_local std::string text;
  return text;
}
inline const char* reason() {
  return last_reason().c_str();
}

/// Calls f(i) for each input. One that throws is refused.
template <class F>
void for_each_input(std::size_t n, unsigned char* status, const F& f) {
  for (std::size_t i = 0; i < n; ++i) try {
      f(i);
    } catch (const std::exception& e) {
      status[i] = liecheck_refused;
      last_reason() = e.what();
    }
}

/// The C function for F, or null if it does not take numbers of S. F makes the call, or P prepares it.
struct Functions {
  using type = liecheck_call;
  template <class F, class P, class Object, class S, std::size_t I, std::size_t R>
  static liecheck_call in() {
    if constexpr (Computes<F, Object, S, I, R> || Prepares<P, Object, S, I>)
      return [](void* object, std::size_t n, const void* inputs, void* results, unsigned char* status) {
        for_each_input(n, status, [&](std::size_t i) {
          Object& o = *static_cast<Object*>(object);
          const std::span<const S, I> in(static_cast<const S*>(inputs) + I * i, I);
          const std::span<S, R> out(static_cast<S*>(results) + R * i, R);
          if constexpr (Computes<F, Object, S, I, R>)
            F()(o, in, out);
          else
            o.write(P()(o, in)(), out);
        });
      };
    else
      return nullptr;
  }
};
/// The C function of one of the library's own checks, or null if it has none in S.
template <class Subject, class S>
liecheck_call check_in(std::string_view name) {
  constexpr auto quaternion = [](auto& subject, auto Q, auto) requires requires {
    subject.check_quaternion(Q);
  }
  { subject.check_quaternion(Q); };
  constexpr auto rotation = [](auto& subject, auto R, auto) requires requires {
    subject.check_rotation(R);
  }
  { subject.check_rotation(R); };
  if (name == "check_quaternion") return Functions::in<decltype(quaternion), void, Subject, S, 4, 0>();
  if (name == "check_rotation") return Functions::in<decltype(rotation), void, Subject, S, 9, 0>();
  return nullptr;
}

/// A model of the subject, with the sizes of its vectors.
template <class Model>
struct Opened {
  Model model;
  std::size_t nq, nv;
};

/// How many numbers an operation on models takes or gives.
struct ModelSize {
  std::size_t q, v, vv, one;
  std::size_t of(std::size_t nq, std::size_t nv) const { return q * nq + v * nv + vv * nv * nv + one; }
};

/// The C function for F, an operation on models, or null if the model has no such function in S.
template <class F, class Model, class S, ModelSize in, ModelSize out>
liecheck_call model_function_in() {
  if constexpr (Computes<F, Model, S, std::dynamic_extent, std::dynamic_extent>)
    return [](void* handle, std::size_t n, const void* inputs, void* results, unsigned char* status) {
      auto& opened = *static_cast<Opened<Model>*>(handle);
      const std::size_t I = in.of(opened.nq, opened.nv), R = out.of(opened.nq, opened.nv);
      for_each_input(n, status, [&](std::size_t i) {
        F()
        (opened.model, std::span<const S>(static_cast<const S*>(inputs) + I * i, I),
         std::span<S>(static_cast<S*>(results) + R * i, R));
      });
    };
  else
    return nullptr;
}
template <class Model, class S>
liecheck_call find_model_function(std::string_view operation) {
#define LIECHECK_MODEL_OPERATION(name, q_in, v_in, one_in, q_out, v_out, vv_out, one_out) \
  if (operation == #name) {                                                               \
    constexpr auto call = [](auto& model, auto in, auto out) requires requires {          \
      model.name(in, out);                                                                \
    }                                                                                     \
    { model.name(in, out); };                                                             \
    return model_function_in<decltype(call), Model, S, ModelSize{q_in, v_in, 0, one_in},  \
                             ModelSize{q_out, v_out, vv_out, one_out}>();                 \
  }
#include <liecheck_model_operations.inc>
#undef LIECHECK_MODEL_OPERATION
  return nullptr;
}

/// Adds what the struct Model offers.
template <class Subject>
void add_models(liecheck_adapter& adapter) {
  if constexpr (requires { typename Subject::Model; }) {
    using Model = typename Subject::Model;
    adapter.models = "joints";
    if constexpr (requires { Subject::models; }) adapter.models = Subject::models;
    if constexpr (requires { Subject::joints; }) adapter.joints = Subject::joints;
    adapter.open_model = [](void*, const liecheck_model* model) -> void* {
      try {
        return new Opened<Model>{Model(*model), model->nq, model->nv};
      } catch (const std::exception& e) {
        last_reason() = e.what();
      } catch (...) {
        last_reason() = "an exception that is no std::exception";
      }
      return nullptr;
    };
    adapter.close_model = [](void*, void* handle) { delete static_cast<Opened<Model>*>(handle); };
    adapter.find_model_call = [](void*, const char* operation, const char* scalar) {
      return std::string_view(scalar) == "float" ? find_model_function<Model, float>(operation)
                                                 : find_model_function<Model, double>(operation);
    };
  }
}

/// Subject::conventions, or null if there are none.
template <class Subject>
constexpr const char* conventions_of() {
  if constexpr (requires { Subject::conventions; })
    return Subject::conventions;
  else
    return nullptr;
}
/// Subject::conventions is known when the adapter is compiled.
template <class Subject>
concept HasConstantConventions = requires {
  typename std::integral_constant<std::size_t, std::string_view(Subject::conventions).size()>;
};
/// Whether they state that poses are (p, Q).
template <class Subject>
constexpr bool has_quaternion_poses() {
  if constexpr (HasConstantConventions<Subject>) {
    constexpr std::string_view all = Subject::conventions, name = "pose form";
    for (std::size_t at = all.find(name); at != all.npos; at = all.find(name, at + 1)) {
      at = all.find_first_not_of(": ", at + name.size());
      if (at == all.npos) break;
      if (all.substr(at).starts_with("quaternion")) return true;
    }
  }
  return false;
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

/// Subject::references, or null if there is no such member.
template <class Subject>
const char* references_of() {
  if constexpr (requires { Subject::references; })
    return Subject::references;
  else
    return nullptr;
}

/// Whether F takes I numbers and writes R, of float or double, or P takes I: checked when the adapter is compiled.
template <class F, class P, class Subject, std::size_t I, std::size_t R>
inline constexpr bool offered = Computes<F, Subject, float, I, R> || Computes<F, Subject, double, I, R> ||
                                Prepares<P, Subject, float, I> || Prepares<P, Subject, double, I>;

}  // namespace liecheck::adapter

// Calls macro(subject, operation) for each of up to 250 operations.
#define LIECHECK_PARENTHESES ()
#define LIECHECK_REPEAT(...) LIECHECK_REPEAT1(LIECHECK_REPEAT1(LIECHECK_REPEAT1(__VA_ARGS__)))
#define LIECHECK_REPEAT1(...) LIECHECK_REPEAT2(LIECHECK_REPEAT2(LIECHECK_REPEAT2(__VA_ARGS__)))
#define LIECHECK_REPEAT2(...) LIECHECK_REPEAT3(LIECHECK_REPEAT3(LIECHECK_REPEAT3(__VA_ARGS__)))
#define LIECHECK_REPEAT3(...) LIECHECK_REPEAT4(LIECHECK_REPEAT4(LIECHECK_REPEAT4(__VA_ARGS__)))
#define LIECHECK_REPEAT4(...) LIECHECK_REPEAT5(LIECHECK_REPEAT5(LIECHECK_REPEAT5(__VA_ARGS__)))
#define LIECHECK_REPEAT5(...) __VA_ARGS__
#define LIECHECK_EACH(macro, subject, ...) \
  __VA_OPT__(LIECHECK_REPEAT(LIECHECK_NEXT(macro, subject, __VA_ARGS__)))
#define LIECHECK_NEXT(macro, subject, operation, ...) \
  macro(subject, operation) __VA_OPT__(LIECHECK_AGAIN LIECHECK_PARENTHESES(macro, subject, __VA_ARGS__))
#define LIECHECK_AGAIN() LIECHECK_NEXT

#define LIECHECK_FIND(Subject, name)                                                                       \
  static_assert(liecheck::adapter::is_operation(#name), #name " is no operation: see docs/operations.md"); \
  if (operation == #name) {                                                                                \
    constexpr auto sizes =                                                                                 \
        liecheck::adapter::sizes_of(#name, liecheck::adapter::has_quaternion_poses<Subject>());            \
    constexpr auto call = [](auto& subject, auto in, auto out) requires requires {                         \
      subject.name(in, out);                                                                               \
    }                                                                                                      \
    { subject.name(in, out); };                                                                            \
    constexpr auto prepare = [](auto& subject, auto in) requires requires {                                \
      subject.name(in)();                                                                                  \
    }                                                                                                      \
    { return subject.name(in); };                                                                          \
    using F = decltype(call);                                                                              \
    using P = decltype(prepare);                                                                           \
    static_assert(liecheck::adapter::offered<F, P, Subject, sizes.inputs, sizes.results>, #name            \
                  " must be void " #name                                                                   \
                  "(std::span<const S, I> arguments, std::span<S, R> result), "                            \
                  "S float or double, all arguments in one span; I and R are in liecheck_operations.inc"); \
    return is_float ? As::template in<F, P, Subject, float, sizes.inputs, sizes.results>()                 \
                    : As::template in<F, P, Subject, double, sizes.inputs, sizes.results>();               \
  }

/// Describes a library to liecheck: the struct, in its own namespace, then the operations that it offers.
/// liecheck_described(object) describes an object that has a state. It is used as long as the library is.
#define LIECHECK_SUBJECT(Subject, ...)                                                               \
  template <class As>                                                                                \
  LIECHECK_HIDDEN typename As::type liecheck_found(                                                  \
      const Subject*, [[maybe_unused]] std::string_view operation, [[maybe_unused]] bool is_float) { \
    LIECHECK_EACH(LIECHECK_FIND, Subject, __VA_ARGS__)                                               \
    return nullptr;                                                                                  \
  }                                                                                                  \
  LIECHECK_HIDDEN inline liecheck_adapter liecheck_described(Subject& object) {                      \
    liecheck_adapter all{};                                                                          \
    all.interface_version = LIECHECK_ADAPTER_VERSION;                                                \
    all.name = object.name, all.version = object.version;                                            \
    all.thread_safe = liecheck::adapter::is_thread_safe<Subject>();                                  \
    all.reason = liecheck::adapter::reason;                                                          \
    all.conventions = liecheck::adapter::conventions_of<Subject>();                                  \
    all.context = std::addressof(object);                                                            \
    all.find_call = [](void*, const char* operation_name, const char* scalar) -> liecheck_call {     \
      const std::string_view operation = operation_name;                                             \
      const bool is_float = std::string_view(scalar) == "float";                                     \
      if (const liecheck_call call = liecheck_found<liecheck::adapter::Functions>(                   \
              static_cast<const Subject*>(nullptr), operation, is_float))                            \
        return call;                                                                                 \
      return is_float ? liecheck::adapter::check_in<Subject, float>(operation)                       \
                      : liecheck::adapter::check_in<Subject, double>(operation);                     \
    };                                                                                               \
    liecheck::adapter::add_models<Subject>(all);                                                     \
    return all;                                                                                      \
  }                                                                                                  \
  LIECHECK_HIDDEN inline const liecheck_adapter& liecheck_subject(const Subject*) {                  \
    static Subject object{};                                                                         \
    static const liecheck_adapter adapter = liecheck_described(object);                              \
    return adapter;                                                                                  \
  }

/// The same, and exports it, once in a shared library.
#define LIECHECK_ADAPTER(Subject, ...)                                                                  \
  LIECHECK_SUBJECT(Subject __VA_OPT__(, ) __VA_ARGS__)                                                  \
  extern "C" const liecheck_adapter* liecheck_get_adapter() {                                           \
    return &liecheck_subject(static_cast<const Subject*>(nullptr));                                     \
  }                                                                                                     \
  extern "C" const char* liecheck_get_source(const char* operation) {                                   \
    return liecheck::adapter::source_of<Subject>(operation);                                            \
  }                                                                                                     \
  extern "C" const char* liecheck_get_references() {                                                    \
    return liecheck::adapter::references_of<Subject>();                                                 \
  }                                                                                                     \
  extern "C" const liecheck_loops* liecheck_get_loops(const char* operation, const char* scalar) {      \
    return liecheck_found<liecheck::adapter::AllLoops>(static_cast<const Subject*>(nullptr), operation, \
                                                       std::string_view(scalar) == "float");            \
  }
