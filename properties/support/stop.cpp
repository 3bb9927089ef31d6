#include <support/stop.hpp>

namespace liecheck::properties {

std::atomic<bool> stop_requested{false};

}  // namespace liecheck::properties
