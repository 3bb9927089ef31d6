#pragma once
// What a URDF text must be before urdfdom sees it. urdfdom says what it dislikes on stderr, without a line,
// and lets much pass; here every complaint is a UrdfError with its line.

#include <liecheck/urdf/urdf.hpp>
#include <string>
#include <unordered_map>

namespace liecheck::urdf_detail {

/// Inertias are printed with few digits: three of them let a moment miss by this much of the largest.
constexpr double printed_inertia_slack = 1e-3;

/// What the text says that urdfdom does not tell.
struct ValidUrdf {
  std::string skeleton;  ///< what urdfdom needs of it
  int robot_line = 0;
  std::unordered_map<std::string, int> joint_line;
  /// A link whose inertia no body has: an error unless what it is fixed to makes up for it.
  struct Fault {
    std::string link;
    int line;
    std::string what, value;
  };
  std::vector<Fault> faults;
  std::vector<std::string> warnings;
};

/// A complaint as UrdfError words it: `FILE:LINE: what (value)`, one line, the value cut to 80 bytes.
std::string complaint(const std::string& file, int line, const std::string& what, const std::string& value);

/// Throws UrdfError unless text is one well-formed robot: a tree of named links, joints of supported types,
/// numbers that are finite, masses >= 0; where options.strict, also where it would warn.
ValidUrdf validateUrdfText(const std::string& text, const std::string& source_name,
                           const UrdfOptions& options);

}  // namespace liecheck::urdf_detail
