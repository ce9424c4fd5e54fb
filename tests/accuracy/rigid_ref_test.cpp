#include <gtest/gtest.h>

#include <random>

#include <pantin/bridge/problems/rigid_ref.hpp>

#include "good_problem.hpp"
#include "reference_run.hpp"

namespace pantin::test {
namespace {

using nlohmann::json;

TEST(RigidRef, ReadsEveryField) {
  // What was written above, looked up by hand; the rod is turned by pi about z, so its centre of gravity lies
  // at node - 0.5 x, and w = 3 z gives it the velocity 3 z x (-0.5 x) = -1.5 y.
  const Loaded<ReferenceProblem> read = parse_rigid_ref(good().dump(), "good.json");
  ASSERT_TRUE(read.value.has_value()) << lines(read.notes);
  const ReferenceProblem& p = *read.value;
  EXPECT_EQ(p.name, "good");
  EXPECT_EQ(p.title, "A good one");
  EXPECT_EQ(p.gravity, Vector3(0, 0, -9.81));
  EXPECT_EQ(p.duration, 2);
  EXPECT_EQ(p.error_metric, "distance");
  ASSERT_EQ(p.bodies.size(), 2u);
  EXPECT_EQ(p.bodies[0].name, "rod");
  EXPECT_EQ(p.bodies[0].mass.mass, 2);
  EXPECT_EQ(p.bodies[0].mass.I_BBcm_B.diagonal(), Vector3(0.2, 0.3, 0.4));
  EXPECT_EQ(p.bodies[0].mass.p_BBcm, Vector3(0.5, 0, 0));
  EXPECT_EQ(p.bodies[0].X_WB.p, Vector3(1, 2, 3));
  EXPECT_EQ(p.bodies[0].v_WBcm, Vector3(0, -1.5, 0));
  EXPECT_EQ(p.bodies[0].w_WB, Vector3(0, 0, 3));
  EXPECT_EQ(p.bodies[1].X_WB.p, Vector3(5, 0, 0));
  EXPECT_EQ(p.particles.at(0).p_W, Vector3(0, 0, 1));
  EXPECT_EQ(std::get<reference::SineLaw>(p.kinematic_bodies.at(0).law).omega, 2);
  ASSERT_EQ(p.joints.size(), 2u);
  EXPECT_EQ(p.joints[1].kind, JointKind::Pivot);
  EXPECT_EQ(p.joints[1].a, "arm");
  EXPECT_EQ(p.joints[1].axis_W, Vector3(0, 1, 0));
  ASSERT_EQ(p.forces.size(), 5u);
  EXPECT_EQ(std::get<reference::Spring>(p.forces[0]).b.point, Vector3(0.1, 0, 0));
  EXPECT_EQ(std::get<reference::ConstantTorque>(p.forces[1]).torque_W, Vector3(0, 0, 1));
  EXPECT_EQ(std::get<reference::Drag>(p.forces[2]).medium_velocity, Vector3(1, 0, 0));
  EXPECT_TRUE(std::get<reference::Drag>(p.forces[3]).quadratic);
  EXPECT_EQ(std::get<reference::CentralGravity>(p.forces[4]).mu, 4);
  EXPECT_EQ(std::get<reference::SphereOnPlane>(p.contacts.at(0).pair).radius, 0.1);
  ASSERT_EQ(p.samples.size(), 2u);
  EXPECT_TRUE(p.samples[0].bodies.empty());
  EXPECT_FALSE(p.samples[0].energy.has_value());
  EXPECT_EQ(p.samples[1].bodies.at(1).w_WB, Vector3(0, 0, 1));
  EXPECT_EQ(p.samples[1].bodies.at(0).p_WBcm, Vector3(1, 1, 1));  // keys are written in alphabetical order
  EXPECT_EQ(p.samples[1].energy->total, 6);
  EXPECT_EQ(p.accuracy.absolute, 1e-12);
  EXPECT_EQ(p.accuracy.attitude_sensitivity.at(0), (std::pair{0.5, 3.0}));
}

TEST(RigidRef, IsSilentAboutAGoodFile) {
  // Nothing was dropped or doubted but the velocity of the wrist, whose arm starts with amplitude * omega = 1
  // rad/s about the wrist's own axis: allowed.
  EXPECT_EQ(lines(parse_rigid_ref(good().dump(), "good.json").notes), "");
}

TEST(RigidRef, TakesAFileWhoseSamplesCarryOnlyTimes) {
  // Such a file states a problem and keeps its solution to itself.
  json problem = buildable();
  problem["samples"] = {{{"t", 0}}, {{"t", 0.5}}, {{"t", 2}}};
  problem.erase("accuracy");
  problem.erase("error_metric");
  const Loaded<ReferenceProblem> read = parse_rigid_ref(problem.dump(), "f");
  ASSERT_TRUE(read.value.has_value()) << lines(read.notes);
  PhysicsManager physics;
  EXPECT_TRUE(instantiate(*read.value, physics).value.has_value());
}

TEST(RigidRef, WarnsOfKeysThatItDoesNotKnow) {
  // The key is extra: the file is still good, and the warning says where it stands.
  json problem = good();
  problem["bodies"][1]["colour/tint"] = "red";
  const Loaded<ReferenceProblem> read = parse_rigid_ref(problem.dump(), "f");
  EXPECT_TRUE(read.value.has_value());
  EXPECT_EQ(
      lines(read.notes),
      "f#/bodies/1/colour~1tint: warning: body 'bob': 'colour/tint': the reader does not know this key: "
      "dropped; check its spelling\n");
}

TEST(RigidRef, WarnsOfVelocitiesThatAJointDoesNotAllow) {
  // The rod's hinge end would move at 0.25 m/s although the world holds it; the problem can be used all the
  // same.
  json problem = good();
  problem["bodies"][0]["velocity_cog"] = {0, -1.25, 0};
  const Loaded<ReferenceProblem> read = parse_rigid_ref(problem.dump(), "f");
  EXPECT_TRUE(read.value.has_value());
  EXPECT_EQ(
      lines(read.notes),
      "f#/joints/0: warning: joint 'hinge': holds 'world' and 'rod', which start with 0.25 m/s and 0 rad/s "
      "across it; correct the velocities; else the first step projects them on the joints\n");
}

TEST(RigidRef, WarnsOfARateAcrossAPivot) {
  // A pivot about y holds the bob against turning about z.
  json problem = good();
  problem["bodies"][1]["angular_velocity_body"] = {0, 0, 2};
  EXPECT_NE(lines(parse_rigid_ref(problem.dump(), "f").notes).find("0 m/s and 2 rad/s across it"),
            std::string::npos);
}

/// The one note about a file whose bob has this inertia.
Loaded<ReferenceProblem> with_inertia(const Vector3& moments) {
  json problem = good();
  problem["bodies"][1]["inertia_cog_body"] = {{moments[0], 0, 0}, {0, moments[1], 0}, {0, 0, moments[2]}};
  return parse_rigid_ref(problem.dump(), "f");
}

TEST(RigidRef, WarnsOfInertiaThatNoBodyHas) {
  // Principal moments 1, 1, 3 break the triangle rule A + B >= C, yet the equations of motion have a
  // solution; the words are those of problem_with(MassProperties).
  const Loaded<ReferenceProblem> read = with_inertia({1, 1, 3});
  const auto problem = problem_with(MassProperties{.I_BBcm_B = Vector3{1, 1, 3}.asDiagonal()});
  EXPECT_EQ(lines(read.notes), "f#/bodies/1/inertia_cog_body: warning: body 'bob': " + problem->text + "; " +
                                   problem->remedy + '\n');
  ASSERT_TRUE(read.value.has_value());
  ReferenceProblem buildable_one = *read.value;
  buildable_one.particles.clear();
  buildable_one.contacts.clear();
  buildable_one.samples.clear();
  buildable_one.forces.resize(3);
  PhysicsManager physics;
  EXPECT_TRUE(instantiate(buildable_one, physics).value.has_value());
}

TEST(RigidRef, RefusesNegativeInertia) {
  // A negative moment makes a motion that gains energy by turning slower.
  const Loaded<ReferenceProblem> read = with_inertia({1, -1, 1});
  const auto problem = problem_with(MassProperties{.I_BBcm_B = Vector3{1, -1, 1}.asDiagonal()});
  EXPECT_FALSE(read.value.has_value());
  EXPECT_EQ(lines(read.notes), "f#/bodies/1/inertia_cog_body: error: body 'bob': " + problem->text + "; " +
                                   problem->remedy + '\n');
}

TEST(RigidRef, FindsAllThatIsWrongAtOnce) {
  // Three independent mistakes of form, three errors.
  json problem = good();
  problem["bodies"][0].erase("mass");
  problem["joints"][1]["type"] = 3;
  problem["duration"] = nullptr;
  const Loaded<ReferenceProblem> read = parse_rigid_ref(problem.dump(), "f");
  EXPECT_EQ(read.notes.size(), 3u) << lines(read.notes);
}

/// Text that is not JSON, and the start of what must be said.
struct BadText {
  const char* name;
  std::string text;
  std::string says;
};

class RigidRefRefusesText : public testing::TestWithParam<BadText> {};

TEST_P(RigidRefRefusesText, AtItsLine) {
  // The mistake stands on a line counted by hand.
  const Loaded<ReferenceProblem> read = parse_rigid_ref(GetParam().text, "f");
  EXPECT_FALSE(read.value.has_value());
  EXPECT_EQ(lines(read.notes).substr(0, GetParam().says.size()), GetParam().says) << lines(read.notes);
}

INSTANTIATE_TEST_SUITE_P(
    RigidRef, RigidRefRefusesText,
    testing::Values(BadText{"Nothing", "", "f:1: error: JSON: "},
                    BadText{"Syntax", "{\n\"a\": 1,\n}", "f:3: error: JSON: syntax error"},
                    BadText{"NotANumber", "{\n\n\"mass\": NaN}", "f:3: error: JSON: syntax error"},
                    BadText{"Infinite", "{\n\"mass\": 1e999}", "f:2: error: JSON: number overflow"},
                    BadText{"Truncated", "{\"schema\": \"rigid-r", "f:1: error: JSON: syntax error"},
                    BadText{"TwiceTheSameKey", "{\"a\": 1, \"a\": 2}",
                            "f: error: JSON: key 'a' stands twice in one object; mend the file"},
                    BadText{"TooDeep", std::string(100000, '['),
                            "f: error: JSON: is nested deeper than 64 levels; mend the file"},
                    BadText{"BadUtf8", "{\"name\": \"\xff\"}", "f:1: error: JSON: syntax error"}),
    [](const auto& test) { return std::string{test.param.name}; });

TEST(RigidRef, SurvivesAnyDamage) {
  // Property over 3000 seeded mutations of a good file (cut, overwritten, repeated): never a crash or an
  // exception, and always a value or an error.
  const std::string text = good().dump(1);
  std::mt19937 random{20240607};
  for (int trial = 0; trial < 3000; ++trial) {
    std::string damaged = text;
    const std::size_t at = random() % damaged.size(), length = 1 + random() % 40;
    switch (random() % 4) {
      case 0:
        damaged.resize(at);
        break;
      case 1:
        damaged[at] = static_cast<char>(random() % 256);
        break;
      case 2:
        damaged.erase(at, length);
        break;
      default:
        damaged.insert(at, damaged.substr(random() % damaged.size(), length));
    }
    const Loaded<ReferenceProblem> read = parse_rigid_ref(damaged, "f");
    ASSERT_NE(read.value.has_value(), has_error(read.notes)) << damaged;
  }
}

TEST(RigidRef, SaysThatAFileIsMissing) {
  // The words of every reader for a file that is not there.
  EXPECT_EQ(lines(load_rigid_ref("nowhere.json").notes),
            "nowhere.json: error: file: does not exist; check the path\n");
}

}  // namespace
}  // namespace pantin::test
