#pragma once
// An adapter whose numbers are converted from the conventions that it states into liecheck's.

#include <adapters/adapter.hpp>
#include <vector>

namespace liecheck::properties::adapters {

class Converted final : public Adapter {
 public:
  /// Throws AdapterFailed if a statement is unknown, or cannot be converted exactly.
  Converted(std::shared_ptr<Adapter> own, const conventions::Statements& stated);
  const Description& description() const override { return own_->description(); }
  std::string call(const Batch& batch) override;
  /// The numbers of `batch` are in the conventions that the adapter states.
  double timed(std::string_view how, const Batch& batch, std::size_t passes) override {
    return own_->timed(how, batch, passes);
  }
  /// The same adapter as if it stated something else.
  Converted with(const conventions::Statements& stated) const { return {own_, stated}; }

 private:
  std::shared_ptr<Adapter> own_;
  std::vector<conventions::Rearranged> rearranged_;  ///< for each of all_sizes()
  bool quaternion_poses_;
};

}  // namespace liecheck::properties::adapters
