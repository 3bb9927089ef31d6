#include <adapters/asked.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <conventions/probe.hpp>
#include <operations/argument_kinds.hpp>
#include <subjects/subject.hpp>

namespace liecheck::properties::adapters {
namespace {

/// The bits of a subject's kinds.
struct Bits {
  const ArgumentKinds& kinds;
  std::uint32_t Taken::*of;
};
constexpr Bits all_bits[] = {
    {order_kinds, &Taken::orders}, {fraction_kinds, &Taken::fractions}, {axis_kinds, &Taken::axes}};

/// Whether the adapter refuses the operation at all probes with an argument of the kind.
template <class S>
bool refuses(Adapter& adapter, const OperationSizes& o, const ArgumentKinds& kinds, std::size_t first,
             int kind) {
  auto probes = conventions::probe_arguments<S>(conventions::operation_named(o.operation));
  if (probes.size() > 6) probes.resize(1);  // one for each order already
  const std::vector<double> value = kinds.example(kind);
  return std::ranges::all_of(probes, [&](conventions::Numbers& probe) {
    std::ranges::copy(value, probe.begin() + static_cast<std::ptrdiff_t>(first));
    std::vector<S> inputs(probe.begin(), probe.end()), results(o.results);
    std::array<Status, 1> status{};
    adapter.call({o, sizeof(S) == 8, 1, std::as_bytes(std::span(inputs)),
                  std::as_writable_bytes(std::span(results)), status});
    return status[0] == Status::refused;
  });
}

/// The kinds that each operation takes. Empty if a call has no answer.
std::map<std::string, std::uint32_t> asked_for(Adapter& adapter, const ArgumentKinds& kinds) try {
  std::map<std::string, std::uint32_t> taken;
  for (const OperationSizes& o : operation_sizes())
    for (const Scalar* scalar : {&oracles::scalar_of<double>, &oracles::scalar_of<float>}) {
      std::size_t first = 0;
      if (argument_kinds(conventions::operation_named(o.operation), first) != &kinds ||
          !adapter.description().offered.contains({std::string(o.operation), std::string(scalar->name)}))
        continue;
      scalar->with([&]<class S>() {
        for (int k = 0; k < kinds.count; ++k)
          if (!refuses<S>(adapter, o, kinds, first, k)) taken[std::string(o.operation)] |= 1u << k;
      });
    }
  return taken;
} catch (const AdapterFailed&) {
  return {};
}

}  // namespace

void ask_for_kinds(Adapter& adapter, Taken& taken) {
  for (const Bits& b : all_bits) {
    const auto all = asked_for(adapter, b.kinds);
    std::uint32_t together = 0;
    for (const auto& [operation, bits] : all) together |= bits;
    for (const auto& [operation, bits] : all)
      if (bits != together) taken.of_operation[operation] = bits;
    taken.*b.of = together ? together : b.kinds.every();
  }
}

bool lacks_kinds(const Operation& operation, const Taken& taken) {
  std::size_t first = 0;
  const ArgumentKinds* const kinds = argument_kinds(operation, first);
  return taken.of_operation.contains(operation.name) || std::ranges::any_of(all_bits, [&](const Bits& b) {
           return kinds == &b.kinds && taken.*b.of != kinds->every();
         });
}

void check_kinds(const Operation& operation, const Taken& taken, std::span<const double> arguments) {
  std::size_t first = 0;
  const ArgumentKinds* const kinds = argument_kinds(operation, first);
  for (const Bits& b : all_bits) {
    if (kinds != &b.kinds) continue;
    const int kind = kinds->kind(arguments.subspan(first));
    const auto own = taken.of_operation.find(operation.name);
    if (kind >= 0 && !((own == taken.of_operation.end() ? taken.*b.of : own->second) >> kind & 1))
      throw CallFailed(fmt::format("the library refuses every {} of this kind", kinds->part), operation.name,
                       Outcome::outside_domain);
  }
}

std::vector<std::string> refusals(const Description& d) {
  std::vector<std::string> all;
  for (const Bits& b : all_bits) {
    // Hardly a library has every order of Euler angles, and nobody needs to be told that.
    if (d.taken.*b.of == b.kinds.every() || b.kinds.names.empty()) continue;
    std::vector<std::string_view> names;
    for (int k = 0; k < b.kinds.count; ++k)
      if (d.taken.*b.of >> k & 1) names.push_back(b.kinds.names[static_cast<std::size_t>(k)]);
    all.push_back(fmt::format("{} refuses every {} but {}: they are outside its domain", d.name, b.kinds.part,
                              fmt::join(names, ", ")));
  }
  if (!d.refused_references.empty())
    all.push_back(fmt::format("{} refuses what is seen in {}: it is outside its domain", d.name,
                              fmt::join(d.refused_references, ", ")));
  return all;
}

}  // namespace liecheck::properties::adapters
