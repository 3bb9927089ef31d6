#pragma once
// URDF texts for tests, and the messages of invalid ones.

#include <gtest/gtest.h>

#include <liecheck/urdf/urdf.hpp>

#include "../refusal.hpp"

namespace liecheck::test {

using V3 = Vector3<double>;
using M3 = Matrix3<double>;

inline std::string fixture(const std::string& name) {
  return std::string(LIECHECK_FIXTURES) + "/robots/" + name;
}

/// A robot with links a and b and a joint j between them. Line 4 is the joint, which contains `elements`.
inline std::string twoLinks(const std::string& type, const std::string& elements) {
  return "<robot name='two'>\n<link name='a'/>\n<link name='b'/>\n<joint name='j' type='" + type +
         "'><parent link='a'/><child link='b'/>" + elements + "</joint>\n</robot>\n";
}
inline const std::string limit = "<limit lower='-1' upper='1' effort='1' velocity='1'/>";

/// A robot with one link a. Line 3 is inside the link.
inline std::string oneLink(const std::string& inside) {
  return "<robot name='one'>\n<link name='a'>\n" + inside + "\n</link>\n</robot>\n";
}
inline std::string inertial(const std::string& mass, const std::string& ixx = "1") {
  return "<inertial><mass value='" + mass + "'/><inertia ixx='" + ixx +
         "' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
}

/// The message for an invalid text; fails if it is accepted.
inline std::string refusal(const std::string& text, RootJoint root = RootJoint::Fixed) {
  testing::internal::CaptureStderr();
  std::string said;
  try {
    buildModelFromUrdfText(text, root, "bad.urdf");
    ADD_FAILURE() << "nothing was refused in\n" << text.substr(0, 500);
  } catch (const UrdfError& e) {
    said = e.what();
    EXPECT_EQ(e.file(), "bad.urdf");
    EXPECT_TRUE(said.starts_with("bad.urdf:" + std::to_string(e.line()) + ": ")) << said;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_FALSE(has(said, "\n"));
  return said;
}
/// Expects that the message names `line`, contains `words`, and ends with `value` in parentheses.
inline void expectRefused(const std::string& text, int line, const std::string& words,
                          const std::string& value) {
  const std::string said = refusal(text);
  EXPECT_TRUE(said.starts_with("bad.urdf:" + std::to_string(line) + ": ")) << said;
  EXPECT_TRUE(has(said, words));
  EXPECT_TRUE(said.ends_with("(" + value + ")")) << said;
}

/// Expects that the text loads with a warning that names `line`, contains `words`, and ends with `value` in
/// parentheses, and that it is refused if strict.
inline void expectWarned(const std::string& text, int line, const std::string& words,
                         const std::string& value, UrdfOptions options = {.root = RootJoint::FreeFlyer}) {
  std::string all;
  bool found = false;
  for (const std::string& warning : loadUrdfText(text, options, "r.urdf").warnings) {
    all += warning + "\n";
    found = found || (warning.starts_with("r.urdf:" + std::to_string(line) + ": ") &&
                      warning.find(words) != warning.npos && warning.ends_with(" (" + value + ")"));
  }
  EXPECT_TRUE(found) << "no warning in line " << line << " of " << words << " (" << value << ") in\n" << all;
  options.strict = true;
  EXPECT_THROW(loadUrdfText(text, options), UrdfError);
}

}  // namespace liecheck::test
