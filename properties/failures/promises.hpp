#pragma once
// What a subject can promise: limits that hold with other seeds, and the inputs for which it promises nothing.
//
// A limit covers the good bands of the angle alone, so that one wrong band does not hide faults in all others. A band of
// a block is bad if a result has no error in eps, if a limit above its largest error would demand no digit, or if that
// error is far above those at moderate angles, so that other inputs may show a cliff; of inputs without an angle, if it
// takes half of the digits and is far above half of the errors. Bad bands are expected failures.

#include <campaign/cliffs.hpp>
#include <campaign/needs.hpp>
#include <hard_cases/hard_cases.hpp>
#include <map>
#include <search/hunt.hpp>
#include <tuple>

namespace liecheck::properties {

/// The bands that are bad and follow each other on one axis: the first and the last of each run.
std::vector<std::pair<std::size_t, std::size_t>> runs_of(const std::vector<Band>& bands,
                                                         const std::vector<bool>& bad);
/// The bands first..last of one axis as inputs of a limits file: an interval, and the names of those that have none.
std::vector<std::string> inputs_of(const std::vector<Band>& bands, std::size_t first, std::size_t last);

class Promises {
 public:
  /// A limit is `allowance` times the largest error. `campaign` must outlive this object.
  explicit Promises(const CampaignResult& campaign);

  /// Adds what a search found.
  void add(const Series& series, const Worst& worst);
  /// Adds the hard cases that fail; returns whether there are any.
  bool add(const std::vector<HardRow>& rows);

  /// The lines of the sections of a limits file. The domain is that of the subject, with bounds where only tiny or only
  /// huge angles are bad.
  struct Promised {
    std::string limits, domain, expected;
  };
  Promised promised() const;

 private:
  struct OfBand {
    double largest = -1;  ///< error or excess, by the rule
    double quantile = 0;  ///< the figure of a cliff
    double median = 0;
    std::uint64_t cases = 0;
    std::string outcome;  ///< of a result without an error in eps
    bool cliff = false;
  };
  struct Block {
    const Series* series;
    std::size_t output;
    std::vector<OfBand> bands;
  };
  using Key = std::tuple<std::string, std::string, std::string>;  ///< operation, block, scalar

  Block& block(const Series& series, std::size_t output);
  bool is_bad(const Block& block, std::size_t band) const;
  /// The bad bands, and those of few cases between two of them. With `edges`, also the band beside each: the cutoff of a
  /// formula may lie in it, which few cases show.
  std::vector<bool> bad_bands(const Block& block, bool edges) const;
  void find_cliffs();
  /// Whether the domain of an operation begins at tiny angles, and ends before huge ones.
  struct Bounds {
    bool lower = false, upper = false;
  };
  std::map<std::string, Bounds> bounds() const;

  const CampaignResult& campaign_;
  std::map<Key, Block> blocks_;
};

}  // namespace liecheck::properties
