#pragma once
// What accuracy costs near 0, at moderate angles and near pi: one sentence for each operation and region.

#include <reports/cost_points.hpp>
#include <reports/picture.hpp>
#include <set>
#include <string>
#include <vector>

namespace liecheck::reports {

/// One implementation of an operation in one region of the angle: its time is the mean over the bands of the region.
struct RegionPoint : CostPoint {
  double low = 0, high = 0;  ///< the spread of the time [ns]
  std::string where;         ///< the band of the region with the largest error
};

struct CostRegion {
  std::string name;
  std::vector<std::string> bands;
};
/// near 0, moderate and near pi: those for which the record has bands.
std::vector<CostRegion> cost_regions(const Json& cost);
/// All inputs together, as one region.
CostRegion every_angle();

/// The timed rows of an operation in a region, the fastest first.
std::vector<RegionPoint> region_points(const Json& cost, const std::string& operation,
                                       const CostRegion& region);

/// The library, if the records are of one alone; "" otherwise.
std::string only_library(const Merged& merged);

/// What the campaign says of an operation: the libraries without a row that fails, and those with one.
struct JudgedIn {
  std::set<std::string> right, wrong;
  JudgedIn() = default;
  JudgedIn(const Looks& looks, const std::string& operation);
  /// The forms of textbooks are wrong at some angle unless a campaign found them right.
  bool may_be_advised(const std::string& subject) const;
};

/// A sentence (HTML) that says which of the libraries to take for the most digits and what is lost with a faster one; of one
/// library beside liecheck's own forms, what the formula could reach: which form wins how many digits for how many ns. What is
/// wrong in the campaign is not advised, and what is right there needs no repair, whatever its error on the stored inputs.
std::string cost_sentence(const std::vector<RegionPoint>& points, const std::string& own_library,
                          const JudgedIn& judged = {});

/// The sentences of all operations as a table; empty without bands.
std::string cost_advice(const Json& cost, const Looks& looks);

/// "on random inputs with angles from 10⁻¹² rad to near π".
std::string timed_inputs(const Json& cost);

}  // namespace liecheck::reports
