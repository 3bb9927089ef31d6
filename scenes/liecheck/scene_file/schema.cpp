#include <liecheck/scene/bodies.hpp>
#include <liecheck/scene/observers/registry.hpp>
#include <liecheck/scene/starts.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <liecheck/scene_file/shapes.hpp>

namespace liecheck {
namespace {

/// Replaces bars, since a bar would end the cell of the table.
std::string withoutBars(const std::string& text, const std::string& replacement) {
  std::string replaced;
  for (const char c : text) replaced += c == '|' ? replacement : std::string(1, c);
  return replaced;
}

std::string keyed(const scene::PartInfo& info) {
  std::string text;
  for (const scene::Key& key : info.keys) {
    const std::string unit = key.unit;
    text += text.empty() ? "`" : "; `";
    text += key.name;
    if (key.fallback && *key.fallback) text += std::string(": ") + key.fallback;
    text += "`";
    if (!unit.empty() && unit != "1")
      text += " [" + (key.kind == scene::Kind::Choice ? "one of " : std::string()) + unit + "]";
    if (!key.fallback) text += " required";
    if (*key.meaning) text += std::string(", ") + key.meaning;
  }
  return text.empty() ? "none" : withoutBars(text, " or ");
}

std::string row(const scene::PartInfo& info) {
  const std::string what = std::string(info.equation) + (*info.energy ? "; " : "") + info.energy;
  return std::string("| `") + info.name + "` | " + withoutBars(what, "\\|") + " | " + keyed(info) + " |\n";
}

const scene::PartInfo& infoOf(const scene::PartInfo& info) {
  return info;
}
template <class Entry>
const scene::PartInfo& infoOf(const Entry& e) {
  if constexpr (std::is_pointer_v<decltype(e.info)>)
    return *e.info;
  else
    return e.info;
}

template <class Entries>
std::string table(const std::string& title, const Entries& entries) {
  std::string text =
      "### " + title + "\n\n| name | what | keys [unit], with their defaults |\n|---|---|---|\n";
  for (const auto& e : entries) text += row(infoOf(e));
  return text + "\n";
}

}  // namespace

std::string sceneSchema() {
  std::string text = table("robot: {body: NAME, ...}", scene::bodyEntries()) +
                     table("shapes: [{shape: NAME, ...}]", scene_file_detail::shapeInfos()) +
                     table("initial: {start: NAME, ...}", scene::startEntries()) +
                     table("effects", scene::effectEntries<double>()) +
                     table("actuation", scene::actuationEntries<double>()) +
                     table("observers", scene::observerEntries());
  text +=
      "### integrator: {name: NAME, step: ...}\n\n| name | order | evaluations | what | source "
      "|\n|---|---|---|---|---|\n";
  for (const scene::MethodInfo& m : scene::methodInfos())
    text += std::string("| `") + m.name + "` | " + std::to_string(m.order) + " | " +
            (m.evaluations ? std::to_string(m.evaluations)
             : m.adaptive  ? "adaptive"
                           : "implicit") +
            " | " + withoutBars(m.equation, "\\|") +
            (m.preserves_momentum ? "; conserves spatial momentum" : "") +
            (m.preserves_energy ? "; no energy drift" : "") +
            (m.lone_body_only ? "; for a lone body only" : "") + " | " + m.source + " |\n";
  return text;
}

}  // namespace liecheck
