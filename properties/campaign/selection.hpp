#pragma once
// Selects the laws, subjects and scalars of a campaign.

#include <campaign/series.hpp>
#include <subjects/subject_names.hpp>

namespace liecheck::properties {

/// Names of subjects, properties and scalars. An empty list means all of them.
struct Selection {
  std::vector<std::string> subjects, properties, scalars;
  std::vector<std::shared_ptr<const SubjectLimits>> limits = {};  ///< of some of the subjects
  std::map<std::string, Profile> profiles = {};  ///< by subject; "": of the others; without: default_profile
};
/// Throws std::invalid_argument for a name that is not known, and for limits of a subject that has others or
/// is not selected.
std::vector<std::unique_ptr<Series>> select(const Selection& selection, const Robot& robot);
/// One law on any subject. `subject` must outlive the series. Throws std::invalid_argument.
std::unique_ptr<Series> series_of(const std::string& property, const Subject& subject, const Robot& robot);

/// Throws std::invalid_argument for a name that is not known.
void check_subjects(const std::vector<std::string>& names);
std::vector<std::string> property_names();
/// What to do for a subject of absent_subjects(), as a sentence without a subject.
std::string how_to_get(const std::string& absent_subject);

}  // namespace liecheck::properties
