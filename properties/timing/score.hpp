#pragma once
// The errors of one operation on given inputs, by block, as the operation's law measures them.

#include <algorithm>
#include <invariants/property.hpp>
#include <optional>
#include <oracles/ball_arithmetic.hpp>
#include <timing/cost.hpp>

namespace liecheck::properties {

/// Collects the errors and outcomes that a law records for one operation.
class BlockCollector final : public Recorder {
 public:
  BlockCollector(const Property& law, const Operation& operation) : Recorder(law.scalar()) {
    for (const Output& o : law.outputs())
      if (o.record == &operation)
        measured_.push_back(o.definition), blocks.push_back({std::string(o.block), {}});
  }
  void record(const Output& output, std::size_t, double error, Kappa) override {
    if (!(error < std::numeric_limits<double>::infinity()))
      outcome(output, 0, Outcome::not_finite);
    else if (BlockErrors* b = at(output))
      b->errors.push_back(error);
  }
  void outcome(const Output& output, std::size_t, Outcome outcome) override {
    if (outcome == Outcome::ill_posed) return;  // the result is not determined: nothing to compare
    if (BlockErrors* b = at(output))
      ++(outcome == Outcome::not_finite     ? b->not_finite
         : outcome == Outcome::wrong_branch ? b->wrong_branch
         : leaves_open(outcome)             ? b->unresolved
                                            : b->refused);
  }
  void refused() {
    for (BlockErrors& b : blocks) ++b.refused;
  }
  std::vector<BlockErrors> blocks;

 private:
  BlockErrors* at(const Output& output) {
    const auto found = std::find(measured_.begin(), measured_.end(), output.definition);
    return found == measured_.end() ? nullptr : &blocks[static_cast<std::size_t>(found - measured_.begin())];
  }
  std::vector<const Block*> measured_;
};

/// `subject` must offer only this operation, so that nothing else is measured. Errors are measured by ball
/// arithmetic or, if that is undecided, with 50 and 100 digits.
inline std::vector<BlockErrors> score(const Property& law, const Operation& operation, const Subject& subject,
                                      const std::vector<std::vector<double>>& inputs) {
  BlockCollector all(law, operation);
  for (const auto& x : inputs) {
    std::optional<BlockCollector> one;
    try {
      // Tries the tiers of ball arithmetic, the cheapest first, until one decides.
      for (std::size_t tier = 0;; ++tier) {
        one.emplace(law, operation);
        try {
          if (!law.measure_fast(subject, x, *one, tier)) law.measure(subject, x, *one);
          break;
        } catch (const oracles::Undecided&) {
        }
      }
    } catch (const std::exception&) {
      all.refused();
      continue;
    }
    merge_blocks(all.blocks, one->blocks);
  }
  return std::move(all.blocks);
}

}  // namespace liecheck::properties
