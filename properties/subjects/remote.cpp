#include <subjects/remote.hpp>

namespace liecheck::properties {

std::set<std::string>& remote_subjects() {
  static std::set<std::string> names;
  return names;
}

}  // namespace liecheck::properties
