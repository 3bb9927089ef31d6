#pragma once
// A series: the cases of one property on one subject in one scalar, and what they came to.

#include <campaign/budgets.hpp>
#include <campaign/case_id.hpp>
#include <campaign/digest.hpp>
#include <campaign/histogram.hpp>
#include <campaign/ranges.hpp>
#include <generators/coverage.hpp>
#include <invariants/property.hpp>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace liecheck::properties {

/// One measurement with its verdict.
struct Judged {
  Residual residual;
  const Budget* budget = nullptr;
  double excess = 0;  ///< error / kappa, under the excess rule
  bool ill_posed = false;
  bool failed = false;
};

/// All measurements of one output in one band.
struct Row {
  std::uint64_t count = 0, ill_posed = 0, unresolved = 0, not_finite = 0, wrong_branch = 0, refused = 0,
                failed = 0;
  Histogram errors;
  double max_error = 0, max_excess = 0;
  double worst_score = -1;  ///< the judged figure of the worst case; infinite for what has none
  std::uint64_t worst_index = 0;
  double worst_kappa = 0;
  void add(const Judged& j, std::uint64_t index);
  void merge(const Row& o);
};

/// Rows by (output, band), found again without a search.
class RowFinder {
 public:
  using Rows = std::map<std::pair<int, int>, Row>;
  RowFinder() = default;
  // What a finder found are the rows of its own map.
  RowFinder(const RowFinder&) {}
  RowFinder(RowFinder&& o) noexcept { o.found_.clear(); }
  RowFinder& operator=(const RowFinder&) {
    found_.clear();
    return *this;
  }
  Row& operator()(Rows& rows, std::size_t output, std::size_t band) {
    if (output >= found_.size()) found_.resize(output + 1);
    auto& of_output = found_[output];
    if (band >= of_output.size()) of_output.resize(band + 1);
    if (!of_output[band]) of_output[band] = &rows[{static_cast<int>(output), static_cast<int>(band)}];
    return *of_output[band];
  }

 private:
  std::vector<std::vector<Row*>> found_;
};

struct Tally {
  RowFinder::Rows rows;
  RowFinder row;
  SetDigest inputs, results;
  Coverage coverage;
  std::uint64_t cases = 0;
  std::uint64_t fast = 0;                ///< decided by ball arithmetic
  std::uint64_t checked = 0;             ///< of those, measured again at 50 and 100 digits
  std::vector<std::uint64_t> disagreed;  ///< indices where that gave another answer
  Ranges done;                           ///< which cases; set by who runs a range
  void merge(const Tally& o);
};

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
  std::string law, equation, source;
  double eps = 0;
  std::vector<Output> outputs;
  std::vector<Field> fields;
  std::vector<std::string> not_offered;

  CaseId id(std::uint64_t seed, std::uint64_t index) const;
  virtual const Bands& bands() const = 0;
  virtual void run(std::uint64_t seed, std::uint64_t index, Tally& tally) const = 0;
  virtual std::vector<std::string> input(const CaseId& id) const = 0;  ///< hexadecimal floats
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
std::vector<std::string> property_names();

/// Reads the robot and its hash. Throws what the URDF reader throws.
Robot load_robot(const std::string& path);
Robot built_in_robot();
/// `path` is what --robot was given; empty where the text came from elsewhere.
Robot robot_of(const std::string& urdf, const std::string& path);

}  // namespace liecheck::properties
