#include <search/features.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <operations/quaternion_poses.hpp>
#include <oracles/orientations.hpp>
#include <string_view>

namespace liecheck::properties {
namespace {

using Of = Feature;
using Long = long double;  // squares of doubles are finite and normal in it
constexpr Long full_pi = std::numbers::pi_v<Long>;

/// max(a, b) where NaN is no number.
double larger(double a, double b) {
  return std::fmax(a, b);
}

template <class T>
Long norm(const T* x, int n) {
  Long sum = 0;
  for (int i = 0; i < n; ++i) sum += Long(x[i]) * Long(x[i]);
  return std::sqrt(sum);
}

/// The features of a body's rotational inertia I [3 x 3]; of several bodies, the smallest differences.
void add_body(Features& f, const double* I) {
  Eigen::Matrix3d M;
  double largest = 0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::fabs(I[i]));
  f[Of::point] = larger(f[Of::point], largest == 0);
  if (largest == 0) return;
  for (int i = 0; i < 9; ++i) M(i / 3, i % 3) = I[i] / largest;
  const Eigen::Vector3d m =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(M, Eigen::EigenvaluesOnly).eigenvalues();
  const auto lower = [&f](Of feature, double value) { f[feature] = std::fmin(f[feature], value); };
  lower(Of::moments_apart, std::min(m[1] - m[0], m[2] - m[1]) / m[2]);
  lower(Of::thin, std::fabs(m[0]) / m[2]);
  lower(Of::flat, (m[0] + m[1] - m[2]) / m[2]);
}

/// Sorts the numbers of one call's arguments into features.
class Sorter {
 public:
  Sorter(const Scalar& scalar, const Context& context)
      : scalar_(scalar), floating_(context.floating), features_(context.features) {}

  void add(const NumberFunction& f, const double* x) {
    for (const Layout* own : f.operation->arguments) {
      const Layout layout = f.quaternion_poses ? with_quaternion(*own) : *own;
      if (layout.parts.size() == 0) features_[Of::seen] = *x++;
      for (const Part& part : layout.parts) add(part, x, size_of(part, f.model)), x += size_of(part, f.model);
    }
  }
  Features result() {
    if (points_.size() == 2 && quaternions_.size() == 2) {
      double between[3];
      for (int i = 0; i < 3; ++i) between[i] = points_[1][i] - points_[0][i];
      features_[Of::apart] = static_cast<double>(norm(between, 3) / norm(points_[0], 3));
    }
    if (phi_) {
      const Long theta = norm(phi_, 3);
      angle(theta, full_pi - theta);
      features_[Of::turn] = static_cast<double>(theta);
      features_[Of::turn_minus_pi] = static_cast<double>(theta - full_pi);
      features_[Of::turn_minus_two_pi] = static_cast<double>(theta - 2 * full_pi);
    } else if (quaternions_.size() > 1) {
      relative_angle(quaternions_[0], quaternions_[1]);
    } else if (!quaternions_.empty()) {
      const Long v = norm(quaternions_[0], 3), w = std::fabs(Long(quaternions_[0][3]));
      angle(2 * std::atan2(v, w), 2 * std::atan2(w, v));
    } else if (matrix_) {
      const Long s = std::sqrt(squared(entry(2, 1) - entry(1, 2)) + squared(entry(0, 2) - entry(2, 0)) +
                               squared(entry(1, 0) - entry(0, 1))),
                 c = entry(0, 0) + entry(1, 1) + entry(2, 2) - 1;
      angle(std::atan2(s, c), std::atan2(s, -c));
    }
    if (features_[Of::order] == features_[Of::order]) features_[Of::lock] = from_lock();
    const double* const axis = phi_ ? phi_ : !quaternions_.empty() ? quaternions_[0] : vector_;
    if (axis) {
      int octant = 0, zeros = 0;
      for (int i = 0; i < 3; ++i) octant += (axis[i] < 0) << i, zeros += axis[i] == 0;
      features_[Of::octant] = octant, features_[Of::zeros] = zeros;
      features_[Of::x_negative] = octant & 1, features_[Of::y_negative] = octant >> 1 & 1;
      features_[Of::z_negative] = octant >> 2;
      features_[Of::largest] = static_cast<double>(
          std::ranges::max_element(axis, axis + 3, {}, [](double x) { return std::fabs(x); }) - axis);
      if (vector_ && axis != vector_) {
        Long sum = 0;
        for (int i = 0; i < 3; ++i) sum += Long(axis[i]) * Long(vector_[i]);
        features_[Of::along] = static_cast<double>(sum / (norm(axis, 3) * norm(vector_, 3)));
      }
    }
    return features_;
  }

 private:
  static Long squared(Long x) { return x * x; }
  Long entry(int i, int j) const { return Long(matrix_[3 * i + j]); }
  /// log2 of a size over the largest exponent of the scalar.
  double scale_of(Long size) const { return static_cast<double>(std::log2(size)) / scalar_.max_exponent; }
  void angle(Long theta, Long pi_minus_theta) {
    features_[Of::theta] = static_cast<double>(theta);
    features_[Of::theta_scale] = scale_of(theta);
    features_[Of::pi_minus_theta] = static_cast<double>(pi_minus_theta);
  }
  /// The angle of a* b.
  void relative_angle(const double* a, const double* b) {
    Long A[4], B[4];
    for (int i = 0; i < 4; ++i) A[i] = Long(a[i]), B[i] = Long(b[i]);
    Long v[3];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      v[i] = A[3] * B[i] - B[3] * A[i] - (A[j] * B[k] - A[k] * B[j]);
    }
    const Long w = std::fabs(A[3] * B[3] + A[0] * B[0] + A[1] * B[1] + A[2] * B[2]);
    angle(2 * std::atan2(norm(v, 3), w), 2 * std::atan2(w, norm(v, 3)));
  }
  /// Of R = R_i(a) R_j(b) R_k(c): |sin b| = |R(i, k)|, or |cos b| = |R(i, i)| if i = k, and the rest of the row is the other
  /// function. Of static axes the transpose. NaN without a rotation.
  double from_lock() const {
    Long R[3][3];
    if (matrix_) {
      for (int i = 0; i < 9; ++i) R[i / 3][i % 3] = matrix_[i];
    } else if (!quaternions_.empty()) {
      const double* Q = quaternions_[0];
      const auto m = Eigen::Quaternion<Long>(Q[3], Q[0], Q[1], Q[2]).normalized().toRotationMatrix();
      for (int i = 0; i < 9; ++i) R[i / 3][i % 3] = m(i / 3, i % 3);
    } else {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const oracles::Order order(static_cast<int>(features_[Of::order]));
    const int row = order.axes[0], column = order.axes[2];
    Long rest = 0;
    for (int k = 0; k < 3; ++k)
      if (k != column) rest += squared(order.rotating ? R[row][k] : R[k][row]);
    const Long at = order.rotating ? R[row][column] : R[column][row];
    return static_cast<double>(std::atan2(std::sqrt(rest), std::fabs(at)));
  }
  void raise(Of feature, double value) { features_[feature] = larger(features_[feature], value); }

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
      if (vectors_ < 2)
        features_[vectors_ == 0 ? Of::first_length : Of::second_length] = scale_of(norm(x, 3));
      if (vectors_++ == 0) vector_ = x;
      if (part.unit == "m") points_.push_back(x);
      const bool speed = part.unit == "m/s" || part.unit == "rad/s";
      raise(part.unit == "m" ? Of::length : speed ? Of::speed : Of::force, scale_of(norm(x, 3)));
    } else if (part.unit == "kg") {
      features_[Of::mass] = scale_of(std::fabs(Long(x[0])));
    } else if (part.name == "order") {
      features_[Of::order] = x[0];
    } else if (part.name == "t") {
      features_[Of::fraction] = x[0];
    } else if (part.name == "wrench_joint") {
      features_[Of::wrench] = x[0] >= 0, features_[Of::wrench_joint] = x[0] + 1;
    }
  }
  void add_quaternion(const double* Q) {
    if (quaternions_.empty()) {
      features_[Of::w] = Q[3];
    } else if (quaternions_.size() == 1) {
      features_[Of::second_w] = Q[3], features_[Of::product] = 0;
      for (int i = 0; i < 4; ++i) features_[Of::product] += quaternions_[0][i] * Q[i];
    }
    quaternions_.push_back(Q);
    const Long size = norm(Q, 4);
    const double defect = static_cast<double>(std::fabs(squared(size) - 1) / scalar_.epsilon);
    if (defect > 16 && !(defect < features_[Of::off_unit])) features_[Of::norm] = static_cast<double>(size);
    raise(Of::off_unit, defect);
  }
  void add_matrix(const double* R) {
    if (!matrix_) matrix_ = R, features_[Of::trace] = R[0] + R[4] + R[8];
    Long sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Long product = i == j ? -1 : 0;
        for (int k = 0; k < 3; ++k) product += Long(R[3 * k + i]) * Long(R[3 * k + j]);
        sum += product * product;
      }
    raise(Of::off_orthogonal, static_cast<double>(std::sqrt(sum) / scalar_.epsilon));
  }
  /// A vector of a whole tree or robot.
  void add_joints(const Part& part, const double* x, int n) {
    double largest = 0;
    for (int i = 0; i < n; ++i) largest = std::max(largest, std::fabs(x[i]));
    const bool not_zero = largest != 0;
    if (part.name == "v") features_[Of::moves] = not_zero;
    if (part.name == "a") features_[Of::accelerates] = not_zero;
    if (part.name == "tau") features_[Of::driven] = not_zero;
    const bool increment = part.name == "delta", drive = part.name == "a" || part.name == "tau";
    raise(part.size == nq                 ? Of::position
          : increment || part.name == "v" ? Of::joint_speed
                                          : Of::drive,
          largest);
    if (!floating_ || drive) return;
    if (part.size == nq && n >= 7) points_.push_back(x), add_quaternion(x + 3);
    if (increment && n >= 6) phi_ = x + 3;
  }

  const Scalar& scalar_;
  bool floating_;
  Features features_;
  int vectors_ = 0;
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

/// How the joints of a tree follow each other, its gravity and its frame.
void add_paths(Features& f, const Tree<double>& tree) {
  using oracles::JointKind;
  struct Path {
    int depth = 0, velocities = 0;  ///< the most velocities of a joint on it
    bool turns = false;
  };
  std::vector<Path> paths;
  for (const Of flag : {Of::depth, Of::several, Of::several_armature, Of::turned_prismatic,
                        Of::inner_free_flyer, Of::narrower})
    f[flag] = 0;
  for (const auto& j : tree.joints) {
    Path path = j.parent < 0 ? Path{} : paths[static_cast<std::size_t>(j.parent)];
    const int n = oracles::velocity_size(j.kind);
    const auto note = [&](Of flag, bool holds) { f[flag] = std::max(f[flag], double(holds)); };
    note(Of::several, n > 1);
    note(Of::several_armature, n > 1 && j.armature > 0);
    note(Of::turned_prismatic, j.kind == JointKind::prismatic && path.turns);
    note(Of::inner_free_flyer, j.kind == JointKind::free_flyer && path.depth > 0);
    note(Of::narrower, n < path.velocities);
    ++path.depth;
    path.velocities = std::max(path.velocities, n);
    path.turns = path.turns || (j.kind != JointKind::prismatic && j.kind != JointKind::translation);
    f[Of::depth] = std::max<double>(f[Of::depth], path.depth);
    paths.push_back(path);
  }
  const auto& g = tree.gravity;
  f[Of::tilted_gravity] = g[0] != 0 || g[1] != 0;
  f[Of::gravity] = f[Of::tilted_gravity] != 0 || std::fabs(g[2] + 9.81) > 1e-6;  // rounded to float, perhaps
  if (const auto joint = static_cast<std::size_t>(tree.frame_joint); joint < paths.size())
    f[Of::frame_depth] = paths[joint].depth;
  f[Of::frame_off] = tree.frame_p[0] != 0 || tree.frame_p[1] != 0 || tree.frame_p[2] != 0;
}

}  // namespace

Context context_of(const Tree<double>& tree) {
  Context context;
  Features& f = context.features;
  context.floating = !tree.joints.empty() && tree.joints[0].kind == oracles::JointKind::free_flyer;
  f[Of::joints] = static_cast<double>(tree.joints.size());
  for (std::size_t kind = 0; kind < 8; ++kind) f.values[static_cast<std::size_t>(Of::revolute) + kind] = 0;
  f[Of::mimics] = f[Of::armature] = 0;
  double lightest = std::numeric_limits<double>::infinity(), heaviest = 0;
  for (const auto& j : tree.joints) {
    f.values[static_cast<std::size_t>(Of::revolute) + static_cast<std::size_t>(j.kind)] += 1;
    if (j.primary >= 0) f[Of::mimics] += 1;
    if (j.armature > 0) f[Of::armature] = 1;
    lightest = std::min(lightest, j.body.mass);
    heaviest = std::max(heaviest, j.body.mass);
    add_body(f, j.body.I_C.x.data());
  }
  f[Of::mass_ratio] = heaviest / lightest;
  if (tree.joints.size() >= 3) f[Of::shape] = shape_of(tree);
  add_paths(f, tree);
  return context;
}

Features features_of(const NumberFunction& function, const std::vector<double>& arguments,
                     const Context& context) {
  const std::vector<double> given =
      function.quaternion_poses
          ? poses_as_quaternions(*function.operation, arguments, function.scalar->is_float())
          : arguments;
  Sorter sorter(*function.scalar, context);
  sorter.add(function, given.data());
  return sorter.result();
}

double shortest_between(double a, double b) {
  const double low = std::min(a, b), high = std::max(a, b);
  if (low <= 0 && high >= 0) return 0;
  for (int digits = 1; digits < 17; ++digits) {
    const double x = std::stod(fmt::format("{:.{}g}", (a + b) / 2, digits));
    if (x >= low && x <= high) return x;
  }
  return (a + b) / 2;
}

}  // namespace liecheck::properties
