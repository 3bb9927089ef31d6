#include <liecheck/scene_file/scene_file.hpp>

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <liecheck/scene/observers/registry.hpp>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene_file/robot.hpp>
#include <liecheck/scene_file/shapes.hpp>
#include <liecheck/scene_file/values.hpp>
#include <liecheck/scene_file/warnings.hpp>
#include <liecheck/text/text_file.hpp>
#include <liecheck/text/utf8.hpp>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

namespace liecheck {

namespace scene_file_detail {
namespace {

using scene::Kind;
using scene::PartInfo;
using scene::Request;
using scene::Scene;

/// An item of a list of parts: a name, or a name with its keys.
template <class Entry>
Request request(const Text& text, const YAML::Node& node, const std::string& what,
                const std::vector<Entry>& known, const Model<double>& model) {
  const bool keyed = node.IsMap();
  if (keyed && node.size() != 1)
    text.refuse(node, "an item of " + what +
                          " is a name, or a name with its keys: - name: {key: value}; this one has " +
                          std::to_string(node.size()) + " names");
  const YAML::Node head = keyed ? YAML::Node(node.begin()->first) : node;
  const YAML::Node keys = keyed ? YAML::Node(node.begin()->second) : YAML::Node();
  const std::string name = text.word(head, (keyed ? "a name in " : "an item of ") + what);
  const int line = Text::lineOf(head);
  const PartInfo& info = *text.entry(head, name, known, "'" + name + "' is not known in " + what).info;
  return {name, text.parameters(keys, line, name, info.keys, &model), line};
}

template <class Entry>
std::vector<Request> requests(const Text& text, const YAML::Node& node, const std::string& what,
                              const std::vector<Entry>& known, const Model<double>& model) {
  std::vector<Request> all;
  if (!node.IsDefined() || node.IsNull() || (node.IsScalar() && node.Scalar() == "none")) return all;
  if (!node.IsSequence()) text.refuse(node, what + " is a list: '- energy' on separate lines, or [energy]");
  for (const auto& item : node) all.push_back(request(text, item, what, known, model));
  return all;
}

/// Reads the integrator, its step, the duration and the sampling interval.
void readTime(const Text& text, const YAML::Node& root, Scene& scene) {
  const YAML::Node method = root["integrator"], duration = root["duration"], output = root["output"];
  if (!method.IsDefined()) text.refuse(0, "the scene needs 'integrator': {name: rkmk4, step: 1 ms}");
  if (!duration.IsDefined()) text.refuse(0, "the scene needs 'duration': 10 s");
  text.checkKeys(method, "integrator", {"name", "step", "tolerance", "compensated"});
  if (!method["name"].IsDefined()) text.refuse(method, "integrator needs 'name', such as rkmk4");
  scene.integrator = text.word(method["name"], "integrator.name");
  const scene::MethodInfo& info = text.at(Text::lineOf(method["name"]), [&]() -> const scene::MethodInfo& {
    return scene::methodInfo(scene.integrator);
  });
  if (info.lone_body_only && !isLoneBody(scene))
    text.refuse(method["name"], "integrator '" + scene.integrator +
                                    "' is for one body on a free_flyer root only: take implicit_midpoint");
  if (method["tolerance"].IsDefined()) {
    if (!info.adaptive)
      text.refuse(method["tolerance"], "integrator '" + scene.integrator + "' takes a step, not a tolerance");
    scene.options.tolerance = text.number(method["tolerance"], "integrator.tolerance", "1", Kind::Positive);
    if (scene.options.tolerance < 1e-15)
      text.refuse(method["tolerance"], "integrator.tolerance is below 1e-15, which double cannot reach");
  }
  if (const YAML::Node sums = method["compensated"]; sums.IsDefined()) {
    const std::string value = text.word(sums, "integrator.compensated");
    if (value != "true" && value != "false")
      text.refuse(sums, "integrator.compensated is true or false, not '" + value + "'");
    scene.options.compensated = value == "true";
  }
  scene.span.duration = text.number(duration, "duration", "s", Kind::Positive);
  double every = 0;
  if (output.IsDefined() && !output.IsNull()) {
    text.checkKeys(output, "output", {"every", "csv", "json"});
    if (output["every"].IsDefined())
      every = text.number(output["every"], "output.every", "s", Kind::Positive);
    if (output["csv"].IsDefined()) scene.csv = text.word(output["csv"], "output.csv");
    if (output["json"].IsDefined()) scene.json = text.word(output["json"], "output.json");
  }
  const auto whole = [&](const YAML::Node& node, double length, double part, const std::string& says) {
    const double count = std::round(length / part);
    if (!(count <= 1e15)) text.refuse(node, says + ": it fits more than 1e15 times");
    if (!(count >= 1) || std::abs(count * part - length) > 1e-9 * length)
      text.refuse(node, says + ": it fits " + std::to_string(length / part) + " times");
    return long(count);
  };
  if (method["step"].IsDefined()) {
    const double step = text.number(method["step"], "integrator.step", "s", Kind::Positive);
    scene.span.steps =
        whole(method["step"], scene.span.duration, step, "duration is not a multiple of integrator.step");
    scene.span.every =
        every > 0 ? whole(output["every"], every, step, "output.every is not a multiple of integrator.step")
                  : std::max(1L, scene.span.steps / 1000);
  } else if (info.adaptive) {
    scene.span.steps = every > 0 ? whole(output["every"], scene.span.duration, every,
                                         "duration is not a multiple of output.every")
                                 : 1000;
  } else {
    text.refuse(method, "integrator '" + scene.integrator + "' needs 'step', such as 1 ms");
  }
}

/// Constructs the system and every observer, so that an error of a part is reported with the part's line.
void checkParts(const Text& text, const YAML::Node& root, const Scene& scene) {
  text.at(Text::lineOf(root["robot"]), [&] {
    return isLoneBody(scene) ? (scene::makeSystem<scene::LoneBody<double>>(scene), 0)
                             : (scene::makeSystem<scene::Tree<double>>(scene), 0);
  });
  std::set<std::string> written;
  for (const Request& r : scene.observers) {
    for (const char* key : {"seed", "refinement"})
      if (const double x = r.parameters.number(key, 0); x != std::floor(x) || x > 9e15)
        text.refuse(r.line, r.name + "." + key + " is not a whole number up to 9e15");
    Scene one = scene;
    one.observers = {r};
    const std::vector<scene::Column> own = text.at(r.line, [&] { return scene::columnsOf(one); });
    for (std::size_t i = 1; i < own.size(); ++i)  // after t
      if (!written.insert(own[i].name).second)
        text.refuse(r.line, "observer '" + r.name + "' writes " + own[i].name +
                                ", which another observer writes too: keep one");
  }
  const YAML::Node output = root["output"];
  if (const std::string why = scene::tooManySamples(scene.span, 1 + double(written.size())); !why.empty())
    text.refuse(output.IsDefined() ? output : root["observers"], "the run would keep " + why);
}

/// Follows the events of a YAML text, and refuses one whose aliases stand for more values than a scene text has room for.
struct Documents final : YAML::EventHandler {
  YAML::Mark begin, now;
  std::vector<std::pair<YAML::anchor_t, std::size_t>>
      open;  ///< lists and maps that have not ended, with their sizes
  std::map<YAML::anchor_t, std::size_t> sizes;

  void add(YAML::anchor_t anchor, std::size_t size) {
    sizes[anchor] = size;
    if (size > max_scene_bytes) throw YAML::ParserException(now, "aliases repeat too many values");
    if (!open.empty()) open.back().second += size;
  }
  void start(const YAML::Mark& m, YAML::anchor_t anchor) { now = m, open.emplace_back(anchor, 1); }
  void end() {
    const auto [anchor, size] = open.back();
    open.pop_back();
    add(anchor, size);
  }
  void OnDocumentStart(const YAML::Mark& m) override { begin = now = m; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& m, YAML::anchor_t anchor) override { now = m, add(anchor, 1); }
  void OnAlias(const YAML::Mark& m, YAML::anchor_t anchor) override {
    now = m;
    if (!sizes.contains(anchor)) throw YAML::ParserException(m, "an alias stands inside of what it repeats");
    add(0, sizes.at(anchor));
  }
  void OnScalar(const YAML::Mark& m, const std::string&, YAML::anchor_t anchor, const std::string&) override {
    now = m, add(anchor, 1);
  }
  void OnSequenceStart(const YAML::Mark& m, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    start(m, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& m, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    start(m, anchor);
  }
  void OnMapEnd() override { end(); }
};

/// The line where the second document of a YAML text begins, or 0. YAML::LoadAll would not end on a text that begins
/// with ',' (yaml-cpp 0.7).
int lineOfSecondDocument(const std::string& content) {
  std::istringstream stream(content);
  YAML::Parser parser(stream);
  Documents first, second;
  if (!parser.HandleNextDocument(first) || !parser.HandleNextDocument(second)) return 0;
  if (second.begin.pos == first.begin.pos)
    throw YAML::ParserException(first.begin, "a value cannot begin so");
  return second.begin.line + 1;
}

/// If a unit stands behind a list in the line or the one before it, says what to write.
std::string unitBehindList(const std::string& content, int line) {
  std::istringstream lines(content);
  std::string now;
  for (int k = 1; k <= line && std::getline(lines, now); ++k) {
    const std::size_t open = now.rfind('['), close = now.find(']', std::min(open, now.size())),
                      unit = now.find_first_not_of(" ]", close);
    if (k < line - 1 || close == std::string::npos || unit == std::string::npos ||
        !(std::isalpha(static_cast<unsigned char>(now[unit])) || now[unit] == '%'))
      continue;
    const std::string own = " " + now.substr(unit, now.find_first_of(" ,}#", unit) - unit);
    std::string numbers = now.substr(open, close - open);
    for (std::size_t at = 0; (at = numbers.find(',', at)) != std::string::npos; at += own.size() + 1)
      numbers.insert(at, own);
    return ": each number has its own unit: write " + numbers + own + "]";
  }
  return "";
}

Scene read(const Text& text, const std::string& content, std::vector<std::string>& warnings) {
  if (content.size() > max_scene_bytes)
    text.refuse(0, "is longer than the limit of a scene: " + std::to_string(max_scene_bytes) + " bytes");
  if (content.find('\0') != std::string::npos) text.refuse(0, "is not text: it contains a zero byte");
  if (const std::size_t bad = firstInvalidUtf8(content); bad < content.size())
    text.refuse(1 + int(std::count(content.begin(), content.begin() + long(bad), '\n')), "is not UTF-8");
  YAML::Node root;
  try {
    if (const int line = lineOfSecondDocument(content))
      text.refuse(line, "contains several documents: a scene is one document");
    root = YAML::Load(content);
  } catch (const YAML::DeepRecursion& e) {
    text.refuse(e.mark.line + 1, "is nested too deeply");
  } catch (const YAML::Exception& e) {
    const int line = e.mark.is_null() ? 0 : e.mark.line + 1;
    text.refuse(line, "is not YAML: " + e.msg + unitBehindList(content, line));
  }
  if (!root.IsMap())
    text.refuse(0, "is not a scene: it has no keys such as 'robot: {body: box, size: [1, 1, 1]}'");
  text.checkKeys(root, "the scene",
                 {"scene", "reason", "robot", "frames", "shapes", "ground", "initial", "effects", "actuation",
                  "integrator", "duration", "observers", "output", "accuracy", "truth"});
  Scene scene;
  scene.source = text.file();
  scene.name = root["scene"].IsDefined() ? text.word(root["scene"], "scene")
                                         : std::filesystem::path(text.file()).stem().string();
  if (root["reason"].IsDefined()) scene.reason = text.word(root["reason"], "reason");
  if (root["truth"].IsDefined()) {
    static const std::vector<std::string> closed_forms = {"free_fall",    "constant_twist", "damped_spring",
                                                          "pendulum",     "axisymmetric",   "triaxial",
                                                          "sleeping_top", "precessing_top"};
    scene.truth = text.word(root["truth"], "truth");
    text.place(root["truth"], scene.truth, closed_forms, "no closed form is named '" + scene.truth + "'");
  }
  if (const YAML::Node accuracy = root["accuracy"]; accuracy.IsDefined() && !accuracy.IsNull()) {
    text.checkKeys(accuracy, "accuracy", {"position", "angle"});
    const auto read = [&](const char* key, const char* unit, double& to) {
      if (const YAML::Node node = accuracy[key]; node.IsDefined())
        to = text.number(node, std::string("accuracy.") + key, unit, Kind::Positive);
    };
    read("position", "m", scene.accepted_position);
    read("angle", "rad", scene.accepted_angle);
  }
  readRobot(text, root, scene, warnings);
  readGround(text, root["ground"], scene);
  readStart(text, root["initial"], scene);
  scene.effects = requests(text, root["effects"], "effects", scene::effectEntries<double>(), scene.model);
  for (Request& r :
       requests(text, root["actuation"], "actuation", scene::actuationEntries<double>(), scene.model))
    scene.effects.push_back(std::move(r));
  const auto less = [](const Request* a, const Request* b) {
    return std::tie(a->name, a->parameters.values) < std::tie(b->name, b->parameters.values);
  };
  std::set<const Request*, decltype(less)> different(less);
  for (const Request& r : scene.effects)
    if (!different.insert(&r).second)
      text.refuse(r.line, "'" + r.name + "' is given twice with the same keys: keep one");
  const auto last = std::stable_partition(scene.effects.begin(), scene.effects.end(), [&](const Request& r) {
    return !text.at(r.line, [&] { return scene::makeEffect<double>(r, scene.model, scene.around); })
                ->follows();
  });
  if (scene.effects.end() - last > 1)
    text.refuse(scene.effects.back().line, "'" + last->name + "' is given twice: name all pairs in one");
  scene.observers = requests(text, root["observers"], "observers", scene::observerEntries(), scene.model);
  readTime(text, root, scene);
  checkParts(text, root, scene);
  addWarnings(text, root, scene, warnings);
  scene.files = text.named();
  return scene;
}

}  // namespace
}  // namespace scene_file_detail

scene::Scene loadSceneText(const std::string& text, const std::string& source_name, const std::string& folder,
                           std::vector<std::string>* warnings, const std::vector<std::string>& outside) {
  std::vector<std::string> of_urdf;
  try {
    scene::Scene scene =
        scene_file_detail::read(scene_file_detail::Text(source_name, folder, outside), text, of_urdf);
    if (warnings) warnings->insert(warnings->end(), of_urdf.begin(), of_urdf.end());
    return scene;
  } catch (const YAML::Exception& e) {  // from a conversion that the schema did not check
    throw SceneError(source_name, e.mark.is_null() ? 0 : e.mark.line + 1, e.msg);
  }
}

scene::Scene loadScene(const std::string& path, std::vector<std::string>* warnings,
                       const std::vector<std::string>& outside) {
  try {
    const std::string text = readTextFile(path, max_scene_bytes);
    return loadSceneText(text, path, std::filesystem::path(path).parent_path().string(), warnings, outside);
  } catch (const FileError& e) {
    throw SceneError(path, 0, e.what());
  }
}

}  // namespace liecheck
