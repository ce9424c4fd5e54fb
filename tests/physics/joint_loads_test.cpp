// Springs, rotors and motors along the numbers of joints.
#include <pantin/physics/constraints/joint_loads.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <support/allocation_guard.hpp>
#include <support/four_bar.hpp>
#include <support/mixed_tree.hpp>

#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/screw.hpp>
#include <pantin/physics/constraints/universal.hpp>
#include <pantin/physics/forces/torsion_spring.hpp>
#include <pantin/physics/integrators/gauss.hpp>
#include <pantin/physics/integrators/radau.hpp>

namespace pantin {
namespace {

using test::joint_here;
using test::lopsided_mass;
using test::run;

constexpr double kInf = std::numeric_limits<double>::infinity();

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

/// x, y, z in a row, with joints x-y and z-y of one kind: the tree begins at whichever of x and z is added
/// first, and runs through one joint from A to B and through the other from B to A.
template <class Settings>
PhysicsManager pair_of(bool z_first, auto load) {
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0.3, -0.2, 0.1}});
  BodyId ids[3];
  for (const int i : z_first ? std::array{2, 1, 0} : std::array{0, 1, 2}) {
    RigidBodySettings s{.name = std::string{"xyz"[i]}, .X_WB = {{0.4 * i, 0.1, 0}}};
    s.w_WB = {0.1 * i, 0.3, 0.2};
    s.mass = lopsided_mass(1 + i);
    ids[i] = physics.add(std::move(s));
  }
  for (const int end : {0, 2}) {
    Settings joint =
        joint_here<Settings>(physics, ids[end], ids[1], {{0.2 * end, 0, 0.1}, test::facing({1, 2, 1})});
    load(physics, joint);
  }
  return physics;
}

/// Springs, damping and motors along all numbers; rotors too.
template <class Settings>
void load_all(PhysicsManager& physics, Settings joint) {
  JointDefinition definition = define(std::move(joint));
  const int count = axis_count(definition.kind);
  definition.pitch = definition.kind == JointKind::Screw ? 0.1 : 0;
  definition.damping = {0.3, 0.2, 0.1};
  // Of a planar joint's distances rotors are seen from the body nearer to the root.
  const bool all_rotors = definition.kind != JointKind::Planar;
  for (int i = 0; i < count; ++i) {
    definition.axes[static_cast<std::size_t>(i)] = {
        .stiffness = 4.0 + i, .rest = 0.3 - 0.2 * i, .armature = all_rotors || i == 2 ? 0.1 + 0.05 * i : 0};
  }
  const JointId id = physics.add_joint(std::move(definition));
  for (int i = 0; i < count; ++i)
    physics.set_motor(id, {.effort = 0.2, .value = 0.5, .rate = -0.3, .stiffness = 2, .damping = 0.4 + i}, i);
}

template <class Settings>
class LoadedJoint : public testing::Test {};
using LoadedJoints = testing::Types<PivotSettings, SliderSettings, CylindricalSettings, UniversalSettings,
                                    PlanarSettings, ScrewSettings>;
TYPED_TEST_SUITE(LoadedJoint, LoadedJoints);

TYPED_TEST(LoadedJoint, ActsTheSameWhicheverWayTheTreeRuns) {
  // One mechanism laid out from either end: the same bodies must move alike, though numbers of links turn
  // their sign, order or frame.
  PhysicsManager one = pair_of<TypeParam>(false, load_all<TypeParam>),
                 other = pair_of<TypeParam>(true, load_all<TypeParam>);
  for (PhysicsManager* physics : {&one, &other}) {
    physics->set_integrator(make_gauss({.stages = 8, .tolerance = 1e-12}));
    ASSERT_TRUE(run(*physics, 0.25, 4));
  }
  for (const BodyId id : one.bodies()) {
    const RigidBody a = one.body(id);
    for (const BodyId found : other.bodies()) {
      const RigidBody b = other.body(found);
      if (a.name() == b.name()) {
        EXPECT_LT((a.p_WBcm() - b.p_WBcm()).norm(), 1e-10) << a.name();
        EXPECT_LT((a.w_WB() - b.w_WB()).norm(), 1e-9) << a.name();
      }
    }
  }
}

TYPED_TEST(LoadedJoint, KeepsEnergyWithSpringsAndRotors) {
  // Without damping and motors the sum of kinetic and potential energy, springs and rotors counted, is an
  // integral of the motion.
  const auto conservative = [](PhysicsManager& physics, TypeParam joint) {
    JointDefinition definition = define(std::move(joint));
    definition.pitch = definition.kind == JointKind::Screw ? 0.1 : 0;
    for (int i = 0; i < axis_count(definition.kind); ++i)
      definition.axes[static_cast<std::size_t>(i)] = {
          .stiffness = 4.0 + i, .rest = 0.3, .armature = 0.1 + 0.2 * i};
    physics.add_joint(std::move(definition));
  };
  PhysicsManager physics = pair_of<TypeParam>(false, conservative);
  physics.set_integrator(make_gauss({.stages = 8, .tolerance = 1e-12}));
  static_cast<void>(physics.snapshot());  // velocities are made to agree with the joints
  const double start = physics.energy().total(), kinetic = physics.energy().kinetic;
  ASSERT_TRUE(run(physics, 0.1, 10));
  EXPECT_NEAR(physics.energy().total(), start, 1e-10);
  EXPECT_GT(std::abs(physics.energy().kinetic - kinetic), 1e-3);
}

TYPED_TEST(LoadedJoint, MovesInLanesAsInTheScalarKernel) {
  // Four and eight stages are computed in lanes, seven by the scalar kernel; all solve the same equations.
  std::vector<Vector3> ends[3];
  for (int i = 0; i < 3; ++i) {
    PhysicsManager physics = pair_of<TypeParam>(false, load_all<TypeParam>);
    physics.set_integrator(
        make_gauss({.stages = std::array{7, 4, 8}[static_cast<std::size_t>(i)], .tolerance = 1e-13}));
    ASSERT_TRUE(physics.step(1).ok());
    for (const BodyId id : physics.bodies()) ends[i].push_back(physics.body(id).p_WBcm());
  }
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_LT((ends[1][b] - ends[0][b]).norm(), 1e-11);
    EXPECT_LT((ends[2][b] - ends[0][b]).norm(), 1e-11);
  }
}

TYPED_TEST(LoadedJoint, LeavesIntegratorsTheirOrder) {
  // Efforts are functions of the stage: halving the step of rk4 divides the error by 16.
  const auto end = [](std::unique_ptr<Integrator> integrator, int steps) {
    PhysicsManager physics = pair_of<TypeParam>(false, load_all<TypeParam>);
    physics.set_integrator(std::move(integrator));
    EXPECT_TRUE(run(physics, 0.5 / steps, steps));
    return physics.body(physics.bodies()[2]).p_WBcm();
  };
  const Vector3 exact = end(make_gauss({.stages = 8, .tolerance = 1e-13}), 1);
  const double coarse = (end(make_integrator("rk4"), 40) - exact).norm(),
               fine = (end(make_integrator("rk4"), 80) - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.2) << coarse << ' ' << fine;
}

TEST(JointLoads, ContinueFromSnapshotsBitForBitAndWithoutAllocating) {
  // Rates of rotors and turns of springs are those of the joints, which are State; steps of a loaded tree
  // take no memory in any of the ways through the kernels.
  for (const char* name : {"rk4", "gauss8", "gauss16", "dormand-prince"}) {
    PhysicsManager physics = pair_of<CylindricalSettings>(false, load_all<CylindricalSettings>);
    physics.set_integrator(make_integrator(name));
    ASSERT_TRUE(run(physics, 0.05, 3));
    const State middle = physics.snapshot();
    ASSERT_TRUE(run(physics, 0.05, 3));
    const State end = physics.snapshot();
    physics.restore(middle);
    const std::size_t before = test::allocations_so_far();
    const bool ok = run(physics, 0.05, 3);
    EXPECT_EQ(test::allocations_so_far() - before, 0u) << name;
    EXPECT_TRUE(ok && physics.snapshot() == end) << name;
  }
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
}

}  // namespace
}  // namespace pantin
