#include <adapters/trees.hpp>

#include <fmt/format.h>
#include <adapters/shapes.hpp>
#include <algorithm>
#include <invariants/property.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <support/json.hpp>

namespace liecheck::properties::adapters {
namespace {

using nlohmann::json;

/// Whether the operation takes a frame.
bool of_frame(const Operation& o) {
  return o.name.starts_with("frame_");
}

/// How many numbers the values have. The reference of a frame has no parts, and is one number.
std::size_t numbers(const auto& layouts, int nq_numbers, int nv_numbers) {
  int n = 0;
  for (const Layout* layout : layouts) {
    if (layout->parts.size() == 0) ++n;
    for (const Part& part : layout->parts)
      n += part.size == nq          ? nq_numbers
           : part.size == nv        ? nv_numbers
           : part.size == nv_by_nv  ? nv_numbers * nv_numbers
           : part.size == six_by_nv ? 6 * nv_numbers
                                    : part.size;
  }
  return static_cast<std::size_t>(n);
}

template <class T>
json list(const T& x) {
  json all = json::array();
  for (const auto& number : x) all.push_back(static_cast<double>(number));
  return all;
}
template <class S>
json body(int joint, const oracles::BodyOf<S>& b, const oracles::Quaternion<S>& Q,
          const oracles::Vec3<S>& p) {
  return {{"joint", joint},   {"Q", list(Q.x)},      {"p", list(p.x)}, {"mass", static_cast<double>(b.mass)},
          {"c", list(b.c.x)}, {"I_C", list(b.I_C.x)}};
}
template <class S>
json joint(const oracles::JointOf<S>& j) {
  json text{{"kind", joint_names()[static_cast<std::size_t>(j.kind)]},
            {"parent", j.parent},
            {"Q", list(j.Q.x)},
            {"p", list(j.p.x)}};
  using enum oracles::JointKind;
  if (j.kind == revolute || j.kind == continuous || j.kind == prismatic || j.kind == helical)
    text["axis"] = list(j.axis.x);
  if (j.kind == helical) text["pitch"] = static_cast<double>(j.pitch);
  if (j.primary < 0) {
    text["armature"] = static_cast<double>(j.armature);
  } else {
    text["mimic"] = j.primary;
    text["multiplier"] = static_cast<double>(j.multiplier), text["offset"] = static_cast<double>(j.offset);
  }
  return text;
}
json joints_of(const auto& tree) {
  using S = std::remove_cvref_t<decltype(tree.frame_p[0])>;
  json text{{"gravity", list(tree.gravity.x)}, {"joints", json::array()}, {"bodies", json::array()}};
  const oracles::Vec3<S> origin{{S(0), S(0), S(0)}};
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    text["joints"].push_back(joint(tree.joints[i]));
    text["bodies"].push_back(
        body<S>(static_cast<int>(i), tree.joints[i].body, {{S(0), S(0), S(0), S(1)}}, origin));
  }
  for (const FixedBody<S>& b : tree.fixed) text["bodies"].push_back(body<S>(b.joint, b.body, b.Q, b.p));
  return text;
}
json urdf_of(const UrdfModel& m, const json& gravity) {
  return {{"urdf", m.text},
          {"root", m.fixed ? "fixed" : "free-flyer"},
          {"order", m.joints},
          {"gravity", gravity}};
}

/// What the tree has and the adapter does not take, in words, or "".
template <class S>
std::string unsupported(const Tree<S>& tree, const Description& adapter) {
  if (adapter.joints.empty()) return "";
  for (const auto& j : tree.joints) {
    std::vector<std::string> uses{joint_names()[static_cast<std::size_t>(j.kind)]};
    if (j.primary >= 0) uses.push_back("mimic");
    if (j.primary < 0 && j.armature != S(0)) uses.push_back("armature");
    for (const std::string& name : uses)
      if (!adapter.joints.contains(name)) return fmt::format("the adapter takes no tree with: {}", name);
  }
  return "";
}

template <class S>
MatX<S> matrix(const S* from, int rows, int columns) {
  return Eigen::Map<const Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(from, rows,
                                                                                             columns);
}
/// The result of an operation from its numbers.
template <class S, class R>
R result(const std::vector<S>& x, const Operation& o, int nv_numbers) {
  if constexpr (std::is_same_v<R, bool>)
    return x[0] != S(0);
  else if constexpr (std::is_same_v<R, VecX<S>>)
    return Eigen::Map<const VecX<S>>(x.data(), static_cast<Eigen::Index>(x.size()));
  else if constexpr (std::is_same_v<R, MatX<S>>)
    return matrix(x.data(), o.results[0]->parts[0].size == six_by_nv ? 6 : nv_numbers, nv_numbers);
  else if constexpr (requires { typename R::second_type; })
    return {matrix(x.data(), nv_numbers, nv_numbers),
            matrix(x.data() + nv_numbers * nv_numbers, nv_numbers, nv_numbers)};
  else
    return Shape<R>::get(x.data());
}

template <class S, class R, class... A>
void fill(std::function<R(const A&...)>& slot, const Operation& o,
          const std::shared_ptr<const Model<S>>& model) {
  slot = [model, &o](const A&... arguments) -> R {
    std::vector<S> numbers;
    (append(numbers, arguments), ...);
    return result<S, R>(model->call(o, std::move(numbers)), o, model->nv());
  };
}
/// Fills the slots of those operations for which `offered` is true.
template <class S, const auto&... all, class Offered>
void fill_all(Slots<S, all...>& slots, const std::shared_ptr<const Model<S>>& model, const Offered& offered) {
  ((offered(all) ? fill(slots[all], all, model) : void()), ...);
}

}  // namespace

const std::vector<std::string>& joint_names() {
  static const std::vector<std::string> all{"revolute", "continuous",  "prismatic",  "helical", "spherical",
                                            "planar",   "translation", "free-flyer", "mimic",   "armature"};
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

template <class S>
Model<S>::Model(const Tree<S>& tree, const Description& adapter, Route route)
    : nq_(tree.nq), nv_(tree.nv), frame_{S(tree.frame_joint)}, route_(std::move(route)) {
  frame_.insert(frame_.end(), tree.frame_Q.x.begin(), tree.frame_Q.x.end());
  frame_.insert(frame_.end(), tree.frame_p.x.begin(), tree.frame_p.x.end());
  const bool urdf = tree.urdf && adapter.models.contains("urdf");
  if (!urdf) unsupported_ = unsupported(tree, adapter);
  json text = urdf ? urdf_of(*tree.urdf, list(tree.gravity.x)) : joints_of(tree);
  text["nq"] = nq_, text["nv"] = nv_;
  text_ = dumped(text);
}
template <class S>
Model<S>::Model(const UrdfModel& robot, Route route)
    : nq_(robot.nq), nv_(robot.nv), route_(std::move(route)) {
  json text = urdf_of(robot, {0, 0, -9.81});
  text["nq"] = nq_, text["nv"] = nv_;
  text_ = dumped(text);
}

template <class S>
OperationSizes Model<S>::sizes(const Operation& o) const {
  return {o.name, numbers(o.arguments, nq_, nv_) + (of_frame(o) ? frame_.size() : 0),
          numbers(o.results, nq_, nv_)};
}

template <class S>
std::vector<S> Model<S>::call(const Operation& o, std::vector<S> arguments) const {
  if (!unsupported_.empty()) throw CallFailed(unsupported_, o.name, Outcome::outside_domain);
  if (of_frame(o)) append(arguments, frame_);
  const OperationSizes expected = sizes(o);
  std::vector<S> results(expected.results, std::numeric_limits<S>::quiet_NaN());
  Status status{};
  std::string why;
  try {
    why = route_().call({expected, sizeof(S) == 8, 1, std::as_bytes(std::span(arguments)),
                         std::as_writable_bytes(std::span(results)), std::span(&status, 1), text_});
  } catch (const AdapterFailed& e) {
    throw CallFailed(e.what(), o.name, Outcome::crashed);
  }
  if (status == Status::refused) throw std::domain_error(in_words(status, why));
  if (status != Status::done) throw CallFailed(in_words(status, why), o.name, outcome_of(status));
  return results;
}

template <class S>
TreeOperations<S> tree_operations(const Tree<S>& tree, const Description& adapter, const Route& route) {
  TreeOperations<S> o;
  if (adapter.models.contains("joints") || (tree.urdf && adapter.models.contains("urdf")))
    fill_all(o, std::make_shared<const Model<S>>(tree, adapter, route), [&](const Operation& operation) {
      return adapter.offered.contains({std::string(operation.name), std::string(oracles::scalar_of<S>.name)});
    });
  return o;
}
template <class S>
RobotOperations<S> robot_operations(const std::string& urdf, bool fixed, const Route& route) {
  RobotOperations<S> o;
  fill_all(o, std::make_shared<const Model<S>>(*urdf_model(urdf, fixed), route),
           [](const Operation&) { return true; });
  return o;
}

template class Model<float>;
template class Model<double>;
template TreeOperations<float> tree_operations(const Tree<float>&, const Description&, const Route&);
template TreeOperations<double> tree_operations(const Tree<double>&, const Description&, const Route&);
template RobotOperations<float> robot_operations(const std::string&, bool, const Route&);
template RobotOperations<double> robot_operations(const std::string&, bool, const Route&);

}  // namespace liecheck::properties::adapters
