// The subjects that register themselves (typed.hpp), and the names of other libraries among them, which may be absent.

#include <algorithm>
#include <deque>
#include <mutex>
#include <set>
#include <subjects/linked.hpp>
#include <subjects/subject_names.hpp>
#include <subjects/typed.hpp>

namespace liecheck::properties {

namespace {

// Pointers to both are given away, so they are deques.
template <class S>
std::deque<TypedSubject<S>>& own() {
  static std::deque<TypedSubject<S>> all;
  return all;
}
std::deque<Subject>& registered() {
  static std::deque<Subject> all;
  return all;
}

template <class S>
void add(TypedSubject<S> subject) {
  registered().push_back(erased(own<S>().emplace_back(std::move(subject))));
}

/// Adds the subjects that are made from copies of the subject liecheck, which is registered before main().
template <class S>
void add_linked() {
  const auto liecheck = std::ranges::find(own<S>(), "liecheck", &TypedSubject<S>::name);
  if (liecheck == own<S>().end()) return;
  const TypedOperations<S> good = liecheck->operations;
  if (linked_bugs<S>)
    for (TypedSubject<S>& s : linked_bugs<S>(good)) add(std::move(s));
  if constexpr (std::is_same_v<S, double>)
    if (linked_history)
      for (TypedSubject<S>& s : linked_history(good)) add(std::move(s));
}
void complete() {
  static std::once_flag once;
  std::call_once(once, [] { add_linked<float>(), add_linked<double>(); });
}

}  // namespace

template <class S>
Registered<S>::Registered(TypedSubject<S> subject) {
  add(std::move(subject));
}
void register_subject(Subject subject) {
  registered().push_back(std::move(subject));
}

void forget_subject(const std::string& name) {
  std::erase_if(registered(), [&](const Subject& s) { return s.name == name; });
}

template <class S>
std::vector<const TypedSubject<S>*> typed_subjects() {
  complete();
  std::vector<const TypedSubject<S>*> all;
  for (const TypedSubject<S>& s : own<S>()) all.push_back(&s);
  std::ranges::sort(all, {}, &TypedSubject<S>::name);
  return all;
}

std::vector<const Subject*> subjects(const Scalar& scalar) {
  complete();
  std::vector<const Subject*> all;
  for (const Subject& s : registered())
    if (*s.scalar == scalar) all.push_back(&s);
  std::ranges::sort(all, {}, &Subject::name);
  return all;
}

std::vector<std::string> subject_names() {
  complete();
  std::set<std::string> names;
  for (const Subject& s : registered()) names.insert(s.name);
  return {names.begin(), names.end()};
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
    if (std::ranges::find(own<double>(), name, &TypedSubject<double>::name) == own<double>().end())
      absent.push_back(name);
  return absent;
}

Operations::Operations() = default;
Operations::Operations(const Operations&) = default;
Operations::Operations(Operations&&) noexcept = default;
Operations& Operations::operator=(const Operations&) = default;
Operations& Operations::operator=(Operations&&) noexcept = default;
Operations::~Operations() = default;
void Operations::take(const Operation& operation, const Operations& from) {
  SpatialSlots<Doubles>::take(operation, from);
}
bool Operations::has(const Operation& operation) const { return SpatialSlots<Doubles>::has(operation); }

template struct Registered<float>;
template struct Registered<double>;
template std::vector<const TypedSubject<float>*> typed_subjects<float>();
template std::vector<const TypedSubject<double>*> typed_subjects<double>();

}  // namespace liecheck::properties
