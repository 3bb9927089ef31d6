#pragma once
// What the adapters of simulators share: the framing of the process protocol, and a robot's URDF with the places of its
// joints in q and v. docs/adapters.md, "Trees and robots", describes both.

#include <unistd.h>
#include <Eigen/Geometry>
#include <cstdio>
#include <functional>
#include <liecheck/urdf/xml.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace trees {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Quaterniond, Eigen::Vector3d, Eigen::VectorXd;

/// A joint that moves, and its first numbers in q and v. A robot from a URDF has only the names and the kind.
struct Joint {
  std::string name, kind, child;  ///< child: the name of its link
  int q = 0, v = 0, parent = -1;
  Quaterniond Q = Quaterniond::Identity();  ///< Q and p: the pose in the parent's frame where q is neutral
  Vector3d p = Vector3d::Zero(), axis = Vector3d::UnitZ();
};

/// A body that is fixed to a joint at the pose (Q, p).
struct Body {
  int joint;
  Quaterniond Q;
  Vector3d p;
  double mass;
  Vector3d c;
  Matrix3d I_C;
};

inline Vector3d three(const nlohmann::json& x) {
  return Vector3d(x.at(0).get<double>(), x.at(1).get<double>(), x.at(2).get<double>());
}
inline Quaterniond unit(const nlohmann::json& x) {
  const Vector3d v = three(x);
  return Quaterniond(x.at(3).get<double>(), v[0], v[1], v[2]).normalized();
}

/// A model of the protocol: the text of a URDF, or a list of joints and bodies.
struct Robot {
  std::string text,
      root;  ///< root: the name of the link that is no child; both are empty for a list of joints
  bool floating = false;  ///< the root of the URDF is a free-flyer, which is joints[0]
  std::vector<Joint> joints;
  std::vector<Body> bodies;
  Vector3d gravity;
  int nq = 0, nv = 0;

  explicit Robot(const nlohmann::json& model) : gravity(three(model.at("gravity"))) {
    if (model.contains("urdf"))
      read_urdf(model);
    else
      read_joints(model);
    for (Joint& j : joints) {
      static const std::map<std::string, std::pair<int, int>> sizes{
          {"revolute", {1, 1}},  {"continuous", {2, 1}},  {"prismatic", {1, 1}},
          {"spherical", {4, 3}}, {"translation", {3, 3}}, {"free-flyer", {7, 6}}};
      const auto size = sizes.find(j.kind);
      if (size == sizes.end())
        throw std::invalid_argument("the adapter takes no joint of the kind " + j.kind);
      j.q = nq, j.v = nv;
      nq += size->second.first, nv += size->second.second;
    }
  }

  /// The angle or length of a joint of one degree of freedom.
  double coordinate(const Joint& j, std::span<const double> q) const {
    const double* const x = &q[static_cast<std::size_t>(j.q)];
    return j.kind == "continuous" ? std::atan2(x[1], x[0]) : x[0];
  }

 private:
  void read_urdf(const nlohmann::json& model) {
    text = model.at("urdf"), floating = model.at("root") == "free-flyer";
    std::map<std::string, Joint> of_name;
    std::map<std::string, bool> is_child;
    const auto robot = liecheck::urdf_detail::parseXml(text, liecheck::urdf_detail::Messages("the URDF"));
    for (const auto& j : robot.children) {
      if (j.name != "joint") continue;
      Joint joint;
      joint.name = j.attribute("name"), joint.kind = j.attribute("type");
      joint.child = j.first("child")->attribute("link");
      if (joint.kind == "floating") joint.kind = "free-flyer";
      is_child[joint.child] = true;
      of_name[joint.name] = joint;
    }
    for (const auto& l : robot.children)
      if (l.name == "link" && !is_child[l.attribute("name")]) root = l.attribute("name");
    for (const std::string name : model.at("order")) {
      Joint own;
      own.name = name, own.kind = "free-flyer", own.child = root;
      joints.push_back(joints.empty() && floating ? own : of_name.at(name));
    }
  }
  void read_joints(const nlohmann::json& model) {
    for (const auto& x : model.at("joints")) {
      Joint j;
      j.name = "joint" + std::to_string(joints.size()), j.kind = x.at("kind"), j.parent = x.at("parent");
      j.Q = unit(x.at("Q")), j.p = three(x.at("p"));
      if (x.contains("axis")) j.axis = three(x.at("axis")).normalized();
      joints.push_back(j);
    }
    for (const auto& x : model.at("bodies")) {
      Body b{x.at("joint"), unit(x.at("Q")), three(x.at("p")), x.at("mass"), three(x.at("c")), {}};
      for (int i = 0; i < 9; ++i)
        b.I_C(i / 3, i % 3) = x.at("I_C").at(static_cast<std::size_t>(i)).get<double>();
      bodies.push_back(b);
    }
  }
};

using Numbers = std::vector<double>;
using Given = std::vector<std::span<const double>>;  ///< the arguments of a call

/// The numbers of a frame: the joint, Q and p in its body's axes.
struct Frame {
  std::size_t joint;
  Quaterniond Q;
  Vector3d p;
  explicit Frame(std::span<const double> x)
      : joint(static_cast<std::size_t>(x[0])),
        Q(Quaterniond(x[4], x[1], x[2], x[3]).normalized()),
        p(x[5], x[6], x[7]) {}
};

template <class M>
Numbers rows(const M& m) {
  Numbers x;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) x.push_back(m(i, j));
  return x;
}
inline Numbers pose(const Matrix3d& R, const Vector3d& p) {
  Numbers x = rows(R);
  x.insert(x.end(), p.data(), p.data() + 3);
  return x;
}
inline VectorXd vector(std::span<const double> x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// An operation: the sizes of its arguments and of its result, in words such as "q v 1" and "vv", and its function.
template <class Tree>
struct Operation {
  std::string arguments, result;
  std::function<Numbers(Tree&, const Given&)> of;
};

/// The streams of the protocol. Standard output becomes standard error, so that nothing that a library prints comes
/// between the answers.
class Wire {
 public:
  Wire() : out_(::fdopen(::dup(1), "wb")) { ::dup2(2, 1); }
  bool line(std::string& text) {
    text.clear();
    for (int c = std::getchar(); c != EOF; c = std::getchar()) {
      if (c == '\n') return true;
      text += static_cast<char>(c);
    }
    return false;
  }
  void read(void* to, std::size_t size) {
    if (std::fread(to, 1, size, stdin) != size) throw std::runtime_error("the call ends early");
  }
  void write(const void* from, std::size_t size) { std::fwrite(from, 1, size, out_); }
  void write(const std::string& text) { write(text.data(), text.size()); }
  void flush() { std::fflush(out_); }

 private:
  std::FILE* out_;
};

inline std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> all(1);
  for (const char c : text)
    if (c == ' ')
      all.emplace_back();
    else
      all.back() += c;
  return all;
}

/// Answers one call of one input. A thrown exception refuses it.
template <class Tree>
void answer(Wire& wire, Tree& tree, const std::string& line,
            const std::map<std::string, Operation<Tree>>& operations) {
  const auto size = [&](const std::string& word) {
    const int nq = tree.robot.nq, nv = tree.robot.nv;
    return static_cast<std::size_t>(word == "q"    ? nq
                                    : word == "v"  ? nv
                                    : word == "vv" ? nv * nv
                                    : word == "6v" ? 6 * nv
                                                   : std::stoi(word));
  };
  const auto call = words(line);  // "call tree_rnea double 1"
  const Operation<Tree>& o = operations.at(call.at(1));
  std::string status, reason;
  Numbers results;
  for (int i = std::stoi(call.at(3)); i > 0; --i) {
    Numbers input;
    std::vector<std::size_t> sizes;
    std::size_t total = 0;
    for (const std::string& word : words(o.arguments)) sizes.push_back(size(word)), total += sizes.back();
    input.resize(total);
    wire.read(input.data(), total * sizeof(double));
    Given given;
    std::size_t at = 0;
    for (const std::size_t n : sizes) given.push_back(std::span(input).subspan(at, n)), at += n;
    Numbers result(size(o.result), std::nan(""));
    status += '\0';
    try {
      result = o.of(tree, given);
    } catch (const std::exception& e) {
      status.back() = 1, reason = std::string(" ") + e.what();
    }
    results.insert(results.end(), result.begin(), result.end());
  }
  wire.write("done " + call.at(3) + reason + "\n" + status);
  wire.write(results.data(), results.size() * sizeof(double));
}

/// Describes the adapter and answers until the input ends. Tree is made of a Robot, which it keeps as `robot`. `takes` is
/// the member "trees" of the description.
template <class Tree>
int serve(const std::string& name, const std::string& version, const nlohmann::json& takes,
          const std::map<std::string, Operation<Tree>>& operations) {
  Wire wire;
  std::string line;
  wire.line(line);  // "liecheck 1"
  nlohmann::json d{{"protocol", 1}, {"name", name}, {"version", version}, {"trees", takes}};
  for (const auto& [operation, of] : operations) d["operations"][operation] = {"double"};
  wire.write(d.dump() + "\n");
  wire.flush();
  std::unique_ptr<Tree> tree;
  while (wire.line(line)) {
    if (line.starts_with("model ")) {
      tree.reset();
      try {
        tree = std::make_unique<Tree>(Robot(nlohmann::json::parse(line.substr(6))));
        wire.write("done\n");
      } catch (const std::exception& e) {
        std::string why = e.what();
        for (char& c : why)
          if (c == '\n') c = ' ';
        wire.write("refused " + why + "\n");
      }
    } else if (tree) {
      answer(wire, *tree, line, operations);
    } else {
      return 1;
    }
    wire.flush();
  }
  return 0;
}

}  // namespace trees
