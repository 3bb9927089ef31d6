#include <subjects/own_programs.hpp>

#include <map>

namespace liecheck::properties {

namespace {

std::map<std::string, OwnPrograms>& registered() {
  static std::map<std::string, OwnPrograms> all;
  return all;
}

}  // namespace

RegisteredPrograms::RegisteredPrograms(std::string subject, OwnPrograms programs) {
  registered().emplace(std::move(subject), std::move(programs));
}

const OwnPrograms* own_programs(const std::string& subject) {
  const auto found = registered().find(subject);
  return found == registered().end() ? nullptr : &found->second;
}

}  // namespace liecheck::properties
