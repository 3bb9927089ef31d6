#include <liecheck/batch/trees.hpp>

#include <exception>
#include <liecheck/algorithms/aba.hpp>
#include <liecheck/batch/dispatch.hpp>

namespace liecheck::batch {

namespace {

using namespace detail;

enum class TreeOperation { forwardKinematics, rnea, aba };

/// Computes states one by one.
template <class S>
struct Single {
  TreeOperation operation;
  const Model<S>& model;
  Data<S> data{model, model.has_mimics ? Dense::Mass : Dense::None};
  std::exception_ptr failure = nullptr;

  static void alone(const TreeTask<S>& task, Eigen::Index i) {
    auto& self = *static_cast<Single*>(task.context);
    try {
      self.compute(task, i);
    } catch (...) {
      self.failure = std::current_exception();
    }
  }

 private:
  void compute(const TreeTask<S>& task, Eigen::Index i) {
    const auto argument = [&](int a) {
      VectorX<S> x(a == 0 ? model.nq : model.nv);
      for (Eigen::Index r = 0; r < x.size(); ++r) x[r] = task.in[a][r * task.stride + i];
      return x;
    };
    S* const to = task.out + i;
    if (operation == TreeOperation::forwardKinematics) {
      liecheck::forwardKinematics(model, data, argument(0));
      for (int k = 0; k < 12 * model.njoints; ++k) {
        const SE3<S>& X = data.oMi[std::size_t(k / 12)];
        to[k * task.stride] = k % 12 < 9 ? X.rotation()(k % 12 / 3, k % 3) : X.translation()[k % 12 - 9];
      }
      return;
    }
    std::vector<Force<S>> fext;
    if (task.in[3])
      for (int j = 0; j < model.njoints; ++j)
        fext.emplace_back(Vector6<S>(Vector6<S>::NullaryExpr(
            [&](Eigen::Index k) { return task.in[3][(6 * j + k) * task.stride + i]; })));
    const VectorX<S>& result =
        operation == TreeOperation::rnea
            ? liecheck::rnea(model, data, argument(0), argument(1), argument(2), External<S>(fext))
            : liecheck::aba(model, data, argument(0), argument(1), argument(2), External<S>(fext));
    for (int k = 0; k < model.nv; ++k) to[k * task.stride] = result[k];
  }
};

struct alignas(64) Cacheline {
  std::byte bytes[64];
};

/// The joints as plain numbers; empty if there are no kernels for one of them.
template <class S>
std::vector<TreeJoint<S>> jointsOf(const Model<S>& model) {
  std::vector<TreeJoint<S>> all(std::size_t(model.njoints));
  for (std::size_t i = 1; i < all.size(); ++i) {
    TreeJoint<S>& to = all[i];
    const Joint<S>& from = model.joints[i];
    const auto about = [&]<class J>(const J& joint, JointKind kind) {
      to.kind = kind, to.axis = joint.axis.to_vector();
    };
    if (const auto* revolute = std::get_if<Revolute<S>>(&from))
      about(*revolute, JointKind::revolute);
    else if (const auto* continuous = std::get_if<Continuous<S>>(&from))
      about(*continuous, JointKind::continuous);
    else if (const auto* prismatic = std::get_if<Prismatic<S>>(&from))
      about(*prismatic, JointKind::prismatic);
    else if (std::holds_alternative<FreeFlyer<S>>(from))
      to.kind = JointKind::free_flyer, to.axis = Vector3<S>::UnitX();
    else
      return {};
    to.parent = model.parents[i], to.q = model.idx_qs[i], to.v = model.idx_vs[i], to.columns = model.nvs[i];
    to.X_PJ = model.jointPlacements[i], to.inertia = model.inertias[i];
    for (int k = 0; k < to.columns; ++k) to.armature[k] = model.armature[to.v + k];
  }
  if (!all.empty()) all[0].axis = Vector3<S>::UnitX();
  return all;
}

template <class S>
States<S> run(TreeOperation operation, const Model<S>& model,
              std::initializer_list<const States<S>*> arguments, const Options& options, States<S>& result) {
  const Eigen::Index columns = (*arguments.begin())->cols();
  std::vector<const S*> in;
  std::vector<int> heights;
  for (const States<S>* x : arguments) {
    if (in.size() == 3 && x->size() == 0) continue;  // no external forces
    const int height = in.empty() ? model.nq : in.size() < 3 ? model.nv : 6 * model.njoints;
    if (x->rows() != height || x->cols() != columns)
      throw std::invalid_argument("an argument of a batch is " + std::to_string(x->rows()) + " x " +
                                  std::to_string(x->cols()) + ", the model needs " + std::to_string(height) +
                                  " x " + std::to_string(columns));
    in.push_back(x->data()), heights.push_back(height);
  }
  const int rows = operation == TreeOperation::forwardKinematics ? 12 * model.njoints : model.nv;
  result.resize(rows, columns);
  const auto joints = jointsOf(model);
  const auto& kernels = kernelsOf(options.instructions).template in<S>();
  const auto kernel = operation == TreeOperation::forwardKinematics ? kernels.forwardKinematics
                      : operation == TreeOperation::rnea            ? kernels.rnea
                                                                    : kernels.aba;
  const int width = joints.empty() ? 1 : kernels.width;
  // Rows are far apart, so a pack would touch as many pages as there are rows: tiles are copied row by row.
  constexpr Eigen::Index tile = 128;
  inThreads(columns, 1, 256, options.threads, [&](Eigen::Index begin, Eigen::Index end) {
    Single<S> single{operation, model};
    std::vector<Cacheline> work(joints.size() * kernels.joint_bytes / sizeof(Cacheline) + 1);
    Tile<S> part(in, heights, rows, columns, width);
    for (Eigen::Index i = begin; i < end; i += tile) {
      part.read(i, std::min(tile, end - i));
      TreeTask<S> task{joints.data(), int(joints.size()), model.gravity, {},     part.out(), part.columns,
                       part.columns,  work.data(),        &single.alone, &single};
      std::copy_n(part.in, in.size(), task.in);
      if (joints.empty())
        for (Eigen::Index k = 0; k < part.columns; ++k) single.alone(task, k);
      else
        kernel(task);
      part.write(result.data());
    }
    if (single.failure) std::rethrow_exception(single.failure);
  });
  return std::move(result);
}

}  // namespace

template <std::floating_point S>
States<S> forwardKinematics(const Model<S>& model, const States<S>& q, const Options& options,
                            States<S> result) {
  return run<S>(TreeOperation::forwardKinematics, model, {&q}, options, result);
}
template <std::floating_point S>
States<S> rnea(const Model<S>& model, const States<S>& q, const States<S>& v, const States<S>& a,
               const Options& options, const States<S>& fext, States<S> result) {
  return run<S>(TreeOperation::rnea, model, {&q, &v, &a, &fext}, options, result);
}
template <std::floating_point S>
States<S> aba(const Model<S>& model, const States<S>& q, const States<S>& v, const States<S>& tau,
              const Options& options, const States<S>& fext, States<S> result) {
  return run<S>(TreeOperation::aba, model, {&q, &v, &tau, &fext}, options, result);
}
template decltype(forwardKinematics<float>) forwardKinematics<float>;
template decltype(forwardKinematics<double>) forwardKinematics<double>;
template decltype(rnea<float>) rnea<float>;
template decltype(rnea<double>) rnea<double>;
template decltype(aba<float>) aba<float>;
template decltype(aba<double>) aba<double>;

}  // namespace liecheck::batch
