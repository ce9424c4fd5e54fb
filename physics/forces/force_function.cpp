#include <pantin/physics/forces/force_function.hpp>

#include <pantin/physics/forces/force_target.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class ForceFunctionLaw final : public ForceLaw {
 public:
  explicit ForceFunctionLaw(const ForceFunction& settings)
      : settings_{settings}, target_{settings.body, settings.particles} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    if (!settings_.on_body) return;
    target_.for_each_simulated(at, [&](std::size_t i) {
      const Wrench added = settings_.on_body(at, i);
      wrenches[i].force += added.force;
      wrenches[i].torque += added.torque;
    });
  }
  double potential_energy(const BodiesAt& at) const override {
    double sum = 0;
    if (!settings_.body_energy) return sum;
    target_.for_each_simulated(at, [&](std::size_t i) { sum += settings_.body_energy(at, i); });
    return sum;
  }
  bool depends_on_velocity() const override { return settings_.depends_on_velocity; }
  bool names(BodyId body) const override { return target_.names(body); }
  Coupling coupling() const override {
    if (!settings_.on_body) return {.reach = Coupling::Reach::Named};
    return settings_.couples_bodies ? Coupling{} : target_.coupling();
  }

  ParticleAction acts_on(ParticleSystemId system) const override {
    return settings_.on_particle ? target_.each_of(system) : ParticleAction::None;
  }
  void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Vector3 force = settings_.on_particle(particle(at, i));
      forces.add(i, force);
    }
  }
  double particle_energy(const ParticlesAt& at) const override {
    double sum = 0;
    if (!settings_.particle_energy) return sum;
    for (std::size_t i = 0; i < at.size(); ++i) sum += settings_.particle_energy(particle(at, i));
    return sum;
  }

 private:
  static ParticleAt particle(const ParticlesAt& at, std::size_t i) {
    return {at.t, at.p_WP(i), at.v_WP(i), at.mass[i]};
  }

  ForceFunction settings_;
  ForceTarget target_;
};

std::optional<SettingsProblem> functions_problem(const ForceFunction& settings) {
  const bool acts = settings.body        ? static_cast<bool>(settings.on_body)
                    : settings.particles ? static_cast<bool>(settings.on_particle)
                                         : settings.on_body || settings.on_particle;
  if (acts) return std::nullopt;
  return SettingsProblem{ProblemCode::OutOfRange, "force function: there is no function for what it acts on",
                         "give on_body for bodies, on_particle for particles"};
}

}  // namespace

std::optional<SettingsProblem> problem_with(const ForceFunction& settings) {
  return first_problem(
      {target_problem("force function", settings.body, settings.particles), functions_problem(settings)});
}

std::unique_ptr<ForceLaw> make_law(const ForceFunction& settings) {
  return std::make_unique<ForceFunctionLaw>(settings);
}

}  // namespace pantin
