// All that a program needs of the library: poses, models, URDF, configurations and algorithms. Batches and scenes
// have headers of their own (liecheck/batch, liecheck/scene).
//
// Before C++20 only the assertion below is compiled, so that the compiler prints this line and not hundreds of others.
#pragma once

#if __cplusplus < 202002L
static_assert(__cplusplus >= 202002L,
              "liecheck needs C++20: compile with -std=c++20, or link liecheck::lib by CMake");
#else
#ifdef __GNUC__
// A program may ask for -Wconversion. The headers count with int, also where std::array has an unsigned index, and
// they construct a double word of float from small ints; both are exact.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#endif
#include "liecheck/algorithms/aba.hpp"
#include "liecheck/algorithms/centroidal.hpp"
#include "liecheck/algorithms/centroidal_derivatives.hpp"
#include "liecheck/algorithms/coriolis.hpp"
#include "liecheck/algorithms/crba.hpp"
#include "liecheck/algorithms/derivatives.hpp"
#include "liecheck/algorithms/energy.hpp"
#include "liecheck/algorithms/frames.hpp"
#include "liecheck/algorithms/jacobians.hpp"
#include "liecheck/algorithms/kinematics.hpp"
#include "liecheck/algorithms/kinematics_derivatives.hpp"
#include "liecheck/algorithms/operational_space.hpp"
#include "liecheck/algorithms/rnea.hpp"
#include "liecheck/multibody/coefficient_rate.hpp"
#include "liecheck/multibody/configuration.hpp"
#include "liecheck/multibody/data.hpp"
#include "liecheck/multibody/means.hpp"
#include "liecheck/multibody/model.hpp"
#include "liecheck/multibody/random_configuration.hpp"
#include "liecheck/multibody/se2.hpp"
#include "liecheck/multibody/se3_configuration.hpp"
#include "liecheck/spatial/checked_rotation.hpp"
#include "liecheck/spatial/euler.hpp"
#include "liecheck/spatial/exp_log.hpp"
#include "liecheck/spatial/extended_pose.hpp"
#include "liecheck/spatial/inertia.hpp"
#include "liecheck/spatial/jacobians.hpp"
#include "liecheck/spatial/preintegration.hpp"
#include "liecheck/spatial/relative_rotation.hpp"
#include "liecheck/spatial/representations.hpp"
#include "liecheck/spatial/se3.hpp"
#include "liecheck/spatial/so3.hpp"
#include "liecheck/spatial/transforms.hpp"
#include "liecheck/urdf/urdf.hpp"
#ifdef __GNUC__
#pragma GCC diagnostic pop
#endif
#endif
