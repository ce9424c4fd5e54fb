#pragma once
// What is integrated together, and how it went: values for the user.
#include <string>
#include <vector>

#include <pantin/physics/ids.hpp>

namespace pantin {

/// One or several islands that are integrated together. An island are simulated bodies, and particles, that
/// joints or force laws couple (ForceLaw::coupling).
struct IslandGroup {
  std::vector<BodyId> bodies{};  ///< in the order of PhysicsManager::bodies()
  bool has_particles{false};     ///< those that laws couple, with these bodies or with each other
  std::string integrator{};      ///< its name
  std::string reason{};          ///< why it is stepped by this integrator, alone or with others, in words
  // Of the last step, as in StepReport; 0 where the groups have changed since.
  int evaluations{0};
  int inner_steps{0};
  int refused_steps{0};
  double shortest_step{0};  ///< [s]
};

}  // namespace pantin
