// A shared library whose poses are (p, Q).

#include "quaternion_poses.hpp"

namespace liecheck::test {
LIECHECK_ADAPTER(QuaternionPoses, log6, exp6, compose, inverse, act_point)
}
