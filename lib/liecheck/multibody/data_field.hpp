#pragma once
// A field of Data: a result that records whether it belongs to the current state.
//
// Every field depends on q, (q, v) or (q, v, a), and some depend on the model's gravity or armature. A field is
// stale if it was never computed, or if an algorithm has since been called with another value of one of these
// inputs. Reading a stale field throws StaleField in debug builds; checked() throws it in every build.

#include <liecheck/scalar/scalar.hpp>
#include <stdexcept>
#include <string>

namespace liecheck {

/// Thrown if a stale field is read; what() names the missing call.
class StaleField : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// The inputs that a field depends on: q, (q, v) or (q, v, a).
enum class Level { Position, Velocity, Acceleration };

/// The constants of a Model that users may set, and that a field depends on.
enum class Constants { None = 0, Gravity = 1, Armature = 2, GravityAndArmature = 3 };

/// Identifies the current inputs: each has a number that changes when the input changes.
struct Clock {
  long q = 0, v = 0, a = 0, gravity = 0, armature = 0;
};

template <Scalar S>
class Data;

template <class T>
class Field {
 public:
  /// name of the field, and the call that computes it. The clock is that of the Data that the field is part of.
  Field(const Clock& clock, const char* name, const char* call, Constants constants = Constants::None,
        T value = T())
      : clock_(&clock), name_(name), call_(call), constants_(constants), value_(std::move(value)) {}
  Field(const Field&) = delete;  // the copy would refer to a clock that may end before it: copy the value

  const T& operator()() const {
#ifndef NDEBUG
    return checked();
#else
    return value_;
#endif
  }
  decltype(auto) operator[](std::size_t i) const {
    return (*this)()[i];
  }

  bool isFresh() const {
    return isOfState() && isOfConstants();
  }
  /// The value. Throws StaleField.
  const T& checked() const {
    if (!isFresh())
      throw StaleField("Data::" + std::string(name_) +
                       (stamp_.q == 0  ? " was never computed"
                        : !isOfState() ? " belongs to an earlier state"
                                       : " was computed with another gravity or armature") +
                       ": call " + call_ + " first");
    return value_;
  }

  /// For algorithms: returns the value and marks it as computed for the current inputs. An algorithm that may
  /// throw calls it when it is done, and works on scratch() before: what it leaves unfinished is stale.
  T& write(Level level) {
    const auto uses = [this](Constants c) { return (int(constants_) & int(c)) != 0; };
    stamp_ = {clock_->q, level == Level::Position ? 0 : clock_->v,
              level == Level::Acceleration ? clock_->a : 0, uses(Constants::Gravity) ? clock_->gravity : 0,
              uses(Constants::Armature) ? clock_->armature : 0};
    return value_;
  }
  /// For algorithms: returns the value for use as scratch storage; the field becomes stale.
  T& scratch() {
    stamp_ = {};
    return value_;
  }

 private:
  template <Scalar S>
  friend class Data;
  /// For copies of a Data: the value and the state it was computed for; the clock stays that of the own Data.
  Field& operator=(const Field& other) {
    stamp_ = other.stamp_, value_ = other.value_;
    return *this;
  }
  /// 0 in a stamp: the field does not depend on this input.
  static bool same(long stamp, long clock) {
    return stamp == 0 || stamp == clock;
  }
  bool isOfState() const {
    return stamp_.q != 0 && stamp_.q == clock_->q && same(stamp_.v, clock_->v) && same(stamp_.a, clock_->a);
  }
  bool isOfConstants() const {
    return same(stamp_.gravity, clock_->gravity) && same(stamp_.armature, clock_->armature);
  }

  const Clock* clock_;
  const char *name_, *call_;
  Constants constants_;
  Clock stamp_;
  T value_;
};

}  // namespace liecheck
