
#include <algorithm>
#include <memory>
#include <mutex>
#include <subjects/linked.hpp>
#include <subjects/other_libraries.hpp>
#include <subjects/typed.hpp>

namespace liecheck::properties {

namespace {

/// A subject with its own functions, and as the harness calls it.
template <class S>
struct Entry {
  TypedSubject<S> typed;
  Subject subject;
  explicit Entry(TypedSubject<S> s) : typed(std::move(s)), subject(erased(typed)) {}
};
template <class S>
std::vector<std::unique_ptr<Entry<S>>>& registry() {
  static std::vector<std::unique_ptr<Entry<S>>> all;
  return all;
}

/// All entries. Known bugs copy the subject liecheck, which is registered before main().
template <class S>
const std::vector<std::unique_ptr<Entry<S>>>& entries() {
  static std::once_flag once;
  std::call_once(once, [] {
    const auto at = std::ranges::find(registry<S>(), "liecheck", [](const auto& e) { return e->typed.name; });
    if (at == registry<S>().end()) return;
    const TypedOperations<S> good = (*at)->typed.operations;
    const auto add = [](std::vector<TypedSubject<S>> more) {
      for (TypedSubject<S>& s : more) registry<S>().push_back(std::make_unique<Entry<S>>(std::move(s)));
    };
    if (linked_bugs<S>) add(linked_bugs<S>(good));
    if constexpr (std::is_same_v<S, double>)
      if (linked_history) add(linked_history(good));
  });
  return registry<S>();
}

}  // namespace

template <class S>
Registered<S>::Registered(TypedSubject<S> subject) {
  registry<S>().push_back(std::make_unique<Entry<S>>(std::move(subject)));
}

template <class S>
std::vector<const TypedSubject<S>*> typed_subjects() {
  std::vector<const TypedSubject<S>*> all;
  for (const auto& e : entries<S>()) all.push_back(&e->typed);
  std::ranges::sort(all, {}, &TypedSubject<S>::name);
  return all;
}

std::vector<const Subject*> subjects(const Scalar& scalar) {
  std::vector<const Subject*> all;
  scalar.with([&]<class S>() {
    for (const auto& e : entries<S>()) all.push_back(&e->subject);
  });
  std::ranges::sort(all, {}, &Subject::name);
  return all;
}

namespace {
constexpr const char* other_libraries[] = {"ceres", "eigen", "manif", "pinocchio", "smooth", "sophus"};
}

bool is_other_library(std::string_view subject) {
  return std::ranges::count(other_libraries, subject) > 0;
}

std::vector<std::string> absent_subjects() {
  std::vector<std::string> absent;
  for (const char* name : other_libraries)
    if (std::ranges::none_of(registry<double>(), [&](const auto& e) { return e->typed.name == name; }))
      absent.push_back(name);
  return absent;
}

template struct Registered<float>;
template struct Registered<double>;
template std::vector<const TypedSubject<float>*> typed_subjects<float>();
template std::vector<const TypedSubject<double>*> typed_subjects<double>();

}  // namespace liecheck::properties
