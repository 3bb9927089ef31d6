// The probe of conventions accuses no correct subject.

#include <gtest/gtest.h>

#include <conventions/probe.hpp>
#include <conventions/reference.hpp>
#include <subjects/typed.hpp>

#include "../properties/altered_libraries.hpp"

namespace liecheck::properties::conventions {
namespace {

/// What the probe says of a subject, a sentence each line.
template <class S>
std::string accusations(const Library& l) {
  std::vector<Probed> all;
  for (const auto& [name, function] : l) {
    all.push_back({&operation_named(name), {}});
    for (const Numbers& x : probe_arguments<S>(*all.back().operation))
      all.back().answers.push_back({x, function(x)});
  }
  std::string text;
  for (const Finding& f : explain(all)) text += f.sentence + "\n";
  return text;
}

/// Other tests register wrong subjects.
bool correct_name(const std::string& name) {
  for (const char* start : {"liecheck", "correct:", "alike:", "textbook", "ceres", "eigen", "manif",
                            "pinocchio", "smooth", "sophus"})
    if (name.starts_with(start)) return true;
  return false;
}

template <class S>
void expect_nothing_of_correct_subjects() {
  int probed = 0;
  for (const TypedSubject<S>* s : typed_subjects<S>()) {
    if (!correct_name(s->name)) continue;
    const Library l = library<S>(s->operations);
    probed += !l.empty();
    EXPECT_EQ(accusations<S>(l), "") << s->name;
  }
  EXPECT_GT(probed, 20);
}

TEST(Probe, FindsNothingInCorrectSubjects) {
  expect_nothing_of_correct_subjects<double>();
  expect_nothing_of_correct_subjects<float>();
}

}  // namespace
}  // namespace liecheck::properties::conventions
