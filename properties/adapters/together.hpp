#pragma once
// Calls of an adapter in another process: those of all tasks that wait go to it in one batch.

#include <adapters/adapter.hpp>

namespace liecheck::properties::adapters {

/// Calls the adapter with one input, and returns and throws what Adapter::call() does. A task of run_together()
/// waits for the other ones (support/together.hpp). If the call of a batch fails, or leaves a misuse that holds for
/// the whole batch, each input is called alone, so that the outcome is that of the input that did it.
std::string call_together(Adapter& adapter, const Batch& one);

}  // namespace liecheck::properties::adapters
