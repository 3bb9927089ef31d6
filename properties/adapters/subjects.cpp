#include <adapters/subjects.hpp>

#include <adapters/liecheck_adapter.h>
#include <fmt/format.h>
#include <adapters/adapter.hpp>
#include <adapters/asked.hpp>
#include <adapters/chosen.hpp>
#include <adapters/converted.hpp>
#include <adapters/exchange.hpp>
#include <adapters/noise.hpp>
#include <adapters/sizes.hpp>
#include <adapters/together.hpp>
#include <adapters/trees.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <conventions/probe.hpp>
#include <conventions/values.hpp>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <operations/quaternion_poses.hpp>
#include <optional>
#include <subjects/number_function.hpp>
#include <subjects/remote.hpp>
#include <subjects/subject.hpp>
#include <support/text.hpp>
#include <vector>

namespace liecheck::properties::adapters {
namespace {

constexpr double timeout_s = 5;  ///< of a call
constexpr std::string_view inside = "in-process:";

bool is_pose_at(const Layout* layout) {
  return is_pose(*layout);
}

/// What was typed, and how to start it once more: every thread has an adapter of its own.
struct Source {
  std::string text;
  int number = 0;
  std::shared_ptr<Adapter> in_process;  ///< or null: a process for each thread
  Description description = {};
  unsigned changes = 0;       ///< how often exchange_adapter() put another one in its place
  std::string own_name = {};  ///< which it gives itself
};

std::array<std::optional<Source>, most_adapters> sources;

/// The adapter of this thread.
Adapter& adapter(int number) {
  struct Own {
    std::shared_ptr<Adapter> adapter;
    unsigned changes = 0;
  };
  thread_local std::array<Own, most_adapters> all;
  Own& own = all[static_cast<std::size_t>(number)];
  const Source& source = *sources[static_cast<std::size_t>(number)];
  if (!own.adapter || own.changes != source.changes) {
    own = {source.in_process ? source.in_process : start(source.text), source.changes};
    Description earlier = source.description;
    earlier.name = source.own_name;
    if (const std::string how = changed(earlier, own.adapter->description()); !how.empty()) {
      own = {};
      throw AdapterFailed(how);
    }
  }
  return *own.adapter;
}

bool in_process(int number) {
  return sources[static_cast<std::size_t>(number)]->in_process != nullptr;
}

/// Calls an operation of the adapter of this thread with numbers of its scalar. Throws CallFailed.
void call_numbers(int number, const OperationSizes& sizes, const Scalar& scalar, const void* inputs,
                  void* results) {
  std::array<Status, 1> status{};
  std::string why;
  try {
    const Batch one{sizes,
                    !scalar.is_float(),
                    1,
                    {static_cast<const std::byte*>(inputs), sizes.inputs * scalar.size},
                    {static_cast<std::byte*>(results), sizes.results * scalar.size},
                    status};
    why = in_process(number) ? adapter(number).call(one) : call_together(adapter(number), one);
  } catch (const AdapterFailed& e) {
    throw CallFailed(e.what(), sizes.operation, Outcome::crashed);
  }
  if (status[0] == Status::done) return;
  if (status[0] == Status::not_repeatable)
    say_not_repeatable(adapter(number).description().name, sizes.operation, why);
  throw CallFailed(in_words(status[0], why), sizes.operation, outcome_of(status[0]));
}

/// Adds the subject of an adapter in one scalar, if it offers anything in it.
void register_one(int number, const std::string& text, const Description& d, const Scalar& scalar) {
  const auto offers = [&d, &scalar](std::string_view operation) {
    return d.offered.contains({std::string(operation), std::string(scalar.name)});
  };
  if (std::ranges::none_of(d.offered, [&](const auto& o) { return o.second == scalar.name; })) return;
  Subject s{d.name, d.version, text, &scalar};
  s.takes = d.taken;
  s.takes.joints = oracles::JointSet(d.joints);
  s.takes.quaternion_poses = conventions::has_quaternion_poses(d.conventions);
  s.takes.reads_urdf = d.models.contains("urdf"), s.takes.mimics = d.models.contains("mimics");
  fill_slots(s.operations, [&](const Operation& o) {
    NumberFunction f{&o, &scalar};
    f.quaternion_poses = s.takes.quaternion_poses;
    if (offers(o.name))
      f.compute = [number, &scalar, &sizes = *sizes_of(o.name)](const void* in, void* out) {
        call_numbers(number, sizes, scalar, in, out);
      };
    if (f.compute && lacks_kinds(o, d.taken))
      f.compute = [call = f.compute, &scalar, &o, taken = d.taken](void* in, void* out) {
        scalar.with([&]<class S>() {
          const auto* const numbers = static_cast<const S*>(in);
          check_kinds(o, taken, std::vector<double>(numbers, numbers + count_numbers(o.arguments)));
        });
        call(in, out);
      };
    return f;
  });
  // A library's own check of a quaternion or a rotation.
  const auto fill_check = [&](auto& slot, const char* name) {
    if (!offers(name)) return;
    slot = [number, &scalar, &sizes = *sizes_of(name)](const auto& x) {
      scalar.with([&]<class N>() {
        std::array<N, 9> numbers;
        N* to = numbers.data();
        put_numbers(x, to);
        call_numbers(number, sizes, scalar, numbers.data(), nullptr);
      });
    };
  };
  fill_check(s.operations.check_quaternion, "check_quaternion");
  fill_check(s.operations.check_rotation, "check_rotation");
  const Route route = [number]() -> Adapter& { return adapter(number); };
  const std::string in(scalar.name);
  if (offers_trees(d, in))
    s.operations.tree = [d, &scalar, route](const Tree<double>& tree) {
      TreeOperations<double> o;
      fill_tree(o, tree, d, scalar, route);
      return o;
    };
  if (offers_robots(d, in))
    s.operations.robot = [&scalar, route, mimics = s.takes.mimics](const std::string& urdf, bool fixed) {
      RobotOperations<double> o;
      fill_robot(o, *urdf_model(urdf, fixed, mimics), scalar, route);
      return o;
    };
  register_subject(std::move(s));
}

/// An adapter whose words have no control characters: they go to terminals, records and pages.
class Printable final : public Adapter {
 public:
  explicit Printable(std::unique_ptr<Adapter> own) : own_(std::move(own)), description_(own_->description()) {
    for (std::string* text : {&description_.name, &description_.version}) *text = printable(*text);
    for (auto& [operation, program] : description_.source) program = printable_lines(program);
  }
  const Description& description() const override { return description_; }
  std::string call(const Batch& batch) override try {
    return printable(own_->call(batch));
  } catch (const AdapterFailed& e) {
    throw AdapterFailed(printable(e.what()));
  }
  std::string repeated(const Batch& batch) override { return printable(own_->repeated(batch)); }
  double timed(std::string_view how, const Batch& batch, std::size_t passes) override {
    return own_->timed(how, batch, passes);
  }

 private:
  std::unique_ptr<Adapter> own_;
  Description description_;
};

/// The adapter as the program calls it.
std::unique_ptr<Adapter> as_called(std::unique_ptr<Adapter> own) {
  own = std::make_unique<Printable>(std::move(own));
  const conventions::Statements stated = own->description().conventions;
  if (stated.empty()) return own;
  return std::make_unique<Chosen>(std::make_unique<Converted>(std::move(own), stated));
}

/// Registers the subject of an adapter. Every thread uses it or, if it is not `in_process`, starts it once more.
std::string register_as(const std::string& text, const std::string& name, bool in_process,
                        const std::function<std::shared_ptr<Adapter>()>& start_first) {
  const auto free = std::ranges::find_if(sources, [](const auto& s) { return !s; });
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument(fmt::format("--adapter: '{}': {}", text, why));
  };
  if (free == sources.end()) refuse(fmt::format("more than {} adapters", most_adapters));
  Source source{text, static_cast<int>(free - sources.begin()), nullptr};
  Description d;
  try {
    const std::shared_ptr<Adapter> first = start_first();
    d = first->description(), source.own_name = d.name;
    if (!name.empty()) d.name = name;
    ask_for_kinds(*first, d.taken);
    const std::set<std::string> references = references_taken(*first);
    std::ranges::set_difference(d.references, references,
                                std::inserter(d.refused_references, d.refused_references.end()));
    d.references = references;
    if (in_process) source.in_process = first;
  } catch (const AdapterFailed& e) {
    refuse(e.what());
  }
  if (const std::string why = complaint_of_name(d.name); !why.empty()) refuse(why);
  for (const auto& [operation, scalar] : d.offered)
    if (!is_operation(operation))
      refuse(fmt::format("it offers '{}', which {}", operation, no_operation(operation)));
  if (d.offered.empty()) refuse("it offers no operation");
  for (const Subject* s : subjects(oracles::scalar_of<double>))
    if (s->name == d.name) refuse(fmt::format("a subject is named '{}' already", d.name));
  source.description = d;
  *free = source;
  if (!in_process) remote_subjects().insert(d.name);
  register_one(source.number, text, d, oracles::scalar_of<float>);
  register_one(source.number, text, d, oracles::scalar_of<double>);
  return d.name;
}

}  // namespace

std::string complaint_of_name(const std::string& name) {
  const bool fits = !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  return fits ? "" : fmt::format("its name '{}' must have letters, digits, '_' and '-' only", name);
}

const std::vector<OperationSizes>& all_sizes() {
  static const std::vector<OperationSizes> all = [] {
    std::vector<OperationSizes> sizes;
    SpatialSlots<Doubles>::for_each([&](const Operation& o) {
      sizes.push_back({o.name, count_numbers(o.arguments), count_numbers(o.results)});
    });
    sizes.push_back({"check_quaternion", 4, 0}), sizes.push_back({"check_rotation", 9, 0});
    return sizes;
  }();
  return all;
}
const std::vector<OperationSizes>& quaternion_sizes() {
  static const std::vector<OperationSizes> all = [] {
    std::vector<OperationSizes> sizes = all_sizes();
    std::size_t at = 0;
    SpatialSlots<Doubles>::for_each([&](const Operation& o) {
      sizes[at].inputs -= 5 * static_cast<std::size_t>(std::ranges::count_if(o.arguments, is_pose_at));
      sizes[at++].results -= 5 * static_cast<std::size_t>(std::ranges::count_if(o.results, is_pose_at));
    });
    return sizes;
  }();
  return all;
}
std::size_t place_of(const OperationSizes& sizes) {
  const OperationSizes* const from = all_sizes().data();
  const bool is_of_all = !std::less<>()(&sizes, from) && std::less<>()(&sizes, from + all_sizes().size());
  return static_cast<std::size_t>(&sizes - (is_of_all ? from : quaternion_sizes().data()));
}
std::span<const OperationSizes> operation_sizes() {
  return std::span(all_sizes()).first(all_sizes().size() - 2);
}

std::string library_in(const std::string& text) {
  if (text.starts_with(inside)) return text.substr(inside.size());
  return text.ends_with(".so") && (std::filesystem::exists(text) || text.find(' ') == text.npos) ? text : "";
}

std::unique_ptr<Adapter> start(const std::string& text) {
  const std::string library = library_in(text);
  return as_called(text.starts_with(inside) ? load_library(library)
                   : library.empty()        ? start_process(text, timeout_s)
                                            : start_library(library, timeout_s));
}

const OperationSizes* sizes_of(std::string_view operation) {
  const auto& all = all_sizes();
  const auto found = std::ranges::find(all, operation, &OperationSizes::operation);
  return found == all.end() ? nullptr : &*found;
}

bool is_operation(std::string_view name) {
  return sizes_of(name) || model_operation(name);
}

std::string no_operation(std::string_view name) {
  if (name == "quaternion_matrix")
    return "is now two operations: matrix_from_quaternion, and matrix_from_quaternion_any_norm, which "
           "normalises";
  return "is no operation; docs/operations.md lists them";
}

std::string register_adapter(const std::string& text, const std::string& name) {
  return register_as(text, name, text.starts_with(inside), [&] { return start(text); });
}
std::unique_ptr<Adapter> linked(const liecheck_adapter& adapter) {
  return as_called(linked_library(adapter));
}
void exchange_adapter(const std::string& name, const std::string& text) {
  const auto source =
      std::ranges::find_if(sources, [&](const auto& s) { return s && s->description.name == name; });
  if (source == sources.end()) throw std::invalid_argument(fmt::format("no adapter is named '{}'", name));
  const std::shared_ptr<Adapter> other = start(text);
  if (const Description& d = other->description();
      d.name != name || d.offered != (*source)->description.offered)
    throw AdapterFailed(
        fmt::format("'{}' is another adapter than {}, or offers other operations", text, name));
  (*source)->text = text, (*source)->in_process = text.starts_with(inside) ? other : nullptr;
  ++(*source)->changes;
}
std::string register_adapter(const liecheck_adapter& adapter) {
  return register_as(fmt::format("{}.so", adapter.name ? adapter.name : ""), "", true,
                     [&] { return linked(adapter); });
}

void withhold(const std::string& text, const std::vector<std::string>& operations) {
  const auto source = std::ranges::find_if(sources, [&](const auto& s) { return s && s->text == text; });
  if (source == sources.end()) throw std::invalid_argument(fmt::format("'{}' is no adapter here", text));
  Description& d = (*source)->description;
  std::erase_if(d.offered, [&](const auto& o) { return std::ranges::count(operations, o.first) > 0; });
  forget_subject(d.name);
  for (const Scalar* scalar : {&oracles::scalar_of<float>, &oracles::scalar_of<double>})
    register_one((*source)->number, text, d, *scalar);
}

bool can_be_timed(const std::string& text) {
  const Description* const d = description_of(text);
  return !library_in(text).empty() || (d && !d->timed.empty());
}
double timed_outside(const std::string& text, std::string_view how, const Batch& batch, std::size_t passes) {
  const auto source = std::ranges::find_if(sources, [&](const auto& s) { return s && s->text == text; });
  return adapter((*source)->number).timed(how, batch, passes);
}

const Description* description_of(const std::string& text) {
  for (const auto& source : sources)
    if (source && source->text == text) return &source->description;
  return nullptr;
}

}  // namespace liecheck::properties::adapters
