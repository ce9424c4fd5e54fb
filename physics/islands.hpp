#pragma once
// Which simulated bodies move on their own: sets that joints and force laws couple. The world, static and
// animated bodies couple nothing. Private to physics.
#include <cstdint>
#include <vector>

#include <pantin/physics/body_store.hpp>
#include <pantin/physics/constraints/tree.hpp>
#include <pantin/physics/forces/force_manager.hpp>

namespace pantin {

struct Island {
  std::vector<std::uint32_t> bodies{};  ///< positions, ascending
  bool is_plain{false};                 ///< one free body that no law names
  bool has_particles{false};            ///< all those that laws couple, and these bodies with them
};

/// In the order of their first bodies; coupled particles without bodies come last.
[[nodiscard]] std::vector<Island> find_islands(const BodyStore& bodies, const TreeLayout& layout,
                                               const ForceManager& forces);

}  // namespace pantin
