#include <pantin/physics/constraints/coupling_row.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/screw.hpp>
#include <pantin/physics/constraints/universal.hpp>
#include <pantin/physics/integrators/gauss.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::joint_here;
using test::run;

/// Two arms on pivots at the ground, and a body on each by the joint under test, whose A is the arm, or the
/// body where `reversed`, so that the tree sees it from its B.
template <class Settings>
struct Pair {
  PhysicsManager physics{};
  std::vector<JointId> joints{};

  Pair(bool reversed, const Settings& like) {
    physics.forces().add(Gravity{.g_W = {1, -3, -9.81}});
    physics.set_integrator(make_gauss({.stages = 8}));
    for (const double side : {0.0, 1.0}) {
      const Vector3 at{side, 0, 0};
      const Quaternion turned{Eigen::AngleAxisd{0.4 + side, Vector3{1, 2, 3}.normalized()}};
      const BodyId arm = physics.add(RigidBodySettings{
          .name = "arm", .X_WB = {at, Quaternion::Identity()}, .mass = test::lopsided_mass()});
      const BodyId tip = physics.add(RigidBodySettings{
          .name = "tip", .X_WB = {at + Vector3{0.1, 0.3, 0}, turned}, .mass = test::lopsided_mass(0.7)});
      physics.add(joint_here<PivotSettings>(physics, BodyId{}, arm, {at, test::facing({0, 1, 0})}));
      Settings s = joint_here<Settings>(physics, reversed ? tip : arm, reversed ? arm : tip,
                                        {at + Vector3{0.1, 0.2, 0.1}, turned}, "joint");
      if constexpr (requires { s.pitch; }) s.pitch = like.pitch;
      joints.push_back(physics.add(s));
    }
  }
};

/// Geared by a ratio of -1.3, the numbers keep to it and the energy stays, on either side: were the gradient
/// of a number or its change wrong, the multipliers would do work, or settling would take motion away.
template <class Settings>
void expect_lossless(int axis_a, int axis_b, const Settings& like = {}) {
  for (const bool reversed : {false, true}) {
    Pair<Settings> pair{reversed, like};
    const GearSettings gear{.a = pair.joints[0],
                            .axis_a = axis_a,
                            .b = pair.joints[1],
                            .axis_b = axis_b,
                            .ratio = -1.3,
                            .offset = 0.2};
    const CouplingId id = pair.physics.add(gear);
    static_cast<void>(pair.physics.snapshot());
    const double start = pair.physics.energy().total();
    ASSERT_TRUE(run(pair.physics, 0.002, 250));
    const double a = pair.physics.joint_value(gear.a)[axis_a], b = pair.physics.joint_value(gear.b)[axis_b];
    EXPECT_NEAR(b, -1.3 * a + 0.2, 1e-12) << reversed;
    EXPECT_GT(std::abs(pair.physics.joint_rate(gear.a)[axis_a]), 1e-2) << "it moves, or this shows little";
    EXPECT_NEAR(pair.physics.joint_rate(gear.b)[axis_b], -1.3 * pair.physics.joint_rate(gear.a)[axis_a],
                1e-10)
        << reversed;
    EXPECT_GT(std::abs(pair.physics.coupling_effort(id)), 1e-3);
    EXPECT_NEAR(pair.physics.energy().total(), start, 1e-9) << reversed;
  }
}

TEST(CouplingRow, DoesNoWorkOnPivots) {
  // See expect_lossless; the same for all kinds below.
  expect_lossless<PivotSettings>(0, 0);
}

TEST(CouplingRow, DoesNoWorkOnSlidersAndScrews) {
  // See expect_lossless.
  expect_lossless<SliderSettings>(0, 0);
  expect_lossless<ScrewSettings>(0, 0, {.pitch = 0.1});
}

TEST(CouplingRow, DoesNoWorkOnCylindricalAndUniversalJoints) {
  // Each number with each other one: angles with distances, first with second axes.
  for (const auto& [a, b] : {std::pair{0, 0}, {0, 1}, {1, 0}}) {
    expect_lossless<CylindricalSettings>(a, b);
    expect_lossless<UniversalSettings>(a, b);
  }
}

TEST(CouplingRow, DoesNoWorkOnPlanarJoints) {
  // Seen from its other side, a planar joint's distances depend on its angle, and change with its rate.
  for (const auto& [a, b] : {std::pair{0, 0}, {0, 1}, {1, 2}, {2, 1}}) expect_lossless<PlanarSettings>(a, b);
}

}  // namespace
}  // namespace pantin
