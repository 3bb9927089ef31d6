#include "long_double.hpp"

namespace liecheck {

LIECHECK_LONG_DOUBLE_ALGORITHMS()

}  // namespace liecheck
