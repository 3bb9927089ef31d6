// Shared libraries with the C interface, in this process.

#include <dlfcn.h>
#include <fmt/format.h>

#include <adapters/liecheck_adapter.h>
#include <adapters/adapter.hpp>
#include <adapters/repeats.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <mutex>
#include <support/float_environment.hpp>
#include <vector>

namespace liecheck::properties::adapters {
namespace {

/// "quaternion: wxyz, twist: angular first"
conventions::Statements stated(const std::string& of_adapter) {
  std::string_view text = of_adapter;
  const auto word = [](std::string_view w) {
    const auto first = w.find_first_not_of(' '), last = w.find_last_not_of(' ');
    return first == w.npos ? std::string() : std::string(w.substr(first, last - first + 1));
  };
  conventions::Statements all;
  while (!text.empty()) {
    const auto end = std::min(text.find(','), text.size());
    const std::string_view one = text.substr(0, end);
    const auto colon = std::min(one.find(':'), one.size());
    all[word(one.substr(0, colon))] = word(one.substr(std::min(colon + 1, one.size())));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return all;
}

/// The shared library in a file, and its liecheck_get_adapter().
std::pair<void*, const liecheck_adapter* (*)()> opened(const std::string& file) {
  const FloatEnvironment
      environment;  // with -ffast-math, the library makes its loader flush subnormal numbers
  void* const module = dlopen(file.find('/') == std::string::npos ? ("./" + file).c_str() : file.c_str(),
                              RTLD_NOW | RTLD_LOCAL);
  if (!module) throw AdapterFailed(fmt::format("the adapter {} cannot be loaded: {}", file, dlerror()));
  const auto entry = reinterpret_cast<const liecheck_adapter* (*)()>(dlsym(module, "liecheck_get_adapter"));
  if (!entry) throw AdapterFailed(fmt::format("{} has no function liecheck_get_adapter()", file));
  return {module, entry};
}

class Library final : public Adapter {
 public:
  using Source = const char* (*)(const char*);
  /// `source` is its liecheck_get_source, or null.
  Library(const liecheck_adapter* its, Source source, const std::string& file, bool repeats)
      : adapter_(its), repeats_here_(repeats) {
    if (!adapter_) throw AdapterFailed(fmt::format("liecheck_get_adapter() of {} returned NULL", file));
    if (adapter_->interface_version != LIECHECK_ADAPTER_VERSION)
      throw AdapterFailed(fmt::format("{} has version {} of the interface, and this program version {}", file,
                                      adapter_->interface_version, LIECHECK_ADAPTER_VERSION));
    if (!adapter_->name || !adapter_->version || !adapter_->find)
      throw AdapterFailed(fmt::format("liecheck_get_adapter() of {} has no name, version or find", file));
    description_.name = adapter_->name, description_.version = adapter_->version;
    if (adapter_->conventions) description_.conventions = stated(adapter_->conventions);
    for (const OperationSizes& o : operation_sizes()) {
      auto& of = functions_.emplace_back();
      repeats_.emplace_back();
      for (const bool is_double : {false, true}) {
        const char* const scalar = is_double ? "double" : "float";
        of[is_double] = adapter_->find(std::string(o.operation).c_str(), scalar);
        if (of[is_double]) description_.offered.emplace(o.operation, scalar);
      }
      if (const char* const text = source ? source(std::string(o.operation).c_str()) : nullptr)
        description_.source.emplace(o.operation, text);
    }
  }
  static std::unique_ptr<Library> loaded(const std::string& file, bool repeats) {
    const FloatEnvironment environment;
    const auto [module, entry] = opened(file);
    const auto source = reinterpret_cast<Source>(dlsym(module, "liecheck_get_source"));
    try {
      return std::make_unique<Library>(entry(), source, file, repeats);
    } catch (const AdapterFailed&) {
      throw;
    } catch (const std::exception& e) {
      throw AdapterFailed(fmt::format("{} throws an exception when it is loaded: {}", file, e.what()));
    } catch (...) {
      throw AdapterFailed(fmt::format("{} throws an exception when it is loaded", file));
    }
  }
  const Description& description() const override { return description_; }
  std::string call(const Batch& b) override {
    std::unique_lock lock(mutex_, std::defer_lock);
    if (!adapter_->thread_safe) lock.lock();
    if (std::string how = checked(b); !how.empty()) return how;
    const bool refused = std::ranges::find(b.status, Status::refused) != b.status.end();
    if (const char* why = refused && adapter_->reason ? adapter_->reason() : nullptr) return why;
    const std::string other = repeats_here_ ? repeated(b) : "";
    if (!other.empty()) b.status[0] = Status::not_repeatable;
    return other;
  }
  std::string repeated(const Batch& b) override {
    const std::size_t at = index(b);
    return repeats_[at][b.is_double].note(b, functions_[at][b.is_double], adapter_->thread_safe);
  }

 private:
  static constexpr int pattern = 0xa5, other = 0x5a;  ///< as numbers both are finite and normal

  /// Calls the function, and again if a number of its results may be unwritten. Sets the status of each input.
  /// Returns how it failed, or "".
  std::string checked(const Batch& b) {
    const FloatEnvironment environment;
    const auto all = [&](Status s) { std::ranges::fill(b.status, s); };
    thread_local std::vector<std::byte> before;
    before.assign(b.inputs.begin(), b.inputs.end());
    std::memset(b.results.data(), pattern, b.results.size());
    if (std::string how = called(b); !how.empty()) return how;
    if (environment.restore()) return all(Status::environment_changed), "";
    if (std::memcmp(before.data(), b.inputs.data(), before.size()) != 0)
      return all(Status::argument_written), "";
    if (const auto kept = numbers_of(b, pattern); !kept.empty()) {
      std::memset(b.results.data(), other, b.results.size());
      if (std::string how = called(b); !how.empty()) return how;
      environment.restore();
      if (std::ranges::includes(numbers_of(b, other), kept)) return all(Status::output_unwritten), "";
    }
    return "";
  }
  static std::size_t index(const Batch& b) {
    return static_cast<std::size_t>(&b.operation - operation_sizes().data());
  }
  std::string called(const Batch& b) try {
    std::ranges::fill(b.status, Status::done);
    functions_[index(b)][b.is_double](b.n, b.inputs.data(), b.results.data(),
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
  static std::vector<std::size_t> numbers_of(const Batch& b, int byte) {
    return b.is_double ? numbers_like<std::uint64_t>(b, byte) : numbers_like<std::uint32_t>(b, byte);
  }
  template <class Bits>
  static std::vector<std::size_t> numbers_like(const Batch& b, int byte) {
    const Bits wanted = ~Bits(0) / 0xff * static_cast<unsigned>(byte);
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < b.results.size() / sizeof(Bits); ++i) {
      Bits bits;
      std::memcpy(&bits, b.results.data() + i * sizeof bits, sizeof bits);
      if (bits == wanted && b.status[i / b.operation.results] == Status::done) places.push_back(i);
    }
    return places;
  }

  const liecheck_adapter* adapter_ = nullptr;
  bool repeats_here_;
  Description description_;
  std::vector<std::array<liecheck_function, 2>> functions_;  ///< of each operation in float and double
  std::deque<std::array<Repeats, 2>> repeats_;
  std::mutex mutex_;
};

}  // namespace

std::unique_ptr<Adapter> load_library(const std::string& file, bool repeats) {
  return Library::loaded(file, repeats);
}
CFunction function_of_library(const std::string& file, const std::string& operation,
                              const std::string& scalar) {
  return opened(file).second()->find(operation.c_str(), scalar.c_str());
}
std::unique_ptr<Adapter> linked_library(const liecheck_adapter& adapter) {
  return std::make_unique<Library>(&adapter, nullptr, "the linked adapter", true);
}

}  // namespace liecheck::properties::adapters
