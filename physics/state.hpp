#pragma once
// Everything that is integrated, as one copyable value: snapshot, rewind, comparison and hash come for free.
// It holds no settings: it fits the manager it was taken from, as long as bodies, joints and kinds stay the
// same.
#include <cstdint>
#include <vector>

#include <pantin/physics/integrators/integrator.hpp>
#include <pantin/physics/integrators/stability_watch.hpp>
#include <pantin/physics/particles/particle_state.hpp>
#include <pantin/physics/rigid_body.hpp>
#include <pantin/physics/stops/axis_mode.hpp>

namespace pantin {

/// Accumulators of one body: user forces and impulses, in W, about the centre of gravity.
struct BodyAccumulators {
  Vector3 force{Vector3::Zero()};           ///< [N]
  Vector3 torque{Vector3::Zero()};          ///< [N m]
  Vector3 force_impulse{Vector3::Zero()};   ///< [N s]
  Vector3 torque_impulse{Vector3::Zero()};  ///< [N m s]
};

struct State {
  std::uint64_t topology{0};    ///< which set of bodies, joints and kinds it fits
  double time{0};               ///< [s]
  double time_compensation{0};  ///< what rounding has kept back from `time` [s]
  std::uint64_t groups{0};      ///< what the next two belong to: which islands are stepped together, by what
  std::vector<StepMemory> memories{};  ///< of integrators that choose their own steps, by group of islands
  std::vector<StabilityMemory> stabilities{};  ///< where steps are watched, by group
  bool at_break{false};                        ///< the last step ended where a driven motion breaks
  std::vector<BodyState> bodies{};
  std::vector<BodyKinematics>
      kinematics{};                   ///< derived, kept so that a restored manager continues bit for bit
  std::vector<BodyState> previous{};  ///< before the last step
  std::vector<BodyAccumulators> accumulators{};
  bool loaded{false};                 ///< some accumulated force or torque is not zero
  bool struck{false};                 ///< some accumulated impulse is not zero
  std::vector<double> coordinates{};  ///< of all trees, in the order of the manager's layout
  std::vector<double> rates{};
  std::vector<double> cut_coordinates{};  ///< of joints that are cut to make trees of loops; 7 numbers each
  std::vector<std::uint8_t> edited{};     ///< per tree: velocities were set from outside since the last step
  std::vector<AxisMode> axis_modes{};     ///< of numbers with stops or friction, in the order of the layout
  std::vector<ParticleSystemState> particles{};
};

[[nodiscard]] bool operator==(const State& a, const State& b);
/// 64-bit FNV-1a over the bits of poses, momenta, particles and time.
[[nodiscard]] std::uint64_t hash(const State& state);

}  // namespace pantin
