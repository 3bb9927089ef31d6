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

/// A shared library is called in this process without a copy of its arguments in shared memory.
std::unique_ptr<adapters::Adapter> quick(const std::string& adapter) {
  return adapter.ends_with(".so") ? adapters::load_library(adapter, false) : adapters::start(adapter);
}

template <class S>
double time_in(adapters::Adapter& adapter, const adapters::OperationSizes& sizes, std::size_t n) {
  using Clock = std::chrono::steady_clock;
  const auto arguments = conventions::probe_arguments<S>(conventions::operation_named(sizes.operation));
  std::vector<S> inputs, results(n * sizes.results);
  for (std::size_t i = 0; i < n; ++i)
    for (const double x : arguments[i % arguments.size()]) inputs.push_back(static_cast<S>(x));
  std::vector<adapters::Status> status(n);
  double best = 0;
  for (int round = 0; round < 7; ++round) {
    const auto start = Clock::now();
    adapter.call({sizes, sizeof(S) == 8, n, std::as_bytes(std::span(inputs)),
                  std::as_writable_bytes(std::span(results)), status});
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
