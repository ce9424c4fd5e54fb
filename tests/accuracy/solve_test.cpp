// solve() on all reference problems, as `pantin solve` runs them: the solver chosen by itself, one tolerance.
#include <pantin/bridge/problems/solve.hpp>

#include <gtest/gtest.h>

#include <map>

#include "reference_run.hpp"

namespace pantin::test {
namespace {

constexpr double kTolerance = 1e-10;

/// Where the greatest error may pass 1e-8 at this tolerance, and why.
struct Excuse {
  double bound;
  const char* reason;
};
const std::map<std::string, Excuse> kConditioning{
    {"dzhanibekov_long_run", {4, "a body that turns over its middle axis loses its attitude exponentially"}},
    {"free_box_gazebo_complex", {1e-6, "turns near its middle axis for 10 s, which is unstable"}},
    {"kepler_e09", {1e-7, "ten orbits of eccentricity 0.9: errors of speed become errors of phase"}},
    {"kepler_inclined_e06", {1e-7, "twenty orbits: errors of speed become errors of phase"}},
    {"rheonomic_rotating_arm", {3e-7, "the pendulum on its arm has unstable positions"}},
    {"simple_pendulum_A01", {1e-5, "2000 s: errors of energy become errors of phase"}},
    {"simple_pendulum_rotating", {2e-7, "20 s near the top: errors of energy become errors of phase"}},
};

TEST(Solve, MeetsTheReferencesAtItsOwnChoice) {
  // Whatever has no contacts finishes, and lies within 1e-8 m and rad of the references, which are good to
  // 1e-10 and better, at 1e-10 a second; but for problems that multiply any error, which are listed.
  const auto folder = reference_folder();
  if (folder.empty()) GTEST_SKIP() << "no folder of reference problems beside the sources";
  int solved = 0;
  for (const auto& file : problems_in(folder)) {
    if (file.stem() == "stiff_spring_mass_k1e10") continue;  // 354,000 steps: `pantin solve` takes 4 s for it
    const std::optional<ReferenceProblem> problem = loaded(file);
    ASSERT_TRUE(problem.has_value());
    const SolveResult result = solve(*problem, {.tolerance = kTolerance});
    if (!problem->contacts.empty()) {
      EXPECT_EQ(result.status, SolveStatus::Refused) << file;
      continue;
    }
    ASSERT_EQ(result.status, SolveStatus::Ok) << file << (result.messages.empty() ? "" : result.messages[0]);
    const auto excuse = kConditioning.find(file.stem().string());
    const double bound = excuse == kConditioning.end() ? 1e-8 : excuse->second.bound;
    EXPECT_LE(result.position_error.value_or(0), bound) << file;
    EXPECT_LE(result.attitude_error.value_or(0), bound) << file;
    EXPECT_LE(result.joint_drift, 1e-12) << file;
    EXPECT_EQ(result.states.size(), problem->samples.size());
    ++solved;
  }
  EXPECT_GE(solved, 30);
}

TEST(Solve, TriesStricterTolerancesWhereOneFails) {
  // Over tolerances of three decades a four-bar that passes positions with all bars in line finishes, with
  // the closed form's motion, though rounding is multiplied there; where other steps had to be taken a
  // message says so.
  const auto folder = reference_folder();
  if (folder.empty()) GTEST_SKIP() << "no folder of reference problems beside the sources";
  const std::optional<ReferenceProblem> problem = loaded(folder / "n_four_bar_N2.json");
  ASSERT_TRUE(problem.has_value());
  for (const double tolerance : {1e-8, 1e-9, 1e-10, 3e-11}) {
    const SolveResult result = solve(*problem, {.tolerance = tolerance});
    ASSERT_EQ(result.status, SolveStatus::Ok) << tolerance;
    EXPECT_LE(result.position_error.value_or(1), 100 * tolerance + 1e-7) << tolerance;
    for (const std::string& message : result.messages)
      EXPECT_NE(message.find("not solved in the steps of a wider tolerance"), std::string::npos);
  }
}

TEST(Solve, FindsIslandsAndTheirSolvers) {
  // Two bodies joined are one island, a third by itself another; a loop is seen, also through the world, and
  // integrated like a tree as long as it stays away from singular positions.
  reference::Problem problem;
  for (const char* name : {"a", "b", "c"}) problem.bodies.push_back({.name = name});
  problem.joints.push_back({.name = "ab", .a = "a", .b = "b"});
  problem.joints.push_back({.name = "wa", .b = "a"});
  std::vector<IslandChoice> choices = choose_solvers(problem, 1e-10);
  ASSERT_EQ(choices.size(), 2u);
  EXPECT_EQ(choices[0].bodies, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(choices[1].bodies, (std::vector<std::string>{"c"}));
  EXPECT_EQ(choices[0].solver, "gauss16");
  EXPECT_EQ(choose_solvers(problem, 1e-3)[0].solver, "gauss8");
  problem.joints.push_back({.name = "wb", .b = "b"});  // through the world
  choices = choose_solvers(problem, 1e-10);
  EXPECT_TRUE(choices[0].has_loop);
  EXPECT_FALSE(choices[1].has_loop);
  EXPECT_EQ(choices[0].solver, "gauss16");
}

TEST(Solve, GivesEachIslandItsOwnSolver) {
  // A body on an overdamped spring, whose motion decays within a microsecond, needs radau; a pendulum that
  // nothing couples with it goes by gauss16, and is where it is, to the bit, when it is alone.
  const MassProperties mass{1, Vector3::Zero(), 0.1 * Matrix3::Identity()};
  reference::Problem alone{.gravity = {0, 0, -9.81}, .duration = 1};
  alone.bodies.push_back({.name = "bob", .mass = mass, .X_WB = {{1, 0, 0}}});
  alone.joints.push_back({.name = "hinge", .b = "bob", .axis_W = {0, 1, 0}});
  reference::Problem both = alone;
  both.bodies.insert(both.bodies.begin(), {.name = "slug", .mass = mass, .X_WB = {{5, 0, 0}}});
  both.forces.push_back(reference::Spring{.a = {.point = {4, 0, 0}},
                                          .b = {.body = "slug"},
                                          .stiffness = 1e6,
                                          .damping = 1e6,
                                          .rest_length = 0.5});
  for (reference::Problem* problem : {&alone, &both}) problem->samples = {{.t = 0.5}, {.t = 1}};

  const SolveResult of_both = solve(both, {.tolerance = 1e-9}), of_bob = solve(alone, {.tolerance = 1e-9});
  ASSERT_EQ(of_both.status, SolveStatus::Ok);
  ASSERT_EQ(of_both.islands.size(), 2u);
  EXPECT_EQ(of_both.islands[0].solver, "radau");
  EXPECT_EQ(of_both.islands[1].solver, "gauss16");
  EXPECT_FALSE(of_both.islands[0].shares_steps || of_both.islands[1].shares_steps);
  EXPECT_EQ(of_both.integrator, "radau, gauss16");
  EXPECT_EQ(of_bob.integrator, "gauss16");
  for (std::size_t i = 0; i < of_bob.states.size(); ++i) {
    const reference::Body &bob = of_both.states[i].bodies[1], &expected = of_bob.states[i].bodies[0];
    EXPECT_EQ(bob.X_WB.p, expected.X_WB.p);
    EXPECT_EQ(bob.v_WBcm, expected.v_WBcm);
  }
  EXPECT_EQ(solve(both, {.integrator = "gauss8", .step = 1e-5}).integrator, "gauss8");
}

TEST(Solve, TakesShortStepsOnlyWhereLoopsComeNearSingularPositions) {
  // A slider-crank stays away from positions in which bars in line may go two ways, four-bars of equal bars
  // pass them twice a turn: there long steps are not trusted.
  const auto folder = reference_folder();
  if (folder.empty()) GTEST_SKIP() << "no folder of reference problems beside the sources";
  for (const auto& [name, solver] : {std::pair{"slider_crank", "gauss16"},
                                     {"andrews_squeezer", "gauss16"},
                                     {"n_four_bar_N1", "dormand-prince"}}) {
    const std::optional<ReferenceProblem> problem = loaded(folder / (std::string{name} + ".json"));
    ASSERT_TRUE(problem.has_value());
    const SolveResult result = solve(*problem, {.tolerance = kTolerance});
    EXPECT_EQ(result.integrator, solver) << name << ' ' << result.loop_margin;
    EXPECT_LE(result.position_error.value_or(1), 1e-9) << name;
  }
}

TEST(Solve, KeepsToTheBranchThroughSingularPositionsWithAnySolver) {
  // Four-bars of equal bars, five turns, against the closed form of the pendulum that they are: no solver
  // leaves the branch on which the cranks stay parallel; where bars are in line rounding is multiplied, up to
  // 1e-5 m, depending on where stages happen to fall. What leaves the branch is off by a bar.
  const auto folder = reference_folder();
  if (folder.empty()) GTEST_SKIP() << "no folder of reference problems beside the sources";
  for (const char* name : {"n_four_bar_N1", "n_four_bar_N2"}) {
    const std::optional<ReferenceProblem> problem = loaded(folder / (std::string{name} + ".json"));
    ASSERT_TRUE(problem.has_value());
    for (const char* integrator : {"gauss8", "gauss16", "dormand-prince"}) {
      for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
        const SolveResult result = solve(*problem, {.integrator = integrator, .tolerance = tolerance});
        ASSERT_EQ(result.status, SolveStatus::Ok) << name << ' ' << integrator << ' ' << tolerance;
        EXPECT_LE(result.position_error.value_or(1), 10 * tolerance + 1e-5)
            << name << ' ' << integrator << ' ' << tolerance;
      }
    }
  }
}

TEST(Solve, RefusesSettingsThatMeanNothing) {
  // Each with its remedy.
  EXPECT_NE(problem_with(SolveSettings{.integrator = "leapfrog"})->remedy.find("auto"), std::string::npos);
  EXPECT_EQ(problem_with(SolveSettings{.integrator = "rk4"})->remedy, "give a step");
  EXPECT_TRUE(problem_with(SolveSettings{.tolerance = -1}));
  EXPECT_TRUE(problem_with(SolveSettings{.step = 0.0}));
  EXPECT_TRUE(problem_with(SolveSettings{.repeats = 0}));
  EXPECT_FALSE(problem_with(SolveSettings{}));
}

}  // namespace
}  // namespace pantin::test
