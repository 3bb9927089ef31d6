// The process that calls the functions of a shared library for the program.

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <unistd.h>

#include <adapters/child.hpp>
#include <adapters/shared_memory.hpp>
#include <adapters/trees.hpp>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <support/json.hpp>

namespace liecheck::properties::adapters {
namespace {

/// Keeps standard output for the answers: what the library prints goes to a file in memory, which shows at once
/// whether its first byte was written.
class Output {
 public:
  Output() : answers_(dup(1)) {
    const int file = memfd_create("printed", MFD_CLOEXEC);
    void* const at =
        file >= 0 && ftruncate(file, 1) == 0 ? mmap(nullptr, 1, PROT_READ, MAP_SHARED, file, 0) : MAP_FAILED;
    if (answers_ < 0 || at == MAP_FAILED || dup2(file, 1) != 1)
      throw AdapterFailed("standard output cannot be kept");
    first_ = static_cast<const volatile char*>(at);
    close(file);
    std::setvbuf(stdout, nullptr, _IONBF, 0);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() { close(answers_); }

  /// A side that sleeps does not miss a byte for which a full pipe has no room: it finds the others.
  void wake() const { say("\n"); }
  void say(const std::string& text) const {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t n = write(answers_, text.data() + done, text.size() - done);
      if (n < 0) throw AdapterFailed("nobody reads the answers");
      done += static_cast<std::size_t>(n);
    }
  }
  /// Whether the library printed since the last time. Its text goes to standard error.
  bool printed() const {
    if (*first_ == 0) return false;
    const off_t size = lseek(1, 0, SEEK_CUR);
    off_t from = 0;
    while (from < size && sendfile(2, 1, &from, static_cast<std::size_t>(size - from)) > 0) {
    }
    return ftruncate(1, 0) == 0 && ftruncate(1, 1) == 0 && lseek(1, 0, SEEK_SET) == 0;
  }

 private:
  int answers_;
  const volatile char* first_;
};

std::string text_of(const Description& d) {
  nlohmann::json operations = nlohmann::json::object();
  for (const auto& [operation, scalar] : d.offered) operations[operation].push_back(scalar);
  return dumped({{"protocol", protocol_version},
                 {"name", d.name},
                 {"version", d.version},
                 {"operations", operations},
                 {"conventions", d.conventions},
                 {"source", d.source},
                 {"timed", d.timed},
                 {"trees", d.joints.empty() ? nlohmann::json{{"models", d.models}}
                                            : nlohmann::json{{"models", d.models}, {"joints", d.joints}}}}) +
         "\n";
}

/// `model` is the one that calls are about.
void answer(Adapter& adapter, Exchange& e, const Output& output, std::string& model) {
  if (e.operation == is_a_model)
    return void(model.assign(reinterpret_cast<const char*>(e.bytes.data()), e.n));
  const std::size_t plain = all_sizes().size();
  const bool of_model = e.operation >= plain;
  const OperationSizes own =
      of_model ? OperationSizes{model_operations().at(e.operation - plain)->name, e.inputs, e.results}
               : OperationSizes{};
  const bool in_quaternions = !of_model && (e.inputs != all_sizes()[e.operation].inputs ||
                                            e.results != all_sizes()[e.operation].results);
  const OperationSizes& o = of_model ? own : (in_quaternions ? quaternion_sizes() : all_sizes())[e.operation];
  const bool is_double = e.is_double != 0;
  const Parts part(o, is_double, e.n);
  const std::span all(e.bytes);
  const std::span status(reinterpret_cast<Status*>(&all[part.inputs + part.results]), part.n);
  const Batch batch{o,
                    is_double,
                    part.n,
                    all.first(part.inputs),
                    all.subspan(part.inputs, part.results),
                    status,
                    of_model ? std::string_view(model) : std::string_view()};
  std::string why = adapter.call(batch);
  if (output.printed()) {
    std::ranges::fill(status, Status::printed);
  } else if (const std::string repeated = adapter.repeated(batch); !repeated.empty()) {
    status[0] = Status::not_repeatable;  // `why` names the input, which may be of an earlier call
    why = repeated;
  }
  e.reason.fill(0);
  std::copy_n(why.data(), std::min(why.size(), e.reason.size() - 1), e.reason.data());
}

/// Reads from standard input. Returns false at its end.
bool slept() {
  char bytes[64];
  return read(0, bytes, sizeof bytes) > 0;
}

}  // namespace

void serve(Adapter& adapter, const std::string& memory) {
  const SharedMemory shared(memory);
  const Output output;
  std::string hello;
  for (char c = 0; c != '\n' && read(0, &c, 1) == 1;) hello += c;
  if (hello != greeting + "\n")
    throw AdapterFailed("expected the line '" + greeting + "', and not " + quoted(hello));
  output.say(text_of(adapter.description()));
  std::string model;
  for (std::uint32_t done = 0;; ++done) {
    bool ended = false;
    wait_for(
        shared->adapter_sleeps, [&] { return ended || shared->asked != done; }, [&] { ended = !slept(); });
    if (ended) return;
    answer(adapter, *shared, output, model);
    shared->answered = done + 1;
    if (shared->program_sleeps.exchange(false)) output.wake();
  }
}

}  // namespace liecheck::properties::adapters
