#include <liecheck/scene/bodies.hpp>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene/starts.hpp>
#include <liecheck/scene_file/scene_file.hpp>

namespace liecheck {
namespace {

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
  std::string escaped;  // a bar would end the cell
  for (const char c : text) escaped += c == '|' ? std::string(" or ") : std::string(1, c);
  return escaped.empty() ? "none" : escaped;
}

/// Escapes bars, since a bar would end the cell of the table.
std::string cell(const char* text) {
  std::string escaped;
  for (; *text; ++text) escaped += *text == '|' ? std::string("\\|") : std::string(1, *text);
  return escaped;
}

std::string row(const scene::PartInfo& info) {
  return std::string("| `") + info.name + "` | " + cell(info.equation) + (*info.energy ? "; " : "") +
         cell(info.energy) + " | " + keyed(info) + " |\n";
}

template <class Infos>
std::string table(const std::string& title, const Infos& infos) {
  std::string text =
      "### " + title + "\n\n| name | what | keys [unit], with their defaults |\n|---|---|---|\n";
  for (const auto& info : infos) text += row(info);
  return text + "\n";
}

}  // namespace

std::string sceneSchema() {
  std::vector<scene::PartInfo> bodies, starts, effects, actuations, observers;
  for (const auto& e : scene::bodyEntries()) bodies.push_back(e.info);
  for (const auto& e : scene::startEntries()) starts.push_back(e.info);
  for (const auto& e : scene::effectEntries<double>()) effects.push_back(*e.info);
  for (const auto& e : scene::actuationEntries<double>()) actuations.push_back(*e.info);
  for (const auto* e : scene::observerInfos()) observers.push_back(*e);
  std::string text = table("robot: {body: NAME, ...}", bodies) +
                     table("initial: {start: NAME, ...}", starts) + table("effects", effects) +
                     table("actuation", actuations) + table("observers", observers);
  text +=
      "### integrator: {name: NAME, step: ...}\n\n| name | order | evaluations | what | source "
      "|\n|---|---|---|---|---|\n";
  for (const scene::MethodInfo& m : scene::methodInfos())
    text += std::string("| `") + m.name + "` | " + std::to_string(m.order) + " | " +
            (m.evaluations ? std::to_string(m.evaluations)
             : m.adaptive  ? "adaptive"
                           : "implicit") +
            " | " + m.equation + (m.preserves_momentum ? "; conserves spatial momentum" : "") +
            (m.preserves_energy ? "; no energy drift" : "") +
            (m.lone_body_only ? "; for a lone body only" : "") + " | " + m.source + " |\n";
  return text;
}

}  // namespace liecheck
