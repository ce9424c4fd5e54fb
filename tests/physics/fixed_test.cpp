#include <pantin/physics/constraints/fixed.hpp>

#include <gtest/gtest.h>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::joint_here;
using test::lopsided_mass;
using test::run;

TEST(Fixed, MakesTwoBodiesMoveAsOne) {
  // Two bodies welded together move like one body with their combined mass properties.
  const Pose X_AB{{0.4, 0.1, -0.3}, Quaternion{Eigen::AngleAxisd{0.8, Vector3::UnitY()}}};
  PhysicsManager pair;
  const BodyId a = pair.add(RigidBodySettings{.name = "a", .mass = lopsided_mass(2)});
  const BodyId b = pair.add(RigidBodySettings{.name = "b", .X_WB = X_AB, .mass = lopsided_mass(1)});
  pair.add(joint_here<FixedSettings>(pair, a, b, {{0.2, 0, 0}, Quaternion::Identity()}));
  PhysicsManager single;
  const std::array parts{lopsided_mass(2), in_frame(X_AB, lopsided_mass(1))};
  const BodyId one = single.add(RigidBodySettings{.name = "one", .mass = combined(parts)});
  pair.apply_impulse(a, {1, 2, 3}, {0.3, 0.2, 0.1});
  single.apply_impulse(one, {1, 2, 3}, {0.3, 0.2, 0.1});
  ASSERT_TRUE(run(pair, 1e-3, 2000));
  ASSERT_TRUE(run(single, 1e-3, 2000));
  // Both are solved by RK4 in different variables (rates, momenta): they differ by the error of the method.
  EXPECT_LT((pair.body(a).X_WB().p - single.body(one).X_WB().p).norm(), 1e-9);
  EXPECT_LT(pair.body(a).q_WB().angularDistance(single.body(one).q_WB()), 1e-9);
  EXPECT_LT(pair.joint_drift().distance, 1e-14);
}

TEST(Fixed, TransmitsWhatTheFarBodyNeeds) {
  // Pushing A with force F accelerates both by F / (m_a + m_b); the weld gives B its share m_b F / (m_a +
  // m_b).
  PhysicsManager physics;
  MassProperties mass;
  mass.mass = 2;
  const BodyId a = physics.add(RigidBodySettings{.name = "a", .mass = mass});
  mass.mass = 3;
  const BodyId b = physics.add(RigidBodySettings{.name = "b", .X_WB = {{1, 0, 0}}, .mass = mass});
  const JointId weld =
      physics.add(joint_here<FixedSettings>(physics, a, b, {{0.5, 0, 0}, Quaternion::Identity()}));
  physics.apply_force(a, {10, 0, 0});
  EXPECT_LT((physics.reaction(weld).force - Vector3{6, 0, 0}).norm(), 1e-13);
  EXPECT_LT(physics.reaction(weld).torque.norm(), 1e-13);
}

TEST(Fixed, HoldsABodyInTheWorld) {
  // Welded to the world nothing moves, and the weld carries weight and its moment.
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  MassProperties mass;
  mass.mass = 2;
  const BodyId a = physics.add(RigidBodySettings{.name = "a", .X_WB = {{1, 0, 0}}, .mass = mass});
  const JointId weld = physics.add(joint_here<FixedSettings>(physics, BodyId{}, a, Pose{}));
  ASSERT_TRUE(run(physics, 0.01, 100));
  EXPECT_EQ(physics.body(a).p_WBcm(), Vector3(1, 0, 0));
  EXPECT_LT((physics.reaction(weld).force - Vector3{0, 0, 20}).norm(), 1e-13);
  EXPECT_LT((physics.reaction(weld).torque - Vector3{0, -20, 0}).norm(), 1e-13);
}

}  // namespace
}  // namespace pantin
