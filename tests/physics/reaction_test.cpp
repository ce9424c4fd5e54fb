#include <gtest/gtest.h>

#include <cmath>

#include "support/contracts.hpp"
#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::facing;
using test::joint_here;
using test::run;

MassProperties point_like(double mass) {
  MassProperties m;
  m.mass = mass;
  m.I_BBcm_B = 1e-4 * Matrix3::Identity();
  return m;
}

TEST(Reaction, CarriesTheWeightOfAHangingChain) {
  // Each ball joint of a chain at rest carries the weight below it, whatever the joints' order of definition.
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  std::vector<JointId> joints;
  BodyId last{};
  for (int i = 0; i < 6; ++i) {
    const BodyId id = physics.add(RigidBodySettings{.X_WB = {{0, 0, -1.0 - i}}, .mass = point_like(1 + i)});
    const Pose here{{0, 0, -0.5 - i}, Quaternion::Identity()};
    joints.push_back(i % 2 == 1 ? physics.add(joint_here<BallSettings>(physics, id, last, here))
                                : physics.add(joint_here<BallSettings>(physics, last, id, here)));
    last = id;
  }
  double below = 0;
  for (int i = 5; i >= 0; --i) {
    below += 1 + i;
    const double sign = i % 2 == 1 ? -1 : 1;  // named from below, the upper body is B: pulled down
    const Wrench r = physics.reaction(joints[static_cast<std::size_t>(i)]);
    EXPECT_LT((r.force - sign * Vector3{0, 0, 10 * below}).norm(), 1e-11);
    EXPECT_LT(r.torque.norm(), 1e-12);
  }
}

TEST(Reaction, AddsTheCentripetalForceAtTheBottomOfASwing) {
  // At the lowest point the pivot pulls with m g + m w^2 l (Newton), and takes no torque about its axis.
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  const BodyId bob =
      physics.add(RigidBodySettings{.name = "bob", .X_WB = {{0, 0, -2}}, .mass = point_like(3)});
  const JointId pivot =
      physics.add(joint_here<PivotSettings>(physics, BodyId{}, bob, {Vector3::Zero(), facing({0, 1, 0})}));
  physics.set_joint_rate(pivot, 1.5);
  const Wrench r = physics.reaction(pivot);
  EXPECT_LT((r.force - Vector3{0, 0, 3 * 10 + 3 * 1.5 * 1.5 * 2}).norm(), 1e-12);
  EXPECT_LT(r.torque.norm(), 1e-12);
}

TEST(Reaction, DrivesAShaker) {
  // A body driven along x against the world needs F = m s'' along x and m g against its weight.
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  const BodyId body = physics.add(RigidBodySettings{.name = "load", .mass = point_like(2)});
  const JointId shaker = physics.add(DrivenSettings{
      .name = "shaker", .b = body, .driver = std::make_unique<test::FunctionDriver>([](double t, Side) {
                                     RigidMotion m;
                                     m.X_AB.p = {std::sin(3 * t), 0, 0};
                                     m.v_AB = {3 * std::cos(3 * t), 0, 0};
                                     m.a_AB = {-9 * std::sin(3 * t), 0, 0};
                                     return m;
                                   })});
  ASSERT_TRUE(run(physics, 0.01, 30));
  const Wrench r = physics.reaction(shaker);
  EXPECT_LT((r.force - Vector3{-18 * std::sin(0.9), 0, 20}).norm(), 1e-12);
}

}  // namespace
}  // namespace pantin
