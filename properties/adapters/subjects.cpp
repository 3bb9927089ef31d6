#include <adapters/subjects.hpp>

#include <adapters/liecheck_adapter.h>
#include <fmt/format.h>
#include <adapters/adapter.hpp>
#include <adapters/converted.hpp>
#include <adapters/exchange.hpp>
#include <adapters/noise.hpp>
#include <adapters/shapes.hpp>
#include <adapters/sizes.hpp>
#include <adapters/together.hpp>
#include <adapters/trees.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <functional>
#include <invariants/property.hpp>
#include <memory>
#include <optional>
#include <subjects/remote.hpp>
#include <vector>

namespace liecheck::properties::adapters {
namespace {

constexpr double timeout_s = 5;  ///< of a call
constexpr std::string_view inside = "in-process:";

/// What was typed, and how to start it once more: every thread has an adapter of its own.
struct Source {
  std::string text;
  int number = 0;
  std::shared_ptr<Adapter> in_process;  ///< or null: a process for each thread
  Description description = {};
  unsigned changes = 0;  ///< how often exchange_adapter() put another one in its place
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
  if (!own.adapter || own.changes != source.changes)
    own = {source.in_process ? source.in_process : start(source.text), source.changes};
  return *own.adapter;
}

bool in_process(int number) {
  return sources[static_cast<std::size_t>(number)]->in_process != nullptr;
}

/// Calls an operation of the adapter of this thread with consecutive numbers, floats or doubles. Throws CallFailed.
void call_numbers(int number, const OperationSizes& sizes, bool is_double, std::span<const std::byte> inputs,
                  std::span<std::byte> results) {
  std::array<Status, 1> status{};
  std::string why;
  try {
    const Batch one{sizes, is_double, 1, inputs, results, status};
    why = in_process(number) ? adapter(number).call(one) : call_together(adapter(number), one);
  } catch (const AdapterFailed& e) {
    throw CallFailed(e.what(), sizes.operation, Outcome::crashed);
  }
  if (status[0] == Status::done) return;
  if (status[0] == Status::not_repeatable)
    say_not_repeatable(adapter(number).description().name, sizes.operation, why);
  throw CallFailed(in_words(status[0], why), sizes.operation, outcome_of(status[0]));
}

/// Its own function for each adapter, operation and scalar, since a slot is a plain pointer; so it is short.
template <int number, const auto& operation, class S, class R, class... A>
R call(A... arguments) {
  static const OperationSizes& sizes = *sizes_of(operation.name);
  std::array<S, (Shape<std::remove_cvref_t<A>>::size + ...)> inputs;
  std::array<S, Shape<R>::size> results;
  S* at = inputs.data();
  ((Shape<std::remove_cvref_t<A>>::put(arguments, at), at += Shape<std::remove_cvref_t<A>>::size), ...);
  call_numbers(number, sizes, sizeof(S) == 8, std::as_bytes(std::span(inputs)),
               std::as_writable_bytes(std::span(results)));
  return Shape<R>::get(results.data());
}

template <int number, class S>
RobotOperations<S> robot(const std::string& urdf, bool fixed) {
  return robot_operations<S>(urdf, fixed, []() -> Adapter& { return adapter(number); });
}

template <int number, class S, const auto& operation, class R, class... A>
void fill(R (*&slot)(A...), const Description& d) {
  if (d.offered.contains({std::string(operation.name), std::string(oracles::scalar_of<S>.name)}))
    slot = &call<number, operation, S, R, A...>;
}
template <int number, class S, const auto&... all>
void fill_all(Slots<S, all...>& slots, const Description& d) {
  (fill<number, S, all>(slots[all], d), ...);
}
/// A library's own check of a quaternion or a rotation.
template <int number, class S, class T>
void fill_check(std::function<void(const T&)>& slot, const char* name, const Description& d) {
  if (!d.offered.contains({name, std::string(oracles::scalar_of<S>.name)})) return;
  slot = [&sizes = *sizes_of(name)](const T& x) {
    std::array<S, Shape<T>::size> numbers;
    Shape<T>::put(x, numbers.data());
    call_numbers(number, sizes, sizeof(S) == 8, std::as_bytes(std::span(numbers)), {});
  };
}
template <int number, class S>
void fill_operations(TypedOperations<S>& o, const Description& d) {
  fill_all<number, S>(static_cast<SpatialSlots<S>&>(o), d);
  fill_check<number, S>(o.check_quaternion, "check_quaternion", d);
  fill_check<number, S>(o.check_rotation, "check_rotation", d);
  if (offers_trees(d, std::string(oracles::scalar_of<S>.name)))
    o.tree = [d](const Tree<S>& tree) {
      return tree_operations(tree, d, []() -> Adapter& { return adapter(number); });
    };
  if (offers_robots(d, std::string(oracles::scalar_of<S>.name))) o.robot = &robot<number, S>;
}

template <class S, int... numbers>
void register_one(int wanted, const std::string& text, const Description& d,
                  std::integer_sequence<int, numbers...>) {
  TypedSubject<S> s{d.name, d.version, {}, text};
  ((wanted == numbers ? fill_operations<numbers, S>(s.operations, d) : void()), ...);
  const bool any = std::ranges::any_of(
      d.offered, [](auto& o) { return o.second == std::string(oracles::scalar_of<S>.name); });
  if (any) Registered<S>(std::move(s));
}

template <class S, class R, class... A>
OperationSizes sizes_in(const Operation& o, R (*)(A...)) {
  return {o.name, (Shape<std::remove_cvref_t<A>>::size + ...), Shape<R>::size};
}
template <class S, const auto&... all>
std::vector<OperationSizes> sizes_with_checks(const Slots<S, all...>& slots) {
  return {sizes_in<S>(all, slots[all])..., {"check_quaternion", 4, 0}, {"check_rotation", 9, 0}};
}

std::unique_ptr<Adapter> converted(std::unique_ptr<Adapter> own) {
  const conventions::Statements stated = own->description().conventions;
  if (stated.empty()) return own;
  return std::make_unique<Converted>(std::move(own), stated);
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
    d = first->description();
    if (!name.empty()) d.name = name;
    if (in_process) source.in_process = first;
  } catch (const AdapterFailed& e) {
    refuse(e.what());
  }
  if (d.name.empty() ||
      !std::ranges::all_of(d.name, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; }))
    refuse(fmt::format("its name '{}' must have letters, digits, '_' and '-' only", d.name));
  for (const auto& [operation, scalar] : d.offered)
    if (!is_operation(operation))
      refuse(fmt::format("it offers '{}', which is no operation; docs/operations.md lists them", operation));
  if (d.offered.empty()) refuse("it offers no operation");
  for (const auto* s : typed_subjects<double>())
    if (s->name == d.name) refuse(fmt::format("a subject is named '{}' already", d.name));
  source.description = d;
  *free = source;
  if (!in_process) remote_subjects().insert(d.name);
  constexpr auto numbers = std::make_integer_sequence<int, most_adapters>();
  register_one<float>(source.number, text, d, numbers);
  register_one<double>(source.number, text, d, numbers);
  return d.name;
}

}  // namespace

const std::vector<OperationSizes>& all_sizes() {
  static const std::vector<OperationSizes> all = sizes_with_checks(SpatialSlots<double>());
  return all;
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
  return converted(text.starts_with(inside) ? load_library(library)
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

std::string register_adapter(const std::string& text, const std::string& name) {
  return register_as(text, name, text.starts_with(inside), [&] { return start(text); });
}
std::unique_ptr<Adapter> linked(const liecheck_adapter& adapter) {
  return converted(linked_library(adapter));
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

const Description* description_of(const std::string& text) {
  for (const auto& source : sources)
    if (source && source->text == text) return &source->description;
  return nullptr;
}

}  // namespace liecheck::properties::adapters
