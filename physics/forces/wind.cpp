#include <pantin/physics/forces/wind.hpp>

#include <cmath>
#include <numbers>
#include <string>

#include <pantin/physics/forces/force_target.hpp>
#include <pantin/physics/forces/medium_drag.hpp>
#include <pantin/physics/forces/wrench_derivatives.hpp>
#include <pantin/physics/random_draws.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

constexpr int kMostHarmonics = 1000;

class WindLaw final : public ForceLaw {
 public:
  explicit WindLaw(const Wind& settings)
      : velocity_{settings},
        target_{settings.body, settings.particles},
        drag_{settings.linear_drag, settings.quadratic_drag} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    if (target_.particles) return;
    const Vector3 u = velocity_(at.t);
    target_.for_each_body(
        at, [&](std::size_t i) { wrenches[i].force += drag_.force(at.kinematics[i].v_WBcm - u); });
  }

  bool add_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const override {
    if (target_.particles) return true;
    const Vector3 u = velocity_(at.t);
    target_.for_each_simulated(at, [&](std::size_t i) {
      derivatives.add(i, i).force.velocity = drag_.derivative(at.kinematics[i].v_WBcm - u);
    });
    return true;
  }

  bool depends_on_velocity() const override { return drag_.linear != 0 || drag_.quadratic != 0; }
  bool names(BodyId body) const override { return target_.names(body); }
  Coupling coupling() const override { return target_.coupling(); }

  ParticleAction acts_on(ParticleSystemId system) const override { return target_.each_of(system); }
  void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
    drag_.add(at, velocity_(at.t), forces);
  }

 private:
  WindVelocity velocity_;
  ForceTarget target_;
  MediumDrag drag_;
};

std::optional<SettingsProblem> harmonics_problem(int harmonics) {
  if (harmonics >= 1 && harmonics <= kMostHarmonics) return std::nullopt;
  return SettingsProblem{ProblemCode::OutOfRange,
                         "wind: harmonics is " + std::to_string(harmonics) + "; it must be 1 to 1000",
                         "give a number of harmonics from 1 to 1000"};
}

}  // namespace

WindVelocity::WindVelocity(const Wind& settings)
    : mean_{settings.mean}, amplitude_{settings.gust_rms * std::sqrt(2.0 / settings.harmonics)} {
  if (settings.gust_rms.isZero(0)) return;
  // The power below omega is the integral of S, 2/pi rms^2 atan(T omega): its inverse places the bands.
  const double whole = std::atan(settings.cutoff);
  for (int k = 0; k < settings.harmonics; ++k) {
    RandomDraws draw{settings.seed, static_cast<std::uint64_t>(k)};
    Harmonic harmonic;
    for (int axis = 0; axis < 3; ++axis) {
      harmonic.frequency[axis] = std::tan(whole * (k + draw()) / settings.harmonics) / settings.gust_time;
      harmonic.phase[axis] = 2 * std::numbers::pi * draw();
    }
    harmonics_.push_back(harmonic);
  }
}

Vector3 WindVelocity::operator()(double t) const {
  Vector3 sum = Vector3::Zero();
  for (const Harmonic& harmonic : harmonics_) {
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] += std::cos(harmonic.frequency[axis] * t + harmonic.phase[axis]);
  }
  return mean_ + amplitude_.cwiseProduct(sum);
}

std::optional<SettingsProblem> problem_with(const Wind& settings) {
  return first_problem(
      {target_problem("wind", settings.body, settings.particles),
       must_be_finite({"wind", "mean", "m/s"}, settings.mean),
       must_be_finite({"wind", "gust rms", "m/s"}, settings.gust_rms),
       must_not_be_negative({"wind", "least gust rms", "m/s"}, settings.gust_rms.minCoeff()),
       must_be_positive({"wind", "gust time", "s"}, settings.gust_time),
       must_be_positive({"wind", "cutoff", "rad"}, settings.cutoff), harmonics_problem(settings.harmonics),
       must_not_be_negative({"wind", "linear drag", "N s/m"}, settings.linear_drag),
       must_not_be_negative({"wind", "quadratic drag", "N s^2/m^2"}, settings.quadratic_drag)});
}

std::unique_ptr<ForceLaw> make_law(const Wind& settings) { return std::make_unique<WindLaw>(settings); }

}  // namespace pantin
