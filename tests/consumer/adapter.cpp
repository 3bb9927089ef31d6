#include "adapter.hpp"

LIECHECK_ADAPTER(MyLib, exp3_quaternion, exp3_matrix, log3_quaternion, left_jacobian6, inverse)
