// Shared libraries with the C interface, in this process.

#include <dlfcn.h>
#include <fmt/format.h>

#include <adapters/liecheck_adapter.h>
#include <adapters/adapter.hpp>
#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <support/float_environment.hpp>
#include <vector>

namespace liecheck::properties::adapters {
namespace {

class Library final : public Adapter {
 public:
  explicit Library(const std::string& file) {
    void* const module = dlopen(file.find('/') == std::string::npos ? ("./" + file).c_str() : file.c_str(),
                                RTLD_NOW | RTLD_LOCAL);
    if (!module) throw AdapterFailed(fmt::format("the adapter {} cannot be loaded: {}", file, dlerror()));
    const auto entry = reinterpret_cast<const liecheck_adapter* (*)()>(dlsym(module, "liecheck_get_adapter"));
    if (!entry) throw AdapterFailed(fmt::format("{} has no function liecheck_get_adapter()", file));
    adapter_ = entry();
    if (!adapter_) throw AdapterFailed(fmt::format("liecheck_get_adapter() of {} returned NULL", file));
    if (adapter_->interface_version != LIECHECK_ADAPTER_VERSION)
      throw AdapterFailed(fmt::format("{} has version {} of the interface, and this program version {}", file,
                                      adapter_->interface_version, LIECHECK_ADAPTER_VERSION));
    if (!adapter_->name || !adapter_->version || !adapter_->find)
      throw AdapterFailed(fmt::format("liecheck_get_adapter() of {} has no name, version or find", file));
    description_.name = adapter_->name, description_.version = adapter_->version;
    for (const OperationSizes& o : operation_sizes()) {
      auto& of = functions_.emplace_back();
      for (const bool is_double : {false, true}) {
        const char* const scalar = is_double ? "double" : "float";
        of[is_double] = adapter_->find(std::string(o.operation).c_str(), scalar);
        if (of[is_double]) description_.offered.emplace(o.operation, scalar);
      }
    }
  }
  const Description& description() const override { return description_; }
  std::string call(const Batch& b) override {
    std::unique_lock lock(mutex_, std::defer_lock);
    if (!adapter_->thread_safe) lock.lock();
    if (std::string how = checked(b); !how.empty()) return how;
    const bool refused = std::ranges::find(b.status, Status::refused) != b.status.end();
    const char* why = refused && adapter_->reason ? adapter_->reason() : nullptr;
    return why ? why : "";
  }

 private:
  static constexpr std::byte pattern{0xa5}, other{0x5a};  ///< as numbers both are finite and normal

  /// Calls the function, and again if a number of its results may be unwritten. Sets the status of each input.
  /// Returns how it failed, or "".
  std::string checked(const Batch& b) {
    const FloatEnvironment environment;
    const auto all = [&](Status s) { std::ranges::fill(b.status, s); };
    inputs_.assign(b.inputs.begin(), b.inputs.end());
    std::ranges::fill(b.results, pattern);
    if (std::string how = called(b); !how.empty()) return how;
    if (environment.restore()) return all(Status::environment_changed), "";
    if (!std::ranges::equal(inputs_, b.inputs)) return all(Status::argument_written), "";
    if (const auto kept = numbers_of(b, pattern); !kept.empty()) {
      std::ranges::fill(b.results, other);
      if (std::string how = called(b); !how.empty()) return how;
      environment.restore();
      if (std::ranges::includes(numbers_of(b, other), kept)) all(Status::output_unwritten);
    }
    return "";
  }
  std::string called(const Batch& b) try {
    std::ranges::fill(b.status, Status::done);
    const auto at = static_cast<std::size_t>(&b.operation - operation_sizes().data());
    functions_[at][b.is_double](b.n, b.inputs.data(), b.results.data(),
                                reinterpret_cast<unsigned char*>(b.status.data()));
    for (const Status s : b.status)
      if (s > Status::refused)
        return failed(b, fmt::format("it gave the status {}: 0 is done, 1 is refused", static_cast<int>(s)));
    return "";
  } catch (const std::exception& e) {
    return failed(b, fmt::format("it threw an exception: {}", e.what()));
  } catch (...) {
    return failed(b, "it threw an exception");
  }
  static std::string failed(const Batch& b, std::string why) {
    std::ranges::fill(b.status, Status::failed);
    return why;
  }
  /// The places of the numbers of the results of inputs that are done, all bytes of which are `byte`.
  static std::vector<std::size_t> numbers_of(const Batch& b, std::byte byte) {
    const std::size_t size = b.is_double ? 8 : 4;
    std::array<std::byte, 8> number;
    number.fill(byte);
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < b.n * b.operation.results; ++i)
      if (b.status[i / b.operation.results] == Status::done &&
          std::memcmp(b.results.data() + i * size, number.data(), size) == 0)
        places.push_back(i);
    return places;
  }

  const liecheck_adapter* adapter_ = nullptr;
  Description description_;
  std::vector<std::array<liecheck_function, 2>> functions_;  ///< of each operation in float and double
  std::vector<std::byte> inputs_;                            ///< before the call
  std::mutex mutex_;
};

}  // namespace

std::unique_ptr<Adapter> load_library(const std::string& file) {
  return std::make_unique<Library>(file);
}

}  // namespace liecheck::properties::adapters
