#pragma once
// A system of particles: many small masses that live in arrays, move under the forces of the world, are
// turned back by deflectors, and may be tied to each other. What changes a system is a verb of
// ParticleManager; this is what systems are made from, and the view for reading one.
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include <pantin/physics/ids.hpp>
#include <pantin/physics/particles/particle_state.hpp>
#include <pantin/physics/pose.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct ParticleSystemSettings {
  std::string name{};  ///< for messages; need not be unique
  double mass{1e-3};   ///< of a particle [kg], > 0
  double radius{0};    ///< by which it meets deflectors [m], >= 0; 0 = a point
  std::size_t capacity{
      10000};       ///< most particles at a time, >= 1; emitters stop there, and the report says so
  int substeps{4};  ///< of an update, where particles are tied to each other, 1 .. 1000
};
[[nodiscard]] std::optional<SettingsProblem> problem_with(const ParticleSystemSettings& settings);

/// A particle to be added by hand.
struct ParticleSettings {
  Vector3 p_WP{Vector3::Zero()};                             ///< [m]
  Vector3 v_WP{Vector3::Zero()};                             ///< [m/s]
  double mass{0};                                            ///< [kg], >= 0; 0 = the system's
  double lifetime{std::numeric_limits<double>::infinity()};  ///< from now [s], > 0
};
[[nodiscard]] std::optional<SettingsProblem> problem_with(const ParticleSettings& settings);

/// A view of one system, by position in its arrays (order of birth); valid until the next step or change.
class ParticleSystem {
 public:
  [[nodiscard]] ParticleSystemId id() const { return state_->id; }
  [[nodiscard]] const std::string& name() const { return settings_->name; }
  [[nodiscard]] const ParticleSystemSettings& settings() const { return *settings_; }
  [[nodiscard]] std::size_t size() const { return state_->size(); }

  /// Positions [m] and velocities [m/s] in W.
  [[nodiscard]] std::span<const double> x() const { return state_->now.x; }
  [[nodiscard]] std::span<const double> y() const { return state_->now.y; }
  [[nodiscard]] std::span<const double> z() const { return state_->now.z; }
  [[nodiscard]] std::span<const double> vx() const { return state_->now.vx; }
  [[nodiscard]] std::span<const double> vy() const { return state_->now.vy; }
  [[nodiscard]] std::span<const double> vz() const { return state_->now.vz; }

  [[nodiscard]] Vector3 p_WP(std::size_t i) const { return state_->now.position(i); }
  [[nodiscard]] Vector3 v_WP(std::size_t i) const { return state_->now.velocity(i); }
  [[nodiscard]] double mass(std::size_t i) const {
    return state_->mass.empty() ? settings_->mass : state_->mass[i];
  }
  /// When it dies [s]; infinity for one that does not.
  [[nodiscard]] double death(std::size_t i) const {
    return state_->death.empty() ? std::numeric_limits<double>::infinity() : state_->death[i];
  }
  [[nodiscard]] ParticleId id(std::size_t i) const { return {state_->id, state_->serial_of(i)}; }
  [[nodiscard]] bool contains(ParticleId id) const {
    return id.system == state_->id && state_->position_of(id.serial) < size();
  }
  /// Position of a particle that is there; size() for one that is not.
  [[nodiscard]] std::size_t position_of(ParticleId id) const {
    return id.system == state_->id ? state_->position_of(id.serial) : size();
  }
  /// Particles that are carried by a deflector they stick to.
  [[nodiscard]] std::span<const StuckParticle> stuck() const { return state_->stuck; }

 private:
  friend class ParticleManager;
  ParticleSystem(const ParticleSystemState& state, const ParticleSystemSettings& settings)
      : state_{&state}, settings_{&settings} {}
  const ParticleSystemState* state_;
  const ParticleSystemSettings* settings_;
};

}  // namespace pantin
