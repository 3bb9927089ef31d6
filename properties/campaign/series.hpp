#pragma once
// A series: the cases of one property on one subject in one scalar, and what they came to.

#include <campaign/case_id.hpp>
#include <campaign/tally.hpp>
#include <memory>

namespace liecheck::properties {

/// The smallest input found that still fails in the same way.
struct Shrunk {
  CaseId id;
  std::vector<std::string> decimal;
  Judged judged;
};

/// One raw input outside any campaign, as a user would hand it in: through the subject's checked entrance.
struct Trial {
  std::vector<std::string> input;  ///< hexadecimal floats
  bool in_domain = true;           ///< false: a rotation more than 8 eps off; refusing it is right
  std::vector<Judged> judged;
  std::string refusal;  ///< what the subject said where it refused
};
struct HuntOptions;
struct HuntResult;

class Series {
 public:
  virtual ~Series() = default;
  std::string property, subject, subject_version, scalar, robot;
  bool robot_fixed = false;
  std::string law, equation, source;
  double eps = 0;
  std::vector<Output> outputs;
  std::vector<Field> fields;
  std::vector<std::string> not_offered;

  CaseId id(std::uint64_t seed, std::uint64_t index) const;
  virtual const Bands& bands() const = 0;
  virtual void run(std::uint64_t seed, std::uint64_t index, Tally& tally) const = 0;
  virtual std::vector<std::string> input(const CaseId& id) const = 0;  ///< hexadecimal floats
  /// A C++ program of a raw input that is the law's own; empty where it has none (campaign/snippet.hpp).
  virtual std::string program(const Output& output, const std::vector<std::string>& input) const = 0;
  virtual std::vector<Judged> replay(const CaseId& id) const = 0;
  /// As replay; a raw input may also hold rotations that are off unit, off orthogonal or reflected.
  virtual Trial attempt(const CaseId& id) const = 0;
  /// At most `evaluations` measurements and two seconds.
  virtual Shrunk shrink(const CaseId& id, int output, int evaluations) const = 0;
  /// The worst input of each block of an operation (hunt.hpp); nothing where this law does not measure it.
  virtual HuntResult hunt(const HuntOptions& options) const = 0;
};

/// Every property on every named subject; empty lists mean "all". Throws std::invalid_argument for a name that
/// is not known.
struct Selection {
  std::vector<std::string> subjects, properties, scalars;
};
std::vector<std::unique_ptr<Series>> select(const Selection& selection, const Robot& robot);
/// One property on any subject, in double; `subject` must outlive it. Throws std::invalid_argument.
std::unique_ptr<Series> series_of(const std::string& property, const Subject<double>& subject,
                                  const Robot& robot);

std::vector<std::string> subject_names();
/// Throws std::invalid_argument for a name that is not known.
void check_subjects(const std::vector<std::string>& names);
std::vector<std::string> property_names();

/// Reads the robot and its hash. Throws what the URDF reader throws.
Robot load_robot(const std::string& path, bool fixed = false);
Robot built_in_robot();
/// " --robot FILE", and its root where that is not free.
std::string robot_flags(const Robot& robot);
/// `path` is what --robot was given; empty where the text came from elsewhere.
Robot robot_of(const std::string& urdf, const std::string& path, bool fixed = false);

}  // namespace liecheck::properties
