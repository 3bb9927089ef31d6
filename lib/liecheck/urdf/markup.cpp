#include <liecheck/multibody/nearest_names.hpp>
#include <liecheck/urdf/markup.hpp>
#include <string>
#include <string_view>

namespace liecheck::urdf_detail {
namespace {

/// The words of an element, separated by spaces. `others` are elements and attributes of other programs that
/// do not change what this reader reads. Source: the XML specification of ros.org, wiki.ros.org/urdf/XML.
struct Words {
  std::string_view element, attributes;
  std::string_view once, repeated;  ///< elements inside it
  std::string_view others;
};
constexpr Words all_words[] = {
    {"robot", "name version", "", "link joint material",
     "gazebo transmission sensor frame mujoco ros2_control collision_filter_group"},
    {"link", "name", "inertial", "visual collision",
     "gazebo contact self_collision_checking collision_checking self_filter"},
    {"inertial", "", "origin mass inertia", "", ""},
    {"origin", "xyz rpy", "", "", ""},
    {"mass", "value", "", "", ""},
    {"inertia", "ixx ixy ixz iyy iyz izz", "", "", ""},
    {"visual", "name", "origin geometry", "material", "group"},
    {"collision", "name", "origin geometry", "", "material sdf max_contacts verbose concave group mask"},
    {"geometry", "name", "box sphere cylinder mesh", "", "capsule"},
    {"box", "size", "", "", ""},
    {"sphere", "radius", "", "", ""},
    {"cylinder", "radius length", "", "", ""},
    {"mesh", "filename scale", "", "", ""},
    {"material", "name", "color texture", "", "specular"},
    {"color", "rgba", "", "", ""},
    {"texture", "filename", "", "", ""},
    {"joint", "name type", "origin axis parent child limit dynamics mimic calibration safety_controller", "",
     "dont_collapse controller_gains traits"},
    {"axis", "xyz", "", "", ""},
    {"parent", "link", "", "", ""},
    {"child", "link", "", "", ""},
    {"limit", "lower upper effort velocity", "", "", ""},
    {"dynamics", "damping friction", "", "", ""},
    {"mimic", "joint multiplier offset", "", "", ""},
    {"calibration", "rising falling reference_position", "", "", ""},
    {"safety_controller", "soft_lower_limit soft_upper_limit k_position k_velocity", "", "", ""},
};

const Words* wordsOf(std::string_view element) {
  for (const Words& words : all_words)
    if (words.element == element) return &words;
  return nullptr;
}

/// Removes the first word from `words` and returns it; empty if there is none.
std::string_view nextWord(std::string_view& words) {
  const std::size_t end = std::min(words.find(' '), words.size());
  const std::string_view word = words.substr(0, end);
  words.remove_prefix(std::min(end + 1, words.size()));
  return word;
}

bool contains(std::string_view words, std::string_view wanted) {
  while (!words.empty())
    if (nextWord(words) == wanted) return true;
  return false;
}

/// The longest word of URDF has 18 letters: of a longer one, the first letters decide what is nearest.
constexpr std::size_t compared_letters = 40;

std::string nearest(std::string_view word, std::initializer_list<std::string_view> known) {
  std::vector<std::string> names;
  for (std::string_view words : known)
    while (!words.empty()) names.emplace_back(nextWord(words));
  return multibody_detail::nearestNames(std::string(word.substr(0, compared_letters)), names);
}

class MarkupCheck {
 public:
  explicit MarkupCheck(Messages& messages) : messages_(messages) {}

  /// Checks e and the elements inside it. The recursion is as deep as known elements nest, at most five.
  void check(const Element& e, const Words& words) {
    attributes(e, words);
    second(e, words);
    for (const Element& child : e.children) {
      const std::string_view name = child.name;
      const bool known = contains(words.once, name) || contains(words.repeated, name);
      if (const Words* inside = known ? wordsOf(name) : nullptr)
        check(child, *inside);
      else if (name.starts_with("xacro:"))
        messages_.warn(child.line, "xacro that is not expanded", child.name);
      else if (name.find(':') == name.npos && !contains(words.others, name))
        messages_.warn(child.line,
                       "an unknown element in <" + std::string(words.element) + "> is ignored" +
                           nearest(name, {words.once, words.repeated}),
                       child.name);
    }
  }

 private:
  void attributes(const Element& e, const Words& words) {
    for (const auto& [name, value, line] : e.attributes) {
      const std::string text = name + "='" + value + "'";
      if (value.find("${") != value.npos || value.find("$(") != value.npos)
        messages_.warn(line, "xacro that is not expanded", text);
      if (name == "xmlns" || name.find(':') != name.npos) continue;
      if (!contains(words.attributes, name) && !contains(words.others, name))
        messages_.warn(line,
                       "an unknown attribute of <" + std::string(words.element) + "> is ignored" +
                           nearest(name, {words.attributes}),
                       text);
    }
  }

  void second(const Element& e, const Words& words) {
    for (std::string_view once = words.once; !once.empty();) {
      const std::string name(nextWord(once));
      const Element* first = e.first(name);
      for (const Element& next : e.children)
        if (next.name == name && &next != first)
          messages_.warn(next.line,
                         "a second <" + name + "> in one <" + std::string(words.element) +
                             "> is ignored, the first is in line " + std::to_string(first->line),
                         e.attribute("name") ? e.attribute("name") : "");
    }
  }

  Messages& messages_;
};

}  // namespace

void checkMarkup(const Element& robot, Messages& messages) {
  MarkupCheck(messages).check(robot, all_words[0]);
}

}  // namespace liecheck::urdf_detail
