#pragma once
// Owns the force laws and has one verb: gather their wrenches.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

/// Laws that are asked together, in the order in which they were added; by reference.
class LawList {
 public:
  explicit LawList(std::span<const ForceLaw* const> laws) : laws_{laws} {}

  /// Adds all laws' wrenches.
  void gather(const BodiesAt& at, std::span<Wrench> wrenches) const;
  /// Adds how all laws' wrenches change with the motion of bodies. False where one couples all bodies and
  /// does not say how.
  [[nodiscard]] bool gather_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const;
  /// The sum of all laws, where each gives the same acceleration to every body [m/s^2].
  [[nodiscard]] std::optional<Vector3> uniform_acceleration() const;
  [[nodiscard]] bool depends_on_velocity() const;

 private:
  std::span<const ForceLaw* const> laws_;
};

class ForceManager {
 public:
  /// Adds a law from its settings, e.g. add(Gravity{.g_W = {0, 0, -9.81}}). Settings with a problem_with
  /// break the contract.
  template <class Settings>
  ForceId add(const Settings& settings) {
    check(problem_with(settings));
    return add_law(make_law(settings));
  }
  /// Adds a law of any kind, the user's own included. Not null.
  ForceId add_law(std::unique_ptr<ForceLaw> law);
  void remove(ForceId id);  ///< must be alive
  /// Removes the laws that name this body; returns how many.
  std::size_t remove_laws_of(BodyId body);
  [[nodiscard]] bool contains(ForceId id) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return laws_.size(); }

  /// All laws, in the order in which they were added.
  [[nodiscard]] std::span<const ForceLaw* const> laws() const noexcept { return all_; }
  /// Changes with every law that is added or removed.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  void gather(const BodiesAt& at, std::span<Wrench> wrenches) const { LawList{all_}.gather(at, wrenches); }
  [[nodiscard]] bool depends_on_velocity() const { return LawList{all_}.depends_on_velocity(); }
  [[nodiscard]] double potential_energy(const BodiesAt& at) const;

  // Particles
  /// The strongest action of any law on a system: Coupled before Each before None.
  [[nodiscard]] ParticleAction action_on(ParticleSystemId system) const;
  /// Adds the forces of all laws that act on each particle by itself.
  void gather(const ParticlesAt& at, const ParticleForces& forces) const;
  [[nodiscard]] double particle_energy(const ParticlesAt& at) const;
  /// Adds the forces of all laws that couple particles.
  void gather(const BodiesAt& bodies, std::span<Wrench> wrenches,
              std::span<const CoupledParticles> systems) const;
  [[nodiscard]] double coupled_energy(const BodiesAt& bodies,
                                      std::span<const CoupledParticles> systems) const;

 private:
  struct Entry {
    ForceId id{};
    std::unique_ptr<ForceLaw> law{};
  };
  static void check(const std::optional<SettingsProblem>& problem);
  void list_anew();
  /// size() where there is no such law.
  [[nodiscard]] std::size_t position_of(ForceId id) const noexcept;

  std::vector<Entry> laws_{};
  std::vector<const ForceLaw*> all_{};  ///< the same
  std::uint64_t revision_{0};
  std::uint32_t next_{1};
};

}  // namespace pantin
