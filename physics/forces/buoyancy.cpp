#include <pantin/physics/forces/buoyancy.hpp>

#include <pantin/physics/forces/force_target.hpp>
#include <pantin/physics/setting_checks.hpp>
#include <pantin/physics/submerged_volume.hpp>

namespace pantin {
namespace {

class BuoyancyLaw final : public ForceLaw {
 public:
  explicit BuoyancyLaw(const Buoyancy& settings)
      : settings_{settings},
        target_{settings.body, settings.particles},
        solid_{settings.shape},
        weight_{settings.density * settings.gravity} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    target_.for_each_body(at, [&](std::size_t i) {
      const VolumeMoment below = below_surface(at, i);
      if (below.volume <= 0) return;
      const Vector3 p_BQ = below.moment / below.volume;
      const PointKinematics centroid = point_at(at, {settings_.body, p_BQ});
      const Vector3 force =
          below.volume * (weight_ * settings_.up_W - settings_.drag * (centroid.v_WQ - settings_.current));
      add_force_at(at, i, centroid.p_WQ, force, wrenches);
    });
  }

  double potential_energy(const BodiesAt& at) const override {
    double sum = 0;
    target_.for_each_simulated(at, [&](std::size_t i) {
      const VolumeMoment below = below_surface(at, i);
      const HalfSpace fluid = in_body(at, i);
      sum += weight_ * (fluid.offset * below.volume - fluid.normal.dot(below.moment));
    });
    return sum;
  }

  bool depends_on_velocity() const override { return settings_.drag != 0; }
  bool names(BodyId body) const override { return target_.names(body); }
  Coupling coupling() const override { return target_.coupling(); }

  ParticleAction acts_on(ParticleSystemId system) const override { return target_.each_of(system); }
  void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double volume = solid_.below(around(at.p_WP(i))).volume;
      forces.add(i, volume * (weight_ * settings_.up_W - settings_.drag * (at.v_WP(i) - settings_.current)));
    }
  }
  double particle_energy(const ParticlesAt& at) const override {
    double sum = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const HalfSpace fluid = around(at.p_WP(i));
      const VolumeMoment below = solid_.below(fluid);
      sum += weight_ * (fluid.offset * below.volume - fluid.normal.dot(below.moment));
    }
    return sum;
  }

 private:
  /// The fluid as seen from a point of the world with axes W.
  [[nodiscard]] HalfSpace around(const Vector3& p_W) const {
    return {settings_.up_W, settings_.up_W.dot(settings_.p_WS - p_W)};
  }
  [[nodiscard]] HalfSpace in_body(const BodiesAt& at, std::size_t i) const {
    const BodyKinematics& k = at.kinematics[i];
    return {k.R_WB.transpose() * settings_.up_W, around(k.p_WBcm - k.R_WB * at.mass[i].p_BBcm).offset};
  }
  [[nodiscard]] VolumeMoment below_surface(const BodiesAt& at, std::size_t i) const {
    return solid_.below(in_body(at, i));
  }

  Buoyancy settings_;
  ForceTarget target_;
  Immersible solid_;
  double weight_;  // of a cubic metre of fluid [N/m^3]
};

std::optional<SettingsProblem> whom_problem(const Buoyancy& settings) {
  if (!settings.body && !settings.particles) {
    return SettingsProblem{ProblemCode::UnknownEntity,
                           "buoyancy: neither a body nor a particle system is named",
                           "name the one that displaces the shape"};
  }
  const auto* sphere = std::get_if<SphereShape>(&settings.shape.geometry);
  if (settings.particles && (sphere == nullptr || !settings.shape.X_BS.p.isZero(0))) {
    return SettingsProblem{ProblemCode::OutOfRange,
                           "buoyancy: the shape of particles is no sphere around them",
                           "give a sphere with its centre at zero"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<SettingsProblem> problem_with(const Buoyancy& settings) {
  return first_problem({target_problem("buoyancy", settings.body, settings.particles), whom_problem(settings),
                        immersion_problem(settings.shape),
                        must_be_finite({"buoyancy", "surface", "m"}, settings.p_WS),
                        must_be_unit({"buoyancy", "up", ""}, settings.up_W),
                        must_not_be_negative({"buoyancy", "density", "kg/m^3"}, settings.density),
                        must_not_be_negative({"buoyancy", "gravity", "m/s^2"}, settings.gravity),
                        must_not_be_negative({"buoyancy", "drag", "N s/m^4"}, settings.drag),
                        must_be_finite({"buoyancy", "current", "m/s"}, settings.current)});
}

std::unique_ptr<ForceLaw> make_law(const Buoyancy& settings) {
  return std::make_unique<BuoyancyLaw>(settings);
}

}  // namespace pantin
