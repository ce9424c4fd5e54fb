#include <pantin/bridge/writers/energy_watch.hpp>

#include <gtest/gtest.h>

#include <pantin/physics/constraints/pivot.hpp>

namespace pantin {
namespace {

TEST(EnergyWatch, MeasuresTheGreatestDeviationAgainstTheEnergyExchanged) {
  // By hand: the total wanders from 10 to 10.5 while at most 4 J are kinetic: 0.5 / 4.
  EnergyWatch watch;
  watch.begin({.kinetic = 0, .potential = 10}, true);
  watch.see({.kinetic = 4, .potential = 6.5});
  watch.see({.kinetic = 2, .potential = 8});
  EXPECT_DOUBLE_EQ(watch.drift().value(), 0.5 / 4);
}

TEST(EnergyWatch, DoesNotCountJumpsBetweenStretches) {
  // A change of drive takes the total from 10 to 3 J; within the stretches nothing drifts.
  EnergyWatch watch;
  watch.begin({.kinetic = 1, .potential = 9}, true);
  watch.begin({.kinetic = 1, .potential = 2}, true);
  watch.see({.kinetic = 2, .potential = 1});
  EXPECT_EQ(watch.drift().value(), 0);
}

TEST(EnergyWatch, SaysNothingWhereEnergyNeedNotStay) {
  // One stretch with work done is enough for the whole to mean nothing; where nothing moves, nothing drifts.
  EnergyWatch watch;
  watch.begin({}, true);
  EXPECT_EQ(watch.drift().value(), 0);
  watch.begin({}, false);
  watch.begin({}, true);
  EXPECT_FALSE(watch.drift());
}

TEST(ConservesEnergy, UnlessAJointDampsOrIsMoved) {
  // Damping takes energy, a motor gives some, and an animated end does work through the joint; springs,
  // static and simulated ends do not.
  for (const double damping : {0.0, 0.1}) {
    PhysicsManager physics;
    const BodyId body = physics.add(RigidBodySettings{.name = "rod"});
    physics.add(PivotSettings{.b = body, .damping = damping});
    EXPECT_EQ(conserves_energy(physics), damping == 0);
  }
  PhysicsManager physics;
  const BodyId still = physics.add(RigidBodySettings{.name = "still", .kind = BodyKind::Static});
  const BodyId rod = physics.add(RigidBodySettings{.name = "rod"});
  const JointId joint = physics.add(PivotSettings{.a = still, .b = rod, .axis = {.stiffness = 3}});
  EXPECT_TRUE(conserves_energy(physics));
  physics.set_motor(joint, {.effort = 1});
  EXPECT_FALSE(conserves_energy(physics));
  physics.clear_motor(joint);
  EXPECT_TRUE(conserves_energy(physics));
  class Standing final : public Driver {
   public:
    RigidMotion motion(double, Side) const override { return {}; }
    double next_break(double) const override { return std::numeric_limits<double>::infinity(); }
  };
  physics.make_animated(still, std::make_unique<Standing>());
  EXPECT_FALSE(conserves_energy(physics));
}

}  // namespace
}  // namespace pantin
