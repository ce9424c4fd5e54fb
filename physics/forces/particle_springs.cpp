// With d = p_b - p_a, l = |d|, n = d / l: the tension T = k (l - l0) + c n . (v_b - v_a) is +T n on a and -T
// n on b, on one line, so momentum and angular momentum of particles and bodies together stay. Potential k (l
// - l0)^2 / 2.
#include <pantin/physics/forces/particle_springs.hpp>

#include <algorithm>
#include <string>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class ParticleSpringsLaw final : public ForceLaw {
 public:
  explicit ParticleSpringsLaw(const ParticleSprings& settings) : settings_{settings} {}

  void add_wrenches(const BodiesAt&, std::span<Wrench>) const override {}

  ParticleAction acts_on(ParticleSystemId system) const override {
    return system == settings_.system ? ParticleAction::Coupled : ParticleAction::None;
  }

  void add_coupled_forces(const BodiesAt& bodies, std::span<Wrench> wrenches,
                          std::span<const CoupledParticles> systems) const override {
    const CoupledParticles* system = own(systems);
    if (system == nullptr) return;
    for (const ParticleSpring& spring : settings_.springs) {
      Ends ends;
      if (!find(*system, bodies, spring, ends)) continue;
      const double length = ends.d.stableNorm();
      if (length == 0) continue;
      const Vector3 n = ends.d / length;
      const Vector3 pull =
          (spring.stiffness * (length - spring.rest_length) + spring.damping * n.dot(ends.d_rate)) * n;
      add(*system, ends.a, pull);
      if (spring.b) {
        add(*system, ends.b, -pull);
      } else if (spring.anchor.body) {
        add_force_at(bodies, bodies.index(spring.anchor.body), ends.p_b, -pull, wrenches);
      }
    }
  }

  double coupled_energy(const BodiesAt& bodies, std::span<const CoupledParticles> systems) const override {
    const CoupledParticles* system = own(systems);
    if (system == nullptr) return 0;
    double sum = 0;
    for (const ParticleSpring& spring : settings_.springs) {
      Ends ends;
      if (!find(*system, bodies, spring, ends)) continue;
      const double stretch = ends.d.stableNorm() - spring.rest_length;
      sum += 0.5 * spring.stiffness * stretch * stretch;
    }
    return sum;
  }

  bool depends_on_velocity() const override {
    return std::any_of(settings_.springs.begin(), settings_.springs.end(),
                       [](const ParticleSpring& spring) { return spring.damping != 0; });
  }

  bool names(BodyId body) const override {
    return std::any_of(
        settings_.springs.begin(), settings_.springs.end(),
        [body](const ParticleSpring& spring) { return body && !spring.b && spring.anchor.body == body; });
  }

 private:
  struct Ends {
    std::size_t a{0}, b{0};
    Vector3 p_b{Vector3::Zero()}, d{Vector3::Zero()}, d_rate{Vector3::Zero()};
  };

  const CoupledParticles* own(std::span<const CoupledParticles> systems) const {
    for (const CoupledParticles& system : systems) {
      if (system.at.system == settings_.system) return &system;
    }
    return nullptr;
  }

  static PointKinematics point(const ParticlesAt& at, std::size_t i) {
    return {{at.x[i], at.y[i], at.z[i]}, {at.vx[i], at.vy[i], at.vz[i]}};
  }

  /// False where a particle is gone.
  static bool find(const CoupledParticles& system, const BodiesAt& bodies, const ParticleSpring& spring,
                   Ends& ends) {
    ends.a = system.position_of(spring.a.serial);
    ends.b = spring.b ? system.position_of(spring.b.serial) : 0;
    if (ends.a == system.at.size() || ends.b == system.at.size()) return false;
    const PointKinematics a = point(system.at, ends.a);
    const PointKinematics b = spring.b ? point(system.at, ends.b) : point_at(bodies, spring.anchor);
    ends.p_b = b.p_WQ;
    ends.d = b.p_WQ - a.p_WQ;
    ends.d_rate = b.v_WQ - a.v_WQ;
    return true;
  }

  static void add(const CoupledParticles& system, std::size_t i, const Vector3& f) {
    system.force.x[i] += f.x();
    system.force.y[i] += f.y();
    system.force.z[i] += f.z();
  }

  ParticleSprings settings_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const ParticleSprings& settings) {
  if (!settings.system || settings.springs.empty()) {
    return SettingsProblem{ProblemCode::UnknownEntity, "particle springs: there is no system, or no spring",
                           "name a particle system and give springs"};
  }
  for (std::size_t k = 0; k < settings.springs.size(); ++k) {
    const ParticleSpring& spring = settings.springs[k];
    const std::string subject = "particle spring " + std::to_string(k);
    if (spring.a.system != settings.system || (spring.b && spring.b.system != settings.system)) {
      return SettingsProblem{ProblemCode::UnknownEntity,
                             subject + ": an end is no particle of the law's system",
                             "give particles of one system"};
    }
    if (spring.a == spring.b) {
      return SettingsProblem{ProblemCode::OutOfRange, subject + ": both ends are one particle",
                             "give two particles"};
    }
    if (auto problem =
            first_problem({must_be_finite({subject, "anchor", "m"}, spring.anchor.p_BQ),
                           must_not_be_negative({subject, "stiffness", "N/m"}, spring.stiffness),
                           must_not_be_negative({subject, "damping", "N s/m"}, spring.damping),
                           must_not_be_negative({subject, "rest length", "m"}, spring.rest_length)})) {
      return problem;
    }
  }
  return std::nullopt;
}

std::unique_ptr<ForceLaw> make_law(const ParticleSprings& settings) {
  return std::make_unique<ParticleSpringsLaw>(settings);
}

}  // namespace pantin
