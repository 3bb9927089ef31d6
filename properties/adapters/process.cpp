// The clients of the process protocol, and of the memory that a shared library is served in: docs/adapters.md.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <adapters/child.hpp>
#include <adapters/noise.hpp>
#include <adapters/shared_memory.hpp>
#include <adapters/trees.hpp>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <liecheck/text/from_chars.hpp>
#include <nlohmann/json.hpp>
#include <support/json.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties::adapters {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers of the protocol are little-endian");

/// The names in the list `member` of the object "trees", each of which must be known.
template <class Wrong>
std::set<std::string> names_in(const nlohmann::json& trees, const char* member,
                               const std::vector<std::string>& known, const std::set<std::string>& otherwise,
                               const Wrong& wrong) {
  if (!trees.contains(member)) return otherwise;
  std::set<std::string> names;
  if (!trees[member].is_array()) throw wrong(fmt::format("has no list '{}' in 'trees'", member));
  for (const auto& name : trees[member]) {
    if (std::ranges::none_of(known, [&](const std::string& k) { return name == k; }))
      throw wrong(fmt::format("has {} in the list '{}' of 'trees', where only {} are known", name.dump(),
                              member, fmt::join(known, ", ")));
    names.insert(name);
  }
  if (names.empty()) throw wrong(fmt::format("has an empty list '{}' in 'trees'", member));
  return names;
}

Description described(const std::string& line) {
  const auto wrong = [&](const std::string& what) -> AdapterFailed {
    return AdapterFailed(fmt::format(
        "the adapter's description {} {}: it must be one line of JSON, such as {{\"protocol\": 1, \"name\": "
        "\"mylib\", \"version\": \"2.1\", \"operations\": {{\"exp6\": [\"double\"]}}}}",
        quoted(line), what));
  };
  nlohmann::json j;
  std::vector<std::set<std::string>> members;  // of the objects that are open
  try {
    j = parsed(line);
    j = nlohmann::json::parse(line,
                              [&](int, nlohmann::json::parse_event_t event, const nlohmann::json& value) {
                                using Event = nlohmann::json::parse_event_t;
                                if (event == Event::object_start) members.emplace_back();
                                if (event == Event::object_end) members.pop_back();
                                if (event == Event::key && !members.back().insert(value).second)
                                  throw wrong(fmt::format("has '{}' twice", value.get<std::string>()));
                                return true;
                              });
  } catch (const nlohmann::json::exception&) {
    throw wrong("is no JSON");
  }
  if (!j.is_object() || !j.contains("protocol")) throw wrong("has no member 'protocol'");
  if (j["protocol"] != protocol_version)
    throw AdapterFailed(fmt::format(
        "the adapter speaks version {} of the protocol, and liecheck " LIECHECK_VERSION " version {}",
        j["protocol"].dump(), protocol_version));
  Description d;
  for (const auto& [member, to] : {std::pair{"name", &d.name}, {"version", &d.version}}) {
    if (!j.contains(member) || !j[member].is_string()) throw wrong(fmt::format("has no text '{}'", member));
    *to = j[member];
  }
  if (!j.contains("operations") || !j["operations"].is_object()) throw wrong("has no object 'operations'");
  for (const auto& [operation, scalars] : j["operations"].items()) {
    if (!scalars.is_array()) throw wrong(fmt::format("has no list of scalars for {}", operation));
    for (const auto& scalar : scalars) {
      if (scalar != "float" && scalar != "double")
        throw wrong(fmt::format("offers {} in {}, which is neither \"float\" nor \"double\"", operation,
                                scalar.dump()));
      d.offered.emplace(operation, scalar);
    }
  }
  const nlohmann::json conventions = j.value("conventions", nlohmann::json::object());
  if (!conventions.is_object()) throw wrong("has no object 'conventions'");
  for (const auto& [name, value] : conventions.items()) {
    if (!value.is_string()) throw wrong(fmt::format("has no text for the convention '{}'", name));
    d.conventions[name] = value;
  }
  for (const auto& [member, to] : {std::pair{"source", &d.source}, {"timed", &d.timed}}) {
    const nlohmann::json texts = j.value(member, nlohmann::json::object());
    if (!texts.is_object()) throw wrong(fmt::format("has no object '{}'", member));
    for (const auto& [operation, text] : texts.items()) {
      if (!text.is_string()) throw wrong(fmt::format("has no text as {} of {}", member, operation));
      (*to)[operation] = text;
    }
  }
  const nlohmann::json trees = j.value("trees", nlohmann::json::object());
  if (!trees.is_object()) throw wrong("has no object 'trees'");
  d.models = names_in(trees, "models", {"joints", "urdf", "mimics"}, d.models, wrong);
  d.joints = names_in(trees, "joints", joint_names(), d.joints, wrong);
  d.references = names_in(trees, "references", {"world", "local", "aligned"}, d.references, wrong);
  return d;
}

/// A call crashed in a process of the adapter's own, which answers the next one.
struct Crashed : AdapterFailed {
  using AdapterFailed::AdapterFailed;
};

/// An adapter in a process, which is started again after it failed.
class Process : public Adapter {
 public:
  const Description& description() const final { return description_; }
  std::string call(const Batch& b) final try {
    if (GivesUp::now()) throw GivenUp{};
    if (!child_) start();
    child_->set_timeout(b.of_many ? std::min(timeout_s_, of_many_s) : timeout_s_);
    return exchange(*child_, b);
  } catch (const TimedOut&) {  // so that a campaign does not wait long for each of many endless loops
    if (!b.of_many) timeout_s_ = std::max(timeout_s_ / 2, std::min(timeout_s_, 0.5));
    end(b, "the adapter gave no answer in time");
    throw;
  } catch (const Crashed& e) {  // the adapter goes on
    if (!b.of_many) say_failed(description_.name, b.operation.operation, e.what(), child_->errors());
    throw;
  } catch (const AdapterFailed& e) {
    end(b, e.what());
    throw;
  } catch (const GivenUp&) {
    if (child_)
      say_failed(description_.name, b.operation.operation, "the adapter gave no answer before the end", "");
    child_.reset();
    throw;
  }

 protected:
  explicit Process(double timeout_s) : timeout_s_(timeout_s) {}
  /// The process, which is started if there is none. The next exchange may take so long.
  Child& ready(double timeout_s) {
    if (!child_) start();
    child_->set_timeout(timeout_s);
    child_->begin();
    return *child_;
  }
  void start() {
    child_ = child(timeout_s_ + start_s);
    child_->begin();
    const std::string hello = greeting + "\n";
    child_->write(hello.data(), hello.size());
    child_->tell("waiting for an adapter to describe itself");
    Description now = described(child_->line("its description"));
    child_->tell("");
    if (const std::string how = description_.name.empty() ? "" : changed(description_, now); !how.empty())
      throw AdapterFailed(how);
    description_ = std::move(now);
  }

 private:
  void end(const Batch& b, const std::string& how) {
    const std::string errors =
        child_ ? child_->errors() : "";  // of many calls, each is made again, and says it again
    if (!b.of_many) say_failed(description_.name, b.operation.operation, how, errors);
    child_.reset();
  }
  virtual std::unique_ptr<Child> child(double timeout_s) = 0;
  virtual std::string exchange(Child& child, const Batch& b) = 0;

  static constexpr double of_many_s = 1;  ///< a campaign calls as many inputs at once as take 0.1 s
  static constexpr double start_s = 10;   ///< more for the start: an interpreter loads its packages
  double timeout_s_;
  Description description_;
  std::unique_ptr<Child> child_;
};

class ProtocolProcess final : public Process {
 public:
  ProtocolProcess(Opener opener, double timeout_s) : Process(timeout_s), opener_(std::move(opener)) {
    start();
  }

 private:
  std::unique_ptr<Child> child(double timeout_s) override { return opener_(timeout_s); }
  double timed(std::string_view how, const Batch& b, std::size_t passes) override {
    if (!description().timed.contains(std::string(b.operation.operation))) return 0;
    Child& child = ready(60);
    const std::string head =
        fmt::format("time {} {} {} {} {}\n", how, b.operation.operation, b.scalar(), b.n, passes);
    child.write(head.data(), head.size());
    child.write(b.inputs.data(), b.inputs.size());
    const std::string answer = child.line("the line 'timed NANOSECONDS'");
    double ns = 0;
    if (answer.starts_with("timed ")) fromChars(answer.data() + 6, answer.data() + answer.size(), ns);
    if (!(ns > 0) || !std::isfinite(ns))
      Child::fail(fmt::format("wrote {} where the line 'timed NANOSECONDS' is due", quoted(answer)));
    return ns;
  }
  std::string exchange(Child& child, const Batch& b) override {
    child.begin();
    if (const std::string refusal = told(child, b.model); !refusal.empty()) {
      std::ranges::fill(b.status, Status::refused);
      return refusal;
    }
    const std::string known = std::exchange(model_, "");  // a new process knows none
    const std::string head = fmt::format("call {} {} {}\n", b.operation.operation, b.scalar(), b.n);
    child.write(head.data(), head.size());
    child.write(b.inputs.data(), b.inputs.size());
    const std::string due = fmt::format("the line 'done {}'", b.n), answer = child.line(due);
    if (answer.starts_with("crashed ")) throw Crashed("the call crashed: " + answer.substr(8));
    const std::string expected = fmt::format("done {}", b.n);
    if (!answer.starts_with(expected) || (answer.size() > expected.size() && answer[expected.size()] != ' '))
      Child::fail(fmt::format("wrote {} where {} is due{}", quoted(answer), due,
                              answer.starts_with("done ") ? "" : ": does it print to standard output?"));
    child.read(std::as_writable_bytes(b.status));
    child.read(b.results);
    if (child.left_over() > 0)
      Child::fail(fmt::format("wrote {} bytes more than its answer has", child.left_over()));
    for (const Status s : b.status)
      if (s > Status::refused)
        Child::fail(fmt::format("gave the status {}: 0 is done, 1 is refused", static_cast<int>(s)));
    model_ = known;
    return answer.size() > expected.size() ? answer.substr(expected.size() + 1) : "";
  }

  /// Sends a model that the adapter does not have. Returns why it is refused, or "".
  std::string told(Child& child, std::string_view model) {
    if (model.empty() || model == model_) return "";
    model_.clear();
    const std::string line = fmt::format("model {}\n", model);
    child.write(line.data(), line.size());
    const std::string answer = child.line("the line 'done' or 'refused' after a model");
    if (answer == "refused" || answer.starts_with("refused "))
      return fmt::format("the model is refused: {}",
                         answer.size() > 8 ? answer.substr(8) : "the adapter gave no reason");
    if (answer != "done")
      Child::fail(
          fmt::format("wrote {} where the line 'done' or 'refused' after a model is due", quoted(answer)));
    model_ = model;
    return "";
  }

  Opener opener_;
  std::string model_;
};

class LibraryProcess final : public Process {
 public:
  LibraryProcess(std::string file, double timeout_s) : Process(timeout_s), file_(std::move(file)) { start(); }

 private:
  std::unique_ptr<Child> child(double timeout_s) override {
    new (&*memory_) Exchange;
    model_.clear();
    return std::make_unique<Child>(fmt::format("exec {} adapter serve {} --memory {}",
                                               shell_quoted(std::filesystem::read_symlink("/proc/self/exe")),
                                               shell_quoted(file_), memory_.path()),
                                   timeout_s);
  }
  std::string exchange(Child& child, const Batch& b) override {
    std::string why;
    Exchange& e = *memory_;
    if (!b.model.empty() && b.model != model_) {
      if (b.model.size() > e.bytes.size())
        Child::fail("is served in memory that has no room for so large a model");
      std::memcpy(e.bytes.data(), b.model.data(), b.model.size());
      e.operation = is_a_model, e.n = static_cast<std::uint32_t>(b.model.size());
      ask(child);
      model_ = b.model;
    }
    Parts part(b.operation, b.is_double, b.n);
    if (part.n == 0) Child::fail("is served in memory that has no room for a call of so many numbers");
    for (std::size_t done = 0; done < b.n; done += part.n) {
      const Parts now(b.operation, b.is_double, std::min(part.n, b.n - done));
      std::byte* const bytes = e.bytes.data();
      std::memcpy(bytes, b.inputs.data() + done * part.inputs / part.n, now.inputs);
      e.operation = place_of(b), e.is_double = b.is_double, e.n = static_cast<std::uint32_t>(now.n);
      e.inputs = static_cast<std::uint32_t>(b.operation.inputs),
      e.results = static_cast<std::uint32_t>(b.operation.results);
      ask(child);
      std::memcpy(b.results.data() + done * part.results / part.n, bytes + now.inputs, now.results);
      std::memcpy(b.status.data() + done, bytes + now.inputs + now.results, now.n);
      if (why.empty()) why.assign(e.reason.data(), strnlen(e.reason.data(), 255));
    }
    return why;
  }
  static std::uint32_t place_of(const Batch& b) {
    if (b.model.empty()) return static_cast<std::uint32_t>(adapters::place_of(b.operation));
    const auto at = std::ranges::find(model_operations(), b.operation.operation, &Operation::name);
    return static_cast<std::uint32_t>(all_sizes().size() +
                                      static_cast<std::size_t>(at - model_operations().begin()));
  }
  /// Waits for the answer to what is in the memory.
  void ask(Child& child) {
    const std::uint32_t call = memory_->asked + 1;
    memory_->asked = call;
    if (memory_->adapter_sleeps.exchange(false)) child.write("\n", 1);
    bool slept = false;
    wait_for(
        memory_->program_sleeps, [&] { return memory_->answered == call; },
        [&] {
          if (!slept) child.begin();
          slept = true;
          child.wait_for_a_byte();
        });
  }

  std::string file_, model_;  ///< the model that the child has
  SharedMemory memory_;
};

}  // namespace

std::unique_ptr<Adapter> start_process(const std::string& command, double timeout_s) {
  return start_with([command](double timeout) { return std::make_unique<Child>(command, timeout); },
                    timeout_s);
}

std::unique_ptr<Adapter> start_with(Opener opener, double timeout_s) {
  return std::make_unique<ProtocolProcess>(std::move(opener), timeout_s);
}

std::unique_ptr<Adapter> start_library(const std::string& file, double timeout_s) {
  return std::make_unique<LibraryProcess>(file, timeout_s);
}

}  // namespace liecheck::properties::adapters
