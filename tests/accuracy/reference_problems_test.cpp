// The reference problems that lie beside a checkout (see reference_folder): what the engine can do it does
// within a bound, what it cannot do it refuses by name.
#include <gtest/gtest.h>

#include <map>

#include "expected_errors.hpp"

namespace pantin::test {
namespace {

namespace fs = std::filesystem;

// Steps are chosen for runs of about a second: 2e-3 s where nothing is fast; some 200 steps a turn for fast
// spins; below 2.8 / (fastest rate) for stiff springs and dampers, where rk4 is stable.
const std::map<std::string, ExpectedErrors> kComesOut{
    {"chain_3d_N10", {2e-3, 5e-7, 2e-6, 7e-8}},
    {"chain_3d_N10_spatial", {1e-3, 2e-7, 2e-6, 2e-8}},
    {"compound_pendulum_offset_hinge", {2e-3, 1e-9, 3e-9, 2e-12}},
    {"double_pendulum", {2e-3, 2e-8, 7e-8, 8e-9}},
    {"double_pendulum_mass_ratio_1e6", {2e-3, 3e-9, 2e-8, 6e-10}},
    // The attitude of a body turning about its middle axis is lost exponentially; LongRunKeepsEnergy goes on.
    {"dzhanibekov_long_run", {5e-4, 0, 7e-5, 6e-11, 20}},
    // 1500 steps, each rounded to half of the 1.9e-9 m between two numbers at 1e7 m.
    {"far_from_origin_1e7", {2e-3, 4e-6, 5e-10, 9e-14}},
    // Damped at 3e4 /s, so the step is bounded by stability and the error is all rounding.
    {"flyball_governor_A05", {5e-5, 0, 0, 0}},
    {"flyball_governor_soft", {2e-3, 2e-7, 2e-7, 8e-8}},
    {"free_asymmetric_stable", {2e-3, 0, 4e-9, 2e-11}},
    {"free_box_gazebo_complex", {1e-3, 4e-11, 9e-8, 8e-13}},
    {"free_box_gazebo_simple", {2e-3, 0, 0, 0}},
    {"gyroscope_free_1e4", {2e-6, 0, 3e-6, 2e-11}},
    {"gyroscope_pivot_1e4", {5e-6, 2e-10, 1e-4, 5e-14}},
    {"heavy_top_literature", {5e-4, 5e-5, 2e-4, 2e-6}},
    {"heavy_top_nutation", {5e-4, 9e-8, 2e-6, 2e-8}},
    {"heavy_top_slow", {2e-3, 2e-7, 6e-7, 2e-8}},
    {"mass_ratio_1e6_spring", {2e-3, 7e-8, 0, 2e-11}},
    {"n_four_bar_N1", {2e-3, 2e-8, 2e-8, 1e-8}},
    {"n_four_bar_N2", {2e-3, 2e-8, 2e-8, 1e-8}},
    {"rheonomic_furuta", {2e-3, 5e-10, 2e-9, 4e-10}},
    {"rheonomic_rotating_arm", {2e-3, 7e-8, 3e-7, 3e-8}},
    {"simple_pendulum_A01", {2e-3, 7e-10, 8e-10, 3e-11}},
    {"simple_pendulum_rotating", {2e-3, 4e-9, 7e-9, 9e-11}},
    {"slider_crank", {2e-3, 3e-7, 2e-6, 3e-7}},
    {"slider_incline_spring_damper", {2e-3, 9e-9, 0, 9e-9}},
    {"slider_incline_spring_overdamped", {2e-3, 2e-8, 0, 3e-7}},
    {"two_mass_soft_stiff_k1e3", {1e-3, 2e-7, 0, 3e-7}},
    {"two_mass_soft_stiff_k1e7", {1e-5, 2e-7, 0, 6e-5}},
};

/// What must be said, with its place, about the problems that physics does not know yet.
const std::map<std::string, std::vector<const char*>> kRefused{
    {"block_friction_flat", {"#/contacts/0: error: contact box_plane: "}},
    {"block_friction_stop", {"#/contacts/0: error: contact box_plane: "}},
    {"block_friction_uphill_return", {"#/contacts/0: error: contact box_plane: "}},
    {"bouncing_ball_e08", {"#/contacts/0: error: contact sphere_plane: "}},
    {"bouncing_ball_e09_moon", {"#/contacts/0: error: contact sphere_plane: "}},
    {"bouncing_ball_elastic", {"#/contacts/0: error: contact sphere_plane: "}},
    {"rod_rod_collision_e0", {"#/contacts/0: error: contact capsule_capsule: "}},
    {"rod_rod_collision_e05", {"#/contacts/0: error: contact capsule_capsule: "}},
};

/// The folder, or the test skipped with the reason.
#define REQUIRE_REFERENCE_FOLDER(folder)                                                                  \
  const fs::path folder = reference_folder();                                                             \
  if (folder.empty()) {                                                                                   \
    GTEST_SKIP()                                                                                          \
        << "no folder with reference problems is beside the sources, and PANTIN_PROBLEMS_DIR names none"; \
  }

TEST(ReferenceFolder, HoldsProblems) {
  // Where the folder is there, it is not empty; where it is not, this says so aloud for all tests below.
  REQUIRE_REFERENCE_FOLDER(folder);
  EXPECT_FALSE(problems_in(folder).empty()) << folder;
}

class ReferenceProblemFile : public testing::TestWithParam<fs::path> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ReferenceProblemFile);

TEST_P(ReferenceProblemFile, ComesOutOrIsRefusedByName) {
  // The samples are solutions that two independent methods agree on to far less than the bounds. A problem in
  // neither table (a later one) must be built and stepped or be refused with an error, whichever it is.
  Loaded<ReferenceProblem> read = load_rigid_ref(GetParam());
  const std::string name = GetParam().stem().string();
  const auto comes_out = kComesOut.find(name);
  const auto refused = kRefused.find(name);
  if (comes_out != kComesOut.end()) {
    ASSERT_TRUE(read.value.has_value()) << lines(read.notes);
    const ExpectedErrors& expected = comes_out->second;
    expect_within(run(*read.value, {.step = expected.step, .until = expected.until}), expected);
    return;
  }
  PhysicsManager physics;
  std::vector<Diagnostic> notes = std::move(read.notes);
  if (read.value) {
    Loaded<ReferenceInstance> built = instantiate(*read.value, physics);
    if (refused == kRefused.end() && built.value) {
      EXPECT_TRUE(physics.step(1e-4).ok());
      return;
    }
    EXPECT_FALSE(built.value.has_value());
    notes = std::move(built.notes);
  }
  EXPECT_TRUE(has_error(notes));
  EXPECT_TRUE(physics.bodies().empty());
  if (refused == kRefused.end()) return;
  EXPECT_TRUE(read.value.has_value()) << "the reader itself knows all of it";
  for (const char* words : refused->second)
    EXPECT_NE(lines(notes).find(words), std::string::npos) << lines(notes);
}

INSTANTIATE_TEST_SUITE_P(Reference, ReferenceProblemFile,
                         testing::ValuesIn(reference_folder().empty() ? std::vector<fs::path>{}
                                                                      : problems_in(reference_folder())),
                         [](const auto& test) { return test_name(test.param); });

/// A problem of particles, the tolerance that it is run at [m/s], and three times the errors found or, where
/// these are rounding, some 1e-13.
struct ParticleProblem {
  const char* name;
  double tolerance, position, energy;
  double step{0.1};  ///< asked for [s]; the integrator cuts it
};

class ParticleProblemFile : public testing::TestWithParam<ParticleProblem> {};

TEST_P(ParticleProblemFile, ComesOutAtATightTolerance) {
  // The bodies' tolerance holds for particles too: orbits, drag and springs come out to some 1e-10 m however
  // long the step that is asked for; were the tolerance not heard, its default would cost four digits.
  REQUIRE_REFERENCE_FOLDER(folder);
  const ParticleProblem& wanted = GetParam();
  const std::optional<ReferenceProblem> problem = loaded(folder / (std::string{wanted.name} + ".json"));
  ASSERT_TRUE(problem.has_value());
  const RunErrors errors = run(*problem, {.tolerance = wanted.tolerance, .step = wanted.step});
  EXPECT_EQ(errors.failure, "");
  EXPECT_EQ(errors.compared, problem->samples.size());
  EXPECT_LE(errors.position, wanted.position);
  EXPECT_LE(errors.energy, wanted.energy);
  std::printf("%s: position %.1e m, energy %.1e\n", wanted.name, errors.position, errors.energy);
}

INSTANTIATE_TEST_SUITE_P(Reference, ParticleProblemFile,
                         testing::Values(ParticleProblem{"kepler_e09", 1e-13, 5e-11, 1e-13},
                                         ParticleProblem{"kepler_inclined_e06", 1e-13, 1e-10, 1e-13},
                                         ParticleProblem{"particle_linear_drag", 1e-13, 2e-13, 1e-13},
                                         ParticleProblem{"particle_quadratic_drag", 1e-13, 2e-12, 1e-13},
                                         ParticleProblem{"penalty_pendulum_k1e4", 1e-12, 2e-13, 1e-13},
                                         ParticleProblem{"stiff_spring_mass_k1e2", 1e-13, 2e-13, 1e-13},
                                         ParticleProblem{"stiff_spring_mass_k1e4", 1e-12, 5e-13, 5e-13}),
                         [](const auto& test) { return std::string{test.param.name}; });
/// Problems with closed loops, a tolerance of dormand-prince and bounds, about ten times what was found when
/// they were written down. Where a stage happens to fall within 1e-5 rad of a position with all bars in line,
/// rounding is multiplied: with 40 loops, 40 m wide, that gave 3e-7 at steps of 0.1 s, and 1e-9 at one step a
/// sample.
struct LoopCase {
  const char* name;
  double tolerance, position, attitude;
};

class ReferenceLoop : public testing::TestWithParam<LoopCase> {};

TEST_P(ReferenceLoop, ComesOutToTheTolerance) {
  // Redundant loops (pivots in space hold planar mechanisms), four-bars that pass through positions in which
  // all bars are in line, where the solver must stay on its branch: the samples are closed forms or 80-bit
  // solutions, good to 1e-13. Bounds are absolute; loops stay closed to rounding.
  REQUIRE_REFERENCE_FOLDER(folder);
  const LoopCase& wanted = GetParam();
  const std::optional<ReferenceProblem> problem = loaded(folder / (std::string{wanted.name} + ".json"));
  ASSERT_TRUE(problem.has_value());
  const RunErrors errors = run(*problem, {.tolerance = wanted.tolerance, .step = 0.1});
  EXPECT_EQ(errors.failure, "");
  EXPECT_GT(errors.compared, 0u);
  EXPECT_LE(errors.position, wanted.position);
  EXPECT_LE(errors.attitude, wanted.attitude);
  EXPECT_LE(errors.joint_drift, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Reference, ReferenceLoop,
                         testing::Values(LoopCase{"andrews_squeezer", 1e-9, 1e-12, 1e-10},
                                         LoopCase{"slider_crank", 1e-11, 1e-11, 1e-11},
                                         LoopCase{"n_four_bar_N1", 1e-10, 1e-8, 1e-8},
                                         LoopCase{"n_four_bar_N2", 1e-10, 1e-7, 1e-7},
                                         LoopCase{"n_four_bar_N40", 1e-9, 3e-6, 3e-6}),
                         [](const auto& test) { return test_name(test.param.name); });

TEST(ReferenceProblems, LongRunKeepsEnergy) {
  // A free body's energy is conserved for 1000 s, although its attitude is long lost. rk4 gains or loses c
  // h^5 a step: three times the 8.5e-9 found at this step.
  REQUIRE_REFERENCE_FOLDER(folder);
  const std::optional<ReferenceProblem> problem = loaded(folder / "dzhanibekov_long_run.json");
  ASSERT_TRUE(problem.has_value());
  const RunErrors errors = run(*problem, {.step = 1e-3});
  EXPECT_EQ(errors.failure, "");
  EXPECT_LT(errors.energy, 3e-8);
}

}  // namespace
}  // namespace pantin::test
