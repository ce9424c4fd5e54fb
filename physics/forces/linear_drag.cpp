#include <pantin/physics/forces/linear_drag.hpp>

#include <pantin/physics/forces/force_target.hpp>
#include <pantin/physics/forces/wrench_derivatives.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class LinearDragLaw final : public ForceLaw {
 public:
  explicit LinearDragLaw(const LinearDrag& settings) : settings_{settings} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    if (settings_.particles) return;
    if (settings_.body) {
      const std::size_t i = at.index(settings_.body);
      add_drag(settings_, 1, at.kinematics.data() + i, wrenches.data() + i);
    } else {
      add_drag(settings_, at.size(), at.kinematics.data(), wrenches.data());
    }
  }

  bool add_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const override {
    ForceTarget{settings_.body, settings_.particles}.for_each_simulated(at, [&](std::size_t i) {
      WrenchDerivative& part = derivatives.add(i, i);
      part.force.velocity = -settings_.coefficient * Matrix3::Identity();
      part.torque.spin = -settings_.angular_coefficient * Matrix3::Identity();
    });
    return true;
  }

  bool depends_on_velocity() const override {
    return settings_.coefficient != 0 || settings_.angular_coefficient != 0;
  }

  ParticleAction acts_on(ParticleSystemId system) const override {
    return ForceTarget{settings_.body, settings_.particles}.each_of(system);
  }

  void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
    const double c = settings_.coefficient;
    const Vector3 u = settings_.medium_velocity;
    add_drag(c, u.x(), at.vx, forces.x.data());
    add_drag(c, u.y(), at.vy, forces.y.data());
    add_drag(c, u.z(), at.vz, forces.z.data());
  }

  bool names(BodyId body) const override { return body && body == settings_.body; }
  Coupling coupling() const override { return ForceTarget{settings_.body, settings_.particles}.coupling(); }

 private:
  /// Settings by value, so that they stay in registers over the loop.
  static void add_drag(LinearDrag drag, std::size_t n, const BodyKinematics* body, Wrench* wrench) {
    for (std::size_t i = 0; i < n; ++i) {
      wrench[i].force -= drag.coefficient * (body[i].v_WBcm - drag.medium_velocity);
      wrench[i].torque -= drag.angular_coefficient * body[i].w_WB;
    }
  }

  static void add_drag(double c, double u, std::span<const double> velocity, double* force) {
    const double* v = velocity.data();
    for (std::size_t i = 0, n = velocity.size(); i < n; ++i) force[i] -= c * (v[i] - u);
  }

  LinearDrag settings_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const LinearDrag& settings) {
  return first_problem({target_problem("linear drag", settings.body, settings.particles),
                        must_not_be_negative({"linear drag", "coefficient", "N s/m"}, settings.coefficient),
                        must_not_be_negative({"linear drag", "angular coefficient", "N m s/rad"},
                                             settings.angular_coefficient),
                        must_be_finite({"linear drag", "medium velocity", "m/s"}, settings.medium_velocity)});
}

std::unique_ptr<ForceLaw> make_law(const LinearDrag& settings) {
  return std::make_unique<LinearDragLaw>(settings);
}

}  // namespace pantin
