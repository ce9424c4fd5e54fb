#pragma once
// Stops and dry friction of joints whose numbers are coupled. Where q_b = ratio q_a + offset holds, b moves
// as a does, so that its stops and its friction are stops and friction of a: at (stop - offset) / ratio, and
// of |ratio| times the effort. Kept apart they would be two names of one thing, which no solver tells apart.
#include <array>
#include <span>
#include <vector>

#include <pantin/physics/constraints/tree.hpp>

namespace pantin {

/// What acts along the numbers of each joint, by position, with that of coupled numbers gathered at the one
/// that leads them all; a number that is led has nothing left. Stops of a number that is led and that would
/// leave its leader no room are dropped.
[[nodiscard]] std::vector<std::array<JointAxis, 3>> axes_by_leader(
    const TreeLayout& layout, std::span<const JointDefinition* const> joints);

}  // namespace pantin
