#pragma once
// A force given by functions of the user, for what is not worth a class (ForceLaw). They are called at every
// stage of the integrator and must depend on their arguments and constants only.
#include <functional>
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

/// A particle at one instant.
struct ParticleAt {
  double t{0};                    ///< [s]
  Vector3 p_WP{Vector3::Zero()};  ///< [m]
  Vector3 v_WP{Vector3::Zero()};  ///< [m/s]
  double mass{0};                 ///< [kg]
};

struct ForceFunction {
  /// Wrench on body i of the arrays, about its centre of gravity, in W.
  std::function<Wrench(const BodiesAt& at, std::size_t i)> on_body{};
  std::function<Vector3(const ParticleAt& particle)> on_particle{};  ///< force, in W [N]
  /// Potential energy of body i and of a particle [J]; none = the force has none.
  std::function<double(const BodiesAt& at, std::size_t i)> body_energy{};
  std::function<double(const ParticleAt& particle)> particle_energy{};
  bool depends_on_velocity{true};  ///< saying false where it does costs verlet its order
  bool couples_bodies{true};       ///< whether on_body looks at bodies other than i (Coupling)
  BodyId body{};                   ///< null, and no system = every simulated body and particle
  ParticleSystemId particles{};    ///< the particles of this system only
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const ForceFunction& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const ForceFunction& settings);

}  // namespace pantin
