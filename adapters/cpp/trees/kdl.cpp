// Orocos KDL: the URDF reader of kdl_parser and the solvers of a Tree, in double. KDL has no joint of more than one
// degree of freedom, so that the root is fixed; its inertia matrix and its forward dynamics are those of chains.

#include <kdl/config.h>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <kdl/treejnttojacsolver.hpp>
#include <kdl_parser/kdl_parser.hpp>

#include "protocol.hpp"

namespace {

using namespace trees;

struct Tree {
  Robot robot;
  KDL::Tree tree;
  std::vector<unsigned> index;  ///< KDL's number of each joint

  explicit Tree(const Robot& given) : robot(given) {
    if (robot.floating) throw std::invalid_argument("KDL has no free-flyer");
    if (!kdl_parser::treeFromString(robot.text, tree))
      throw std::invalid_argument("kdl_parser does not read the URDF");
    if (static_cast<int>(tree.getNrOfJoints()) != robot.nv)
      throw std::invalid_argument("kdl_parser reads another number of joints");
    for (const Joint& j : robot.joints) index.push_back(GetTreeElementQNr(tree.getSegment(j.child)->second));
  }
  KDL::JntArray q(std::span<const double> x) const {
    KDL::JntArray y(tree.getNrOfJoints());
    for (std::size_t i = 0; i < index.size(); ++i) y(index[i]) = robot.coordinate(robot.joints[i], x);
    return y;
  }
  KDL::JntArray v(std::span<const double> x) const {
    KDL::JntArray y(tree.getNrOfJoints());
    for (std::size_t i = 0; i < index.size(); ++i) y(index[i]) = x[i];
    return y;
  }
  const std::string& link(std::size_t joint) const { return robot.joints[joint].child; }
};

Numbers rnea(Tree& t, const Given& x) {
  KDL::TreeIdSolver_RNE solver(t.tree, {t.robot.gravity[0], t.robot.gravity[1], t.robot.gravity[2]});
  KDL::WrenchMap wrenches;
  if (x[3][0] >= 0)
    wrenches[t.link(static_cast<std::size_t>(x[3][0]))] = {{x[4][0], x[4][1], x[4][2]},
                                                           {x[4][3], x[4][4], x[4][5]}};
  KDL::JntArray tau(t.tree.getNrOfJoints());
  if (solver.CartToJnt(t.q(x[0]), t.v(x[1]), t.v(x[2]), wrenches, tau) < 0)
    throw std::runtime_error("TreeIdSolver_RNE fails");
  Numbers y;
  for (const unsigned k : t.index) y.push_back(tau(k));
  return y;
}
KDL::Frame placed(Tree& t, std::span<const double> q, const Frame& f) {
  KDL::TreeFkSolverPos_recursive solver(t.tree);
  KDL::Frame X;
  if (solver.JntToCart(t.q(q), X, t.link(f.joint)) < 0)
    throw std::runtime_error("TreeFkSolverPos_recursive fails");
  return X *
         KDL::Frame(KDL::Rotation::Quaternion(f.Q.x(), f.Q.y(), f.Q.z(), f.Q.w()), {f.p[0], f.p[1], f.p[2]});
}
Numbers frame_pose(Tree& t, const Given& x) {
  const KDL::Frame X = placed(t, x[0], Frame(x[1]));
  Numbers y(X.M.data, X.M.data + 9);
  y.insert(y.end(), X.p.data, X.p.data + 3);
  return y;
}
Numbers frame_jacobian(Tree& t, const Given& x) {
  const Frame f(x[2]);
  const KDL::Frame X = placed(t, x[0], f);
  KDL::TreeFkSolverPos_recursive of_link(t.tree);
  KDL::Frame link;
  KDL::Jacobian J(t.tree.getNrOfJoints());
  if (of_link.JntToCart(t.q(x[0]), link, t.link(f.joint)) < 0 ||
      KDL::TreeJntToJacSolver(t.tree).JntToJac(t.q(x[0]), J, t.link(f.joint)) < 0)
    throw std::runtime_error("TreeJntToJacSolver fails");
  J.changeRefPoint((x[1][0] == 0 ? KDL::Vector::Zero() : X.p) - link.p);  // in the root's axes, at the link
  if (x[1][0] == 1) J.changeBase(X.M.Inverse());
  MatrixXd y(6, t.robot.nv);
  for (std::size_t i = 0; i < t.index.size(); ++i)
    y.col(static_cast<int>(i)) = J.data.col(static_cast<int>(t.index[i]));
  return rows(y);
}

}  // namespace

int main() {
  return serve<Tree>("kdl_trees", KDL_VERSION_STRING,
                     {{"models", {"urdf"}}, {"joints", {"revolute", "continuous", "prismatic"}}},
                     {{"tree_rnea", {"q v v 1 6", "v", rnea}},
                      {"frame_pose", {"q 8", "12", frame_pose}},
                      {"frame_jacobian", {"q 1 8", "6v", frame_jacobian}}});
}
