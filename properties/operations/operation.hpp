#pragma once
// The types of an operation's arguments and result, and the slots of a subject.
//
// An operation that a subject offers is a constant with a unique type Typed<...>. The types of its arguments
// and of its result give the signature of the slot. A quantity that only a law forms, such as the power in
// two frames, is a plain Operation without a slot.

#include <functional>
#include <operations/description.hpp>
#include <operations/values.hpp>
#include <string_view>
#include <utility>

namespace liecheck::properties {

/// In the place of a scalar: the numbers of any scalar as doubles.
struct Doubles {};
template <class S>
struct NumberOf {
  using type = S;
};
template <>
struct NumberOf<Doubles> {
  using type = double;
};

// The types of arguments and results, for every scalar S.
namespace type {
template <int R, int C = 1>
struct Numbers {
  template <class S>
  using of = Eigen::Matrix<S, R, C>;
};
template <template <class> class Record>
struct RecordOf {
  template <class S>
  using of = Record<S>;
};
template <class T>
struct Same {
  template <class>
  using of = T;
};
struct Scalar {
  template <class S>
  using of = S;
};
struct TwoMatrices {
  template <class S>
  using of = std::pair<MatX<S>, MatX<S>>;
};
using Vector3 = Numbers<3>;
using Vector4 = Numbers<4>;
using Vector6 = Numbers<6>;
using Vector7 = Numbers<7>;
using Vector9 = Numbers<9>;
using ExtendedPose = Numbers<15>;
using Matrix9 = Numbers<9, 9>;
using Matrix3 = Numbers<3, 3>;
using Matrix6 = Numbers<6, 6>;
using Matrix76 = Numbers<7, 6>;
using Vector = Numbers<Eigen::Dynamic>;
using Matrix = Numbers<Eigen::Dynamic, Eigen::Dynamic>;
using PoseValue = RecordOf<Pose>;
using BodyValue = RecordOf<Body>;
using Index = Same<int>;
using Reference = Same<Seen>;
using Truth = Same<bool>;
}  // namespace type

/// A layout with the type that holds it.
template <class Type>
struct Value : Layout {};

/// An operation with a slot. Id makes the type unique. Bound: the function belongs to one robot or tree.
template <class Id, bool Bound, class Result, class... Arguments>
struct Typed : Operation {
  template <class S>
  using Plain = typename Result::template of<S>(const typename Arguments::template of<S>&...);
  /// A function that finds what it belongs to by itself is a plain pointer.
  template <class S>
  using Function = std::conditional_t<Bound || std::is_same_v<S, Doubles>,
                                      std::function<Plain<typename NumberOf<S>::type>>,
                                      Plain<typename NumberOf<S>::type>*>;
};

struct Text {
  std::string_view name, definition, source;
};

/// The record of a quantity that only a law forms. Layouts must be constants with static storage, because
/// their addresses are stored.
template <class... Arguments>
consteval Operation formed(Text text, const Layout& result, std::initializer_list<Block> blocks, Call call,
                           const Arguments&... arguments) {
  return {text.name, text.definition, text.source, {&arguments...}, {&result}, blocks, call};
}
/// operation<struct Exp6>({name, definition, source}, result, {blocks}, call, arguments...).
template <class Id, bool Bound = false, class Result, class... Arguments>
consteval Typed<Id, Bound, Result, Arguments...> operation(Text text, const Value<Result>& result,
                                                           std::initializer_list<Block> blocks, Call call,
                                                           const Value<Arguments>&... arguments) {
  return {formed(text, result, blocks, call, arguments...)};
}

template <class S, class O>
struct Slot {
  typename O::template Function<S> function = nullptr;
};

/// The functions of a subject in one scalar. slots[op::exp6] is null if the subject does not offer exp6.
template <class S, const auto&... Operations>
class Slots : Slot<S, std::remove_cvref_t<decltype(Operations)>>... {
 public:
  template <class O>
  auto& operator[](const O&) {
    return static_cast<Slot<S, O>&>(*this).function;
  }
  template <class O>
  const auto& operator[](const O&) const {
    return static_cast<const Slot<S, O>&>(*this).function;
  }
  /// Copies one operation's function.
  void take(const Operation& operation, const Slots& from) {
    ((&Operations == &operation ? void((*this)[Operations] = from[Operations]) : void()), ...);
  }
  /// Whether the operation has a slot here and a function in it.
  bool has(const Operation& operation) const {
    return ((&Operations == &operation && (*this)[Operations] != nullptr) || ...);
  }
  /// Calls visit(operation) for each operation.
  template <class Visit>
  static void for_each(Visit visit) {
    (visit(Operations), ...);
  }
};

}  // namespace liecheck::properties
