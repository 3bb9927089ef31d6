#pragma once
// A call on a tree that the subject refused.

#include <stdexcept>
#include <string>
#include <string_view>

namespace liecheck::properties {

/// Says which operation refused. A law catches it as std::domain_error where the operation may refuse.
struct CallRefused : std::domain_error {
  CallRefused(const std::string& reason, std::string_view its_operation)
      : std::domain_error(reason), operation(its_operation) {}
  std::string_view operation;
};

}  // namespace liecheck::properties
