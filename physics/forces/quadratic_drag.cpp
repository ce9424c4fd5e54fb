#include <pantin/physics/forces/quadratic_drag.hpp>

#include <pantin/physics/forces/force_target.hpp>
#include <pantin/physics/forces/medium_drag.hpp>
#include <pantin/physics/forces/wrench_derivatives.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class QuadraticDragLaw final : public ForceLaw {
 public:
  explicit QuadraticDragLaw(const QuadraticDrag& settings)
      : settings_{settings},
        target_{settings.body, settings.particles},
        drag_{.quadratic = settings.coefficient} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    target_.for_each_body(at, [&](std::size_t i) {
      const Vector3& w_WB = at.kinematics[i].w_WB;
      wrenches[i].force += drag_.force(at.kinematics[i].v_WBcm - settings_.medium_velocity);
      wrenches[i].torque -= settings_.angular_coefficient * w_WB.norm() * w_WB;
    });
  }

  bool add_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const override {
    const MediumDrag angular{.quadratic = settings_.angular_coefficient};
    target_.for_each_simulated(at, [&](std::size_t i) {
      WrenchDerivative& part = derivatives.add(i, i);
      part.force.velocity = drag_.derivative(at.kinematics[i].v_WBcm - settings_.medium_velocity);
      part.torque.spin = angular.derivative(at.kinematics[i].w_WB);
    });
    return true;
  }

  bool depends_on_velocity() const override {
    return settings_.coefficient != 0 || settings_.angular_coefficient != 0;
  }
  bool names(BodyId body) const override { return target_.names(body); }
  Coupling coupling() const override { return target_.coupling(); }

  ParticleAction acts_on(ParticleSystemId system) const override { return target_.each_of(system); }
  void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
    drag_.add(at, settings_.medium_velocity, forces);
  }

 private:
  QuadraticDrag settings_;
  ForceTarget target_;
  MediumDrag drag_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const QuadraticDrag& settings) {
  return first_problem(
      {target_problem("quadratic drag", settings.body, settings.particles),
       must_not_be_negative({"quadratic drag", "coefficient", "N s^2/m^2"}, settings.coefficient),
       must_not_be_negative({"quadratic drag", "angular coefficient", "N m s^2/rad^2"},
                            settings.angular_coefficient),
       must_be_finite({"quadratic drag", "medium velocity", "m/s"}, settings.medium_velocity)});
}

std::unique_ptr<ForceLaw> make_law(const QuadraticDrag& settings) {
  return std::make_unique<QuadraticDragLaw>(settings);
}

}  // namespace pantin
