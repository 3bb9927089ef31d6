#include "mylib.hpp"

LIECHECK_ADAPTER(MyLib, exp3_quaternion, log3_quaternion, inverse)
