#include <pantin/physics/forces/magnetic_field.hpp>

#include <pantin/physics/forces/force_target.hpp>
#include <pantin/physics/forces/wrench_derivatives.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class MagneticFieldLaw final : public ForceLaw {
 public:
  explicit MagneticFieldLaw(const MagneticField& settings)
      : charged_field_{settings.charge * settings.field_W}, target_{settings.body, settings.particles} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    target_.for_each_body(
        at, [&](std::size_t i) { wrenches[i].force += at.kinematics[i].v_WBcm.cross(charged_field_); });
  }
  bool add_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const override {
    target_.for_each_simulated(
        at, [&](std::size_t i) { derivatives.add(i, i).force.velocity = -cross_matrix(charged_field_); });
    return true;
  }
  bool depends_on_velocity() const override { return !charged_field_.isZero(0); }
  bool names(BodyId body) const override { return target_.names(body); }
  Coupling coupling() const override { return target_.coupling(); }

  ParticleAction acts_on(ParticleSystemId system) const override { return target_.each_of(system); }
  void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
    const double bx = charged_field_.x(), by = charged_field_.y(), bz = charged_field_.z();
    for (std::size_t i = 0, n = at.size(); i < n; ++i) {
      forces.x[i] += at.vy[i] * bz - at.vz[i] * by;
      forces.y[i] += at.vz[i] * bx - at.vx[i] * bz;
      forces.z[i] += at.vx[i] * by - at.vy[i] * bx;
    }
  }

 private:
  Vector3 charged_field_;  // c B
  ForceTarget target_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const MagneticField& settings) {
  return first_problem({target_problem("magnetic field", settings.body, settings.particles),
                        must_be_finite({"magnetic field", "field", "T"}, settings.field_W),
                        must_be_finite({"magnetic field", "charge", "C"}, settings.charge)});
}

std::unique_ptr<ForceLaw> make_law(const MagneticField& settings) {
  return std::make_unique<MagneticFieldLaw>(settings);
}

}  // namespace pantin
