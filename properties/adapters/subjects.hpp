#pragma once
// Subjects whose functions are those of an adapter.

#include <adapters/adapter.hpp>
#include <string>

namespace liecheck::properties::adapters {

/// Starts an adapter. `text` is a command of the process protocol, the path of a shared library (*.so), which
/// runs in a process of its own, or "in-process:" and such a path. What it states of its conventions is converted.
/// Throws AdapterFailed.
std::unique_ptr<Adapter> start(const std::string& text);

/// What is wrong with the name of an adapter, which becomes a part of addresses and commands; or "".
std::string complaint_of_name(const std::string& name);

/// The path of the shared library that `text` names; "" if it is a command.
std::string library_in(const std::string& text);

/// Starts an adapter and registers its subject, in float and double as it offers them. Returns the name of the
/// subject, which is `name` or, if that is "", the adapter's own. Throws std::invalid_argument if the adapter does not start, if a subject has its name, if it offers
/// an operation that does not exist, or if most_adapters are registered.
std::string register_adapter(const std::string& text, const std::string& name = "");

/// An adapter that is linked into this program, with its stated conventions converted. Throws AdapterFailed.
std::unique_ptr<Adapter> linked(const liecheck_adapter& adapter);

/// Registers the subject of an adapter that is linked into this program, in the same way. Its cases replay with
/// --adapter NAME.so.
std::string register_adapter(const liecheck_adapter& adapter);

inline constexpr int most_adapters = 16;

/// The subject of this adapter has these operations no more. No series of it may have begun.
void withhold(const std::string& text, const std::vector<std::string>& operations);

/// Whether it is a shared library, or a program that times itself: the time of another one would be that of its pipe.
bool can_be_timed(const std::string& text);
/// Adapter::timed() of the adapter that was registered with this text.
double timed_outside(const std::string& text, std::string_view how, const Batch& batch, std::size_t passes);

/// What the adapter that was registered with this text says of itself; null if there is none.
const Description* description_of(const std::string& text);

}  // namespace liecheck::properties::adapters
