#include <adapters/converted.hpp>

#include <fmt/format.h>
#include <adapters/sizes.hpp>
#include <conventions/probe.hpp>
#include <operations/operations.hpp>
#include <vector>

namespace liecheck::properties::adapters {
namespace {

/// Calls convert(order, from, to) for each of n values of S.
template <class S, class Convert>
void each(const conventions::Order& order, std::size_t n, const std::byte* from, std::byte* to,
          Convert convert) {
  for (std::size_t i = 0; i < n; ++i)
    convert(order, reinterpret_cast<const S*>(from) + i * order.size(),
            reinterpret_cast<S*>(to) + i * order.size());
}

template <class S>
std::string call_in(Adapter& own, const conventions::Rearranged& r, const Batch& b) {
  std::vector<S> inputs(b.n * r.arguments.size()), results(b.n * r.result.size());
  const auto input_bytes = std::as_writable_bytes(std::span(inputs)),
             result_bytes = std::as_writable_bytes(std::span(results));
  each<S>(r.arguments, b.n, b.inputs.data(), input_bytes.data(), conventions::encode<S>);
  const std::string why =
      own.call({b.operation, b.is_double, b.n, input_bytes, result_bytes, b.status, {}, b.of_many});
  each<S>(r.result, b.n, result_bytes.data(), b.results.data(), conventions::decode<S>);
  return why;
}

}  // namespace

Converted::Converted(std::shared_ptr<Adapter> own, const conventions::Statements& stated)
    : own_(std::move(own)) {
  try {
    for (const OperationSizes& o : operation_sizes())
      rearranged_.push_back(conventions::rearranged(conventions::operation_named(o.operation), stated));
    // A check takes what these operations take, and has no result.
    for (const Operation* like :
         {static_cast<const Operation*>(&op::normalize), static_cast<const Operation*>(&op::log3_matrix)})
      rearranged_.push_back({conventions::rearranged(*like, stated).arguments, {}});
  } catch (const std::invalid_argument& e) {
    throw AdapterFailed(fmt::format("of the conventions that the adapter states, {}", e.what()));
  }
}

std::string Converted::call(const Batch& b) {
  if (!b.model.empty()) return own_->call(b);  // statements concern the operations on poses
  const conventions::Rearranged& r = rearranged_[static_cast<std::size_t>(&b.operation - all_sizes().data())];
  return b.is_double ? call_in<double>(*own_, r, b) : call_in<float>(*own_, r, b);
}

}  // namespace liecheck::properties::adapters
