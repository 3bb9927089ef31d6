#pragma once
// The results of a series: a verdict for each measurement, and a row of totals for each output and band.

#include <budgets/budgets.hpp>
#include <campaign/digest.hpp>
#include <campaign/histogram.hpp>
#include <campaign/ranges.hpp>
#include <generators/coverage.hpp>
#include <invariants/measurement.hpp>
#include <map>
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
                failed = 0, unmeasured = 0;
  std::uint64_t not_repeatable = 0, argument_written = 0, output_unwritten = 0, crashed = 0;
  std::uint64_t environment_changed = 0, printed = 0;
  std::uint64_t outside_domain = 0;  ///< neither measured nor judged
  Histogram errors;
  double max_error = 0, max_excess = 0;
  double worst_score = -1;  ///< error or excess of the worst case; infinite if not measured
  std::uint64_t worst_index = 0;
  double worst_kappa = 0;
  std::uint64_t inside() const { return count - outside_domain; }
  void add(const Judged& j, std::uint64_t index);
  void merge(const Row& o);
  /// The number of measurements that decide something: pass or fail.
  std::uint64_t judged() const { return inside() - ill_posed - unresolved - unmeasured; }

 private:
  void take_worst(bool other_failed, double score, std::uint64_t index, double kappa);
};

/// Rows by (output, band) in a map. `of` caches pointers to the rows, so that it need not search the map.
class Rows : std::map<std::pair<int, int>, Row> {
 public:
  using Cell = key_type;
  using map::at, map::begin, map::end, map::find, map::size, map::operator[];
  Rows() = default;
  Rows(const Rows& o) : map(o) {}
  Rows(Rows&&) = default;  // the addresses of the rows stay valid
  Rows& operator=(const Rows& o) { return *this = Rows(o); }
  Rows& operator=(Rows&&) = default;
  ~Rows() = default;

  Row& of(std::size_t output, std::size_t band) {
    if (output >= found_.size()) found_.resize(output + 1);
    auto& of_output = found_[output];
    if (band >= of_output.size()) of_output.resize(band + 1);
    if (!of_output[band]) of_output[band] = &(*this)[{static_cast<int>(output), static_cast<int>(band)}];
    return *of_output[band];
  }
  void erase(const_iterator row) {
    found_.clear();
    map::erase(row);
  }

 private:
  std::vector<std::vector<Row*>> found_;
};

/// What one case says about each output of its law.
MeasuredOutputs measured_outputs(const std::vector<Judged>& judged);

struct Tally {
  Rows rows;
  SetDigest inputs, results;
  Coverage coverage;
  std::uint64_t cases = 0;
  std::uint64_t fast = 0;                ///< decided by ball arithmetic
  std::uint64_t checked = 0;             ///< `fast` cases that were measured again at 50 and 100 digits
  std::vector<std::uint64_t> disagreed;  ///< indices of the `checked` cases with a different result
  Ranges done;                           ///< the cases in this tally; the caller of Series::run sets it
  void merge(const Tally& o);
};

}  // namespace liecheck::properties
