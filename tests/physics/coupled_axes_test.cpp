#include <pantin/physics/stops/coupled_axes.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <support/mechanisms.hpp>

namespace pantin {
namespace {

constexpr double kInertia = 0.5;  // of each wheel about its axle [kg m^2]

/// Two wheels on axles along z, geared so that the second turns `ratio` times as far as the first.
struct Wheels {
  Wheels(double ratio, const JointAxis& of_first, const JointAxis& of_second) {
    first = add_wheel("first", 0, of_first);
    second = add_wheel("second", 1, of_second);
    physics.add(GearSettings{.a = first, .b = second, .ratio = ratio});
    physics.set_integrator(make_integrator("gauss16", 1e-12));
  }
  JointId add_wheel(const char* name, double x, const JointAxis& axis) {
    RigidBodySettings s;
    s.name = name;
    s.X_WB.p = {x, 0, 0};
    s.mass.mass = 1;
    s.mass.I_BBcm_B = Vector3{kInertia, kInertia, kInertia}.asDiagonal();
    const BodyId body = physics.add(std::move(s));
    return physics.add(PivotSettings{.name = name, .b = body, .X_AJ = {{x, 0, 0}}, .axis = axis});
  }
  void step_until(double t, int steps = 10) {
    const double h = (t - physics.time()) / steps;
    for (int i = 0; i < steps; ++i) ASSERT_TRUE(physics.step(h).ok());
  }
  PhysicsManager physics{};
  JointId first{}, second{};
};

TEST(CoupledAxes, AStopOfWhatIsLedStopsTheLeaderToo) {
  // The second wheel may turn to 0.6 rad, against the first's turn: at ratio -2 the first meets that at -0.3
  // rad. Both turn evenly until then, rest from then on, and the blow is one event.
  Wheels wheels{-2, {}, {.upper = 0.6}};
  wheels.physics.set_joint_rate(wheels.first, -1.0);
  wheels.step_until(0.29);
  EXPECT_NEAR(wheels.physics.joint_value(wheels.first), -0.29, 1e-12);
  wheels.step_until(1);
  EXPECT_NEAR(wheels.physics.joint_value(wheels.first), -0.3, 1e-9);
  EXPECT_NEAR(wheels.physics.joint_value(wheels.second), 0.6, 1e-9);
  EXPECT_EQ(wheels.physics.joint_rate(wheels.first), 0.0);
}

TEST(CoupledAxes, FrictionOfBothBrakesTheirCommonMotion) {
  // Both slide at once: friction on the first is F1 + |ratio| F2, what turns is I (1 + ratio^2). From the
  // rate w it comes to rest after w^2 I (1 + ratio^2) / (2 (F1 + |ratio| F2)), and stays.
  const double ratio = 3, F1 = 0.2, F2 = 0.1, w = 2;
  Wheels wheels{ratio, {.friction = F1}, {.friction = F2}};
  wheels.physics.set_joint_rate(wheels.first, w);
  const double way = w * w * kInertia * (1 + ratio * ratio) / (2 * (F1 + ratio * F2));
  wheels.step_until(2 * way / w * 1.5);
  EXPECT_NEAR(wheels.physics.joint_value(wheels.first), way, 1e-8 * way);
  EXPECT_EQ(wheels.physics.joint_rate(wheels.first), 0.0);
  EXPECT_EQ(wheels.physics.axis_mode(wheels.first), AxisMode::Stuck);
  const double before = wheels.physics.joint_value(wheels.first);
  wheels.step_until(wheels.physics.time() + 10);
  EXPECT_EQ(wheels.physics.joint_value(wheels.first), before);
}

TEST(CoupledAxes, TheNarrowerStopCounts) {
  // The first wheel's own stop at 0.2 rad lies before that of the second, at 0.9 / 3.
  Wheels wheels{3, {.upper = 0.2, .restitution = 1}, {.upper = 0.9}};
  wheels.physics.set_joint_rate(wheels.first, 1.0);
  wheels.step_until(0.3);  // back by 0.1 from 0.2: a blow without loss
  EXPECT_NEAR(wheels.physics.joint_value(wheels.first), 0.1, 1e-9);
  EXPECT_NEAR(wheels.physics.joint_rate(wheels.second), -3.0, 1e-9);
}

}  // namespace
}  // namespace pantin
