#pragma once
// Model: the constants of a robot. Results are in Data, so any number of threads can share one Model.
//
// Joint 0 is the universe. Joint i > 0 is attached to joint parents[i] < i at jointPlacements[i]. It has
// nqs[i] numbers of q from idx_qs[i] on, and nvs[i] numbers of v from idx_vs[i] on. A mimic has none; its
// idx_qs and idx_vs are those of its primary. Names and conventions are Pinocchio's. Users may set
// gravity, limits, friction, damping and armature; only member functions change the other fields.

#include <atomic>
#include <liecheck/multibody/frame.hpp>
#include <liecheck/multibody/joint.hpp>
#include <liecheck/multibody/nearest_names.hpp>
#include <liecheck/spatial/checked_rotation.hpp>
#include <liecheck/spatial/inertia.hpp>
#include <stdexcept>
#include <unordered_map>
#include <vector>

namespace liecheck {

namespace multibody_detail {
/// Returns a number that it has not returned before in this process.
inline int nextRevision() {
  static std::atomic<int> last{0};
  return ++last;
}
}  // namespace multibody_detail

template <Scalar S>
class Model {
 public:
  std::string name;
  int nq = 0, nv = 0, njoints = 0, nframes = 0;

  std::vector<std::string> names;       ///< of joints
  std::vector<int> parents;             ///< parent joint of joint i
  std::vector<SE3<S>> jointPlacements;  ///< X_PJ at q = neutral
  std::vector<Inertia<S>> inertias;     ///< of all bodies fixed to joint i, in joint i's frame
  std::vector<Joint<S>> joints;
  std::vector<int> idx_qs, idx_vs, nqs, nvs;
  std::vector<Frame<S>> frames;

  /// The columns of all motion subspaces: joint i has column_counts[i] columns from idx_columns[i] on. Column
  /// k is multiplied by v[column_to_v[k]]. ncolumns is nv plus the number of mimics.
  int ncolumns = 0;
  std::vector<int> idx_columns, column_counts, column_to_v, column_to_joint;
  bool has_mimics = false;

  Vector3<S> gravity{S(0), S(0), S(-981) / S(100)};  ///< acceleration of a free fall, in the world [m/s^2]

  /// Infinite by default: effort [nv; N, N m], velocity [nv; m/s, rad/s], position [nq].
  VectorX<S> effortLimit, velocityLimit, lowerPositionLimit, upperPositionLimit;
  /// Zero by default [nv]: dry friction [N, N m], viscous damping [N s/m, N m s], inertia of the motor at the
  /// output of the gear [kg, kg m^2]. rnea and aba use the armature, but ignore friction and damping.
  VectorX<S> friction, damping, armature;

  /// Changes whenever a joint, a frame or a body is added; only copies of this model have the same revision. Data
  /// refuses a model with another revision than the one it was made from.
  int revision = 0;

  Model();

  /// Adds a joint, without body and frame, to joint `parent` at X_PJ; returns its index. Throws
  /// std::invalid_argument if the parent does not exist, the name is taken, the joint is a universe, the
  /// primary of a mimic does not exist or does not have nv = 1, or X_PJ is not a pose.
  int addJoint(int parent, const Joint<S>& joint, const SE3<S>& X_PJ, const std::string& joint_name);

  /// Adds a frame; returns its index. Two frames may share a name if their types differ (a joint and a link).
  /// Throws std::invalid_argument if a parent does not exist, a frame of that name and type exists, the
  /// placement is not a pose, or the parent frame moves with another joint than the frame (for the frame of a
  /// joint: than the joint's parent). Parent frame 0, the universe, states no parent and is always accepted.
  int addFrame(const Frame<S>& frame);

  /// Adds the frame of a joint, of the same name. parent_frame defaults to the frame of its parent joint.
  int addJointFrame(int joint, int parent_frame = -1);

  /// Adds the frame of a link fixed to a joint at X_JB. parent_frame defaults to the frame of that joint.
  int addBodyFrame(const std::string& body, int joint, const SE3<S>& X_JB = SE3<S>::Identity(),
                   int parent_frame = -1);

  /// Adds the frame of a fixed joint at X_JF. No joint is added, since the child link moves with `joint`.
  int addFixedJoint(const std::string& fixed_name, int joint, const SE3<S>& X_JF, int parent_frame = -1);

  /// Fixes a body to a joint. I_B is in the body's frame, whose pose in the joint's frame is X_JB. Throws
  /// std::invalid_argument if whyInvalid(I_B) finds something, X_JB is not a pose, or the sum of the joint's
  /// bodies overflows. whyUnphysical checks the moments; one of several bodies may lack what their sum has.
  void appendBodyToJoint(int joint, const Inertia<S>& I_B, const SE3<S>& X_JB = SE3<S>::Identity());

  /// The joint's index; njoints if there is none of that name.
  int getJointId(const std::string& joint_name) const {
    const auto found = joint_ids_.find(joint_name);
    return found == joint_ids_.end() ? njoints : found->second;
  }
  bool existJointName(const std::string& joint_name) const { return joint_ids_.contains(joint_name); }
  /// The joint's index. Throws std::invalid_argument with the nearest names if there is none of that name.
  int requireJointId(const std::string& joint_name) const;

  /// The index of the frame; nframes if none has that name. Throws std::invalid_argument if several have it.
  int getFrameId(const std::string& frame_name) const;
  /// The index of the frame of that name and type; nframes if there is none.
  int getFrameId(const std::string& frame_name, FrameType type) const;
  bool existFrame(const std::string& frame_name) const { return frame_ids_.contains(frame_name); }
  bool existFrame(const std::string& frame_name, FrameType type) const {
    return getFrameId(frame_name, type) < nframes;
  }
  /// As requireJointId, for frames. Throws std::invalid_argument also if several frames have that name.
  int requireFrameId(const std::string& frame_name) const;

  /// The same robot with each constant converted to T; none is recomputed. Throws std::invalid_argument if one
  /// other than a limit, or the inertia of a joint's bodies about its origin, is too large for T.
  template <Scalar T>
  Model<T> cast() const;

 private:
  template <Scalar T>
  friend class Model;

  int addJointUnchecked(int parent, const Joint<S>& joint, const SE3<S>& X_PJ, const std::string& joint_name);
  int addFrameUnchecked(const Frame<S>& frame);
  static void grow(VectorX<S>& v, int size, const S& value);
  /// `of` and a name in quotes are joined only for a message: models are built in the loops of campaigns.
  void checkJoint(int joint, const char* of, const std::string& quoted = "") const;
  void checkCarrier(const Frame<S>& frame) const;
  static void checkPose(const SE3<S>& X, const char* of, const std::string& quoted, const char* what = "");
  static std::string named(const char* of, const std::string& quoted) {
    return quoted.empty() ? of : of + (" '" + quoted + "'");
  }
  int frameOfJoint(int joint) const;

  std::unordered_map<std::string, int> joint_ids_;
  std::unordered_multimap<std::string, int> frame_ids_;
};

// Members are defined outside the class: those defined inside are inline and are instantiated in every file.
template <Scalar S>
Model<S>::Model() {
  addJointUnchecked(0, Universe<S>(), SE3<S>::Identity(), "universe");
  addFrameUnchecked({"universe", 0, 0, SE3<S>::Identity(), FrameType::FIXED_JOINT});
}

template <Scalar S>
int Model<S>::addJoint(int parent, const Joint<S>& joint, const SE3<S>& X_PJ, const std::string& joint_name) {
  checkJoint(parent, "the parent of joint", joint_name);
  if (existJointName(joint_name))
    throw std::invalid_argument("the model already has a joint named '" + joint_name + "'");
  if (std::holds_alternative<Universe<S>>(joint))
    throw std::invalid_argument("joint '" + joint_name + "' is a second universe");
  if (const Mimic<S>* mimic = std::get_if<Mimic<S>>(&joint)) {
    checkJoint(mimic->primary, "the primary of joint", joint_name);
    if (nvs[std::size_t(mimic->primary)] != 1)
      throw std::invalid_argument("joint '" + joint_name + "' mimics joint '" +
                                  names[std::size_t(mimic->primary)] +
                                  "', which does not have exactly one degree of freedom");
  }
  checkPose(X_PJ, "the placement of joint", joint_name);
  return addJointUnchecked(parent, joint, X_PJ, joint_name);
}

template <Scalar S>
int Model<S>::addFrame(const Frame<S>& frame) {
  checkJoint(frame.parentJoint, "the parent of frame", frame.name);
  if (frame.parentFrame < 0 || frame.parentFrame >= nframes)
    throw std::invalid_argument("the parent of frame '" + frame.name + "' is frame " +
                                std::to_string(frame.parentFrame) + ": the number of frames is " +
                                std::to_string(nframes));
  if (existFrame(frame.name, frame.type))
    throw std::invalid_argument("the model already has a frame of that type named '" + frame.name + "'");
  checkCarrier(frame);
  checkPose(frame.placement, "the placement of frame", frame.name);
  return addFrameUnchecked(frame);
}

template <Scalar S>
int Model<S>::addJointFrame(int joint, int parent_frame) {
  checkJoint(joint, "a joint frame's joint");
  if (parent_frame < 0) parent_frame = frameOfJoint(parents[std::size_t(joint)]);
  return addFrame({names[std::size_t(joint)], joint, parent_frame, SE3<S>::Identity(), FrameType::JOINT});
}

template <Scalar S>
int Model<S>::addBodyFrame(const std::string& body, int joint, const SE3<S>& X_JB, int parent_frame) {
  checkJoint(joint, "the parent of body", body);
  if (parent_frame < 0) parent_frame = frameOfJoint(joint);
  return addFrame({body, joint, parent_frame, X_JB, FrameType::BODY});
}

template <Scalar S>
int Model<S>::addFixedJoint(const std::string& fixed_name, int joint, const SE3<S>& X_JF, int parent_frame) {
  checkJoint(joint, "the parent of fixed joint", fixed_name);
  if (parent_frame < 0) parent_frame = frameOfJoint(joint);
  return addFrame({fixed_name, joint, parent_frame, X_JF, FrameType::FIXED_JOINT});
}

template <Scalar S>
void Model<S>::appendBodyToJoint(int joint, const Inertia<S>& I_B, const SE3<S>& X_JB) {
  checkJoint(joint, "a body's parent");
  const std::string& carrier = names[std::size_t(joint)];
  const std::string why = whyInvalid(I_B);
  if (!why.empty()) throw std::invalid_argument(named("a body of joint", carrier) + ": " + why);
  checkPose(X_JB, "a body of joint", carrier, ": its pose");
  Inertia<S>& I_J = inertias[std::size_t(joint)];
  const Inertia<S> sum = I_J + X_JB.act(I_B);
  if (!sum.matrix().allFinite())
    throw std::invalid_argument(named("a body of joint", carrier) +
                                ": its inertia and that of the others, about the joint's origin, overflow");
  I_J = sum;
  revision = multibody_detail::nextRevision();
}

template <Scalar S>
int Model<S>::requireJointId(const std::string& joint_name) const {
  if (!existJointName(joint_name))
    throw std::invalid_argument("no joint is named '" + joint_name + "'" +
                                multibody_detail::nearestNames(joint_name, names));
  return getJointId(joint_name);
}

template <Scalar S>
int Model<S>::getFrameId(const std::string& frame_name) const {
  if (frame_ids_.count(frame_name) > 1)
    throw std::invalid_argument("several frames are named '" + frame_name + "': give the type as well");
  const auto found = frame_ids_.find(frame_name);
  return found == frame_ids_.end() ? nframes : found->second;
}

template <Scalar S>
int Model<S>::getFrameId(const std::string& frame_name, FrameType type) const {
  const auto [begin, end] = frame_ids_.equal_range(frame_name);
  for (auto i = begin; i != end; ++i)
    if (frames[std::size_t(i->second)].type == type) return i->second;
  return nframes;
}

template <Scalar S>
int Model<S>::requireFrameId(const std::string& frame_name) const {
  if (!existFrame(frame_name)) {
    std::vector<std::string> all;
    for (const Frame<S>& f : frames) all.push_back(f.name);
    throw std::invalid_argument("no frame is named '" + frame_name + "'" +
                                multibody_detail::nearestNames(frame_name, all));
  }
  return getFrameId(frame_name);
}

template <Scalar S>
template <Scalar T>
Model<T> Model<S>::cast() const {
  Model<T> m;
  m.name = name;
  m.nq = nq, m.nv = nv, m.njoints = njoints, m.nframes = nframes, m.revision = revision;
  m.names = names, m.parents = parents;
  m.idx_qs = idx_qs, m.idx_vs = idx_vs, m.nqs = nqs, m.nvs = nvs;
  m.ncolumns = ncolumns, m.idx_columns = idx_columns, m.column_counts = column_counts;
  m.column_to_v = column_to_v, m.column_to_joint = column_to_joint, m.has_mimics = has_mimics;
  m.joint_ids_ = joint_ids_, m.frame_ids_ = frame_ids_;
  m.gravity = gravity.template cast<T>();
  m.effortLimit = effortLimit.template cast<T>(), m.velocityLimit = velocityLimit.template cast<T>();
  m.lowerPositionLimit = lowerPositionLimit.template cast<T>();
  m.upperPositionLimit = upperPositionLimit.template cast<T>();
  m.friction = friction.template cast<T>(), m.damping = damping.template cast<T>();
  m.armature = armature.template cast<T>();
  m.jointPlacements.clear(), m.inertias.clear(), m.joints.clear(), m.frames.clear();
  for (const SE3<S>& X : jointPlacements) m.jointPlacements.push_back(X.template cast<T>());
  for (const Inertia<S>& I : inertias)
    m.inertias.emplace_back(T(I.mass()), Vector3<T>(I.lever().template cast<T>()),
                            Matrix3<T>(I.inertia().template cast<T>()));
  const auto fits = [](const auto& numbers, const std::string& what) {
    if (!numbers.allFinite())
      throw std::invalid_argument("cast: " + what + " is not finite in the new scalar");
  };
  fits(m.gravity, "gravity"), fits(m.armature, "armature");
  fits(m.friction, "friction"), fits(m.damping, "damping");
  for (std::size_t i = 0; i < names.size(); ++i) {
    fits(m.jointPlacements[i].translation(), "the placement of joint '" + names[i] + "'");
    fits(m.inertias[i].matrix(), "the inertia of joint '" + names[i] + "'");
  }
  for (const Joint<S>& j : joints) m.joints.push_back(liecheck::cast<T, S>(j));
  for (const Frame<S>& f : frames) {
    m.frames.push_back(f.template cast<T>());
    fits(m.frames.back().placement.translation(), "the placement of frame '" + f.name + "'");
  }
  return m;
}

template <Scalar S>
int Model<S>::addJointUnchecked(int parent, const Joint<S>& joint, const SE3<S>& X_PJ,
                                const std::string& joint_name) {
  const Mimic<S>* mimic = std::get_if<Mimic<S>>(&joint);
  joint_ids_.emplace(joint_name, njoints);
  names.push_back(joint_name);
  parents.push_back(parent);
  jointPlacements.push_back(X_PJ);
  inertias.push_back(Inertia<S>::Zero());
  joints.push_back(joint);
  idx_qs.push_back(mimic ? idx_qs[std::size_t(mimic->primary)] : nq);
  idx_vs.push_back(mimic ? idx_vs[std::size_t(mimic->primary)] : nv);
  idx_columns.push_back(ncolumns);
  nqs.push_back(liecheck::nq(joint)), nvs.push_back(liecheck::nv(joint));
  column_counts.push_back(mimic ? 1 : nvs.back());
  for (int k = 0; k < column_counts.back(); ++k) {
    column_to_v.push_back(idx_vs.back() + k);
    column_to_joint.push_back(njoints);
  }
  nq += nqs.back();
  nv += nvs.back();
  ncolumns += column_counts.back();
  has_mimics = has_mimics || mimic;
  const S infinity = std::numeric_limits<S>::infinity();
  grow(effortLimit, nv, infinity), grow(velocityLimit, nv, infinity);
  grow(lowerPositionLimit, nq, -infinity), grow(upperPositionLimit, nq, infinity);
  grow(friction, nv, S(0)), grow(damping, nv, S(0)), grow(armature, nv, S(0));
  revision = multibody_detail::nextRevision();
  return njoints++;
}

template <Scalar S>
int Model<S>::addFrameUnchecked(const Frame<S>& frame) {
  frame_ids_.emplace(frame.name, nframes);
  frames.push_back(frame);
  revision = multibody_detail::nextRevision();
  return nframes++;
}

template <Scalar S>
void Model<S>::grow(VectorX<S>& v, int size, const S& value) {
  const Eigen::Index before = v.size();
  v.conservativeResize(size);
  v.tail(size - before).setConstant(value);
}

template <Scalar S>
void Model<S>::checkJoint(int joint, const char* of, const std::string& quoted) const {
  if (joint < 0 || joint >= njoints)
    throw std::invalid_argument(named(of, quoted) + " is joint " + std::to_string(joint) +
                                ", and the number of joints is " + std::to_string(njoints));
}

template <Scalar S>
void Model<S>::checkCarrier(const Frame<S>& frame) const {
  const int carrier = frames[std::size_t(frame.parentFrame)].parentJoint;
  const int due =
      frame.type == FrameType::JOINT ? parents[std::size_t(frame.parentJoint)] : frame.parentJoint;
  if (frame.parentFrame == 0 || carrier == due) return;
  const auto joint = [this](int i) { return "joint '" + names[std::size_t(i)] + "'"; };
  throw std::invalid_argument("the parent of frame '" + frame.name + "' is frame '" +
                              frames[std::size_t(frame.parentFrame)].name + "' (frame " +
                              std::to_string(frame.parentFrame) + "), which moves with " + joint(carrier) +
                              ", not with " + joint(due));
}

/// The rotation may be off by sqrt(eps), half the digits: typed numbers are accepted, mistakes are not.
template <Scalar S>
void Model<S>::checkPose(const SE3<S>& X, const char* of, const std::string& quoted, const char* what) {
  using std::sqrt;
  const S budget = sqrt(eps<S>());
  bool all_finite = true;
  for (int i = 0; i < 3; ++i) all_finite = all_finite && finite<S>(X.translation()[i]);
  if (all_finite && checked_rotation_detail::isRotation<S>(X.rotation(), budget)) return;
  const std::string pose = named(of, quoted) + what;
  checked_rotation_detail::refuseNonFinite<S>(pose + ": position", X.translation());
  checkedRotation<S>(X.rotation(), budget, pose + ": rotation");
}

template <Scalar S>
int Model<S>::frameOfJoint(int joint) const {
  const std::string& joint_name = names[std::size_t(joint)];
  const int frame = joint == 0 ? 0 : getFrameId(joint_name, FrameType::JOINT);
  if (frame == nframes)
    throw std::invalid_argument("joint '" + joint_name + "' has no frame yet: call addJointFrame first");
  return frame;
}

extern template class Model<float>;
extern template class Model<double>;
extern template Model<float> Model<double>::cast<float>() const;
extern template Model<double> Model<double>::cast<double>() const;

}  // namespace liecheck
