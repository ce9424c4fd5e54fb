// Springs, rotors and motors along the numbers of joints, on pivots.
#include <pantin/physics/constraints/joint_loads.hpp>

#include <cmath>
#include <utility>

#include <gtest/gtest.h>
#include <support/four_bar.hpp>

#include <pantin/physics/integrators/gauss.hpp>

namespace pantin {
namespace {

using test::joint_here;
using test::lopsided_mass;
using test::run;

/// A body on one pivot about z, without gravity: I about the pivot is 0.5.
struct Wheel {
  static constexpr double kInertia = 0.5;
  PhysicsManager physics{};
  BodyId body{};
  JointId joint{};

  explicit Wheel(const JointAxis& axis = {}, bool reversed = false) {
    MassProperties mass;
    mass.mass = 2;
    mass.I_BBcm_B = Vector3{0.3, 0.4, kInertia}.asDiagonal();
    body = physics.add(RigidBodySettings{.name = "wheel", .mass = mass});
    const BodyId post =
        reversed ? physics.add(RigidBodySettings{.name = "post", .kind = BodyKind::Static}) : BodyId{};
    joint = physics.add(reversed ? PivotSettings{.name = "axle", .a = body, .b = post, .axis = axis}
                                 : PivotSettings{.name = "axle", .b = body, .axis = axis});
    physics.set_integrator(make_gauss({.stages = 8, .tolerance = 1e-13}));
  }
};

TEST(JointLoads, ASpringSwingsAboutItsRestThroughWholeTurns) {
  // I q'' = -k (q - rest) has the closed form rest + (q0 - rest) cos(sqrt(k / I) t); the rest is more than a
  // turn away, which poses cannot tell, and the joint may be seen from either side.
  for (const bool reversed : {false, true}) {
    Wheel wheel{{.stiffness = 8, .rest = 9}, reversed};
    ASSERT_TRUE(run(wheel.physics, 0.05, 40));
    const double omega = std::sqrt(8 / Wheel::kInertia);
    EXPECT_NEAR(wheel.physics.joint_value(wheel.joint), 9 - 9 * std::cos(2 * omega), 1e-11) << reversed;
    EXPECT_NEAR(wheel.physics.energy().total(), 0.5 * 8 * 81, 1e-9) << reversed;
  }
}

TEST(JointLoads, ARotorAddsItsInertia) {
  // A pendulum with armature a moves as one whose inertia about the axis is greater by a: the same equation.
  // Energies agree too, with that of the rotor counted.
  const auto pendulum = [](double more, double armature) {
    PhysicsManager physics;
    physics.forces().add(Gravity{});
    MassProperties mass;
    mass.p_BBcm = {0.4, 0, 0};
    mass.I_BBcm_B = Vector3{0.2, 0.2 + more, 0.3}.asDiagonal();
    const BodyId b = physics.add(RigidBodySettings{.mass = mass});
    physics.add(PivotSettings{.b = b,
                              .X_AJ = {{}, test::facing({0, 1, 0})},
                              .X_BJ = {{}, test::facing({0, 1, 0})},
                              .axis = {.armature = armature}});
    physics.set_integrator(make_gauss({.stages = 8, .tolerance = 1e-13}));
    return physics;
  };
  PhysicsManager a = pendulum(0.07, 0), b = pendulum(0, 0.07);
  const double start = b.energy().total();
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(a.step(0.1).ok() && b.step(0.1).ok());
    EXPECT_NEAR(a.joint_value(a.joints()[0]), b.joint_value(b.joints()[0]), 1e-11);
    EXPECT_NEAR(b.energy().kinetic, a.energy().kinetic, 1e-11);
    EXPECT_NEAR(b.energy().total(), start, 1e-11);
  }
}

TEST(JointLoads, ARotorMakesUpForWhatHasNoMass) {
  // Nothing but a rotor of 0.2 resists on the pivot of a massless body: q'' = effort / 0.2. Without it the
  // joint is named as moving nothing that resists.
  const auto rig = [](double armature) {
    PhysicsManager physics;
    const BodyId b = physics.add(RigidBodySettings{.mass = {0, Vector3::Zero(), Matrix3::Zero()}});
    physics.set_motor(physics.add(PivotSettings{.b = b, .axis = {.armature = armature}}), {.effort = 3});
    return physics;
  };
  PhysicsManager physics = rig(0.2);
  EXPECT_TRUE(physics.singular_joints().empty());
  ASSERT_TRUE(run(physics, 0.1, 5));
  EXPECT_NEAR(physics.joint_value(physics.joints()[0]), 0.5 * 3 / 0.2 * 0.25, 1e-13);
  EXPECT_EQ(rig(0).singular_joints().size(), 1u);
}

TEST(JointLoads, RotorsKeepTheirMomentumInBlowsAndFollowVelocitiesThatAreSet) {
  // Of wheel and rotor together an angular impulse of 3 about the axle changes the momentum, (I + a) v. A
  // velocity that is set is that of the wheel, rotor and all, and adding a body to the scene changes neither.
  Wheel wheel{{.armature = 0.25}};
  wheel.physics.set_velocity(wheel.body, Vector3::Zero(), {0, 0, 4});
  EXPECT_NEAR(wheel.physics.energy().kinetic, 0.5 * 0.75 * 16, 1e-13);
  wheel.physics.apply_angular_impulse(wheel.body, {0, 0, 3});
  ASSERT_TRUE(wheel.physics.step(1e-3).ok());
  EXPECT_NEAR(wheel.physics.joint_rate(wheel.joint), 4 + 3 / 0.75, 1e-12);
  wheel.physics.add(RigidBodySettings{.name = "other", .mass = lopsided_mass()});
  ASSERT_TRUE(wheel.physics.step(1e-3).ok());
  EXPECT_NEAR(wheel.physics.joint_rate(wheel.joint), 8, 1e-12);
}

TEST(JointLoads, ShareMomentumAmongFloatingBodies) {
  // Spring, rotor and motor act on both bodies of a floating pair alike: momentum and angular momentum about
  // any point stay what they are; energy too, once the motor is gone.
  PhysicsManager physics;
  const BodyId a = physics.add(RigidBodySettings{.w_WB = {1, 2, 3}, .mass = lopsided_mass()});
  const BodyId b = physics.add(RigidBodySettings{.X_WB = {{0.5, 0, 0}}, .mass = lopsided_mass(2)});
  auto pivot = joint_here<PivotSettings>(physics, a, b, {{0.2, 0, 0}, test::facing({1, 1, 2})});
  pivot.axis = {.stiffness = 5, .rest = 1, .armature = 0.1};
  const JointId joint = physics.add(pivot);
  physics.set_integrator(make_gauss({.stages = 8, .tolerance = 1e-12}));
  physics.set_motor(joint, {.effort = 2, .damping = 0.5});
  const State start = physics.snapshot();
  const test::Momenta before = test::momenta_of(physics);
  ASSERT_TRUE(run(physics, 0.1, 20));
  EXPECT_LT((test::momenta_of(physics).linear - before.linear).norm(), 1e-12);
  EXPECT_LT((test::momenta_of(physics).angular - before.angular).norm(), 1e-11);
  physics.restore(start);
  physics.clear_motor(joint);
  const double energy = physics.energy().total();
  ASSERT_TRUE(run(physics, 0.1, 20));
  EXPECT_NEAR(physics.energy().total(), energy, 1e-10);
}

/// A four-bar with springs and rotors on its pivots, its crank heavier to turn by `more`.
PhysicsManager loaded_four_bar(const std::array<JointAxis, 4>& axes, double more,
                               std::array<int, 4> order = {0, 1, 2, 3}) {
  test::FourBar bar{order, 0.02, true, axes};
  MassProperties crank = bar.physics.body(bar.rods[0]).mass_properties();
  crank.I_BBcm_B(2, 2) += more;
  bar.physics.set_mass_properties(bar.rods[0], crank, InertiaCheck::Solvable);
  bar.physics.set_integrator(make_gauss({.stages = 8, .tolerance = 1e-11}));
  return std::move(bar.physics);
}

TEST(JointLoads, ActInCutJointsAsInOthers) {
  // A rotor on the crank's ground pivot is the same as that much more inertia of the crank. With a rotor
  // there, the pivot stays in the tree; with rotors on the others instead of it, it is the one that is cut.
  // The motor on it winds a spring over several turns, in one long step, blows included.
  const JointAxis spring{.stiffness = 0.2, .rest = 1}, rotor{.stiffness = 0.1, .armature = 0.03};
  std::array<JointAxis, 4> kept{spring, rotor, rotor, rotor};
  kept[0].armature = 0.05;
  std::array<JointAxis, 4> cut{spring, rotor, rotor, rotor};
  PhysicsManager a = loaded_four_bar(kept, 0), b = loaded_four_bar(cut, 0.05);
  for (PhysicsManager* physics : {&a, &b}) {
    for (const JointId joint : physics->joints())
      if (physics->joint(joint).name == "base") physics->set_motor(joint, {.effort = 4, .damping = 0.1});
    ASSERT_TRUE(physics->step(1.5).ok());
    physics->apply_impulse(physics->bodies()[1], {0.5, 1, 0});
    ASSERT_TRUE(physics->step(0.2).ok());
  }
  EXPECT_GT(std::abs(double{a.joint_value(a.joints()[0])}), 7.0);
  EXPECT_NEAR(a.joint_value(a.joints()[0]), b.joint_value(b.joints()[0]), 1e-8);
  EXPECT_NEAR(a.joint_rate(a.joints()[0]), b.joint_rate(b.joints()[0]), 1e-7);
  EXPECT_NEAR(a.energy().potential, b.energy().potential, 1e-7);
  EXPECT_NEAR(a.energy().kinetic, b.energy().kinetic, 1e-6);
  // What the other joints hold is the same, cut or not; a planar mechanism determines it in the plane.
  for (std::size_t j = 1; j < 4; ++j) {
    const Wrench held = a.reaction(a.joints()[j]), other = b.reaction(b.joints()[j]);
    EXPECT_LT((held.force - other.force).head<2>().norm(), 1e-5) << j;
    EXPECT_NEAR(held.torque.z(), other.torque.z(), 1e-6) << j;
  }
}

TEST(JointLoads, ArePartOfTheReaction) {
  // The wheel needs I q'' of its axle, whose spring also has to turn the rotor: q'' = -k (q - rest) / (I +
  // a).
  Wheel wheel{{.stiffness = 8, .rest = 2, .armature = 0.25}};
  EXPECT_NEAR(wheel.physics.joint_effort(wheel.joint), 16, 1e-14);
  EXPECT_NEAR(wheel.physics.reaction(wheel.joint).torque.z(), 16 * 0.5 / 0.75, 1e-13);
}

}  // namespace
}  // namespace pantin
