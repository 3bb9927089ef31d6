#include <adapters/chosen.hpp>

#include <fmt/format.h>
#include <adapters/sizes.hpp>
#include <conventions/choices.hpp>
#include <cstring>
#include <limits>

namespace liecheck::properties::adapters {
namespace {

template <class S>
conventions::Numbers numbers(std::span<const std::byte> bytes, std::size_t i, std::size_t n) {
  std::vector<S> typed(n);
  if (n) std::memcpy(typed.data(), bytes.data() + i * n * sizeof(S), n * sizeof(S));
  return {typed.begin(), typed.end()};
}

}  // namespace

Chosen::Chosen(std::unique_ptr<Adapter> own) : own_(std::move(own)) {
  for (const auto& [name, value] : own_->description().conventions)
    if (conventions::choice_named(name) && value != conventions::free_choice) stated_[name] = value;
}

std::string Chosen::call(const Batch& b) {
  std::string why = own_->call(b);
  if (stated_.empty() || !b.model.empty() || b.operation.results == 0) return why;
  const Operation& o = conventions::operation_named(b.operation.operation);
  for (std::size_t i = 0; i < b.n; ++i) {
    if (b.status[i] != Status::done) continue;
    const auto x = b.is_double ? numbers<double>(b.inputs, i, b.operation.inputs)
                               : numbers<float>(b.inputs, i, b.operation.inputs),
               y = b.is_double ? numbers<double>(b.results, i, b.operation.results)
                               : numbers<float>(b.results, i, b.operation.results);
    for (const auto& [name, value] : stated_) {
      const std::string broken = conventions::broken_choice(
          name, value, o, x, y,
          b.is_double ? std::numeric_limits<double>::epsilon() : std::numeric_limits<float>::epsilon());
      if (broken.empty()) continue;
      b.status[i] = Status::other_choice;
      why = fmt::format("the adapter states \"{}\": \"{}\", but {}", name, value, broken);
      break;
    }
  }
  return why;
}

}  // namespace liecheck::properties::adapters
