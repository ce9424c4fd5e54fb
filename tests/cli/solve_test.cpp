// `pantin solve`: what it says of problems, and how it ends.
#include "models.hpp"
#include "program.hpp"

namespace pantin::test {
namespace {

std::string own_problem(const std::string& name) {
  return std::string{PANTIN_SOURCE_DIR} + "/assets/problems/" + name + ".json";
}

/// A stone that falls from rest, with nothing but times in its samples.
constexpr const char* kBareProblem = R"({"schema": "rigid-ref/1", "name": "stone", "title": "A stone",
  "gravity": [0, 0, -10], "bodies": [{"name": "stone", "mass": 2,
  "inertia_cog_body": [[1,0,0],[0,1,0],[0,0,1]], "cog_in_node": [0,0,0], "position_node": [0,0,5],
  "position_cog": [0,0,5], "orientation_wxyz": [1,0,0,0], "velocity_cog": [1,0,0], "velocity_node": [1,0,0],
  "angular_velocity_world": [0,0,0], "angular_velocity_body": [0,0,0]}],
  "duration": 1, "samples": [{"t": 0.5}, {"t": 1}]})";

TEST(Solve, SaysAllKeysOnOneLineAProblem) {
  // One JSON object a line, in the order of the files; the problems that come with the sources have closed
  // forms, which auto meets at its tolerance.
  const Ran ran = pantin({"solve", "--json", "--tolerance", "1e-10", own_problem("free_symmetric_top"),
                          own_problem("slider_spring_damper")});
  EXPECT_EQ(ran.code, 0) << ran.err;
  std::istringstream lines{ran.out};
  std::string line;
  int count = 0;
  while (std::getline(lines, line)) {
    const Json result = Json::parse(line);
    ++count;
    for (const char* key : {"problem", "status", "integrator", "tolerance", "position_error_m",
                            "attitude_error_rad", "velocity_error_mps", "energy_drift_relative",
                            "joint_drift_m", "steps", "evaluations", "cpu_seconds", "islands", "messages"}) {
      EXPECT_TRUE(result.contains(key)) << key;
    }
    EXPECT_EQ(result["status"], "ok");
    EXPECT_EQ(result["integrator"], "gauss16");
    EXPECT_LT(result["position_error_m"], 1e-8);
    EXPECT_LT(result["attitude_error_rad"], 1e-8);
    ASSERT_EQ(result["islands"].size(), 1u);
    for (const char* key : {"bodies", "solver", "reason", "shares_steps"})
      EXPECT_TRUE(result["islands"][0].contains(key)) << key;
    EXPECT_FALSE(result.contains("states"));
  }
  EXPECT_EQ(count, 2);
}

TEST(Solve, GivesStatesWhereSamplesHoldOnlyTimes) {
  // A stone thrown: x = t, z = 5 - 5 t^2, v_z = -10 t; errors are null because nothing is there to compare.
  const TemporaryFolder folder;
  const Ran ran = pantin({"solve", "--json", "--states", folder.write("stone.json", kBareProblem)});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_TRUE(result["position_error_m"].is_null());
  EXPECT_TRUE(result["attitude_error_rad"].is_null());
  ASSERT_EQ(result["states"].size(), 2u);
  const Json& last = result["states"][1];
  EXPECT_EQ(last["t"], 1.0);
  const Json& stone = last["bodies"]["stone"];
  EXPECT_NEAR(stone["position_cog"][0], 1, 1e-14);
  EXPECT_NEAR(stone["position_cog"][2], 0, 1e-14);
  EXPECT_NEAR(stone["velocity_cog"][2], -10, 1e-13);
  EXPECT_EQ(stone["quaternion_wxyz"].size(), 4u);
  EXPECT_EQ(stone["angular_velocity_world"].size(), 3u);
  EXPECT_TRUE(last["particles"].empty());
}

TEST(Solve, RefusesByNameAndGoesOn) {
  // A file that is none does not keep the next from being solved; the code tells that one was refused.
  const TemporaryFolder folder;
  const Ran ran = pantin({"solve", "--json", folder.write("bad.json", "{}"), own_problem("welded_pendulum")});
  EXPECT_EQ(ran.code, 1);
  std::istringstream lines{ran.out};
  std::string first, second;
  std::getline(lines, first), std::getline(lines, second);
  EXPECT_EQ(Json::parse(first)["status"], "refused");
  EXPECT_NE(Json::parse(first)["messages"][0].get<std::string>().find("bad.json"), std::string::npos);
  EXPECT_EQ(Json::parse(second)["status"], "ok");
}

TEST(Solve, TakesFixedStepsOfAnyIntegrator) {
  // rk4 at two steps: sixteen times the error at twice the step, and the step stands in the place of the
  // tolerance.
  const auto error = [](const char* step) {
    const Ran ran =
        pantin({"solve", "--json", "--integrator", "rk4", "--step", step, own_problem("free_symmetric_top")});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_FALSE(ran.json().contains("tolerance"));
    return ran.json()["attitude_error_rad"].get<double>();
  };
  EXPECT_NEAR(error("0.02") / error("0.01"), 16, 2);
}

TEST(Solve, RefusesIntegratorsThatKeepNoTolerance) {
  // rk4 without a step would have nothing to go by.
  const Ran ran = pantin({"solve", "--integrator", "rk4", own_problem("free_symmetric_top")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(ran.says("give a step")) << ran.err;
}

TEST(Solve, PrintsATableForPeople) {
  // The same numbers in words, with the reason for the solver.
  const Ran ran = pantin({"solve", "--states", own_problem("free_symmetric_top")});
  EXPECT_EQ(ran.code, 0);
  for (const char* text :
       {"position error [m]", "processor time [s]", "gauss16: ", "angular velocity [rad/s]"})
    EXPECT_NE(ran.out.find(text), std::string::npos) << text << '\n' << ran.out;
}

}  // namespace
}  // namespace pantin::test
