// Joints with several motions, or coupled ones, against the same motion made of pivots and sliders with
// massless bodies between: elimination is exact for those too, so both must agree: to round-off where the
// coordinates are the same, to RK4's error (1e-10 here) where they are not.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/screw.hpp>
#include <pantin/physics/constraints/universal.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::joint_here;
using test::lopsided_mass;
using test::run;

/// An arm on a pivot, then the joint in question, then a body that carries another on a ball joint.
struct Rig {
  PhysicsManager physics{};
  BodyId arm{}, load{}, tail{};
  std::vector<JointId> joints{};
  Pose X_WJ{{0.6, 0.1, 0.2}, Quaternion{Eigen::AngleAxisd{0.8, Vector3{1, 2, 3}.normalized()}}};

  Rig() {
    physics.forces().add(Gravity{.g_W = {1, -2, -9}});
    RigidBodySettings s{.name = "arm", .mass = lopsided_mass()};
    arm = physics.add(std::move(s));
    physics.add(
        joint_here<PivotSettings>(physics, BodyId{}, arm, Pose{{0.1, 0, 0}, test::facing({1, 1, 0})}));
    load =
        physics.add(RigidBodySettings{.name = "load", .X_WB = {{0.9, 0.2, 0.1}}, .mass = lopsided_mass(2)});
    tail =
        physics.add(RigidBodySettings{.name = "tail", .X_WB = {{1.3, 0.2, 0.1}}, .mass = lopsided_mass(0.5)});
    physics.add(joint_here<BallSettings>(physics, load, tail, Pose{{1.1, 0.2, 0.1}}));
  }

  /// A body without mass whose origin stands at J.
  BodyId between(const std::string& name) {
    RigidBodySettings s{.name = name, .X_WB = X_WJ};
    s.mass = {0, Vector3::Zero(), Matrix3::Zero()};
    return physics.add(std::move(s));
  }
  template <class Settings>
  void join(BodyId a, BodyId b, const Quaternion& turned = Quaternion::Identity()) {
    joints.push_back(physics.add(joint_here<Settings>(physics, a, b, X_WJ * Pose{Vector3::Zero(), turned})));
  }
  void set_rates(const std::vector<JointNumbers>& rates) {
    for (std::size_t i = 0; i < joints.size(); ++i) physics.set_joint_rate(joints[i], rates[i]);
  }
};

void expect_same_motion(Rig& one, Rig& other) {
  ASSERT_TRUE(run(one.physics, 1e-3, 500));
  ASSERT_TRUE(run(other.physics, 1e-3, 500));
  for (const auto body : {&Rig::arm, &Rig::load, &Rig::tail}) {
    const RigidBody a = one.physics.body(one.*body), b = other.physics.body(other.*body);
    EXPECT_LT((a.p_WBcm() - b.p_WBcm()).norm(), 2e-10);
    EXPECT_LT(a.q_WB().angularDistance(b.q_WB()), 2e-10);
    EXPECT_LT((a.angular_momentum() - b.angular_momentum()).norm(), 1e-9);
  }
  EXPECT_LT(one.physics.joint_drift().distance, 1e-14);
  EXPECT_LT(one.physics.joint_drift().angle, 1e-7);
}

const Quaternion kXAlongZ{Eigen::AngleAxisd{M_PI / 2, Vector3::UnitY()}};   // z of the turned frame is x of J
const Quaternion kYAlongZ{Eigen::AngleAxisd{-M_PI / 2, Vector3::UnitX()}};  // z of the turned frame is y of J

TEST(Universal, MovesAsTwoPivotsWithAMasslessCross) {
  // From either side: as seen from b the second turn comes first, which the solver sees as the same kind in
  // other frames.
  for (const bool reversed : {false, true}) {
    Rig one, two;
    if (reversed) one.join<UniversalSettings>(one.load, one.arm);
    else one.join<UniversalSettings>(one.arm, one.load);
    const BodyId cross = two.between("cross");
    const BodyId first = reversed ? two.load : two.arm, second = reversed ? two.arm : two.load;
    two.join<PivotSettings>(first, cross);
    two.join<PivotSettings>(cross, second, kXAlongZ);
    one.set_rates({{2, -3}});
    two.set_rates({2.0, -3.0});
    expect_same_motion(one, two);
    const JointNumbers angles = one.physics.joint_value(one.joints[0]),
                       rates = one.physics.joint_rate(one.joints[0]);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(angles[i], two.physics.joint_value(two.joints[static_cast<std::size_t>(i)]), 1e-11);
      EXPECT_NEAR(rates[i], two.physics.joint_rate(two.joints[static_cast<std::size_t>(i)]), 1e-10);
    }
  }
}

TEST(Cylindrical, MovesAsAPivotAndASlider) {
  // About and along one axis.
  for (const bool reversed : {false, true}) {
    Rig one, two;
    if (reversed) one.join<CylindricalSettings>(one.load, one.arm);
    else one.join<CylindricalSettings>(one.arm, one.load);
    const BodyId ring = two.between("ring");
    const BodyId first = reversed ? two.load : two.arm, second = reversed ? two.arm : two.load;
    two.join<PivotSettings>(first, ring);
    two.join<SliderSettings>(ring, second);
    one.set_rates({{2, -0.3}});
    two.set_rates({2.0, -0.3});
    expect_same_motion(one, two);
    EXPECT_NEAR(one.physics.joint_value(one.joints[0])[0], two.physics.joint_value(two.joints[0]), 1e-11);
    EXPECT_NEAR(one.physics.joint_rate(one.joints[0])[1], two.physics.joint_rate(two.joints[1]), 1e-10);
  }
}

TEST(Planar, MovesAsTwoSlidersAndAPivot) {
  // Along x, along y, then about z.
  for (const bool reversed : {false, true}) {
    Rig one, two;
    if (reversed) one.join<PlanarSettings>(one.load, one.arm);
    else one.join<PlanarSettings>(one.arm, one.load);
    const BodyId x = two.between("x"), y = two.between("y");
    two.join<SliderSettings>(reversed ? two.load : two.arm, x, kXAlongZ);
    two.join<SliderSettings>(x, y, kYAlongZ);
    two.join<PivotSettings>(y, reversed ? two.arm : two.load);
    one.set_rates({{0.5, -0.3, 4}});
    two.set_rates({0.5, -0.3, 4.0});
    expect_same_motion(one, two);
    for (int i = 0; i < 3; ++i) {
      const JointId part = two.joints[static_cast<std::size_t>(i)];
      EXPECT_NEAR(one.physics.joint_value(one.joints[0])[i], two.physics.joint_value(part), 2e-10);
      EXPECT_NEAR(one.physics.joint_rate(one.joints[0])[i], two.physics.joint_rate(part), 1e-9);
    }
  }
}

TEST(Screw, FallsAsItsThreadLets) {
  // Closed form: a nut on a vertical thread of pitch h has the energy (I + m h^2) w^2 / 2 - m g h a, so it
  // turns at the constant acceleration m g h / (I + m h^2); RK4 is exact for that.
  const double m = 2, h = 0.05, I = 0.004, g = 9.81;
  for (const bool reversed : {false, true}) {
    PhysicsManager physics;
    physics.forces().add(Gravity{.g_W = {0, 0, -g}});
    RigidBodySettings nut{.name = "nut", .X_WB = {{0.2, 0, 1}}};
    nut.mass = {m, Vector3::Zero(), Vector3{0.003, 0.003, I}.asDiagonal()};
    const BodyId id = physics.add(std::move(nut));
    RigidBodySettings post{.name = "post"};
    const BodyId ground = physics.add(std::move(post));
    physics.make_static(ground);
    ScrewSettings s = reversed ? joint_here<ScrewSettings>(physics, id, ground, Pose{{0.2, 0, 1}})
                               : joint_here<ScrewSettings>(physics, ground, id, Pose{{0.2, 0, 1}});
    s.pitch = h;
    const JointId screw = physics.add(std::move(s));
    ASSERT_TRUE(run(physics, 1e-2, 100));
    // Down is against the thread: both ends see the same positive turning or the same negative one.
    const double a = -m * g * h / (I + m * h * h) / 2;
    EXPECT_NEAR(physics.body(id).p_WBcm().z(), 1 + h * a, 1e-12);
    EXPECT_NEAR(physics.joint_value(screw), reversed ? -a : a, 1e-10);
    EXPECT_NEAR(physics.joint_rate(screw), reversed ? -2 * a : 2 * a, 1e-10);
    EXPECT_LT(physics.joint_drift().distance, 1e-14);
  }
}

TEST(Screw, KeepsMomentumAndEnergyBetweenFloatingBodies) {
  // No outer force: momentum, angular momentum and energy of the pair stay; RK4 keeps the latter two to 1e-9
  // here.
  PhysicsManager physics;
  const BodyId a = physics.add(RigidBodySettings{.name = "a", .w_WB = {1, 2, -3}, .mass = lopsided_mass()});
  const BodyId b =
      physics.add(RigidBodySettings{.name = "b", .X_WB = {{0.3, 0.2, 0}}, .mass = lopsided_mass(2)});
  ScrewSettings s = joint_here<ScrewSettings>(physics, a, b, Pose{{0.2, 0.1, 0}, test::facing({1, 2, 2})});
  s.pitch = 0.1;
  const JointId screw = physics.add(std::move(s));
  physics.set_joint_rate(screw, 8.0);
  ASSERT_TRUE(run(physics, 1e-6, 1));
  const test::Momenta start = test::momenta_of(physics);
  const double energy = physics.energy().total();
  ASSERT_TRUE(run(physics, 5e-4, 2000));
  const test::Momenta end = test::momenta_of(physics);
  EXPECT_LT((end.linear - start.linear).norm(), 1e-10);
  EXPECT_LT((end.angular - start.angular).norm(), 1e-8);
  EXPECT_NEAR(physics.energy().total(), energy, 1e-8 * energy);
  EXPECT_GT(std::abs(physics.joint_value(screw)), 2 * M_PI);
}

TEST(CompoundJoints, GiveBackTheValuesAndRatesSet) {
  // What is set is read, turns included; poses are those of the coordinates, as joint_pose says.
  Rig rig;
  rig.join<PlanarSettings>(rig.arm, rig.load);
  const BodyId fork =
      rig.physics.add(RigidBodySettings{.name = "fork", .X_WB = {{2, 0, 0}}, .mass = lopsided_mass()});
  rig.join<UniversalSettings>(fork, rig.tail);
  const BodyId rod =
      rig.physics.add(RigidBodySettings{.name = "rod", .X_WB = {{2, 1, 0}}, .mass = lopsided_mass()});
  rig.join<CylindricalSettings>(rod, fork);
  const std::vector<JointNumbers> values{{0.1, -0.2, 7.0}, {-8.0, 1.2}, {20.0, 0.4}};
  const std::vector<JointNumbers> rates{{1, 2, 3}, {-4, 5}, {6, -7}};
  for (std::size_t i = 0; i < 3; ++i) {
    rig.physics.set_joint_value(rig.joints[i], values[i]);
    rig.physics.set_joint_rate(rig.joints[i], rates[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const JointDefinition& joint = rig.physics.joint(rig.joints[i]);
    const JointNumbers value = rig.physics.joint_value(rig.joints[i]),
                       rate = rig.physics.joint_rate(rig.joints[i]);
    for (int k = 0; k < values[i].size(); ++k) {
      EXPECT_NEAR(value[k], values[i][k], 1e-13);
      EXPECT_NEAR(rate[k], rates[i][k], 1e-12);
    }
    const Pose X_AB = inverse(rig.physics.body(joint.a).X_WB()) * rig.physics.body(joint.b).X_WB();
    const Pose expected = joint.X_AJ * joint_pose(joint, values[i]) * inverse(joint.X_BJ);
    EXPECT_LT((X_AB.p - expected.p).norm(), 1e-14);
    EXPECT_LT(X_AB.q.angularDistance(expected.q), 1e-7);  // near 0 an angular distance has half the digits
  }
}

TEST(CompoundJoints, DampEachMotionByItsOwn) {
  // Closed form: on a fixed axis the angle slows as exp(-c t / I), the distance as exp(-d t / m). RK4 at 100
  // steps a time constant errs by 1e-10.
  PhysicsManager physics;
  RigidBodySettings s{.name = "sleeve"};
  s.mass = {2, Vector3::Zero(), Vector3{0.3, 0.3, 0.5}.asDiagonal()};
  const BodyId sleeve = physics.add(std::move(s));
  const JointId joint =
      physics.add(CylindricalSettings{.b = sleeve, .angular_damping = 0.25, .linear_damping = 3});
  physics.set_joint_rate(joint, {4, 5});
  ASSERT_TRUE(run(physics, 1e-2, 100));
  EXPECT_NEAR(physics.joint_rate(joint)[0], 4 * std::exp(-0.25 / 0.5), 1e-9);
  EXPECT_NEAR(physics.joint_rate(joint)[1], 5 * std::exp(-3.0 / 2), 1e-9);
}

}  // namespace
}  // namespace pantin
