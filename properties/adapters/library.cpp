// Shared libraries with the C interface, in this process or served to another one.

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <adapters/liecheck_adapter.h>
#include <adapters/adapter.hpp>
#include <adapters/sizes.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <support/json.hpp>
#include <vector>

namespace liecheck::properties::adapters {
namespace {

/// "quaternion: wxyz, twist: angular first"
conventions::Statements stated(std::string_view text) {
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
    if (adapter_->conventions) description_.conventions = stated(adapter_->conventions);
    for (const OperationSizes& o : operation_sizes())
      for (const char* scalar : {"float", "double"})
        if (const liecheck_function f = adapter_->find(o.operation, scalar)) {
          description_.offered.emplace(o.operation, scalar);
          functions_[{o.operation, scalar}] = f;
        }
  }
  const Description& description() const override { return description_; }
  std::string call(const Batch& b) override {
    std::unique_lock lock(mutex_, std::defer_lock);
    if (!adapter_->thread_safe) lock.lock();
    std::ranges::fill(b.status, liecheck_done);
    functions_.at({b.operation, b.scalar})(b.n, b.inputs.data(), b.results.data(), b.status.data());
    const bool refused = std::ranges::find(b.status, liecheck_refused) != b.status.end();
    const char* why = refused && adapter_->reason ? adapter_->reason() : nullptr;
    return why ? why : "";
  }

 private:
  const liecheck_adapter* adapter_ = nullptr;
  Description description_;
  std::map<std::pair<std::string, std::string>, liecheck_function> functions_;
  std::mutex mutex_;
};

/// The conversation of one adapter with the program that started it.
class Server {
 public:
  /// Keeps standard output for the answers. What the library prints goes to standard error.
  Server() : out_(fdopen(dup(1), "w")) { dup2(2, 1); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server() {
    if (out_) fclose(out_);
  }

  void run(Adapter& adapter) {
    const std::string hello = line();
    if (hello != greeting) {
      if (!hello.empty()) throw AdapterFailed("expected the line '" + std::string(greeting) + "'");
      return;
    }
    describe(adapter.description());
    for (std::string head = line(); !head.empty(); head = line()) answer(adapter, head);
  }

 private:
  static std::string line() {
    std::string text;
    for (int c = getchar(); c != EOF && c != '\n'; c = getchar()) text += static_cast<char>(c);
    return text;
  }
  void describe(const Description& d) {
    nlohmann::json operations = nlohmann::json::object();
    for (const auto& [operation, scalar] : d.offered) operations[operation].push_back(scalar);
    say(dumped({{"protocol", 1},
                {"name", d.name},
                {"version", d.version},
                {"operations", operations},
                {"conventions", d.conventions}}) +
        "\n");
  }
  void answer(Adapter& adapter, const std::string& head) {
    char operation[65], scalar[17];
    std::size_t n = 0;
    if (std::sscanf(head.c_str(), "call %64s %16s %zu", operation, scalar, &n) != 3)
      throw AdapterFailed("expected a line 'call OPERATION SCALAR COUNT'");
    const auto sizes = std::ranges::find_if(operation_sizes(), [&](const OperationSizes& o) {
      return std::string_view(o.operation) == operation;
    });
    if (sizes == operation_sizes().end() || !adapter.description().offered.contains({operation, scalar}))
      throw AdapterFailed(fmt::format("{} in {} is not offered", operation, scalar));
    const std::size_t bytes = std::string_view(scalar) == "float" ? 4 : 8;
    inputs_.resize(n * sizes->inputs * bytes), results_.resize(n * sizes->results * bytes), status_.resize(n);
    if (fread(inputs_.data(), 1, inputs_.size(), stdin) != inputs_.size()) return;
    std::ranges::fill(results_, std::byte{0xff});  // not a number
    std::string why = adapter.call({operation, scalar, n, inputs_, results_, status_});
    std::ranges::replace(why, '\n', ' ');
    say(fmt::format("done {}{}{}\n", n, why.empty() ? "" : " ", why));
    fwrite(status_.data(), 1, status_.size(), out_);
    fwrite(results_.data(), 1, results_.size(), out_);
    fflush(out_);
  }
  void say(const std::string& text) {
    fwrite(text.data(), 1, text.size(), out_);
    fflush(out_);
  }
  FILE* out_;
  std::vector<std::byte> inputs_, results_;
  std::vector<unsigned char> status_;
};

}  // namespace

std::unique_ptr<Adapter> load_library(const std::string& file) {
  return std::make_unique<Library>(file);
}

void serve(Adapter& adapter) {
  Server().run(adapter);
}

}  // namespace liecheck::properties::adapters
