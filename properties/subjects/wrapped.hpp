#pragma once
// A subject's operations, each call of which goes through a hook: to check every call, or to plant faults.

#include <stdexcept>
#include <subjects/tree.hpp>
#include <utility>

namespace liecheck::properties {

/// The operations of `base`, whose calls become hook(operation, function, arguments...), where `function` is
/// the function of the base. What the hook returns is the result. A hook is const callable and copied into
/// the functions of robots and trees. If it has a member on(urdf text, fixed) or on(tree), then the functions
/// of that robot or tree use the hook that this member returns.
///
/// Plain pointers carry no state, so they find their Wrapped through a pointer of the thread: they may be
/// called only while an Active of this Wrapped exists on the thread. The base of a Wrapped must not be a
/// Wrapped with the same type of hook.
template <class S, class Hook>
class Wrapped {
 public:
  Wrapped(const TypedOperations<S>& base, Hook hook)
      : base_(base), operations_(base), hook_(std::move(hook)) {
    redirect(operations_);
    if (base.robot)
      operations_.robot = [](const std::string& urdf, bool fixed) {
        const Wrapped& here = active();
        return bound(here.base_.robot(urdf, fixed), here.on(urdf, fixed));
      };
    if (base.tree)
      operations_.tree = [this](const Tree<S>& tree) { return bound(base_.tree(tree), on(tree)); };
  }
  Wrapped(const Wrapped&) = delete;
  Wrapped& operator=(const Wrapped&) = delete;

  /// May be copied, but not used after this Wrapped is gone.
  const TypedOperations<S>& operations() const { return operations_; }
  const Hook& hook() const { return hook_; }

  /// While it exists, the plain functions called on this thread belong to `wrapped`.
  class Active {
   public:
    explicit Active(const Wrapped& wrapped) : before_(std::exchange(current(), &wrapped)) {}
    Active(const Active&) = delete;
    Active& operator=(const Active&) = delete;
    ~Active() { current() = before_; }

   private:
    const Wrapped* before_;
  };
  /// Gives this thread another Wrapped, or none, and returns the one that it had.
  static const Wrapped* exchange(const Wrapped* other) { return std::exchange(current(), other); }

 private:
  static const Wrapped*& current() {
    thread_local const Wrapped* wrapped = nullptr;
    return wrapped;
  }
  static const Wrapped& active() {
    if (!current()) throw std::logic_error("a wrapped operation was called without an Active on its thread");
    return *current();
  }

  template <const auto&... all>
  static void redirect(Slots<S, all...>& slots) {
    (redirect_one<all>(slots[all]), ...);
  }
  template <const auto& operation, class R, class... A>
  static void redirect_one(R (*&slot)(A...)) {
    if (slot)
      slot = [](A... arguments) -> R {
        const Wrapped& here = active();
        return here.hook_(operation, here.base_[operation], arguments...);
      };
  }

  template <class... Context>
  auto on(const Context&... context) const {
    if constexpr (requires { hook_.on(context...); })
      return hook_.on(context...);
    else
      return hook_;
  }
  template <class BoundHook, const auto&... all>
  static Slots<S, all...> bound(Slots<S, all...> slots, const BoundHook& hook) {
    const auto one = [&hook](const auto& operation, auto& slot) {
      if (slot)
        slot = [hook, &operation, function = slot](const auto&... arguments) {
          return hook(operation, function, arguments...);
        };
    };
    (one(all, slots[all]), ...);
    return slots;
  }

  TypedOperations<S> base_, operations_;
  Hook hook_;
};

}  // namespace liecheck::properties
