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

 private:
  Vector3 g_W_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const Gravity& settings) {
  return must_be_finite({"gravity", "acceleration", "m/s^2"}, settings.g_W);
}

std::unique_ptr<ForceLaw> make_law(const Gravity& settings) { return std::make_unique<GravityLaw>(settings); }

}  // namespace pantin
