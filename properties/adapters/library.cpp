// Shared libraries with the C interface, in this process.

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <adapters/liecheck_adapter.h>
#include <adapters/adapter.hpp>
#include <adapters/flat_model.hpp>
#include <adapters/inside.hpp>
#include <adapters/repeats.hpp>
#include <adapters/trees.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <support/float_environment.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>
#include <thread>
#include <vector>

namespace liecheck::properties::adapters {
namespace {

std::string word(std::string_view w) {
  const auto first = w.find_first_not_of(' '), last = w.find_last_not_of(' ');
  return first == w.npos ? std::string() : std::string(w.substr(first, last - first + 1));
}
/// The parts of "one, two, three".
std::vector<std::string> listed(const std::string& text) {
  std::vector<std::string> all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    all.push_back(word(std::string_view(text).substr(at, end - at)));
    at = end + 1;
  }
  return all;
}
/// "quaternion: wxyz, twist: angular first"
conventions::Statements stated(const std::string& text) {
  conventions::Statements all;
  for (const std::string& one : listed(text)) {
    const auto colon = std::min(one.find(':'), one.size());
    all[word(one.substr(0, colon))] = word(one.substr(std::min(colon + 1, one.size())));
  }
  return all;
}
/// The names in a list, each of which must be known.
std::set<std::string> names_in(const char* text, const std::vector<std::string>& known,
                               const std::string& file) {
  std::set<std::string> names;
  for (const std::string& name : listed(text)) {
    if (std::ranges::find(known, name) == known.end())
      throw AdapterFailed(fmt::format("{} takes trees with '{}', where only {} are known", file, name,
                                      fmt::join(known, ", ")));
    names.insert(name);
  }
  return names;
}

/// The shared library in a file, and its liecheck_get_adapter().
std::pair<void*, const liecheck_adapter* (*)()> opened(const std::string& file) {
  const std::jthread slow([&](const std::stop_token& ended) {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any end;
    end.wait_for(lock, ended, std::chrono::seconds(1), [] { return false; });
    if (!ended.stop_requested() && isatty(2))
      std::fprintf(stderr, "%s is loaded, and its constructors have not returned yet\n",
                   printable(file).c_str());
  });
  const FloatEnvironment
      environment;  // with -ffast-math, the library makes its loader flush subnormal numbers
  void* const module = dlopen(file.find('/') == std::string::npos ? ("./" + file).c_str() : file.c_str(),
                              RTLD_NOW | RTLD_LOCAL);
  if (!module) throw AdapterFailed(fmt::format("the adapter {} cannot be loaded: {}", file, dlerror()));
  const auto entry = reinterpret_cast<const liecheck_adapter* (*)()>(dlsym(module, "liecheck_get_adapter"));
  if (!entry) throw AdapterFailed(fmt::format("{} has no function liecheck_get_adapter()", file));
  return {module, entry};
}

/// A function of the library, or null.
template <class F>
F exported(void* module, const char* name) {
  return module ? reinterpret_cast<F>(dlsym(module, name)) : nullptr;
}

/// An adapter of version 1 or 2, with NULL for what version 1 does not have.
liecheck_adapter copied(const liecheck_adapter& its) {
  liecheck_adapter all{};
  std::memcpy(&all, &its, its.interface_version == 1 ? offsetof(liecheck_adapter, context) : sizeof all);
  return all;
}

class Library final : public Adapter {
 public:
  /// Of a shared library, or of an adapter that is linked and has no `module`.
  Library(const liecheck_adapter* its, void* module, const std::string& file, bool repeats)
      : repeats_here_(repeats) {
    if (repeats) Inside::watch();
    if (!its) throw AdapterFailed(fmt::format("liecheck_get_adapter() of {} returned NULL", file));
    if (its->interface_version < 1 || its->interface_version > LIECHECK_ADAPTER_VERSION)
      throw AdapterFailed(fmt::format("{} has version {} of the interface, and liecheck " LIECHECK_VERSION
                                      " versions 1 to {}",
                                      file, its->interface_version, LIECHECK_ADAPTER_VERSION));
    adapter_ = copied(*its);
    const auto source = exported<decltype(&liecheck_get_source)>(module, "liecheck_get_source");
    const auto references = exported<decltype(&liecheck_get_references)>(module, "liecheck_get_references");
    const auto loops = exported<decltype(&liecheck_get_loops)>(module, "liecheck_get_loops");
    if (!adapter_.name || !adapter_.version ||
        !(adapter_.find || adapter_.find_call || adapter_.find_model_call))
      throw AdapterFailed("liecheck_get_adapter() of " + file +
                          " has no name, version or function that finds "
                          "functions: find, find_call or find_model_call");
    description_.name = adapter_.name, description_.version = adapter_.version;
    if (adapter_.conventions) description_.conventions = stated(adapter_.conventions);
    const auto offer = [&](std::string_view operation, bool is_double, const CFunction& f) {
      const char* const scalar = is_double ? "double" : "float";
      if (f) description_.offered.emplace(operation, scalar);
      if (const auto* l = f && loops ? loops(std::string(operation).c_str(), scalar) : nullptr)
        description_.timed[std::string(operation)] = l->own_types ? "own types" : "numbers";
      return f;
    };
    for (const OperationSizes& o : all_sizes()) {
      const std::string name(o.operation);
      auto& of = functions_.emplace_back();
      repeats_.emplace_back();
      for (const bool is_double : {false, true})
        of[is_double] = offer(name, is_double, found(adapter_, name, is_double));
      if (const char* const text = source ? source(name.c_str()) : nullptr)
        description_.source.emplace(name, text);
    }
    if (!adapter_.find_model_call && !adapter_.open_model && !adapter_.models) return;
    if (!adapter_.find_model_call || !adapter_.open_model)
      throw AdapterFailed(fmt::format("{} has no {}, without which it takes no model", file,
                                      adapter_.open_model ? "find_model_call" : "open_model"));
    description_.models =
        names_in(adapter_.models ? adapter_.models : "joints", {"joints", "urdf", "mimics"}, file);
    if (description_.models.empty()) throw AdapterFailed(fmt::format("{} has an empty list of models", file));
    if (adapter_.joints) description_.joints = names_in(adapter_.joints, joint_names(), file);
    if (const char* const names = references ? references() : nullptr)
      description_.references = names_in(names, {"world", "local", "aligned"}, file);
    for (const Operation* o : model_operations())
      for (const bool is_double : {false, true}) {
        const std::string name(o->name);
        const liecheck_call call =
            adapter_.find_model_call(adapter_.context, name.c_str(), is_double ? "double" : "float");
        model_functions_[name][is_double] = offer(name, is_double, {nullptr, call, nullptr});
      }
  }
  /// The function of one of all_sizes(), if the adapter has it.
  static CFunction found(const liecheck_adapter& a, const std::string& operation, bool is_double) {
    const char* const scalar = is_double ? "double" : "float";
    if (a.find_call) return {nullptr, a.find_call(a.context, operation.c_str(), scalar), a.context};
    const bool is_check = operation.starts_with("check_");  // which version 1 does not have
    return {a.find && !is_check ? a.find(operation.c_str(), scalar) : nullptr, nullptr, nullptr};
  }
  static std::unique_ptr<Library> loaded(const std::string& file, bool repeats) {
    const FloatEnvironment environment;
    const auto [module, entry] = opened(file);
    try {
      return std::make_unique<Library>(entry(), module, file, repeats);
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
    if (GivesUp::now()) throw GivenUp{};
    std::unique_lock lock(mutex_, std::defer_lock);
    if (!adapter_.thread_safe) lock.lock();
    std::shared_ptr<Handle> model;
    CFunction function;
    if (b.model.empty()) {
      function = functions_[place_of(b.operation)][b.is_double];
    } else {
      std::string why;
      model = handle_of(b.model, why);
      if (!model) return std::ranges::fill(b.status, Status::refused), why;
      function = model_functions_.at(std::string(b.operation.operation))[b.is_double];
      function.context = model->handle;
    }
    if (std::string how = checked(b, function); !how.empty()) return how;
    const bool refused = std::ranges::find(b.status, Status::refused) != b.status.end();
    if (refused) return reason();
    const std::string other = repeats_here_ ? repeated(b) : "";
    if (!other.empty()) b.status[0] = Status::not_repeatable;
    return other;
  }
  std::string repeated(const Batch& b) override {
    if (!b.model.empty()) return "";
    const std::size_t at = place_of(b.operation);
    const Inside inside(adapter_.name, b.operation.operation);
    return repeats_[at][b.is_double].note(b, functions_[at][b.is_double], adapter_.thread_safe);
  }

 private:
  static constexpr int pattern = 0xa5, other = 0x5a;  ///< as numbers both are finite and normal
  static constexpr std::size_t most_models = 16;      ///< that are kept open

  /// A model that the library has opened.
  struct Handle {
    const liecheck_adapter& adapter;
    void* handle;
    Handle(const liecheck_adapter& a, void* h) : adapter(a), handle(h) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
      try {
        if (adapter.close_model) adapter.close_model(adapter.context, handle);
      } catch (...) {  // of foreign code, which concerns no result
      }
    }
  };

  std::string reason() const {
    const char* const why = adapter_.reason ? adapter_.reason() : nullptr;
    return why ? why : "";
  }
  /// The model of the text, or null if the library refuses it for the reason `why`.
  std::shared_ptr<Handle> handle_of(std::string_view text, std::string& why) try {
    const std::lock_guard lock(models_mutex_);
    const auto known =
        std::ranges::find(models_, text, &std::pair<std::string, std::shared_ptr<Handle>>::first);
    if (known != models_.end()) return known->second;
    const FloatEnvironment environment;
    const FlatModel model(text);
    const Inside inside(adapter_.name, "open_model");
    void* const handle = adapter_.open_model(adapter_.context, &model.model());
    if (!handle)
      return why = "the model is refused: " + (reason().empty() ? "the adapter gave no reason" : reason()),
             nullptr;
    if (models_.size() == most_models) models_.pop_front();
    return models_.emplace_back(text, std::make_shared<Handle>(adapter_, handle)).second;
  } catch (const std::exception& e) {
    return why = fmt::format("the model is refused: {}", e.what()), nullptr;
  } catch (...) {
    return why = "the model is refused: open_model threw an exception", nullptr;
  }

  /// Calls the function, and again if a number of its results may be unwritten. Sets the status of each input.
  /// Returns how it failed, or "".
  std::string checked(const Batch& b, const CFunction& function) {
    const FloatEnvironment environment;
    const auto all = [&](Status s) { std::ranges::fill(b.status, s); };
    thread_local std::vector<std::byte> before;
    before.assign(b.inputs.begin(), b.inputs.end());
    std::memset(b.results.data(), pattern, b.results.size());
    if (std::string how = called(b, function); !how.empty()) return how;
    if (environment.restore()) return all(Status::environment_changed), "";
    if (std::memcmp(before.data(), b.inputs.data(), before.size()) != 0)
      return all(Status::argument_written), "";
    if (const auto kept = numbers_of(b, pattern); !kept.empty()) {
      std::memset(b.results.data(), other, b.results.size());
      if (std::string how = called(b, function); !how.empty()) return how;
      environment.restore();
      if (std::ranges::includes(numbers_of(b, other), kept)) return all(Status::output_unwritten), "";
    }
    return "";
  }
  std::string called(const Batch& b, const CFunction& function) const try {
    std::ranges::fill(b.status, Status::done);
    const Inside inside(adapter_.name, b.operation.operation);
    function(b.n, b.inputs.data(), b.results.data(), reinterpret_cast<unsigned char*>(b.status.data()));
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

  liecheck_adapter adapter_{};  ///< of version 1, with NULL for the rest
  bool repeats_here_;
  Description description_;
  std::vector<std::array<CFunction, 2>> functions_;  ///< of all_sizes() in float and double
  std::map<std::string, std::array<CFunction, 2>> model_functions_;
  std::deque<std::array<Repeats, 2>> repeats_;
  std::mutex mutex_, models_mutex_;
  std::deque<std::pair<std::string, std::shared_ptr<Handle>>> models_;  ///< by their text
};

}  // namespace

std::unique_ptr<Adapter> load_library(const std::string& file, bool repeats) {
  return Library::loaded(file, repeats);
}
CFunction function_of_library(const std::string& file, const std::string& operation,
                              const std::string& scalar) {
  return Library::found(copied(*opened(file).second()), operation, scalar == "double");
}
const liecheck_loops* loops_of_library(const std::string& file, const std::string& operation,
                                       const std::string& scalar) {
  const auto get = exported<decltype(&liecheck_get_loops)>(opened(file).first, "liecheck_get_loops");
  return get ? get(operation.c_str(), scalar.c_str()) : nullptr;
}
std::unique_ptr<Adapter> linked_library(const liecheck_adapter& adapter) {
  return std::make_unique<Library>(&adapter, nullptr, "the linked adapter", true);
}

}  // namespace liecheck::properties::adapters
