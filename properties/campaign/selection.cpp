#include <campaign/selection.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <invariants/property.hpp>
#include <set>
#include <stdexcept>
#include <subjects/subject_names.hpp>
#include <support/progress.hpp>

namespace liecheck::properties {

namespace {

/// Whether the subject runs only if the user names it. This applies to variants, such as textbook:1e-4.
bool on_request(const std::string& subject) {
  return subject.find(':') != std::string::npos;
}

/// The limits file of a subject, or null.
std::shared_ptr<const SubjectLimits> limits_of(const Selection& selection, const std::string& subject) {
  for (const auto& limits : selection.limits)
    if (limits->subject == subject) return limits;
  return nullptr;
}

Profile profile_of(const Selection& selection, const std::string& subject, const SubjectLimits* own,
                   bool of_adapter) {
  for (const std::string& name : {subject, std::string()})
    if (const auto at = selection.profiles.find(name); at != selection.profiles.end()) return at->second;
  return default_profile(own, of_adapter || is_other_library(subject));
}

void check_limits(const Selection& selection) {
  const auto known = subject_names();
  std::set<std::string> seen;
  for (const auto& limits : selection.limits) {
    const auto refuse = [&](const std::string& why) {
      throw std::invalid_argument(fmt::format("{}:{}: {}", limits->file, limits->subject_line, why));
    };
    const std::string& name = limits->subject;
    const auto& selected = selection.subjects;
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse(fmt::format("unknown subject '{}'; 'liecheck list' shows them", name));
    if (!seen.insert(name).second) refuse(fmt::format("subject '{}' has another limits file, too", name));
    if (selected.empty() ? on_request(name)
                         : std::find(selected.begin(), selected.end(), name) == selected.end())
      refuse(fmt::format("subject '{}' is not selected: these limits judge nothing", name));
  }
}

void add_series(const Selection& selection, const Robot& robot, const Scalar& scalar, Counted& prepared,
                std::vector<std::unique_ptr<Series>>& all) {
  const auto wanted = [](const std::vector<std::string>& list, const std::string& name) {
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
  };
  if (!wanted(selection.scalars, std::string(scalar.name))) return;
  for (const Subject* subject : subjects(scalar)) {
    if (!wanted(selection.subjects, subject->name)) continue;
    if (selection.subjects.empty() && on_request(subject->name)) continue;
    for (auto& property : make_properties(scalar)) {
      if (!wanted(selection.properties, property->name()) || !property->offered(*subject)) continue;
      prepared.next();  // each reads the robot
      auto own = limits_of(selection, subject->name);
      const Profile profile = profile_of(selection, subject->name, own.get(), !subject->adapter.empty());
      auto series = std::make_unique<Series>(std::move(property), *subject, robot, own, profile);
      if (series->due) all.push_back(std::move(series));  // it may offer what another robot would need
    }
  }
}

void check_names(const std::vector<std::string>& given, const std::vector<std::string>& known,
                 const char* what) {
  for (const std::string& name : given) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::vector<std::string> plain;
    std::copy_if(known.begin(), known.end(), std::back_inserter(plain),
                 [](auto& n) { return !on_request(n); });
    throw std::invalid_argument(fmt::format(
        "--{0}: unknown {0} '{1}'; known: {2}{3}", what, name, fmt::join(plain, ", "),
        plain.size() < known.size() ? ", and the variants and bugs that 'liecheck list' describes" : ""));
  }
}

}  // namespace

std::string how_to_get(const std::string& subject) {
  if (subject == "ceres") return "install libceres-dev and build again";
  std::string variable = subject;
  for (char& c : variable) c = static_cast<char>(c - 'a' + 'A');
  return fmt::format(
      "configure with -D{}_INCLUDE=DIR, the folder of its headers, and build again (docs/contributing.md)",
      variable);
}

std::vector<std::unique_ptr<Series>> select(const Selection& selection, const Robot& robot) {
  check_subjects(selection.subjects);
  check_names(selection.properties, property_names(), "property");
  check_names(selection.scalars, {"float", "double"}, "scalar");
  check_limits(selection);
  std::vector<std::unique_ptr<Series>> all;
  Counted prepared("preparing", "laws", 1);
  for (const Scalar* scalar : {&oracles::scalar_of<float>, &oracles::scalar_of<double>})
    add_series(selection, robot, *scalar, prepared, all);
  return all;
}

std::unique_ptr<Series> series_of(const std::string& property, const Subject& subject, const Robot& robot) {
  check_names({property}, property_names(), "property");
  for (auto& p : make_properties(*subject.scalar))
    if (p->name() == property) return std::make_unique<Series>(std::move(p), subject, robot);
  return nullptr;
}

void check_subjects(const std::vector<std::string>& names) {
  const auto absent = absent_subjects(), known = subject_names();  // an adapter may have the name of an absent one
  for (const std::string& name : names)
    if (std::ranges::find(absent, name) != absent.end() && std::ranges::find(known, name) == known.end())
      throw std::invalid_argument(
          fmt::format("--subject: '{}' is absent from this build: {}", name, how_to_get(name)));
  check_names(names, subject_names(), "subject");
}

std::vector<std::string> property_names() {
  std::vector<std::string> names;
  for (const auto& p : make_properties(oracles::scalar_of<double>)) names.push_back(p->name());
  return names;
}

}  // namespace liecheck::properties
