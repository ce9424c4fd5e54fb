#pragma once
// A part of the world, laid out by itself: some free bodies and trees, numbered anew, with a kernel of their
// own. Private to physics.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <pantin/physics/constraints/articulated.hpp>
#include <pantin/physics/constraints/joint_loads.hpp>
#include <pantin/physics/constraints/loop_closer.hpp>
#include <pantin/physics/constraints/tree.hpp>
#include <pantin/physics/forces/force_law.hpp>

namespace pantin {

struct WorldPart {
  TreeLayout layout{};
  std::vector<std::uint32_t> trees{};   ///< where each of its trees stands in the layout of everything
  std::vector<const ForceLaw*> laws{};  ///< that may act on its bodies, in their order
  Articulated kernel{};
  LoopCloser loops{};
  JointLoads loads{};
};

/// The free bodies (by position) and trees (by number in `whole`) of a part, both ascending; no laws
/// and loads yet.
/// Bodies, joints and grounds keep their positions.
[[nodiscard]] std::unique_ptr<WorldPart> part_of(const TreeLayout& whole,
                                                 std::span<const std::uint32_t> free_bodies,
                                                 std::span<const std::uint32_t> trees);

}  // namespace pantin
