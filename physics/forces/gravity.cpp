#include <pantin/physics/forces/gravity.hpp>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class GravityLaw final : public ForceLaw {
 public:
  explicit GravityLaw(const Gravity& settings) : g_W_{settings.g_W} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    // Bodies that are not simulated get their share too: it is ignored, and a branch would cost more.
    const Vector3 g_W = g_W_;
    const MassProperties* mass = at.mass.data();
    Wrench* wrench = wrenches.data();
    for (std::size_t i = 0, n = at.size(); i < n; ++i) wrench[i].force += mass[i].mass * g_W;
  }

  double potential_energy(const BodiesAt& at) const override {
    double energy = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (at.kind[i] != BodyKind::Simulated) continue;
      energy -= at.mass[i].mass * g_W_.dot(at.kinematics[i].p_WBcm);
    }
    return energy;
  }

  bool add_derivatives(const BodiesAt&, WrenchDerivatives&) const override { return true; }  // none changes
  std::optional<Vector3> uniform_acceleration() const override { return g_W_; }
  Coupling coupling() const override { return {.reach = Coupling::Reach::Each}; }

  ParticleAction acts_on(ParticleSystemId) const override { return ParticleAction::Each; }

  void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
    const double gx = g_W_.x(), gy = g_W_.y(), gz = g_W_.z();
    const double* mass = at.mass.data();
    double *fx = forces.x.data(), *fy = forces.y.data(), *fz = forces.z.data();
    for (std::size_t i = 0, n = at.size(); i < n; ++i) {
      fx[i] += mass[i] * gx;
      fy[i] += mass[i] * gy;
      fz[i] += mass[i] * gz;
    }
  }

  double particle_energy(const ParticlesAt& at) const override {
    const double gx = g_W_.x(), gy = g_W_.y(), gz = g_W_.z();
    double energy = 0;
    for (std::size_t i = 0, n = at.size(); i < n; ++i) {
      energy -= at.mass[i] * (gx * at.x[i] + gy * at.y[i] + gz * at.z[i]);
    }
    return energy;
  }

 private:
  Vector3 g_W_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const Gravity& settings) {
  return must_be_finite({"gravity", "acceleration", "m/s^2"}, settings.g_W);
}

std::unique_ptr<ForceLaw> make_law(const Gravity& settings) { return std::make_unique<GravityLaw>(settings); }

}  // namespace pantin
