#include <lattice/features.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace liecheck::properties {
namespace {

using F = Feature;
using Number = long double;  // squares of doubles are finite and normal in it
constexpr Number full_pi = std::numbers::pi_v<Number>;

/// max(a, b) where NaN is no number.
double larger(double a, double b) {
  return std::fmax(a, b);
}

template <class T>
Number norm(const T* x, int n) {
  Number sum = 0;
  for (int i = 0; i < n; ++i) sum += Number(x[i]) * Number(x[i]);
  return std::sqrt(sum);
}

/// The features of a body's rotational inertia I [3 x 3]; of several bodies, the smallest differences.
void add_body(Features& f, const double* I) {
  Eigen::Matrix3d M;
  double largest = 0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::fabs(I[i]));
  f[F::point] = larger(f[F::point], largest == 0);
  if (largest == 0) return;
  for (int i = 0; i < 9; ++i) M(i / 3, i % 3) = I[i] / largest;
  const Eigen::Vector3d m =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(M, Eigen::EigenvaluesOnly).eigenvalues();
  const auto lower = [&f](F feature, double value) { f[feature] = std::fmin(f[feature], value); };
  lower(F::moments_apart, std::min(m[1] - m[0], m[2] - m[1]) / m[2]);
  lower(F::thin, std::fabs(m[0]) / m[2]);
  lower(F::flat, (m[0] + m[1] - m[2]) / m[2]);
}

/// Sorts the numbers of one call's arguments into features.
class Sorter {
 public:
  Sorter(const Scalar& scalar, const Context& context)
      : scalar_(scalar), floating_(context.floating), features_(context.features) {}

  void add(const NumberFunction& f, const double* x) {
    for (const Layout* layout : f.operation->arguments) {
      if (layout->parts.size() == 0) features_[F::seen] = *x++;
      for (const Part& part : layout->parts)
        add(part, x, size_of(part, f.model)), x += size_of(part, f.model);
    }
  }
  Features result() {
    if (points_.size() == 2 && quaternions_.size() == 2) {
      double between[3];
      for (int i = 0; i < 3; ++i) between[i] = points_[1][i] - points_[0][i];
      features_[F::apart] = static_cast<double>(norm(between, 3) / norm(points_[0], 3));
    }
    if (phi_) {
      const Number theta = norm(phi_, 3);
      angle(theta, full_pi - theta);
      features_[F::turn] = static_cast<double>(theta);
      features_[F::turn_minus_pi] = static_cast<double>(theta - full_pi);
      features_[F::turn_minus_two_pi] = static_cast<double>(theta - 2 * full_pi);
    } else if (quaternions_.size() > 1) {
      relative_angle(quaternions_[0], quaternions_[1]);
    } else if (!quaternions_.empty()) {
      const Number v = norm(quaternions_[0], 3), w = std::fabs(Number(quaternions_[0][3]));
      angle(2 * std::atan2(v, w), 2 * std::atan2(w, v));
    } else if (matrix_) {
      const Number s = std::sqrt(squared(entry(2, 1) - entry(1, 2)) + squared(entry(0, 2) - entry(2, 0)) +
                                 squared(entry(1, 0) - entry(0, 1))),
                   c = entry(0, 0) + entry(1, 1) + entry(2, 2) - 1;
      angle(std::atan2(s, c), std::atan2(s, -c));
    }
    const double* const axis = phi_ ? phi_ : !quaternions_.empty() ? quaternions_[0] : vector_;
    if (axis) {
      int octant = 0, zeros = 0;
      for (int i = 0; i < 3; ++i) octant += (axis[i] < 0) << i, zeros += axis[i] == 0;
      features_[F::octant] = octant, features_[F::zeros] = zeros;
    }
    return features_;
  }

 private:
  static Number squared(Number x) { return x * x; }
  Number entry(int i, int j) const { return Number(matrix_[3 * i + j]); }
  /// log2 of a size over the largest exponent of the scalar.
  double scale_of(Number size) const { return static_cast<double>(std::log2(size)) / scalar_.max_exponent; }
  void angle(Number theta, Number pi_minus_theta) {
    features_[F::theta] = static_cast<double>(theta);
    features_[F::theta_scale] = scale_of(theta);
    features_[F::pi_minus_theta] = static_cast<double>(pi_minus_theta);
  }
  /// The angle of a* b.
  void relative_angle(const double* a, const double* b) {
    Number A[4], B[4];
    for (int i = 0; i < 4; ++i) A[i] = Number(a[i]), B[i] = Number(b[i]);
    Number v[3];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      v[i] = A[3] * B[i] - B[3] * A[i] - (A[j] * B[k] - A[k] * B[j]);
    }
    const Number w = std::fabs(A[3] * B[3] + A[0] * B[0] + A[1] * B[1] + A[2] * B[2]);
    angle(2 * std::atan2(norm(v, 3), w), 2 * std::atan2(w, norm(v, 3)));
  }
  void raise(F feature, double value) { features_[feature] = larger(features_[feature], value); }

  void add(const Part& part, const double* x, int n) {
    if (part.size < 0) {
      add_joints(part, x, n);
    } else if (n == 4) {
      add_quaternion(x);
    } else if (n == 9 && part.unit == "1") {
      add_matrix(x);
    } else if (n == 9) {
      add_body(features_, x);
    } else if (n == 3 && part.unit == "rad") {
      phi_ = x;
    } else if (n == 3) {
      if (!vector_) vector_ = x;
      if (part.unit == "m") points_.push_back(x);
      const bool speed = part.unit == "m/s" || part.unit == "rad/s";
      raise(part.unit == "m" ? F::length : speed ? F::speed : F::force, scale_of(norm(x, 3)));
    } else if (part.unit == "kg") {
      features_[F::mass] = scale_of(std::fabs(Number(x[0])));
    } else if (part.name == "wrench_joint") {
      features_[F::wrench] = x[0] >= 0;
    }
  }
  void add_quaternion(const double* Q) {
    if (quaternions_.empty()) features_[F::w] = Q[3];
    quaternions_.push_back(Q);
    const Number size = norm(Q, 4);
    const double defect = static_cast<double>(std::fabs(squared(size) - 1) / scalar_.epsilon);
    if (defect > 16 && !(defect < features_[F::off_unit])) features_[F::norm] = static_cast<double>(size);
    raise(F::off_unit, defect);
  }
  void add_matrix(const double* R) {
    if (!matrix_) matrix_ = R;
    Number sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Number product = i == j ? -1 : 0;
        for (int k = 0; k < 3; ++k) product += Number(R[3 * k + i]) * Number(R[3 * k + j]);
        sum += product * product;
      }
    raise(F::off_orthogonal, static_cast<double>(std::sqrt(sum) / scalar_.epsilon));
  }
  /// A vector of a whole tree or robot.
  void add_joints(const Part& part, const double* x, int n) {
    double largest = 0;
    for (int i = 0; i < n; ++i) largest = std::max(largest, std::fabs(x[i]));
    const bool increment = part.name == "delta", drive = part.name == "a" || part.name == "tau";
    raise(part.size == nq ? F::position : increment || part.name == "v" ? F::joint_speed : F::drive, largest);
    if (!floating_ || drive) return;
    if (part.size == nq && n >= 7) points_.push_back(x), add_quaternion(x + 3);
    if (increment && n >= 6) phi_ = x + 3;
  }

  const Scalar& scalar_;
  bool floating_;
  Features features_;
  const double *phi_ = nullptr, *matrix_ = nullptr, *vector_ = nullptr;
  std::vector<const double*> quaternions_, points_;
};

/// 0 for a chain, 1 for a star, 2 if all joints are on the world, else 3.
int shape_of(const Tree<double>& tree) {
  bool chain = true, star = true, world = true;
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    const int parent = tree.joints[i].parent;
    chain = chain && parent == static_cast<int>(i) - 1;
    star = star && parent == (i == 0 ? -1 : 0);
    world = world && parent == -1;
  }
  return chain ? 0 : star ? 1 : world ? 2 : 3;
}

}  // namespace

Context context_of(const Tree<double>& tree) {
  Context context;
  Features& f = context.features;
  context.floating = !tree.joints.empty() && tree.joints[0].kind == oracles::JointKind::free_flyer;
  f[F::joints] = static_cast<double>(tree.joints.size());
  for (std::size_t kind = 0; kind < 8; ++kind) f.values[static_cast<std::size_t>(F::revolute) + kind] = 0;
  f[F::mimics] = f[F::armature] = 0;
  double lightest = std::numeric_limits<double>::infinity(), heaviest = 0;
  for (const auto& j : tree.joints) {
    f.values[static_cast<std::size_t>(F::revolute) + static_cast<std::size_t>(j.kind)] += 1;
    if (j.primary >= 0) f[F::mimics] += 1;
    if (j.armature > 0) f[F::armature] = 1;
    lightest = std::min(lightest, j.body.mass);
    heaviest = std::max(heaviest, j.body.mass);
    add_body(f, j.body.I_C.x.data());
  }
  f[F::mass_ratio] = heaviest / lightest;
  if (tree.joints.size() >= 3) f[F::shape] = shape_of(tree);
  return context;
}

Features features_of(const NumberFunction& function, const std::vector<double>& arguments,
                     const Context& context) {
  Sorter sorter(*function.scalar, context);
  sorter.add(function, arguments.data());
  return sorter.result();
}

}  // namespace liecheck::properties
