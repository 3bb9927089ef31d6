// liecheck's batches of poses and states, one column at a time: a kernel computes it with all lanes of a
// register. `liecheck cost` times whole batches (timing/batches.hpp). All sets of instructions give the same
// bits (tests/lib/batch_test.cpp).

#include <subjects/liecheck_trees.hpp>
#include <subjects/own_programs.hpp>

#include <liecheck/batch/poses.hpp>
#include <liecheck/batch/trees.hpp>
#include <liecheck/spatial/checked_rotation.hpp>

namespace liecheck::properties {
namespace {

template <class S>
struct Batch {
  template <int N>
  static batch::Rows<S, N> one(const Vec<S, N>& v) {
    return v.array();
  }
  static batch::Rows<S, 12> one(const Pose<S>& X) {
    batch::Rows<S, 12> rows(12, 1);
    for (int i = 0; i < 12; ++i) rows(i) = i < 9 ? X.R(i / 3, i % 3) : X.p[i - 9];
    return rows;
  }
  static Pose<S> pose(const batch::Rows<S, 12>& rows) {
    Pose<S> X;
    for (int i = 0; i < 12; ++i) (i < 9 ? X.R(i / 3, i % 3) : X.p[i - 9]) = rows(i);
    return X;
  }
  static Mat<S, 6> matrix(const batch::Rows<S, 36>& rows) {
    Mat<S, 6> m;
    for (int i = 0; i < 36; ++i) m(i / 6, i % 6) = rows(i);
    return m;
  }

  /// The algorithms on one state of a tree.
  static TreeOperations<S> tree(const Tree<S>& bodies) {
    using X = VecX<S>;
    using Force6 = Vec<S, 6>;
    const auto model = std::make_shared<const Model<S>>(liecheck_model<S>(bodies));
    const auto one = [](const X& x) { return batch::States<S>(x.array()); };
    const auto external = [model](int joint, const Force6& F) {
      batch::States<S> all;
      if (joint < 0) return all;
      all.setZero(6 * model->njoints, 1);
      all.template middleRows<6>(6 * (joint + 1)) = F.array();
      return all;
    };
    TreeOperations<S> o;
    o[op::tree_rnea] = [=](const X& q, const X& v, const X& a, int i, const Force6& F) -> X {
      return batch::rnea<S>(*model, one(q), one(v), one(a), {}, external(i, F)).matrix();
    };
    o[op::tree_aba] = [=](const X& q, const X& v, const X& tau, int i, const Force6& F) -> X {
      return batch::aba<S>(*model, one(q), one(v), one(tau), {}, external(i, F)).matrix();
    };
    o[op::frame_pose] = [=](const X& q) {
      const auto all = batch::forwardKinematics<S>(*model, one(q));
      const Frame<S>& frame = model->frames.back();
      const Pose<S> joint = pose(batch::Rows<S, 12>(all.template middleRows<12>(12 * frame.parentJoint)));
      const SE3<S> X_WF = SE3<S>(joint.R, joint.p) * frame.placement;
      return Pose<S>{X_WF.rotation(), X_WF.translation()};
    };
    return o;
  }

  static TypedSubject<S> make() {
    TypedSubject<S> s{"liecheck:batch", LIECHECK_VERSION, {}};
    auto& o = s.operations;
    o.check_quaternion = [](const Vec<S, 4>& Q) { checkedQuaternion<S>(Q); };
    o[op::exp3_quaternion] = [](const Vec<S, 3>& phi) -> Vec<S, 4> {
      const Vec<S, 6> xi = (Vec<S, 6>() << Vec<S, 3>::Zero(), phi).finished();
      return batch::exp6<S>(one(xi)).template bottomRows<4>();
    };
    o[op::log3_quaternion] = [](const Vec<S, 4>& Q) -> Vec<S, 3> {
      const Vec<S, 7> q = (Vec<S, 7>() << Vec<S, 3>::Zero(), Q).finished();
      return batch::log6<S>(one(q)).template bottomRows<3>();
    };
    o[op::rotate_point] = [](const Vec<S, 4>& Q, const Vec<S, 3>& x) -> Vec<S, 3> {
      const Vec<S, 7> q = (Vec<S, 7>() << Vec<S, 3>::Zero(), Q).finished();
      return batch::act<S>(one(q), one(x));
    };
    o[op::exp6] = [](const Vec<S, 6>& xi) { return pose(batch::exp6Matrix<S>(one(xi))); };
    o[op::compose] = [](const Pose<S>& X, const Pose<S>& Y) {
      return pose(batch::compose<S>(one(X), one(Y)));
    };
    o[op::act_point] = [](const Pose<S>& X, const Vec<S, 3>& x) -> Vec<S, 3> {
      return batch::act<S>(one(X), one(x));
    };
    o[op::integrate] = [](const Vec<S, 7>& q, const Vec<S, 6>& d) -> Vec<S, 7> {
      return batch::integrate<S>(one(q), one(d));
    };
    o[op::difference] = [](const Vec<S, 7>& q0, const Vec<S, 7>& q1) -> Vec<S, 6> {
      return batch::difference<S>(one(q0), one(q1));
    };
    o[op::right_jacobian6] = [](const Vec<S, 6>& xi) { return matrix(batch::Jexp6<S>(one(xi))); };
    o[op::right_jacobian6_inverse] = [](const Vec<S, 6>& xi) {
      return matrix(batch::rightJacobianInverse<S>(one(xi)));
    };
    o.tree = &tree;
    return s;
  }
};

const Registered<float> in_float(Batch<float>::make());
const Registered<double> in_double(Batch<double>::make());

const RegisteredPrograms programs(
    "liecheck:batch",
    {"-I lib -lliecheck_batch",
     "#include <liecheck/batch/poses.hpp>\n"
     "using namespace liecheck;\n",
     "",
     {{&op::exp3_quaternion,
       "batch::Rows<S, 6> xi(6, 1);\nxi << 0, 0, 0, phi;\nstd::cout << batch::exp6<S>(xi).bottomRows<4>() << "
       "'\\n';"},
      {&op::log3_quaternion,
       "batch::Rows<S, 7> q(7, 1);\nq << 0, 0, 0, Q;\nstd::cout << batch::log6<S>(q).bottomRows<3>() << "
       "'\\n';"},
      {&op::rotate_point,
       "batch::Rows<S, 7> q(7, 1);\nq << 0, 0, 0, Q;\nstd::cout << batch::act<S>(q, batch::Rows<S, "
       "3>(p.array())) << '\\n';"},
      {&op::exp6, "batch::exp6Matrix<S>(batch::Rows<S, 6>(xi.array()))"},
      {&op::compose,
       "batch::Rows<S, 12> X(12, 1);\nX << R.transpose().reshaped(), p;\nbatch::Rows<S, 12> Y(12, 1);\nY << "
       "R_Y.transpose().reshaped(), p_Y;\nstd::cout << batch::compose<S>(X, Y) << '\\n';"},
      {&op::act_point,
       "batch::Rows<S, 12> X(12, 1);\nX << R.transpose().reshaped(), p;\nstd::cout << batch::act<S>(X, "
       "batch::Rows<S, 3>(p_Y.array())) << '\\n';"},
      {&op::integrate,
       "batch::integrate<S>(batch::Rows<S, 7>(q0.array()), batch::Rows<S, 6>(delta.array()))"},
      {&op::difference, "batch::difference<S>(batch::Rows<S, 7>(q0.array()), batch::Rows<S, 7>(q1.array()))"},
      {&op::right_jacobian6, "batch::Jexp6<S>(batch::Rows<S, 6>(xi.array()))"},
      {&op::right_jacobian6_inverse, "batch::rightJacobianInverse<S>(batch::Rows<S, 6>(xi.array()))"}}});

}  // namespace
}  // namespace liecheck::properties
