#pragma once
// The law of a field that acts on each body and particle by itself: what uniform and radial fields share.
// A field gives at(p), the force per unit of mass or charge, derivative(p) of that, and potential(p), the
// energy per unit. Private to the force laws.
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/forces/force_target.hpp>
#include <pantin/physics/forces/wrench_derivatives.hpp>

namespace pantin {

template <class Field>
class FieldLaw final : public ForceLaw {
 public:
  FieldLaw(const Field& field, std::optional<double> charge, const ForceTarget& target)
      : field_{field}, charge_{charge}, target_{target} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    target_.for_each_body(at, [&](std::size_t i) {
      wrenches[i].force += charge_.value_or(at.mass[i].mass) * field_.at(at.kinematics[i].p_WBcm);
    });
  }
  double potential_energy(const BodiesAt& at) const override {
    double sum = 0;
    target_.for_each_simulated(at, [&](std::size_t i) {
      sum += charge_.value_or(at.mass[i].mass) * field_.potential(at.kinematics[i].p_WBcm);
    });
    return sum;
  }
  bool add_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const override {
    target_.for_each_simulated(at, [&](std::size_t i) {
      derivatives.add(i, i).force.position =
          charge_.value_or(at.mass[i].mass) * field_.derivative(at.kinematics[i].p_WBcm);
    });
    return true;
  }
  bool names(BodyId body) const override { return target_.names(body); }
  Coupling coupling() const override { return target_.coupling(); }

  ParticleAction acts_on(ParticleSystemId system) const override { return target_.each_of(system); }
  void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Vector3 force = charge_.value_or(at.mass[i]) * field_.at(at.p_WP(i));
      forces.add(i, force);
    }
  }
  double particle_energy(const ParticlesAt& at) const override {
    double sum = 0;
    for (std::size_t i = 0; i < at.size(); ++i)
      sum += charge_.value_or(at.mass[i]) * field_.potential(at.p_WP(i));
    return sum;
  }

 private:
  Field field_;
  std::optional<double> charge_;
  ForceTarget target_;
};

}  // namespace pantin
