#pragma once
// An adapter whose results are held to the choices that it states.

#include <adapters/adapter.hpp>

namespace liecheck::properties::adapters {

class Chosen final : public Adapter {
 public:
  explicit Chosen(std::unique_ptr<Adapter> own);
  const Adapter& own() const { return *own_; }
  const Description& description() const override { return own_->description(); }
  std::string call(const Batch& batch) override;
  std::string repeated(const Batch& batch) override { return own_->repeated(batch); }
  double timed(std::string_view how, const Batch& batch, std::size_t passes) override {
    return own_->timed(how, batch, passes);
  }

 private:
  std::unique_ptr<Adapter> own_;
  conventions::Statements stated_;  ///< choices, without those that are free
};

}  // namespace liecheck::properties::adapters
