#pragma once
// Another build of a registered adapter.

#include <string>

namespace liecheck::properties::adapters {

/// Calls of the registered adapter `name` go to another build of it from now on; `text` is as for start(). No thread may
/// call it meanwhile. Throws AdapterFailed if it does not start, or is another adapter.
void exchange_adapter(const std::string& name, const std::string& text);

}  // namespace liecheck::properties::adapters
