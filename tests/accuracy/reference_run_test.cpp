#include "reference_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pantin::test {
namespace {

TEST(AttitudeError, IsTheAngleOfTheRelativeRotation) {
  // By construction: two attitudes that differ by a known rotation, small ones included, where an arc cosine
  // of a number near 1 would return 0 or 1e-8.
  const Quaternion q = Quaternion{0.3, -0.5, 0.7, 0.4}.normalized();
  const Vector3 axis = Vector3{1, 2, -2} / 3;
  for (const double angle : {3.0, 1.0, 1e-3, 1e-8, 1e-12}) {
    const Quaternion turned = q * Quaternion{Eigen::AngleAxisd{angle, axis}};
    // Rounding of two unit quaternions: 1e-15.
    EXPECT_NEAR(attitude_error(q, turned), angle, 2e-15) << angle;
    EXPECT_NEAR(attitude_error(turned, q), angle, 2e-15) << angle;
  }
}

TEST(AttitudeError, DoesNotSeeTheSignOfAQuaternion) {
  // q and -q are one rotation.
  const Quaternion q = Quaternion{0.3, -0.5, 0.7, 0.4}.normalized();
  const Quaternion minus_q{-q.w(), -q.x(), -q.y(), -q.z()};
  EXPECT_LT(attitude_error(q, minus_q), 1e-15);
}

/// A body in free flight with one wrong sample.
ReferenceProblem wrong_by(const Vector3& shift, double angle) {
  ReferenceProblem problem{.name = "made up", .duration = 1};
  problem.bodies.push_back({.name = "b", .v_WBcm = {1, 0, 0}});
  const Quaternion q{Eigen::AngleAxisd{angle, Vector3::UnitX()}};
  problem.samples.push_back(
      {.t = 0.5, .bodies = {{.name = "b", .p_WBcm = Vector3{0.5, 0, 0} + shift, .q_WB = q}}});
  problem.samples.push_back({.t = 1, .bodies = {{.name = "b", .p_WBcm = Vector3{1, 0, 0}}}});
  return problem;
}

TEST(ReferenceRun, MeasuresWhatASampleIsOffBy) {
  // The flight is exact (uniform motion), so the error is what was put into the samples; the maximum is kept
  // although the last sample is right.
  const RunErrors errors = run(wrong_by({0, 3e-3, 4e-3}, 0.2), {.step = 0.3});
  EXPECT_EQ(errors.failure, "");
  EXPECT_EQ(errors.compared, 2u);
  EXPECT_NEAR(errors.position, 5e-3, 1e-15);
  EXPECT_NEAR(errors.attitude, 0.2, 1e-15);
}

TEST(ReferenceRun, ComparesParticlesAndTheirEnergy) {
  // A particle in uniform motion is 5 mm off one of its samples, and its 2 J off the stated 1 J.
  ReferenceProblem problem{.name = "made up", .duration = 1};
  problem.particles.push_back({.name = "p", .mass = 1, .v_W = {2, 0, 0}});
  problem.samples.push_back({.t = 0.5, .bodies = {{.name = "p", .p_WBcm = Vector3{1, 3e-3, 4e-3}}}});
  problem.samples.push_back({.t = 1, .energy = reference::SampleEnergy{.kinetic = 1, .total = 1}});
  const RunErrors errors = run(problem, {.step = 0.3});
  EXPECT_EQ(errors.failure, "");
  EXPECT_EQ(errors.compared, 1u);
  EXPECT_NEAR(errors.position, 5e-3, 1e-15);
  EXPECT_NEAR(errors.energy, 1, 1e-14);
}

TEST(ReferenceRun, StopsAtTheLastSampleThatCounts) {
  // The wrong sample lies behind the end.
  ReferenceProblem problem = wrong_by(Vector3::Zero(), 0);
  problem.samples.back().bodies.front().p_WBcm = Vector3{9, 9, 9};
  EXPECT_LT(run(problem, {.step = 0.3, .until = 0.5}).position, 1e-15);
  problem.duration = 0.7;
  EXPECT_LT(run(problem, {.step = 0.3}).position, 1e-15);
}

TEST(ReferenceRun, TellsWhyAProblemCannotBeBuilt) {
  // A contact is refused; the reason is not lost.
  ReferenceProblem problem = wrong_by(Vector3::Zero(), 0);
  problem.contacts.push_back({.pair = reference::SphereOnPlane{.body = "b", .radius = 1}});
  EXPECT_NE(run(problem, {}).failure.find("contact sphere_plane"), std::string::npos);
}

}  // namespace
}  // namespace pantin::test
