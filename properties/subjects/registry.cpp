#include <subjects/subject.hpp>

#include <algorithm>
#include <memory>
#include <mutex>
#include <subjects/linked.hpp>
#include <subjects/other_libraries.hpp>

namespace liecheck::properties {

namespace {

template <class S>
std::vector<std::unique_ptr<Subject<S>>>& registry() {
  static std::vector<std::unique_ptr<Subject<S>>> all;
  return all;
}

}  // namespace

template <class S>
Registered<S>::Registered(Subject<S> subject) {
  registry<S>().push_back(std::make_unique<Subject<S>>(std::move(subject)));
}

template <class S>
std::vector<const Subject<S>*> subjects() {
  if constexpr (std::is_floating_point_v<S>) {  // bugs copy the subject liecheck, registered by now
    static std::once_flag once;
    std::call_once(once, [] {
      const auto at = std::ranges::find(registry<S>(), "liecheck", [](const auto& s) { return s->name; });
      if (at == registry<S>().end()) return;
      const Operations<S> good = (*at)->operations;
      const auto add = [](std::vector<Subject<S>> more) {
        for (Subject<S>& s : more) registry<S>().push_back(std::make_unique<Subject<S>>(std::move(s)));
      };
      if (linked_bugs<S>) add(linked_bugs<S>(good));
      if constexpr (std::is_same_v<S, double>)
        if (linked_history) add(linked_history(good));
    });
  }
  std::vector<const Subject<S>*> all;
  for (const auto& s : registry<S>()) all.push_back(s.get());
  std::ranges::sort(all, {}, &Subject<S>::name);
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
    if (std::ranges::none_of(registry<double>(), [&](const auto& s) { return s->name == name; }))
      absent.push_back(name);
#ifndef LIECHECK_QD
  absent.push_back("liecheck in double-double (QD)");
#endif
  return absent;
}

template struct Registered<float>;
template struct Registered<double>;
template struct Registered<float128>;
template std::vector<const Subject<float>*> subjects<float>();
template std::vector<const Subject<double>*> subjects<double>();
template std::vector<const Subject<float128>*> subjects<float128>();

}  // namespace liecheck::properties
