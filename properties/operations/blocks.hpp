#pragma once
// The names of blocks, and the blocks that several operations share.

#include <operations/operation.hpp>

namespace liecheck::properties {

namespace block {
inline constexpr BlockName rotation{"rotation"}, norm_defect{"norm defect"},
    orthogonality_defect{"orthogonality defect"}, rotation_vector{"rotation vector"},
    translation{"translation"}, linear{"linear"}, angular{"angular"}, jacobian{"jacobian"},
    coupling{"coupling"}, jump{"jump"}, sign{"sign"}, point{"point"}, power{"power"}, energy{"energy"},
    mass{"mass"}, lever{"lever"}, inertia{"inertia"}, matrix{"matrix"}, rotation_rate{"rotation rate"},
    R_dot{"R_dot"}, translation_matrix{"translation matrix"}, quaternion_matrix{"quaternion matrix"},
    zeros{"zeros"}, continuous{"continuous"}, joint{"joint"}, same{"same"}, torque{"torque"},
    acceleration{"acceleration"}, by_q{"by q"}, by_v{"by v"};
}

namespace op {

inline constexpr Block rotation_of_quaternion{block::rotation, "2 min(|Q/|Q| - Q_exact|, |Q/|Q| + Q_exact|)",
                                              "absolute", "rad"};
inline constexpr Block norm_of_quaternion{block::norm_defect, "| |Q|^2 - 1 |", "absolute", "1"};
inline constexpr Block rotation_of_matrix{
    block::rotation, "angle from the exact rotation to the rotation nearest to R", "absolute", "rad"};
inline constexpr Block orthogonality_of_matrix{block::orthogonality_defect, "|R^T R - I|, Frobenius",
                                               "absolute", "1"};
inline constexpr Block rotation_vector{block::rotation_vector, "|phi - phi_exact|", "|phi_exact|", "rad"};

}  // namespace op
}  // namespace liecheck::properties
