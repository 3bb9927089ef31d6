#include <adapters/adapter.hpp>
#include <adapters/subjects.hpp>
#include <algorithm>
#include <chrono>
#include <conventions/probe.hpp>
#include <conventions/reference.hpp>
#include <league/measure.hpp>
#include <memory>
#include <vector>

namespace liecheck::properties::league {

namespace {

/// A shared library is called in this process without a copy of its arguments in shared memory, if they have liecheck's
/// form.
std::unique_ptr<adapters::Adapter> quick(const std::string& adapter) {
  if (!adapter.ends_with(".so")) return adapters::start(adapter);
  auto library = adapters::load_library(adapter, false);
  if (conventions::has_quaternion_poses(library->description().conventions)) return adapters::start(adapter);
  return library;
}

template <class S>
double time_in(adapters::Adapter& adapter, const adapters::OperationSizes& sizes, std::size_t n) {
  using Clock = std::chrono::steady_clock;
  const auto arguments = conventions::probe_arguments<S>(conventions::operation_named(sizes.operation));
  std::vector<S> inputs, results(n * sizes.results);
  std::vector<adapters::Status> status;
  const auto call = [&] {
    status.resize(inputs.size() / sizes.inputs);
    adapter.call({sizes, sizeof(S) == 8, status.size(), std::as_bytes(std::span(inputs)),
                  std::as_writable_bytes(std::span(results)).first(status.size() * sizes.results * sizeof(S)),
                  status});
  };
  const auto add = [&](const conventions::Numbers& x) {
    for (const double number : x) inputs.push_back(static_cast<S>(number));
  };
  std::ranges::for_each(arguments, add);
  call();
  std::vector<conventions::Numbers> answered;  // without the orders of Euler angles that the library lacks
  for (std::size_t i = 0; i < arguments.size(); ++i)
    if (status[i] == adapters::Status::done) answered.push_back(arguments[i]);
  if (answered.empty()) return 0;
  inputs.clear();
  for (std::size_t i = 0; i < n; ++i) add(answered[i % answered.size()]);
  double best = 0;
  for (int round = 0; round < 7; ++round) {
    const auto start = Clock::now();
    call();
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    if (std::ranges::any_of(status, [](adapters::Status s) { return s != adapters::Status::done; })) return 0;
    best = round == 0 ? ns : std::min(best, ns);
  }
  return best / static_cast<double>(n);
}

}  // namespace

double time_of_call(const std::string& text, const std::string& operation, const std::string& scalar) try {
  const adapters::OperationSizes* const sizes = adapters::sizes_of(operation);
  if (!sizes) return 0;
  const auto adapter = quick(text);
  const std::size_t n = text.ends_with(".so") ? 20000 : 600;
  return scalar == "double" ? time_in<double>(*adapter, *sizes, n) : time_in<float>(*adapter, *sizes, n);
} catch (const adapters::AdapterFailed&) {
  return 0;
}

}  // namespace liecheck::properties::league
