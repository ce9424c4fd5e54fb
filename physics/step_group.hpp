#pragma once
// One or several islands that an integrator advances together: what it needs, and what it has to say. Private
// to physics.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <pantin/physics/particles/particles_at.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

/// Islands that choose their own steps under the integrator that is common to all do so each by itself up to
/// this many, and all together beyond: at each evaluation of one the force laws are asked about all bodies.
inline constexpr std::size_t kMostSeparateIslands = 32;

/// An integrator for the island of a body.
struct BodyIntegrator {
  BodyId body{};
  std::unique_ptr<Integrator> integrator{};
};

struct StepGroup {
  std::vector<std::uint32_t> bodies{};  ///< positions, ascending
  bool has_particles{false};            ///< those that laws couple
  Integrator* integrator{nullptr};
  std::string reason{};

  /// Null where it is the only group: that goes by the dynamics of everything.
  std::unique_ptr<WorldPart> part{};
  std::unique_ptr<WorldDynamics> of_part{};
  WorldDynamics* dynamics{nullptr};

  // Of the last step.
  MotionRecord motion{};  ///< where it is kept, or events are looked for
  int evaluations{0}, accepted{0}, refused{0};
  double shortest{std::numeric_limits<double>::infinity()};  ///< accepted [s]
  double loop_margin{1};
  /// Adds the steps that its integrator has taken.
  void note(const StepControl& control) {
    accepted += control.accepted;
    refused += control.refused;
    if (control.accepted > 0) shortest = std::min(shortest, control.shortest);
  }
};

/// What the groups were made for; they are made anew when it has changed.
struct GroupsKey {
  std::uint64_t layout{0}, forces{0}, integrators{0}, integrator_of_particles{0};
  bool is_guarded{false};  ///< joints have stops or friction
  std::vector<ParticleSystemId> systems{};
};

}  // namespace pantin
