#pragma once
// What a step has to say: values, never callbacks.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pantin/physics/ids.hpp>

namespace pantin {

struct Energy {
  double kinetic{0};    ///< of all simulated bodies, and of rotors on their joints [J]
  double potential{0};  ///< of the laws that have one, and of springs on joints [J]
  [[nodiscard]] double total() const { return kinetic + potential; }
};

struct JointDrift {
  double distance{0};  ///< [m]
  double angle{0};     ///< [rad]
};

/// All particle systems in one step.
struct ParticleReport {
  std::size_t count{0};          ///< alive at the end
  std::uint64_t born{0};         ///< from emitters
  std::uint64_t died{0};         ///< of age
  std::uint64_t dropped{0};      ///< births that found no room: raise the capacity
  std::uint64_t deflections{0};  ///< contacts with deflectors; of one: DeflectorManager::hits
  std::uint64_t pushed_out{0};   ///< found inside a deflector and put on its surface
  std::uint64_t stuck{0};        ///< began to stick to a deflector
  std::uint64_t unresolved{0};   ///< met more surfaces in the step than are followed (Sweep::kMostContacts)
  Energy energy{};               ///< of the particles alone [J]
  int evaluations{0};            ///< of the derivatives of batches of particles
  int inner_steps{0};            ///< that an adaptive integrator took for them, all batches together
  int constraint_iterations{0};  ///< most that a solve of ties took; 0 = none
  double constraint_error{0};    ///< greatest |length / rest - 1| of ties without compliance
  bool converged{true};          ///< whether every solve of ties reached its tolerance
};

enum class StepStatus {
  Done,
  NotFinite,  ///< a number overflowed or became NaN; the state before the step is kept
  LoopOpen,   ///< a loop of joints cannot be closed, or a coupling not be met; the state before the step is
              ///< kept
};

/// Motion that decays or swings faster than the integrator bears at the step asked for.
struct FastMotion {
  double rate{0};          ///< [1/s]; 0 = nothing was too fast, or steps are not watched
  int parts{1};            ///< into which updates were cut for it
  bool implicitly{false};  ///< too many: taken whole, by the implicit midpoint rule
  BodyId body{};    ///< what takes the greatest part in it: a body without joints, or the root of a tree
  JointId joint{};  ///< or a joint; both null where particles do
};

struct StepReport {
  StepStatus status{StepStatus::Done};
  double time{0};           ///< reached [s]
  int updates{0};           ///< parts the step was cut into, at breaks of driven motions
  int evaluations{0};       ///< of the derivative
  int inner_steps{0};       ///< that an adaptive integrator took inside; 0 of others
  int refused_steps{0};     ///< that it took back for missing its tolerance
  double shortest_step{0};  ///< that it accepted [s]
  /// How near closed loops came to a singular position, as where bars are in line, at any evaluation: about
  /// the square of the angle that is left; 1 = far away, or no loops.
  double loop_margin{1};
  FastMotion fast{};
  std::size_t moved{0};  ///< bodies with a changed pose
  Energy energy{};       ///< of bodies, at the end
  int joint_events{0};   ///< PhysicsManager::joint_events says which
  /// Parts of the step in which events at stops and in dry friction crowded, so that its rest was advanced by
  /// short steps of first order (guarded_step.cpp).
  int crowded{0};
  std::vector<JointId> broken{};  ///< joints that bore more than their strength and are gone
  ParticleReport particles{};
  BodyId body{};          ///< culprit of a failed step, if it is one body
  ParticleId particle{};  ///< the same, if it is a particle
  std::string message{};  ///< of a failed step: what happened, where, what to do

  [[nodiscard]] bool ok() const noexcept { return status == StepStatus::Done; }
};

}  // namespace pantin
