#include <pantin/physics/forces/central_attraction.hpp>

#include <cmath>

#include <pantin/physics/forces/force_target.hpp>
#include <pantin/physics/forces/wrench_derivatives.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class CentralAttractionLaw final : public ForceLaw {
 public:
  explicit CentralAttractionLaw(const CentralAttraction& settings)
      : settings_{settings}, target_{settings.body, settings.particles} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    if (target_.particles) return;
    const Vector3 p_WC = centre(at);
    Vector3 reaction = Vector3::Zero();
    target_.for_each_simulated(at, [&](std::size_t i) {
      if (is_centre(at, i)) return;
      const Vector3 force = at.mass[i].mass * acceleration(at.kinematics[i].p_WBcm - p_WC);
      wrenches[i].force += force;
      reaction -= force;
    });
    react(at, p_WC, reaction, wrenches);
  }

  double potential_energy(const BodiesAt& at) const override {
    if (target_.particles) return 0;
    const Vector3 p_WC = centre(at);
    double sum = 0;
    target_.for_each_simulated(at, [&](std::size_t i) {
      if (!is_centre(at, i)) sum += at.mass[i].mass * potential(at.kinematics[i].p_WBcm - p_WC);
    });
    return sum;
  }

  bool add_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const override {
    if (target_.particles) return true;
    const Vector3 p_WC = centre(at);
    target_.for_each_simulated(at, [&](std::size_t i) {
      if (is_centre(at, i)) return;
      const double m = at.mass[i].mass;
      const Vector3 r = at.kinematics[i].p_WBcm - p_WC;
      derivatives.add_pair(at, i, settings_.centre,
                           {.force_a = m * acceleration(r), .by_distance = -m * gradient(r)});
    });
    return true;
  }

  bool names(BodyId body) const override {
    return target_.names(body) || (body && body == settings_.centre.body);
  }
  /// The centre feels all that it pulls, and they feel where it is.
  Coupling coupling() const override {
    Coupling coupling = target_.coupling();
    if (!settings_.centre.body) return coupling;
    if (target_.is_all()) coupling.reach = Coupling::Reach::All;
    coupling.bodies.push_back(settings_.centre.body);
    return coupling;
  }

  ParticleAction acts_on(ParticleSystemId system) const override {
    if (!target_.includes(system)) return ParticleAction::None;
    return settings_.centre.body ? ParticleAction::Coupled : ParticleAction::Each;
  }

  void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
    static_cast<void>(attract(at, settings_.centre.p_BQ, forces));
  }
  double particle_energy(const ParticlesAt& at) const override {
    return energy_of(at, settings_.centre.p_BQ);
  }

  void add_coupled_forces(const BodiesAt& bodies, std::span<Wrench> wrenches,
                          std::span<const CoupledParticles> systems) const override {
    if (!settings_.centre.body) return;
    const Vector3 p_WC = centre(bodies);
    for (const CoupledParticles& system : systems) {
      if (!target_.includes(system.at.system)) continue;
      react(bodies, p_WC, -attract(system.at, p_WC, system.force), wrenches);
    }
  }
  double coupled_energy(const BodiesAt& bodies, std::span<const CoupledParticles> systems) const override {
    if (!settings_.centre.body) return 0;
    double sum = 0;
    for (const CoupledParticles& system : systems) {
      if (target_.includes(system.at.system)) sum += energy_of(system.at, centre(bodies));
    }
    return sum;
  }

 private:
  [[nodiscard]] Vector3 centre(const BodiesAt& at) const { return point_at(at, settings_.centre).p_WQ; }
  [[nodiscard]] bool is_centre(const BodiesAt& at, std::size_t i) const {
    return settings_.centre.body && i == at.index(settings_.centre.body);
  }
  void react(const BodiesAt& at, const Vector3& p_WC, const Vector3& force,
             std::span<Wrench> wrenches) const {
    if (settings_.centre.body) add_force_at(at, at.index(settings_.centre.body), p_WC, force, wrenches);
  }
  /// sqrt(r^2 + s^2) without overflow or underflow.
  [[nodiscard]] double distance(const Vector3& r) const {
    return std::hypot(r.stableNorm(), settings_.softening);
  }
  [[nodiscard]] Vector3 acceleration(const Vector3& r) const {
    const double d = distance(r);
    if (d == 0) return Vector3::Zero();
    return -(settings_.mu / (d * d)) * (r / d);
  }
  /// Of the acceleration, by r.
  [[nodiscard]] Matrix3 gradient(const Vector3& r) const {
    const double d = distance(r);
    if (d == 0) return Matrix3::Zero();
    const Vector3 n = r / d;
    return -(settings_.mu / (d * d)) / d * (Matrix3::Identity() - 3 * n * n.transpose());
  }
  [[nodiscard]] double potential(const Vector3& r) const {
    const double d = distance(r);
    return d == 0 ? 0 : -settings_.mu / d;
  }

  /// Adds the forces on a batch; returns their sum.
  Vector3 attract(const ParticlesAt& at, const Vector3& p_WC, const ParticleForces& forces) const {
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Vector3 force = at.mass[i] * acceleration(at.p_WP(i) - p_WC);
      forces.add(i, force);
      sum += force;
    }
    return sum;
  }
  [[nodiscard]] double energy_of(const ParticlesAt& at, const Vector3& p_WC) const {
    double sum = 0;
    for (std::size_t i = 0; i < at.size(); ++i) sum += at.mass[i] * potential(at.p_WP(i) - p_WC);
    return sum;
  }

  CentralAttraction settings_;
  ForceTarget target_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const CentralAttraction& settings) {
  if (settings.body && settings.body == settings.centre.body) {
    return SettingsProblem{ProblemCode::OutOfRange, "central attraction: the centre's own body is attracted",
                           "name another body"};
  }
  return first_problem({target_problem("central attraction", settings.body, settings.particles),
                        must_be_finite({"central attraction", "centre", "m"}, settings.centre.p_BQ),
                        must_be_finite({"central attraction", "mu", "m^3/s^2"}, settings.mu),
                        must_not_be_negative({"central attraction", "softening", "m"}, settings.softening)});
}

std::unique_ptr<ForceLaw> make_law(const CentralAttraction& settings) {
  return std::make_unique<CentralAttractionLaw>(settings);
}

}  // namespace pantin
