#include <adapters/tree_check.hpp>

#include <fmt/format.h>
#include <adapters/asked.hpp>
#include <adapters/trees.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <invariants/tree_law.hpp>
#include <iterator>
#include <operations/numbers.hpp>
#include <subjects/subject.hpp>
#include <support/embedded.hpp>
#include <support/same_numbers.hpp>

namespace liecheck::properties::adapters {
namespace {

/// Numbers from -1 to 1 without a pattern.
class Numbers {
 public:
  double operator()() { return 2 * (std::fmod(0.6180339887 * ++k_, 1) - 0.5); }
  oracles::Vec3<double> three() {
    const double x = (*this)(), y = (*this)();
    return {{x, y, (*this)()}};
  }
  std::vector<double> unit(int n) {
    std::vector<double> x;
    double square = 0;
    for (int i = 0; i < n; ++i) x.push_back((*this)()), square += x.back() * x.back();
    for (double& number : x) number /= std::sqrt(square);
    return x;
  }

 private:
  int k_ = 0;
};

/// A chain with one joint of each kind that the adapter takes, and two bodies on each.
Tree<double> chain(const Description& adapter) {
  const auto takes = [&](std::size_t name) {
    return adapter.joints.empty() || adapter.joints.contains(joint_names()[name]);
  };
  Numbers number;
  Tree<double> tree;
  tree.gravity = {{0.3, -0.2, -9.7}};
  constexpr int free_flyer = static_cast<int>(oracles::JointKind::free_flyer);
  for (int kind = free_flyer; kind >= 0; --kind) {
    if (!takes(static_cast<std::size_t>(kind))) continue;
    oracles::JointOf<double> j;
    j.kind = static_cast<oracles::JointKind>(kind);
    j.parent = static_cast<int>(tree.joints.size()) - 1;
    const auto Q = number.unit(4), axis = number.unit(3);
    j.Q = {{Q[0], Q[1], Q[2], Q[3]}}, j.axis = {{axis[0], axis[1], axis[2]}}, j.p = number.three();
    j.pitch = 0.2, j.multiplier = j.offset = 0, j.armature = takes(joint_names().size() - 1) ? 0.1 : 0;
    j.body = {1.5, number.three(), {{0.5, 0.05, 0.02, 0.05, 0.6, 0.03, 0.02, 0.03, 0.7}}};
    tree.joints.push_back(j);
  }
  tree.index();
  tree.frame_joint = static_cast<int>(tree.joints.size()) - 1;
  tree.frame_Q = {{0.5, -0.5, 0.1, 0.7}}, tree.frame_p = number.three();
  for (int i = 0; i <= tree.frame_joint; ++i) {
    const auto Q = number.unit(4);
    const oracles::BodyOf<double> body{0.75, number.three(), tree.joints[0].body.I_C};
    tree.fixed.push_back({i, body, {{Q[0], Q[1], Q[2], Q[3]}}, number.three()});
  }
  return tree;
}

Tree<double> built_in_robot_tree() {
  const RobotNumbers r = robot_numbers({.name = "", .urdf = built_in_robot_urdf, .path = "", .hash = ""});
  const TreeCase<double> c(r.at, r.numbers, r.numbers);
  Tree<double> tree = described(c);
  tree.urdf = urdf_model(built_in_robot_urdf, false);
  tree.frame_joint = static_cast<int>(tree.joints.size()) - 1;
  return tree;
}

/// A state of a tree, as numbers rounded to a scalar.
struct State {
  std::vector<double> q, v, a, joint, F;

  State(const Tree<double>& tree, const Scalar& scalar, Numbers& number)
      : joint{static_cast<double>(tree.joints.size()) - 1} {
    const auto next = [&] { return scalar.rounded(number()); };
    for (const auto& j : tree.joints) {
      if (j.primary >= 0) continue;
      using enum oracles::JointKind;
      const int n = configuration_size(j.kind), circle = j.kind == continuous || j.kind == planar ? 2 : 0,
                unit = j.kind == spherical || j.kind == free_flyer ? 4 : circle;
      for (int k = unit; k < n; ++k) q.push_back(next());
      for (const double x : number.unit(unit)) q.push_back(scalar.rounded(x));
    }
    for (auto* part : {&v, &a}) std::generate_n(std::back_inserter(*part), tree.nv, next);
    std::generate_n(std::back_inserter(F), 6, next);
  }
};

/// The numbers of the argument that the layout names. `other` is a second state.
std::vector<double> argument(const Layout& layout, const State& x, const State& other, Seen seen) {
  return layout.name == "q1"                            ? other.q
         : layout.name.starts_with('q')                 ? x.q
         : layout.name == "v" || layout.name == "delta" ? x.v
         : layout.name == op::wrench_joint.name         ? x.joint
         : layout.name == op::wrench.name               ? x.F
         : layout.name == op::seen.name                 ? std::vector{static_cast<double>(seen)}
                                                        : x.a;
}

constexpr const char* reference_names[] = {"world", "local", "aligned"};

bool sees(const Operation& o) {
  return std::ranges::any_of(o.arguments, [](const Layout* l) { return l->name == op::seen.name; });
}

std::string difference(const std::vector<double>& x, const std::vector<double>& right) {
  double size = 0;
  for (const double y : right) size = std::max(size, std::fabs(y));
  for (std::size_t k = 0; k < x.size(); ++k)
    if (!(std::fabs(x[k] - right[k]) <= size / 1000))
      return fmt::format("number {} of its result is {:.6g}, and {:.6g} is right", k + 1, x[k], right[k]);
  return "";
}

/// What an operation promises of its numbers: of a Coriolis matrix C, of which there are many, C v and C + C^T.
std::vector<double> promised(const Operation& o, const std::vector<double>& x, const std::vector<double>& v) {
  if (o.name != op::tree_coriolis.name) return x;
  const std::size_t n = v.size();
  std::vector<double> all(n);
  for (std::size_t i = 0; i < n * n; ++i) {
    all[i / n] += x[i] * v[i % n];
    all.push_back(x[i] + x[i % n * n + i / n]);
  }
  return all;
}

/// What other convention makes the numbers right, in words, or "".
std::string explanation(const Operation& o, const std::vector<double>& x, const std::vector<double>& right,
                        const std::vector<double>& v) {
  const Few<Part, 4>& parts = o.results[0]->parts;
  const int shape = parts[0].size;
  const bool two_vectors = parts.size() == 2 && shape == 3 && parts[1].size == 3;
  const std::size_t n = two_vectors ? x.size() : x.size() / parts.size();  // the numbers of one matrix
  const std::size_t rows = shape == six_by_nv     ? 6
                           : shape == three_by_nv ? 3
                           : shape == nv_by_nv    ? static_cast<std::size_t>(std::sqrt(double(n)) + 0.5)
                                                  : 0;
  // `from`: the place, in each matrix, of its number i.
  const auto is = [&](const auto& from, double sign = 1) {
    std::vector<double> other = x;
    for (std::size_t i = 0; i < x.size(); ++i) other[i] = sign * x[from(i)];
    return difference(promised(o, other, v), promised(o, right, v)).empty();
  };
  const auto in_each = [n](const auto& from) {
    return [n, from](std::size_t i) { return i / n * n + from(i % n); };
  };
  const std::size_t columns = rows ? n / rows : 0;
  if (is([](std::size_t i) { return i; }, -1)) return ": it has the opposite sign";
  if (rows > 0 && is(in_each([&](std::size_t i) { return i % columns * rows + i / columns; })))
    return rows == columns ? ": it is transposed" : ": it is stored column by column";
  if ((two_vectors || rows == 6) && is(in_each([n](std::size_t i) { return (i + n / 2) % n; })))
    return ": its angular part comes first";
  const std::size_t half = x.size() / 2;
  return parts.size() == 2 && !two_vectors && is([&](std::size_t i) { return (i + half) % x.size(); })
             ? fmt::format(": its two parts are exchanged, '{}' comes first", parts[0].name)
             : "";
}

/// V x of the columns of J (6 x nv, row by row) for a velocity V = J v.
std::vector<double> moved_columns(const std::vector<double>& J, const std::vector<double>& v) {
  const std::size_t n = v.size();
  std::vector<double> V(6), all(J.size());
  for (std::size_t i = 0; i < J.size(); ++i) V[i / n] += J[i] * v[i % n];
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto cross = [&](std::size_t a, std::size_t b) {  // component i of V[a..] x column k of J from b
        const std::size_t y = (i + 1) % 3, z = (i + 2) % 3;
        return V[a + y] * J[(b + z) * n + k] - V[a + z] * J[(b + y) * n + k];
      };
      all[i * n + k] = cross(3, 0) + cross(0, 3);
      all[(3 + i) * n + k] = cross(3, 3);
    }
  return all;
}

class TreeCheck {
 public:
  TreeCheck(Adapter& adapter, const Scalar& scalar, const Tree<double>& tree,
            std::vector<CheckedOperation>& to, std::vector<conventions::Finding>& findings)
      : adapter_(adapter),
        scalar_(scalar),
        to_(to),
        findings_(findings),
        model_(tree, adapter.description(), scalar, [&]() -> Adapter& { return adapter; }),
        where_(tree.urdf ? "of the URDF of the built-in robot" : "of a chain of joints with two bodies each"),
        first_(tree, scalar, number_),
        second_(tree, scalar, number_) {}

  template <const auto&... all>
  void each(const Slots<double, all...>& reference) {
    if constexpr (std::is_base_of_v<Slot<double, std::remove_cvref_t<decltype(op::frame_jacobian)>>,
                                    Slots<double, all...>>)
      columns_ = [&](const std::vector<double>& x) {
        return called(reference[op::frame_jacobian], op::frame_jacobian, x.data(), model_.size());
      };
    const auto right = [&](const auto& o) {
      one(o, [&](const std::vector<double>& x) { return called(reference[o], o, x.data(), model_.size()); });
    };
    (right(all), ...);
  }

 private:
  using Reference = std::function<std::vector<double>(const std::vector<double>& arguments)>;

  void one(const Operation& o, const Reference& reference) {
    const std::string scalar(scalar_.name);
    if (!adapter_.description().offered.contains({std::string(o.name), scalar})) return;
    const auto is_this = [&](const CheckedOperation& c) {
      return c.operation == o.name && c.scalar == scalar;
    };
    auto at = std::ranges::find_if(to_, is_this);
    if (at == to_.end()) at = to_.insert(at, {std::string(o.name), scalar, ""});
    for (const Seen seen : {Seen::world, Seen::local, Seen::aligned}) {
      if (sees(o) && !references_.contains(reference_names[static_cast<int>(seen)])) continue;
      if (!at->complaint.empty() || (!sees(o) && seen != Seen::world)) return;
      scalar_.with([&]<class S>() { at->complaint = asked<S>(o, reference, seen); });
    }
  }
  /// Whether a rate of a Jacobian in LOCAL lacks the term of the frame's own velocity V = J v, in words, or "". Its product
  /// with v is right, since V x V = 0.
  std::string without_own_velocity(const State& at, std::vector<double> x,
                                   const std::vector<double>& right) const {
    std::vector<double> arguments = at.q;
    arguments.push_back(static_cast<double>(Seen::local));
    const std::vector<double> term = moved_columns(columns_(arguments), at.v);
    if (term.size() != x.size()) return "";
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= term[i];
    return difference(x, right).empty() ? ": it lacks - V x J, the frame's own velocity" : "";
  }
  template <class S>
  std::string asked(const Operation& o, const Reference& reference, Seen seen) try {
    std::vector<S> inputs;
    std::vector<std::vector<double>> right;
    for (const auto& [x, other] : {std::pair(&first_, &second_), std::pair(&second_, &first_)}) {
      std::vector<double> arguments;
      for (const Layout* layout : o.arguments)
        std::ranges::copy(argument(*layout, *x, *other, seen), std::back_inserter(arguments));
      right.push_back(reference(arguments));
      inputs.insert(inputs.end(), arguments.begin(), arguments.end());
      if (of_frame(o))
        inputs.insert(inputs.end(), model_.frame().begin(), model_.frame().end());
    }
    const OperationSizes sizes = model_.sizes(o);
    std::vector<S> together(2 * sizes.results), single = together;
    std::vector<Status> status(2);
    const auto call = [&](std::size_t first, std::size_t n, std::vector<S>& results) {
      return adapter_.call(
          {sizes, sizeof(S) == 8, n,
           std::as_bytes(std::span(inputs).subspan(first * sizes.inputs, n * sizes.inputs)),
           std::as_writable_bytes(std::span(results).subspan(first * sizes.results, n * sizes.results)),
           std::span(status).subspan(first, n), model_.text()});
    };
    const std::string why = call(0, 2, together);
    for (const Status s : status)
      if (s != Status::done) return fmt::format("{}: {}", where_, in_words(s, why));
    for (std::size_t k = 0; k < 2; ++k) call(k, 1, single);
    if (!same_numbers<S>(together, single))
      return fmt::format("{}: gives other numbers for 2 inputs in one batch than one by one", where_);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto x = std::span(single).subspan(k * sizes.results, sizes.results);
      const std::vector<double> got(x.begin(), x.end());
      const State& at = k == 0 ? first_ : second_;
      std::string wrong = difference(promised(o, got, at.v), promised(o, right[k], at.v));
      if (wrong.empty()) continue;
      if (o.name == op::tree_coriolis.name) wrong = "C v or C + C^T is wrong";
      wrong += explanation(o, got, right[k], at.v);
      if (seen == Seen::local && o.name == op::frame_jacobian_rate.name)
        wrong += without_own_velocity(at, got, right[k]);
      constexpr const char* references[] = {" in WORLD", " in LOCAL", " in LOCAL_WORLD_ALIGNED"};
      findings_.push_back({false,
                           fmt::format("{} {}{}: {}", o.name, where_,
                                       sees(o) ? references[static_cast<int>(seen)] : "", wrong),
                           {std::string(o.name)}});
      return "is wrong";
    }
    return "";
  } catch (const AdapterFailed& e) {
    return fmt::format("{}: {}", where_, e.what());
  }

  Adapter& adapter_;
  const Scalar& scalar_;
  std::vector<CheckedOperation>& to_;
  std::vector<conventions::Finding>& findings_;
  Model model_;
  std::string where_;
  std::function<std::vector<double>(const std::vector<double>&)> columns_;  ///< J at q, as seen
  Numbers number_;
  State first_, second_;
  std::set<std::string> references_ = references_taken(adapter_);
};

void check_in(const Scalar& scalar, Adapter& adapter, Checked& all) {
  const Description& d = adapter.description();
  const auto every = subjects(scalar);
  const Operations& own = (*std::ranges::find(every, "liecheck", &Subject::name))->operations;
  const auto check = [&](const Tree<double>& tree) {
    TreeCheck c(adapter, scalar, tree, all.operations, all.findings);
    c.each(own.tree(tree));
    if (tree.urdf) c.each(own.robot(tree.urdf->text, tree.urdf->fixed));
  };
  if (d.models.contains("joints")) check(chain(d));
  if (d.models.contains("urdf")) check(built_in_robot_tree());
}

/// Whether the adapter refuses the operation on the tree in a reference.
template <class S>
bool refuses(Adapter& adapter, const Model& model, const Operation& o, const State& x, int seen) {
  std::vector<S> inputs;
  for (const Layout* layout : o.arguments)
    std::ranges::copy(argument(*layout, x, x, static_cast<Seen>(seen)), std::back_inserter(inputs));
  inputs.insert(inputs.end(), model.frame().begin(), model.frame().end());
  const OperationSizes sizes = model.sizes(o);
  std::vector<S> results(sizes.results);
  Status status{};
  adapter.call({sizes,
                sizeof(S) == 8,
                1,
                std::as_bytes(std::span(inputs)),
                std::as_writable_bytes(std::span(results)),
                {&status, 1},
                model.text()});
  return status == Status::refused;
}

}  // namespace

std::set<std::string> references_taken(Adapter& adapter) try {
  const Description& d = adapter.description();
  std::set<std::string> taken;
  for (const Scalar* scalar : {&oracles::scalar_of<double>, &oracles::scalar_of<float>}) {
    std::vector<const Operation*> asked;
    for (const Operation* o : model_operations())
      if (sees(*o) && d.offered.contains({std::string(o->name), std::string(scalar->name)}))
        asked.push_back(o);
    if (asked.empty()) continue;
    const Tree<double> tree = d.models.contains("joints") ? chain(d) : built_in_robot_tree();
    const Model model(tree, d, *scalar, [&]() -> Adapter& { return adapter; });
    Numbers number;
    const State x(tree, *scalar, number);
    for (const Operation* o : asked)
      for (int seen = 0; seen < 3; ++seen)
        scalar->with([&]<class S>() {
          if (d.references.contains(reference_names[seen]) && !refuses<S>(adapter, model, *o, x, seen))
            taken.insert(reference_names[seen]);
        });
  }
  return taken.empty() ? d.references : taken;
} catch (const AdapterFailed&) {
  return adapter.description().references;
}

Checked check_trees(Adapter& adapter) {
  Checked all;
  const auto of_trees = [](const auto& offered) { return model_operation(offered.first) != nullptr; };
  if (std::ranges::none_of(adapter.description().offered, of_trees)) return all;
  check_in(oracles::scalar_of<double>, adapter, all);
  check_in(oracles::scalar_of<float>, adapter, all);
  return all;
}

}  // namespace liecheck::properties::adapters
