#pragma once
// Bodies and the particles that forces couple with them, as one system of equations: the integrator of the
// bodies advances both, each at its order. Coordinates: those of the bodies, then x, y, z of each system;
// velocities likewise. Private to physics.
#include <span>
#include <vector>

#include <pantin/physics/particles/particle_state.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

class CoupledDynamics final : public Dynamics, public WrenchSource {
 public:
  CoupledDynamics(BodyStore& bodies, ForceManager& forces) : bodies_{bodies}, forces_{forces} {}

  /// Finds the systems under laws that couple, with each other and with the bodies of `world`; `takes(k)`
  /// says which may be integrated so. False where there are none.
  template <class Takes, class MassOf>
  bool begin(WorldDynamics& world, const Takes& takes, const MassOf& mass_of) {
    world_ = &world;
    members_.clear();
    if (!world_is_coupled()) return false;
    for (std::size_t k = 0; k < bodies_.state.particles.size(); ++k) {
      if (takes(k) && forces_.action_on(bodies_.state.particles[k].id) == ParticleAction::Coupled) {
        add_member(k, mass_of(k));
      }
    }
    return !members_.empty();
  }
  [[nodiscard]] bool has(std::size_t system) const;
  /// The coordinates and velocities at the begin, the bodies' among them.
  [[nodiscard]] std::span<double> coordinates_now();
  [[nodiscard]] std::span<double> velocities_now();
  /// Gives the bodies' part back to their dynamics, and is no longer asked for wrenches.
  void end();
  /// Where a system has arrived.
  void read(std::size_t system, ParticleArrays& out) const;

  [[nodiscard]] std::size_t coordinates() const override { return q_.size(); }
  [[nodiscard]] std::size_t velocities() const override { return v_.size(); }
  void rate(Instant at, std::span<const double> q, std::span<const double> v,
            std::span<double> q_dot) override;
  void acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                    std::span<double> v_dot) override;
  void derivative(Instant at, std::span<const double> q, std::span<const double> v, std::span<double> q_dot,
                  std::span<double> v_dot) override;
  void settle(Instant at, std::span<double> q, std::span<double> v) override {
    world_->settle(at, q.first(world_->coordinates()), v.first(world_->velocities()));
  }
  [[nodiscard]] bool has_constraints() const override { return world_->has_constraints(); }
  [[nodiscard]] double motion_error(std::span<const double> q, std::span<const double> v,
                                    std::span<const double> q_error, std::span<const double> v_error,
                                    double h) override;
  [[nodiscard]] bool acceleration_depends_on_velocity() const override {
    return world_->acceleration_depends_on_velocity();
  }
  void add_wrenches(const BodiesAt& bodies, std::span<Wrench> wrenches) override;

 private:
  struct Member {
    std::size_t system{0}, begin{0}, size{0};  ///< in the arrays of all members
  };
  void add_member(std::size_t system, double mass);
  [[nodiscard]] bool world_is_coupled() const {
    return forces_.size() > 0 && !bodies_.state.particles.empty();
  }
  void look_at(std::span<const double> q, std::span<const double> v);

  BodyStore& bodies_;
  ForceManager& forces_;
  WorldDynamics* world_{nullptr};
  std::vector<Member> members_{};
  std::vector<CoupledParticles> views_{};
  std::vector<double> q_{}, v_{}, force_{}, mass_{};
};

}  // namespace pantin
