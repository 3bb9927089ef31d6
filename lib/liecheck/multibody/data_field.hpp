#pragma once
// A field of Data: a result that records whether it belongs to the current state.
//
// Every field depends on q, (q, v) or (q, v, a). A field is stale if it was never computed, or if an
// algorithm has since been called with another value of an input that the field depends on. Reading a stale
// field throws StaleField in debug builds; checked() throws it in every build.

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

/// Identifies the current state: each input has a number that changes when the input changes.
struct Clock {
  long q = 0, v = 0, a = 0;
};

template <class T>
class Field {
 public:
  /// name of the field, and the call that computes it.
  Field(const Clock& clock, const char* name, const char* call, T value = T())
      : clock_(&clock), name_(name), call_(call), value_(std::move(value)) {}

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
    return stamp_.q != 0 && stamp_.q == clock_->q && (stamp_.v == 0 || stamp_.v == clock_->v) &&
           (stamp_.a == 0 || stamp_.a == clock_->a);
  }
  /// The value. Throws StaleField.
  const T& checked() const {
    if (!isFresh())
      throw StaleField("Data::" + std::string(name_) +
                       (stamp_.q == 0 ? " was never computed" : " belongs to an earlier state") + ": call " +
                       call_ + " first");
    return value_;
  }

  /// For algorithms: returns the value for writing and marks it as computed for the current state.
  T& write(Level level) {
    stamp_ = {clock_->q, level == Level::Position ? 0 : clock_->v,
              level == Level::Acceleration ? clock_->a : 0};
    return value_;
  }
  /// For algorithms: returns the value for use as scratch storage; the field becomes stale.
  T& scratch() {
    stamp_ = {};
    return value_;
  }

 private:
  const Clock* clock_;
  const char *name_, *call_;
  Clock stamp_;
  T value_;
};

}  // namespace liecheck
