#pragma once
// Which joints of closed loops are cut, so that what is left are trees. Everything that is not simulated
// counts as one with the world.
#include <cstdint>
#include <span>
#include <vector>

#include <pantin/physics/body_store.hpp>
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/tree.hpp>

namespace pantin {

struct SpanningTree {
  std::vector<std::uint8_t> is_cut{};     ///< by joint position
  std::vector<std::int32_t> mechanism{};  ///< by body position: number of its mechanism with loops or
                                          ///< couplings; -1 = none
  std::int32_t mechanisms{0};
  [[nodiscard]] bool has_loops() const noexcept { return mechanisms > 0; }
};

/// Rows by which a joint of this kind holds its bodies together: six less its rates.
[[nodiscard]] int row_count(JointKind kind) noexcept;

/// Cuts the joints with the fewest rows in all: a maximum spanning tree by rows. Among equals those that lie
/// farther from the ground are cut (from the floating root, where there is no ground), then those added
/// later. Coupled joints are cut only where a loop consists of them: a coupling needs the coordinates of its
/// joints.
[[nodiscard]] SpanningTree span_trees(const BodyStore& bodies, std::span<const JointDefinition* const> joints,
                                      std::span<const JointCoupling> couplings = {});

}  // namespace pantin
