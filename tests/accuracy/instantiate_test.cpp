#include <gtest/gtest.h>

#include <cmath>

#include <pantin/bridge/problems/rigid_ref.hpp>

#include "good_problem.hpp"
#include "reference_run.hpp"

namespace pantin::test {
namespace {

using nlohmann::json;

ReferenceProblem problem_of(const json& text) {
  Loaded<ReferenceProblem> read = parse_rigid_ref(text.dump(), "f");
  if (!read.value) ADD_FAILURE() << lines(read.notes);
  return read.value.value_or(ReferenceProblem{});
}

TEST(Instantiate, BuildsBodiesAsTheyAreGiven) {
  // What the file says, read back from physics; rounding of one rotation.
  PhysicsManager physics;
  const Loaded<ReferenceInstance> built = instantiate(problem_of(buildable()), physics);
  ASSERT_TRUE(built.value.has_value()) << lines(built.notes);
  EXPECT_EQ(built.value->bodies.size(), 3u);
  EXPECT_EQ(built.value->joints.size(), 2u);
  EXPECT_EQ(built.value->forces.size(), 6u);  // gravity and five of the file
  const RigidBody rod = physics.body(built.value->bodies.at("rod"));
  EXPECT_EQ(rod.name(), "rod");
  EXPECT_EQ(rod.kind(), BodyKind::Simulated);
  EXPECT_EQ(rod.mass(), 2);
  EXPECT_LT((rod.p_WBcm() - Vector3{0.5, 2, 3}).norm(), 1e-15);
  EXPECT_LT((rod.X_WB().p - Vector3{1, 2, 3}).norm(), 1e-15);
  EXPECT_LT((rod.v_WBcm() - Vector3{0, -1.5, 0}).norm(), 1e-15);
  EXPECT_LT((rod.w_WB() - Vector3{0, 0, 3}).norm(), 1e-14);
  EXPECT_EQ(physics.body(built.value->bodies.at("arm")).kind(), BodyKind::Animated);
}

TEST(Instantiate, BuildsParticlesByName) {
  // What the file says, read back; each is alone in its system, so that a law can be meant for it alone.
  PhysicsManager physics;
  const Loaded<ReferenceInstance> built = instantiate(problem_of(buildable()), physics);
  ASSERT_TRUE(built.value.has_value()) << lines(built.notes);
  const ParticleId p = built.value->particles.at("p");
  const ParticleSystem system = physics.particles().system(p.system);
  ASSERT_EQ(system.size(), 1u);
  EXPECT_EQ(system.name(), "p");
  EXPECT_EQ(system.mass(0), 0.5);
  EXPECT_EQ(system.p_WP(0), Vector3(0, 0, 1));
  EXPECT_EQ(system.v_WP(0), Vector3(1, 0, 0));
}

/// Two particles, the first of them at (1, 0, 0), and nothing else but what is given.
json two_particles(const json& force) {
  json problem = buildable();
  for (const char* part : {"bodies", "kinematic_bodies", "joints"}) problem[part] = json::array();
  problem["particles"] = {{{"name", "p"}, {"mass", 0.5}, {"position", {1, 0, 0}}, {"velocity", {0, 0, 0}}},
                          {{"name", "r"}, {"mass", 1.5}, {"position", {3, 0, 0}}, {"velocity", {0, 1, 0}}}};
  problem["gravity"] = {0, 0, 0};
  problem["forces"] = {force};
  problem["samples"] = {{{"t", 0}}};
  return problem;
}

TEST(Instantiate, MeansALawForTheParticleItNames) {
  // The pull at 1 m from the centre with mu = 4 is 4 m/s^2 towards it: after 1 ms p has -4e-3 m/s, to a
  // relative 1e-6 for the change of the pull, and r its velocity to the bit.
  const json force = {{"type", "central_gravity"}, {"particle", "p"}, {"center", {0, 0, 0}}, {"mu", 4}};
  PhysicsManager physics;
  const Loaded<ReferenceInstance> built = instantiate(problem_of(two_particles(force)), physics);
  ASSERT_TRUE(built.value.has_value()) << lines(built.notes);
  ASSERT_TRUE(physics.step(1e-3).ok());
  const auto velocity = [&](const char* name) {
    return physics.particles().system(built.value->particles.at(name).system).v_WP(0);
  };
  EXPECT_NEAR(velocity("p").x(), -4e-3, 1e-8);
  EXPECT_EQ(velocity("r"), Vector3(0, 1, 0));
}

TEST(Instantiate, TiesTwoParticlesByASpring) {
  // 10 N/m stretched from 1 m to 2 m pulls with 10 N: p (0.5 kg) gets 20 m/s^2 along +x, r (1.5 kg) the
  // opposite momentum, exactly.
  const json force = {{"type", "spring_damper_point_to_point"},
                      {"a", {{"body", "p"}}},
                      {"b", {{"body", "r"}}},
                      {"stiffness", 10},
                      {"rest_length", 1}};
  PhysicsManager physics;
  const Loaded<ReferenceInstance> built = instantiate(problem_of(two_particles(force)), physics);
  ASSERT_TRUE(built.value.has_value()) << lines(built.notes);
  ASSERT_TRUE(physics.step(1e-3).ok());
  const Vector3 p = physics.particles().system(built.value->particles.at("p").system).v_WP(0);
  const Vector3 r = physics.particles().system(built.value->particles.at("r").system).v_WP(0);
  EXPECT_NEAR(p.x(), 20e-3, 1e-6);
  EXPECT_LT((0.5 * p + 1.5 * r - Vector3(0, 1.5, 0)).norm(), 1e-15);
}

TEST(Instantiate, StartsJointsAtZeroWithTheFilesAxisAndSense) {
  // The rod turns at 3 rad/s about +z against the world, so the hinge's rate is +3; the start pose is zero.
  PhysicsManager physics;
  const Loaded<ReferenceInstance> built = instantiate(problem_of(buildable()), physics);
  ASSERT_TRUE(built.value.has_value());
  const JointId hinge = built.value->joints.at("hinge");
  EXPECT_NEAR(double{physics.joint_value(hinge)}, 0, 1e-15);
  EXPECT_NEAR(double{physics.joint_rate(hinge)}, 3, 1e-14);
  EXPECT_LT(physics.joint_drift().distance, 1e-15);
}

TEST(Instantiate, ExchangesTheEndsOfAJointWhoseSecondIsTheWorld) {
  // B against A is then the world against the rod: -3 rad/s about +z.
  json problem = buildable();
  problem["joints"][0]["body_a"] = "rod";
  problem["joints"][0]["body_b"] = "world";
  PhysicsManager physics;
  const Loaded<ReferenceInstance> built = instantiate(problem_of(problem), physics);
  ASSERT_TRUE(built.value.has_value()) << lines(built.notes);
  EXPECT_NEAR(double{physics.joint_rate(built.value->joints.at("hinge"))}, -3, 1e-14);
}

TEST(Instantiate, MovesKinematicBodiesByTheirLaw) {
  // angle(t) = 0.5 sin(2 t + 0.3) + 0.7 t; the start attitude belongs to t = 0, so the arm has turned by
  // angle(t) - angle(0) about y. Rates are central differences' limits, known in closed form.
  json text = buildable();
  text["kinematic_bodies"][0]["law"] = {
      {"type", "sine"}, {"amplitude", 0.5}, {"omega", 2}, {"phase", 0.3}, {"rate", 0.7}};
  text["kinematic_bodies"][0]["orientation_wxyz"] = {0, 1, 0, 0};
  PhysicsManager physics;
  const Loaded<ReferenceInstance> built = instantiate(problem_of(text), physics);
  ASSERT_TRUE(built.value.has_value());
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(physics.step(0.05).ok());
  const RigidBody arm = physics.body(built.value->bodies.at("arm"));
  const double angle = 0.5 * (std::sin(1.3) - std::sin(0.3)) + 0.35, rate = std::cos(1.3) + 0.7;
  const Quaternion expected = Quaternion{Eigen::AngleAxisd{angle, Vector3::UnitY()}} * Quaternion{0, 1, 0, 0};
  EXPECT_LT(attitude_error(arm.q_WB(), expected), 1e-14);
  EXPECT_LT((arm.w_WB() - Vector3{0, rate, 0}).norm(), 1e-14);
  EXPECT_LT((arm.X_WB().p - Vector3{5, 0, 0}).norm(), 1e-14);
}

TEST(Instantiate, FollowsAUniformlyAcceleratedLaw) {
  // angle = 0.4 t + 3 t^2 / 2, closed form at 0.5 s.
  const reference::AngleAt at =
      evaluate(reference::UniformAccelerationLaw{.rate = 0.4, .acceleration = 3}, 0.5);
  EXPECT_NEAR(at.angle, 0.575, 1e-15);
  EXPECT_NEAR(at.rate, 1.9, 1e-15);
  EXPECT_EQ(at.acceleration, 3);
}

TEST(Instantiate, GivesALawWhoseDerivativesAreThoseOfItsAngle) {
  // Central differences of step 1e-4 are right to about 1e-8 times the third derivative.
  const reference::AngleLaw law = reference::SineLaw{.amplitude = 0.7, .omega = 3, .phase = 0.4, .rate = -1};
  const double h = 1e-4;
  for (const double t : {0.0, 0.3, 1.7}) {
    const reference::AngleAt before = evaluate(law, t - h), now = evaluate(law, t),
                             after = evaluate(law, t + h);
    EXPECT_NEAR(now.rate, (after.angle - before.angle) / (2 * h), 1e-6);
    EXPECT_NEAR(now.acceleration, (after.rate - before.rate) / (2 * h), 1e-6);
  }
}

/// A change after which physics must refuse the problem, and what must be said about it.
struct Unsupported {
  const char* name;
  void (*change)(json&);
  const char* says;
};

class InstantiateRefuses : public testing::TestWithParam<Unsupported> {};

TEST_P(InstantiateRefuses, ByNameAndLeavesPhysicsAsItWas) {
  // The file is good, physics cannot hold it: one error, and not a single part has been built.
  json problem = buildable();
  GetParam().change(problem);
  PhysicsManager physics;
  const BodyId there = physics.add(RigidBodySettings{.name = "there before"});
  const Loaded<ReferenceInstance> built = instantiate(problem_of(problem), physics);
  EXPECT_FALSE(built.value.has_value());
  EXPECT_EQ(lines(built.notes), std::string{"f#"} + GetParam().says + '\n');
  EXPECT_EQ(physics.bodies().size(), 1u);
  EXPECT_TRUE(physics.contains(there));
  EXPECT_TRUE(physics.joints().empty());
  EXPECT_EQ(physics.forces().size(), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Instantiate, InstantiateRefuses,
    testing::Values(Unsupported{
        "Contacts", [](json& p) { p["contacts"] = good()["contacts"]; },
        "/contacts/0: error: contact sphere_plane: physics has no contacts yet; leave it out if "
        "the bodies "
        "never touch"}),
    [](const auto& test) { return std::string{test.param.name}; });

/// A joint of type ball between bob and rod, given at a place of the world.
json with_loop(const Vector3& anchor) {
  json p = buildable();
  p["joints"].push_back({{"type", "ball"},
                         {"name", "loop"},
                         {"body_a", "bob"},
                         {"body_b", "rod"},
                         {"anchor_world", {anchor.x(), anchor.y(), anchor.z()}}});
  p["bodies"][0]["angular_velocity_world"] = {0, 0, 0};
  p["bodies"][0]["velocity_cog"] = {0, 0, 0};
  return p;
}

TEST(Instantiate, HoldsAJointThatClosesALoop) {
  // Anchors are given in the world at the start, so that every loop of a file starts closed; the arm drives
  // it on.
  PhysicsManager physics;
  const Loaded<ReferenceInstance> built = instantiate(problem_of(with_loop({5, 0, 0})), physics);
  ASSERT_TRUE(built.value.has_value()) << lines(built.notes);
  EXPECT_EQ(physics.joints().size(), 3u);
  ASSERT_TRUE(physics.step(1e-3).ok());
  EXPECT_LT(physics.joint_drift().distance, 1e-12);
}

TEST(Instantiate, RefusesAValueThatIsNoProblem) {
  // A problem that did not come from a file is judged by the same rules.
  ReferenceProblem problem = problem_of(buildable());
  problem.bodies[0].mass.mass = -1;
  PhysicsManager physics;
  EXPECT_FALSE(instantiate(problem, physics).value.has_value());
  EXPECT_TRUE(physics.bodies().empty());
}

TEST(Instantiate, TakesOutWhatItBuiltWhenAJointMovesNothingThatResists) {
  // A bob without inertia on a ball joint in its centre of gravity: turning it takes no torque, so its motion
  // is not determined; the words are those of singular_joints.
  json problem = buildable();
  problem["bodies"][1]["inertia_cog_body"] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  problem["joints"][1]["type"] = "ball";
  PhysicsManager physics;
  const Loaded<ReferenceInstance> built = instantiate(problem_of(problem), physics);
  EXPECT_FALSE(built.value.has_value());
  EXPECT_NE(lines(built.notes).find("f#/joints/1: error: joint 'wrist': "), std::string::npos)
      << lines(built.notes);
  EXPECT_TRUE(physics.bodies().empty());
  EXPECT_TRUE(physics.joints().empty());
  EXPECT_EQ(physics.forces().size(), 0u);
}

}  // namespace
}  // namespace pantin::test
