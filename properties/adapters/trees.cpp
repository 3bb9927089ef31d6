#include <adapters/trees.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <subjects/call_refused.hpp>
#include <subjects/number_function.hpp>
#include <support/json.hpp>

namespace liecheck::properties::adapters {
bool of_frame(const Operation& o) {
  return o.name.starts_with("frame_") || o.name == op::operational_inertia.name;
}

namespace {

using nlohmann::json;

/// Whether the operation takes a reference.
bool sees(const Operation& o) {
  return std::ranges::any_of(o.arguments, [](const Layout* l) { return l->name == op::seen.name; });
}

/// Writes a model with its numbers rounded to a scalar.
struct Writer {
  const Scalar& scalar;

  double number(double x) const { return scalar.rounded(x); }
  json list(const auto& x) const {
    json all = json::array();
    for (const double n : x) all.push_back(number(n));
    return all;
  }
  json body(int joint, const oracles::BodyOf<double>& b, const oracles::Quaternion<double>& Q,
            const oracles::Vec3<double>& p) const {
    return {{"joint", joint},         {"Q", list(Q.x)},   {"p", list(p.x)},
            {"mass", number(b.mass)}, {"c", list(b.c.x)}, {"I_C", list(b.I_C.x)}};
  }
  json joint(const oracles::JointOf<double>& j) const {
    json text{{"kind", joint_names()[static_cast<std::size_t>(j.kind)]},
              {"parent", j.parent},
              {"Q", list(j.Q.x)},
              {"p", list(j.p.x)}};
    using enum oracles::JointKind;
    if (j.kind == revolute || j.kind == continuous || j.kind == prismatic || j.kind == helical)
      text["axis"] = list(j.axis.x);
    if (j.kind == helical) text["pitch"] = number(j.pitch);
    if (j.primary < 0) {
      text["armature"] = number(j.armature);
    } else {
      text["mimic"] = j.primary;
      text["multiplier"] = number(j.multiplier), text["offset"] = number(j.offset);
    }
    return text;
  }
  json joints_of(const Tree<double>& tree) const {
    json text{{"gravity", list(tree.gravity.x)}, {"joints", json::array()}, {"bodies", json::array()}};
    for (std::size_t i = 0; i < tree.joints.size(); ++i) {
      text["joints"].push_back(joint(tree.joints[i]));
      text["bodies"].push_back(body(static_cast<int>(i), tree.joints[i].body, {{0, 0, 0, 1}}, {{0, 0, 0}}));
    }
    for (const FixedBody<double>& b : tree.fixed) text["bodies"].push_back(body(b.joint, b.body, b.Q, b.p));
    return text;
  }
};
json urdf_of(const UrdfModel& m, const json& gravity) {
  return {{"urdf", m.text},
          {"root", m.fixed ? "fixed" : "free-flyer"},
          {"order", m.joints},
          {"gravity", gravity}};
}

/// What the tree has and the adapter does not take, in words, or "".
std::string unsupported(const Tree<double>& tree, const Description& adapter) {
  if (adapter.joints.empty()) return "";
  for (const auto& j : tree.joints) {
    std::vector<std::string> uses{joint_names()[static_cast<std::size_t>(j.kind)]};
    if (j.primary >= 0) uses.push_back("mimic");
    if (j.primary < 0 && j.armature != 0) uses.push_back("armature");
    for (const std::string& name : uses)
      if (!adapter.joints.contains(name)) return fmt::format("the adapter takes no tree with: {}", name);
  }
  return "";
}

}  // namespace

const std::vector<std::string>& joint_names() {
  static const std::vector<std::string> all(oracles::joint_names.begin(), oracles::joint_names.end());
  return all;
}

const std::vector<const Operation*>& model_operations() {
  static const std::vector<const Operation*> all = [] {
    std::vector<const Operation*> list;
    const auto add = [&](const Operation& o) { list.push_back(&o); };
    TreeOperations<double>::for_each(add), RobotOperations<double>::for_each(add);
    return list;
  }();
  return all;
}
const Operation* model_operation(std::string_view name) {
  const auto found = std::ranges::find(model_operations(), name, &Operation::name);
  return found == model_operations().end() ? nullptr : *found;
}

bool offers_trees(const Description& adapter, const std::string& scalar) {
  bool any = false;
  TreeOperations<double>::for_each([&](const Operation& o) {
    any = any || adapter.offered.contains({std::string(o.name), scalar});
  });
  return any;
}
bool offers_robots(const Description& adapter, const std::string& scalar) {
  bool all = adapter.models.contains("urdf");
  RobotOperations<double>::for_each([&](const Operation& o) {
    all = all && adapter.offered.contains({std::string(o.name), scalar});
  });
  return all;
}

Model::Model(const Tree<double>& tree, const Description& adapter, const Scalar& scalar, Route route)
    : size_{tree.nq, tree.nv},
      scalar_(scalar),
      frame_{static_cast<double>(tree.frame_joint)},
      references_(adapter.references),
      route_(std::move(route)) {
  frame_.insert(frame_.end(), tree.frame_Q.x.begin(), tree.frame_Q.x.end());
  frame_.insert(frame_.end(), tree.frame_p.x.begin(), tree.frame_p.x.end());
  const bool urdf = tree.urdf && adapter.models.contains("urdf");
  if (!urdf) unsupported_ = unsupported(tree, adapter);
  const Writer writer{scalar};
  json text = urdf ? urdf_of(*tree.urdf, writer.list(tree.gravity.x)) : writer.joints_of(tree);
  text["nq"] = size_.nq, text["nv"] = size_.nv;
  text_ = dumped(text);
}
Model::Model(const UrdfModel& robot, const Scalar& scalar, Route route)
    : size_{robot.nq, robot.nv}, scalar_(scalar), route_(std::move(route)) {
  json text = urdf_of(robot, {0, 0, -9.81});
  text["nq"] = size_.nq, text["nv"] = size_.nv;
  text_ = dumped(text);
}

OperationSizes Model::sizes(const Operation& o) const {
  return {o.name, count_numbers(o.arguments, size_) + (of_frame(o) ? frame_.size() : 0),
          count_numbers(o.results, size_)};
}

void Model::check_reference(const Operation& o, const void* arguments) const {
  constexpr std::array names{"world", "local", "aligned"};
  scalar_.with([&]<class S>() {  // the reference is the last argument
    const auto seen = static_cast<const S*>(arguments)[count_numbers(o.arguments, size_) - 1];
    if (!references_.contains(names.at(static_cast<std::size_t>(seen))))
      throw CallFailed(
          fmt::format("the adapter sees no frame in: {}", names.at(static_cast<std::size_t>(seen))), o.name,
          Outcome::outside_domain);
  });
}

void Model::call(const Operation& o, const void* arguments, void* results) const {
  if (!unsupported_.empty()) throw CallFailed(unsupported_, o.name, Outcome::outside_domain);
  const OperationSizes expected = sizes(o);
  const std::size_t size = scalar_.size;
  if (sees(o)) check_reference(o, arguments);
  std::vector<std::byte> all(expected.inputs * size);
  std::byte* const frame = std::copy_n(static_cast<const std::byte*>(arguments),
                                       count_numbers(o.arguments, size_) * size, all.data());
  if (of_frame(o)) scalar_.with([&]<class S>() { std::ranges::copy(frame_, reinterpret_cast<S*>(frame)); });
  Status status{};
  std::string why;
  try {
    why = route_().call({expected,
                         !scalar_.is_float(),
                         1,
                         all,
                         {static_cast<std::byte*>(results), expected.results * size},
                         {&status, 1},
                         text_});
  } catch (const AdapterFailed& e) {
    throw CallFailed(e.what(), o.name, Outcome::crashed);
  }
  if (status == Status::refused) throw CallRefused(in_words(status, why), o.name);
  if (status != Status::done) throw CallFailed(in_words(status, why), o.name, outcome_of(status));
}

namespace {

/// The functions of a model that are `offered`.
FindFunction found_in(std::shared_ptr<const Model> model, const Scalar& scalar, const auto& offered,
                      int tree = 0) {
  return [model = std::move(model), &scalar, offered, tree](const Operation& o) {
    NumberFunction f{&o, &scalar, model->size(), tree};
    if (offered(o)) f.compute = [model, &o](const void* in, void* out) { model->call(o, in, out); };
    return f;
  };
}

}  // namespace

void fill_tree(TreeOperations<double>& o, const Tree<double>& tree, const Description& adapter,
               const Scalar& scalar, const Route& route) {
  const int number = next_tree();
  if (!adapter.models.contains("joints") && !(tree.urdf && adapter.models.contains("urdf"))) return;
  fill_slots(o,
             found_in(
                 std::make_shared<const Model>(tree, adapter, scalar, route), scalar,
                 [&](const Operation& operation) {
                   return adapter.offered.contains({std::string(operation.name), std::string(scalar.name)});
                 },
                 number));
}
void fill_robot(RobotOperations<double>& o, const UrdfModel& robot, const Scalar& scalar,
                const Route& route) {
  fill_slots(o, found_in(std::make_shared<const Model>(robot, scalar, route), scalar,
                         [](const Operation&) { return true; }));
}

}  // namespace liecheck::properties::adapters
