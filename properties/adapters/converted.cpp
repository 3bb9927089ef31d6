#include <adapters/converted.hpp>

#include <fmt/format.h>
#include <adapters/sizes.hpp>
#include <conventions/probe.hpp>
#include <cstring>
#include <operations/operations.hpp>
#include <operations/quaternion_poses.hpp>
#include <vector>

namespace liecheck::properties::adapters {
namespace {

/// Calls convert(order, from, to) for each value of S.
template <class S, class Convert>
void each(const conventions::Order& order, std::span<const S> from, S* to, Convert convert) {
  for (std::size_t i = 0; i < from.size(); i += order.size()) convert(order, from.data() + i, to + i);
}

/// The numbers that convert(those of a value as doubles) returns, for each value of n numbers.
template <class S, class Convert>
std::vector<S> in_other_form(std::span<const S> from, std::size_t n, Convert convert) {
  std::vector<S> all;
  for (; !from.empty(); from = from.subspan(n))
    for (const double x : convert(std::vector<double>(from.begin(), from.begin() + std::ptrdiff_t(n))))
      all.push_back(static_cast<S>(x));
  return all;
}

template <class S>
std::string call_in(Adapter& own, const conventions::Rearranged& r, const OperationSizes& sizes,
                    const Batch& b) {
  std::span given(reinterpret_cast<const S*>(b.inputs.data()), b.n * b.operation.inputs);
  const bool in_quaternions = &sizes != &b.operation;
  std::vector<S> poses;
  if (in_quaternions && sizes.inputs != b.operation.inputs)
    given = poses = in_other_form(given, b.operation.inputs, [&](const std::vector<double>& x) {
      return poses_as_quaternions(conventions::operation_named(sizes.operation), x, !b.is_double);
    });
  std::vector<S> inputs(given.size()), results(b.n * sizes.results), own_order(results.size());
  each<S>(r.arguments, given, inputs.data(), conventions::encode<S>);
  const std::string why = own.call({sizes,
                                    b.is_double,
                                    b.n,
                                    std::as_bytes(std::span(inputs)),
                                    std::as_writable_bytes(std::span(results)),
                                    b.status,
                                    {},
                                    b.of_many});
  each<S>(r.result, results, own_order.data(), conventions::decode<S>);
  if (in_quaternions && sizes.results != b.operation.results)
    own_order =
        in_other_form(std::span<const S>(own_order), sizes.results, [&](const std::vector<double>& y) {
          return poses_as_matrices(*conventions::operation_named(sizes.operation).results[0], y,
                                   !b.is_double);
        });
  std::memcpy(b.results.data(), own_order.data(), b.results.size());
  return why;
}

}  // namespace

Converted::Converted(std::shared_ptr<Adapter> own, const conventions::Statements& stated)
    : own_(std::move(own)), quaternion_poses_(conventions::has_quaternion_poses(stated)) {
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
  const std::size_t at = place_of(b.operation);
  const OperationSizes& sizes = quaternion_poses_ ? quaternion_sizes()[at] : b.operation;
  return b.is_double ? call_in<double>(*own_, rearranged_[at], sizes, b)
                     : call_in<float>(*own_, rearranged_[at], sizes, b);
}

}  // namespace liecheck::properties::adapters
