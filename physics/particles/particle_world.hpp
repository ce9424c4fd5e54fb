#pragma once
// What a ParticleManager consists of, and the parts of an update. Private to physics.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <pantin/physics/particles/coupled_dynamics.hpp>
#include <pantin/physics/particles/particle_block.hpp>
#include <pantin/physics/particles/particle_manager.hpp>
#include <pantin/physics/particles/tied_particles.hpp>

namespace pantin {

struct Emitter {
  EmitterId id{};
  EmitterSettings settings{};
};

/// A birth that falls due in this update.
struct DueBirth {
  double time{0}, death{0};
};

/// A particle that begins to stick in this update.
struct NewlyStuck {
  std::size_t position{0};
  DeflectorId deflector{};
  Vector3 p_DP{Vector3::Zero()};
  Vector3 p_free{Vector3::Zero()},
      v_free{Vector3::Zero()};  ///< how it would end, were it let go after the contact
};

/// Constants and work space of one system; its state is in State, at the same position.
struct SystemData {
  ParticleSystemSettings settings{};
  std::vector<Emitter> emitters{};
  std::vector<Tie> ties{};
  std::vector<Pin> pins{};  ///< by serial
  TiedParticles tied{};
  bool rows_are_stale{true};
  std::uint64_t rows_of_population{0};  ///< for which `tied` was built

  ParticleArrays next{};        ///< where an update arrives; becomes the state when all went well
  std::vector<DueBirth> due{};  ///< at the end of `next`
  std::vector<EmitterState> emitters_next{};
  std::vector<NewlyStuck> newly_stuck{};
  std::vector<std::size_t> skip{};  ///< positions of stuck particles, ascending
  Energy energy{};
  // Tied systems
  std::vector<Vector3> q0{}, q1{}, v{}, force{};
  std::vector<double> inverse_mass{};
  std::vector<std::size_t> pinned{};  ///< positions of the pins' particles; size of the system where gone

  [[nodiscard]] bool is_tied() const { return !ties.empty() || !pins.empty(); }
};

struct ParticleManager::Impl {
  Impl(BodyStore& b, ForceManager& f, DeflectorManager& d)
      : bodies{b}, forces{f}, deflectors{d}, block{f}, sweep{d}, coupled{b, f} {}

  BodyStore& bodies;
  ForceManager& forces;
  DeflectorManager& deflectors;
  ParticleBlock block;
  Sweep sweep;
  CoupledDynamics coupled;
  std::vector<SystemData> systems{};
  std::vector<BodyKinematics> before{};
  std::unique_ptr<Integrator> integrator{};
  bool integrator_is_given{false};
  std::uint64_t integrator_revision{0};
  std::vector<std::size_t> skip_in_batch{};
  ParticleReport report{};
  ParticleId not_finite{};
  std::uint32_t next_system{1}, next_emitter{1}, next_tie{1};
  // Work space of tied systems
  std::vector<double> soa{}, masses{};  ///< six arrays, and three of forces
  std::vector<Vector3> kicked{};
  ParticleArrays begin_arrays{};
  std::vector<Wrench> wrenches{};
  std::vector<CoupledParticles> views{};

  [[nodiscard]] ParticleSystemState& state(std::size_t k) { return bodies.state.particles[k]; }

  // The parts of an update (particle_step.cpp, births.cpp, tied_step.cpp).
  [[nodiscard]] bool advance(std::size_t k, double t, double h);
  /// For births of this update.
  [[nodiscard]] std::size_t room_in(std::size_t k) {
    return systems[k].settings.capacity - state(k).size() - systems[k].due.size();
  }
  void plan_births(std::size_t k, double t, double h);
  [[nodiscard]] bool move_batch(std::size_t k, std::size_t first, std::size_t n, double t, double h,
                                double s0);
  void carry_stuck(std::size_t k);
  void commit(std::size_t k, double t_end);
  void remove_dead(std::size_t k, double t_end);
  void list_skipped(std::size_t k);
  [[nodiscard]] DeflectorMotion motion_of(BodyId body, double h) const;
  void prepare_ties(std::size_t k);
  [[nodiscard]] bool advance_tied(std::size_t k, double t, double h);
  void place_pins(std::size_t k, double fraction, double h);
  void find_forces(std::size_t k, double t, std::span<const Vector3> q, double weight);
  void predict(std::size_t k, double half);
  [[nodiscard]] bool sweep_tied(std::size_t k, double s0, double s1, double h);
  void feel_pins(std::size_t k);
  [[nodiscard]] CoupledParticles view_of(std::size_t k, double t, std::span<double> arrays);
  [[nodiscard]] double coupled_energy();
};

}  // namespace pantin
