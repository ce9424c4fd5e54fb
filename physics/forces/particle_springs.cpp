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
  explicit ParticleSpringsLaw(const ParticleSprings& settings) : settings_{settings} {
    for (const ParticleSpring& spring : settings_.springs) {
      for (const ParticleId& end : {spring.a, spring.b}) {
        if (end && acts_on(end.system) == ParticleAction::None) systems_.push_back(end.system);
      }
    }
  }

  void add_wrenches(const BodiesAt&, std::span<Wrench>) const override {}

  ParticleAction acts_on(ParticleSystemId system) const override {
    const bool acts = std::find(systems_.begin(), systems_.end(), system) != systems_.end();
    return acts ? ParticleAction::Coupled : ParticleAction::None;
  }

  void add_coupled_forces(const BodiesAt& bodies, std::span<Wrench> wrenches,
                          std::span<const CoupledParticles> systems) const override {
    for (const ParticleSpring& spring : settings_.springs) {
      Ends ends;
      if (!find(systems, bodies, spring, ends)) continue;
      const double length = ends.d.stableNorm();
      if (length == 0) continue;
      const Vector3 n = ends.d / length;
      const Vector3 pull =
          (spring.stiffness * (length - spring.rest_length) + spring.damping * n.dot(ends.d_rate)) * n;
      ends.a.system->force.add(ends.a.position, pull);
      if (spring.b) {
        ends.b.system->force.add(ends.b.position, -pull);
      } else if (spring.anchor.body) {
        add_force_at(bodies, bodies.index(spring.anchor.body), ends.p_b, -pull, wrenches);
      }
    }
  }

  double coupled_energy(const BodiesAt& bodies, std::span<const CoupledParticles> systems) const override {
    double sum = 0;
    for (const ParticleSpring& spring : settings_.springs) {
      Ends ends;
      if (!find(systems, bodies, spring, ends)) continue;
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
  Coupling coupling() const override {
    Coupling coupling{.reach = Coupling::Reach::Named};
    for (const ParticleSpring& spring : settings_.springs) {
      if (!spring.b && spring.anchor.body) coupling.bodies.push_back(spring.anchor.body);
    }
    return coupling;
  }

 private:
  /// A particle in the arrays of its system; no system = it is not there.
  struct End {
    const CoupledParticles* system{nullptr};
    std::size_t position{0};
  };
  struct Ends {
    End a{}, b{};
    Vector3 p_b{Vector3::Zero()}, d{Vector3::Zero()}, d_rate{Vector3::Zero()};
  };

  static End find(std::span<const CoupledParticles> systems, ParticleId id) {
    for (const CoupledParticles& system : systems) {
      if (system.at.system != id.system) continue;
      const std::size_t i = system.position_of(id.serial);
      return i < system.at.size() ? End{&system, i} : End{};
    }
    return {};
  }

  static PointKinematics point(const End& end) {
    return {end.system->at.p_WP(end.position), end.system->at.v_WP(end.position)};
  }

  /// False where a particle is gone.
  static bool find(std::span<const CoupledParticles> systems, const BodiesAt& bodies,
                   const ParticleSpring& spring, Ends& ends) {
    ends.a = find(systems, spring.a);
    if (spring.b) ends.b = find(systems, spring.b);
    if (ends.a.system == nullptr || (spring.b && ends.b.system == nullptr)) return false;
    const PointKinematics a = point(ends.a);
    const PointKinematics b = spring.b ? point(ends.b) : point_at(bodies, spring.anchor);
    ends.p_b = b.p_WQ;
    ends.d = b.p_WQ - a.p_WQ;
    ends.d_rate = b.v_WQ - a.v_WQ;
    return true;
  }

  ParticleSprings settings_;
  std::vector<ParticleSystemId> systems_{};  // each once
};

}  // namespace

std::optional<SettingsProblem> problem_with(const ParticleSprings& settings) {
  if (settings.springs.empty()) {
    return SettingsProblem{ProblemCode::OutOfRange, "particle springs: there is no spring", "give springs"};
  }
  for (std::size_t k = 0; k < settings.springs.size(); ++k) {
    const ParticleSpring& spring = settings.springs[k];
    const std::string subject = "particle spring " + std::to_string(k);
    if (!spring.a) {
      return SettingsProblem{ProblemCode::UnknownEntity, subject + ": end a is no particle",
                             "give a particle as end a"};
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
