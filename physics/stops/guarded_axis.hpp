#pragma once
// The numbers of joints that stops bound or dry friction brakes, as the solver's trees see them.
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <pantin/physics/constraints/tree.hpp>

namespace pantin {

struct GuardedAxis {
  std::uint32_t joint{0};     ///< position
  int axis{0};                ///< which of the joint's numbers
  std::uint32_t link{0};      ///< that the joint ties to its parent
  std::uint32_t q{0}, v{0};   ///< coordinate and rate, among those of all trees
  double sense{1};            ///< the joint's number is this times the coordinate
  double lower{0}, upper{0};  ///< of the coordinate [rad or m]
  double restitution{0};
  double friction{0};  ///< [N m or N]

  [[nodiscard]] bool has_friction() const noexcept { return friction > 0; }
};

/// Where one of a joint's numbers is in a link: which of the link's, and its sense.
struct AxisPlace {
  int number{0};
  double sense{1};
  bool known{true};  ///< false: of a joint seen from B this number is none of the link's alone
};
[[nodiscard]] AxisPlace place_of_axis(JointKind kind, int axis, bool reversed);

/// By link, so that those of a tree stand side by side. What acts on coupled numbers acts on the one that
/// leads them (coupled_axes.hpp).
[[nodiscard]] std::vector<GuardedAxis> guarded_axes(const TreeLayout& layout,
                                                    std::span<const JointDefinition* const> joints);

/// Joint positions and numbers that have stops or friction, move something, and are not among guarded_axes.
[[nodiscard]] std::vector<std::pair<std::uint32_t, int>> unguarded_axes(
    const TreeLayout& layout, std::span<const JointDefinition* const> joints);

}  // namespace pantin
