#pragma once
// The results of a series: a verdict for each measurement, and a row of totals for each output and band.

#include <campaign/budgets.hpp>
#include <campaign/digest.hpp>
#include <campaign/histogram.hpp>
#include <campaign/ranges.hpp>
#include <generators/coverage.hpp>
#include <invariants/property.hpp>
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
                failed = 0;
  Histogram errors;
  double max_error = 0, max_excess = 0;
  double worst_score = -1;  ///< error or excess of the worst case; infinite if not measured
  std::uint64_t worst_index = 0;
  double worst_kappa = 0;
  void add(const Judged& j, std::uint64_t index);
  void merge(const Row& o);
};

/// Rows by (output, band) in a map. `of` stores pointers to the rows, so that it needs no search.
class Rows {
 public:
  using Cell = std::pair<int, int>;
  using Map = std::map<Cell, Row>;
  Rows() = default;
  Rows(const Rows& o) : map_(o.map_) {}
  Rows(Rows&& o) noexcept { swap(o); }
  Rows& operator=(Rows o) noexcept {
    swap(o);
    return *this;
  }
  ~Rows() = default;

  Row& of(std::size_t output, std::size_t band) {
    if (output >= found_.size()) found_.resize(output + 1);
    auto& of_output = found_[output];
    if (band >= of_output.size()) of_output.resize(band + 1);
    if (!of_output[band]) of_output[band] = &map_[{static_cast<int>(output), static_cast<int>(band)}];
    return *of_output[band];
  }
  Row& operator[](const Cell& cell) { return map_[cell]; }
  const Row& at(const Cell& cell) const { return map_.at(cell); }
  std::size_t size() const { return map_.size(); }
  Map::const_iterator begin() const { return map_.begin(); }
  Map::const_iterator end() const { return map_.end(); }
  Map::iterator begin() { return map_.begin(); }
  Map::iterator end() { return map_.end(); }
  void erase(Map::const_iterator row) {
    found_.clear();
    map_.erase(row);
  }

 private:
  void swap(Rows& o) noexcept {  // the addresses of the rows stay valid
    map_.swap(o.map_);
    found_.swap(o.found_);
  }
  Map map_;
  std::vector<std::vector<Row*>> found_;
};

struct Tally {
  Rows rows;
  SetDigest inputs, results;
  Coverage coverage;
  std::uint64_t cases = 0;
  std::uint64_t fast = 0;                ///< decided by ball arithmetic
  std::uint64_t checked = 0;             ///< number of these that were measured again at 50 and 100 digits
  std::vector<std::uint64_t> disagreed;  ///< indices of those with a different result
  Ranges done;                           ///< the cases in this tally; the caller of Series::run sets it
  void merge(const Tally& o);
};

}  // namespace liecheck::properties
