#pragma once
// Gives the islands of a problem the solvers chosen for them. Private to the problems.
#include <string>
#include <vector>

#include <pantin/bridge/problems/rigid_ref.hpp>
#include <pantin/bridge/problems/solve.hpp>

namespace pantin {

/// Sets the integrators of `physics`, in which the problem was built, and writes back to `islands` what runs.
/// Particles that no body is coupled with have one integrator for all: where motion of any of them decays
/// fast, that which suits it.
void set_integrators(const ReferenceInstance& built, const SolveSettings& settings,
                     std::vector<IslandChoice>& islands, PhysicsManager& physics);

/// The names of all solvers, each once, in the order of the islands; that of `auto` where there is no island.
[[nodiscard]] std::string names_of_solvers(const std::vector<IslandChoice>& islands);

}  // namespace pantin
