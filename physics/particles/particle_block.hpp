#pragma once
// A batch of particles of one system in a small work space that stays in the nearest cache: loaded from the
// system's arrays, advanced by an integrator, swept past the deflectors, stored. Private to physics.
#include <cstdint>
#include <span>
#include <vector>

#include <pantin/physics/deflectors/sweep.hpp>
#include <pantin/physics/forces/force_manager.hpp>
#include <pantin/physics/integrators/integrator.hpp>
#include <pantin/physics/particle_system.hpp>
#include <pantin/physics/step_report.hpp>

namespace pantin {

class ParticleBlock final : public Dynamics {
 public:
  static constexpr std::size_t kMost = 256;

  explicit ParticleBlock(const ForceManager& forces);

  /// Takes n <= kMost particles; masses are the system's where `masses` is empty.
  void load(ParticleSystemId system, const ParticleArrays& from, std::size_t first, std::size_t n,
            std::span<const double> masses, double mass);
  void integrate(Integrator& integrator, double t, double h);
  /// Instead of integrating: where somebody else has brought them, from position `first` of these arrays.
  void arrive(const ParticleArrays& at, std::size_t first);
  /// Position of the first particle that is not finite; size() if all are.
  [[nodiscard]] std::size_t first_not_finite() const;
  /// Sweeps what may meet a deflector from fraction s0 of the update of h [s] to its end. Positions in `skip`
  /// are left alone; `sticks(i, deflector, p_W)` hears of those that stick from now on.
  template <class Sticks>
  void sweep(Sweep& sweep, double s0, double h, double radius, std::span<const std::size_t> skip,
             const Sticks& sticks) {
    find_near(sweep, s0, h, radius, skip);
    for (const std::size_t i : near_) {
      MovingParticle particle = particle_at(i, s0, h, radius);
      const std::uint64_t before = sweep.counts.deflections;
      Deflector* const stuck = sweep.carry(particle);
      if (stuck != nullptr) sticks(i, *stuck, particle);
      if (sweep.counts.deflections == before) continue;
      put(i, particle.end_position(), particle.end_velocity());
    }
  }
  void store(ParticleArrays& to, std::size_t first) const;
  [[nodiscard]] std::size_t size() const noexcept { return n_; }
  [[nodiscard]] Energy energy(double t) const;

  [[nodiscard]] std::size_t coordinates() const override { return 3 * n_; }
  [[nodiscard]] std::size_t velocities() const override { return 3 * n_; }
  void rate(Instant at, std::span<const double> q, std::span<const double> v,
            std::span<double> q_dot) override;
  void acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                    std::span<double> v_dot) override;
  void list_groups(NumberGroups& groups) override;  ///< every particle by itself
  [[nodiscard]] bool acceleration_depends_on_velocity() const override {
    return forces_.depends_on_velocity();
  }

  int evaluations{0};  ///< of v' since it was last set to 0

 private:
  void find_near(Sweep& sweep, double s0, double h, double radius, std::span<const std::size_t> skip);
  [[nodiscard]] MovingParticle particle_at(std::size_t i, double s0, double h, double radius) const;
  void put(std::size_t i, const Vector3& p, const Vector3& v);
  [[nodiscard]] ParticlesAt view(Instant at, std::span<const double> q, std::span<const double> v) const;

  const ForceManager& forces_;
  ParticleSystemId system_{};
  std::size_t n_{0};
  std::vector<double> p0_, v0_, q_, v_;  // x of all, y of all, z of all
  std::vector<double> mass_, inverse_mass_, inverse_length2_, margin_, gap_, scratch_;
  std::vector<std::size_t> near_{};
};

}  // namespace pantin
