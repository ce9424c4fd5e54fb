// `pantin run`: physics, placement and refusals, seen through the program. Drives are in run_drives_test.cpp.
#include <cmath>
#include <numbers>

#include "models.hpp"
#include "program.hpp"

namespace pantin::test {
namespace {

/// The JSON of a run that has to succeed.
Json run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"run", "--json"});
  const Ran ran = pantin(arguments);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return ran.json();
}

TEST(Run, LetsAStoneFall) {
  // Free fall: z = -g t^2 / 2, v = -g t; RK4 is exact for a quadratic, so round-off over 240 steps is all.
  const TemporaryFolder folder;
  const Json result = run(
      {folder.write("stone.urdf", kStoneUrdf), "--floating-base", "--simulate", "all", "--duration", "1"});
  const Json& last = result["samples"].back()["bodies"]["stone"];
  EXPECT_NEAR(last["position_origin"][2].get<double>(), -9.81 / 2, 1e-12);
  EXPECT_NEAR(last["velocity_cog"][2].get<double>(), -9.81, 1e-12);
  EXPECT_EQ(last["drive"], "simulated");
  EXPECT_EQ(result["samples"].back()["energy"]["kinetic"].get<double>() +
                result["samples"].back()["energy"]["potential"].get<double>(),
            result["samples"].back()["energy"]["total"].get<double>());
  EXPECT_EQ(result["summary"]["steps"], 240);
  EXPECT_EQ(result["summary"]["evaluations"], 960);  // four stages a step
}

TEST(Run, HoldsAFixedBase) {
  // The base is fixed unless told otherwise: the stone is tied to the world and has nowhere to fall.
  const TemporaryFolder folder;
  const Json result =
      run({folder.write("stone.urdf", kPendulumUrdf), "--simulate", "all", "--duration", "0.5"});
  for (const Json& sample : result["samples"])
    if (sample["bodies"].contains("base")) {
      EXPECT_NEAR(sample["bodies"]["base"]["position_origin"][2].get<double>(), 0, 1e-15);
    }
}

TEST(Run, FollowsGravityAsGiven) {
  // x = a t^2 / 2 along the gravity that was asked for, nothing along any other axis.
  const TemporaryFolder folder;
  const Json result = run({folder.write("stone.urdf", kStoneUrdf), "--floating-base", "--simulate", "all",
                           "--duration", "1", "--gravity", "-2,0,0"});
  const Json& position = result["samples"].back()["bodies"]["stone"]["position_origin"];
  EXPECT_NEAR(position[0].get<double>(), -1, 1e-12);
  EXPECT_EQ(position[1].get<double>(), 0);
  EXPECT_EQ(position[2].get<double>(), 0);
}

TEST(Run, BeginsWithTheJointValuesGiven) {
  // A small swing about the lowest point: theta(t) = 0.01 cos(w t), w^2 = m g c / (I + m c^2). The next term
  // of the period is theta^2 / 16 relative, 6e-6 here, which shifts the phase by less than 2e-5 rad in 1 s.
  const TemporaryFolder folder;
  const Json result = run({folder.write("p.urdf", kPendulumUrdf), "--simulate", "all", "--joint",
                           "hinge=0.01", "--duration", "1", "--every", "0.25"});
  const double w = std::sqrt(2 * 9.81 * 0.5 / (0.2 + 2 * 0.25));
  EXPECT_NEAR(result["samples"][0]["joints"]["hinge"]["value"].get<double>(), 0.01, 1e-15);
  for (const Json& sample : result["samples"]) {
    const double t = sample["t"].get<double>();
    EXPECT_NEAR(sample["joints"]["hinge"]["value"].get<double>(), 0.01 * std::cos(w * t), 1e-6);
    EXPECT_NEAR(sample["joints"]["hinge"]["rate"].get<double>(), -0.01 * w * std::sin(w * t), 1e-6);
  }
}

TEST(Run, SaysHowTrueItStayed) {
  // A pendulum without damping keeps its energy; RK4 at 1/240 s on a swing of 1.4 s errs by about (w h)^5 a
  // step, 1e-9 and less over a few periods. Its body stays on its joint to round-off.
  const TemporaryFolder folder;
  const Json summary =
      run({folder.write("p.urdf", kPendulumUrdf), "--simulate", "all", "--joint", "hinge=1"})["summary"];
  EXPECT_EQ(summary["energy_conserved_expected"], true);
  EXPECT_GT(summary["energy_drift_relative"].get<double>(), 0);
  EXPECT_LT(summary["energy_drift_relative"].get<double>(), 1e-7);
  EXPECT_LT(summary["joint_drift_m"].get<double>(), 1e-12);
  EXPECT_LT(summary["joint_drift_rad"].get<double>(), 1e-12);
  EXPECT_EQ(summary["completed"], true);
  EXPECT_EQ(summary["integrator"], "rk4");
  EXPECT_EQ(summary["step"], 1.0 / 240);
  EXPECT_EQ(summary["duration"], 5.0);
}

TEST(Run, LeavesOutLimitsAndFrictionWhereAskedTo) {
  // A pendulum with dry friction hits its lower limit and comes to rest: energy is lost, events are counted.
  // With
  // --free-joints it swings through and keeps its energy.
  const TemporaryFolder folder;
  std::string text = kPendulumUrdf;
  const std::string axis = "<axis xyz=\"0 1 0\"/>", type = "continuous";
  text.insert(text.find(axis) + axis.size(),
              "<limit lower=\"-0.5\" upper=\"2\" effort=\"1\" velocity=\"1\"/><dynamics friction=\"0.4\"/>");
  if (const std::size_t at = text.find(type); at != std::string::npos)
    text.replace(at, type.size(), "revolute");
  const std::string file = folder.write("p.urdf", text);
  const Json held = run({file, "--simulate", "all", "--joint", "hinge=1", "--duration", "9"})["summary"];
  EXPECT_GE(held["joint_events"].get<int>(), 2);
  EXPECT_EQ(held["crowded"], 0);
  EXPECT_TRUE(held["energy_drift_relative"].is_null());
  EXPECT_LT(held["energy_final"].get<double>(), held["energy_initial"].get<double>() - 1);
  const Json free = run({file, "--simulate", "all", "--joint", "hinge=1", "--free-joints"})["summary"];
  EXPECT_EQ(free["joint_events"], 0);
  EXPECT_LT(free["energy_drift_relative"].get<double>(), 1e-7);
}

TEST(Run, ExpectsNoConservationUnderDamping) {
  // Damping takes energy, so a drift would mean nothing: it is null, and the energy at the end is less.
  const TemporaryFolder folder;
  std::string text = kPendulumUrdf;
  const std::string axis = "<axis xyz=\"0 1 0\"/>";
  text.insert(text.find(axis) + axis.size(), "<dynamics damping=\"0.5\"/>");
  const Json summary =
      run({folder.write("p.urdf", text), "--simulate", "all", "--joint", "hinge=1"})["summary"];
  EXPECT_EQ(summary["energy_conserved_expected"], false);
  EXPECT_TRUE(summary["energy_drift_relative"].is_null());
  EXPECT_LT(summary["energy_final"].get<double>(), summary["energy_initial"].get<double>() - 1);
}

TEST(Run, TakesTheIntegratorAskedFor) {
  // Explicit Euler falls short of the parabola by exactly g h t / 2, semi-implicit Euler overshoots by the
  // same.
  const TemporaryFolder folder;
  const std::string file = folder.write("stone.urdf", kStoneUrdf);
  const auto height = [&](const std::string& integrator) {
    return run({file, "--floating-base", "--simulate", "all", "--duration", "1", "--step", "0.01", "--every",
                "1", "--integrator", integrator})["samples"]
        .back()["bodies"]["stone"]["position_origin"][2]
        .get<double>();
  };
  EXPECT_NEAR(height("euler"), -9.81 / 2 + 9.81 * 0.01 / 2, 1e-12);
  EXPECT_NEAR(height("semi-implicit-euler"), -9.81 / 2 - 9.81 * 0.01 / 2, 1e-12);
}

TEST(Run, StridesFromSampleToSample) {
  // A stone under gravity is a parabola, which gauss8 follows in any step: with --adaptive two samples take
  // two updates, without it 200 steps of 0.01 s.
  const TemporaryFolder folder;
  const std::string file = folder.write("stone.urdf", kStoneUrdf);
  std::vector<std::string> arguments{
      file,   "--floating-base", "--simulate", "all",          "--duration", "2", "--every", "1", "--step",
      "0.01", "--tolerance",     "1e-9",       "--integrator", "gauss8"};
  EXPECT_EQ(run(arguments)["summary"]["steps"], 200);
  arguments.push_back("--adaptive");
  const nlohmann::json told = run(arguments);
  EXPECT_EQ(told["summary"]["steps"], 2);
  EXPECT_NEAR(told["samples"].back()["bodies"]["stone"]["position_origin"][2].get<double>(), -2 * 9.81,
              1e-11);
  const Ran ran = pantin({"run", file, "--simulate", "all", "--adaptive"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(ran.says("--adaptive: needs --integrator dormand-prince, gauss8, gauss16 or radau, not rk4"))
      << ran.err;
}

TEST(Run, TurnsModelsOfAnotherUpAxis) {
  // The cart rises along +Y of its file; with Z up in the scene that is +Z, and gravity acts along -Z.
  const TemporaryFolder folder;
  const std::string urdf = folder.write("stone.urdf", kStoneUrdf);
  const std::string gltf = folder.write("cart.gltf", cart_gltf());
  const Json result = run({urdf, gltf, "--animate", "cart/track/cart=rise", "--duration", "1"});
  const Json& cart = result["samples"].back()["bodies"]["cart/track/cart"];
  EXPECT_NEAR(cart["position_origin"][2].get<double>(), 1, 1e-12);
  EXPECT_NEAR(cart["velocity_cog"][2].get<double>(), 1, 1e-12);
  EXPECT_NEAR(cart["position_origin"][1].get<double>(), 0, 1e-12);
  EXPECT_NE(
      result["ledger"].dump().find("Y is up in the file, Z in the scene: the node 'cart' above the model"),
      std::string::npos)
      << result["ledger"];
  const Json own = run({gltf, "--up", "Y", "--animate", "track=rise", "--duration", "1"});
  EXPECT_NEAR(own["samples"].back()["bodies"]["track/cart"]["position_origin"][1].get<double>(), 1, 1e-12);
}

TEST(Run, TellsEqualFilesApart) {
  // Two files of the same name get one node each, numbered as siblings of equal name are.
  const TemporaryFolder folder;
  const std::string file = folder.write("stone.urdf", kStoneUrdf);
  const Json result = run({file, file, "--floating-base", "--simulate", "all", "--duration", "0.1"});
  const Json& bodies = result["samples"].back()["bodies"];
  EXPECT_TRUE(bodies.contains("stone[0]/stone")) << bodies;
  EXPECT_TRUE(bodies.contains("stone[1]/stone")) << bodies;
}

TEST(Run, NamesJointsByPathWhereNamesRepeat) {
  // Both pendulums call their joint 'hinge': the key is the path of the child then.
  const TemporaryFolder folder;
  const std::string a = folder.write("a.urdf", kPendulumUrdf);
  const std::string b = folder.write("b.urdf", kPendulumUrdf);
  const Json result = run({a, b, "--simulate", "all", "--joint", "b/base/rod=0.5", "--duration", "0.1"});
  const Json& joints = result["samples"][0]["joints"];
  EXPECT_EQ(joints["a/base/rod"]["value"].get<double>(), 0);
  EXPECT_NEAR(joints["b/base/rod"]["value"].get<double>(), 0.5, 1e-15);  // by way of a quaternion
}

TEST(Run, WarnsWhenThereIsNothingToDo) {
  // A robot of which nothing is simulated stands still: allowed, but said.
  const TemporaryFolder folder;
  const Json result = run({folder.write("p.urdf", kPendulumUrdf), "--duration", "0.1"});
  EXPECT_NE(result["ledger"].dump().find("nothing is simulated and nothing is animated"), std::string::npos);
  EXPECT_EQ(result["samples"].size(), 7u);
}

TEST(Run, KeepsWhatWasReachedWhenNumbersOverflow) {
  // At 1e307 m/s^2 the speed passes the largest double, 1.8e308 m/s, within 18 s at the latest: exit 3, the
  // message says what to do, and the samples until then are in the file.
  const TemporaryFolder folder;
  const std::string out = folder.path("t.json");
  const Ran ran =
      pantin({"run", folder.write("stone.urdf", kStoneUrdf), "--floating-base", "--simulate", "all",
              "--gravity", "1e307,0,0", "--duration", "30", "--every", "0.1", "--out", out});
  EXPECT_EQ(ran.code, 3) << ran.err;
  EXPECT_TRUE(ran.says("simulation")) << ran.err;
  EXPECT_NE(ran.out.find("wrote what was reached to"), std::string::npos) << ran.out;
  const Json result = Json::parse(content_of(out));
  EXPECT_EQ(result["summary"]["completed"], false);
  EXPECT_GT(result["samples"].size(), 1u);
  EXPECT_LT(result["samples"].size(), 200u);
  EXPECT_NE(result["ledger"].dump().find("\"error\""), std::string::npos);
  for (const Json& sample : result["samples"])
    for (const Json& x : sample["bodies"]["stone"]["position_origin"]) EXPECT_FALSE(x.is_null());
}

struct Refusal {
  std::vector<std::string> arguments{};
  std::string says{};
};

TEST(Run, RefusesBeforeAnythingRuns) {
  // Bad names are found before the first step: exit 1, a remedy, and no output file.
  const TemporaryFolder folder;
  const std::string urdf = folder.write("p.urdf", kPendulumUrdf);
  const std::string gltf = folder.write("cart.gltf", cart_gltf());
  const std::string out = folder.path("t.csv");
  const std::vector<Refusal> refusals{
      {{urdf, "--simulate", "base/rodd"},
       "--simulate 'base/rodd': no node has the path 'base/rodd'; did you mean 'base/rod'?"},
      {{urdf, "--simulate", "rod"}, "did you mean 'base/rod'?"},
      {{urdf, "--toggle", "1:base/rob=simulated"}, "--toggle 'base/rob': no node has the path 'base/rob'"},
      {{urdf, "--animate", "nobody"}, "--animate 'nobody': no node has the path 'nobody'"},
      {{urdf, "--animate", "base"}, "--animate 'base': the model has no clips; leave it out"},
      {{gltf, "--animate", "track=goo"}, "--animate 'goo': the model has no clip 'goo'; did you mean 'go'?"},
      {{urdf, "--joint", "hinges=1"}, "no link has this name; did you mean 'hinge'?"},
      {{folder.path("none.urdf")}, "none.urdf: error: "},
      {{urdf, folder.write("broken.urdf", kBrokenUrdf)}, "broken.urdf:3: error: "},
  };
  for (const Refusal& refusal : refusals) {
    std::vector<std::string> arguments{"run", "--out", out};
    arguments.insert(arguments.end(), refusal.arguments.begin(), refusal.arguments.end());
    const Ran ran = pantin(arguments);
    EXPECT_EQ(ran.code, 1) << refusal.says;
    EXPECT_TRUE(ran.says(refusal.says)) << refusal.says << "\n" << ran.err;
    EXPECT_FALSE(fs::exists(out));
  }
}

TEST(Run, SaysWhyItCannotWrite) {
  // Output is opened before the run, so nothing is simulated in vain, and no temporary file stays behind.
  const TemporaryFolder folder;
  const std::string file = folder.write("p.urdf", kPendulumUrdf);
  fs::create_directory(folder.path("folder.csv"));
  const Ran no_folder = pantin({"run", file, "--out", folder.path("nowhere/t.csv")});
  EXPECT_EQ(no_folder.code, 1);
  EXPECT_TRUE(no_folder.says("t.csv: error: output file: cannot be created: No such file or directory"))
      << no_folder.err;
  const Ran is_folder = pantin({"run", file, "--out", folder.path("folder.csv")});
  EXPECT_EQ(is_folder.code, 1);
  EXPECT_TRUE(is_folder.says("folder.csv: error: output file: is a folder")) << is_folder.err;
  EXPECT_EQ(mkfifo(folder.path("pipe.csv").c_str(), 0600), 0);
  const Ran is_pipe = pantin({"run", file, "--out", folder.path("pipe.csv")});
  EXPECT_EQ(is_pipe.code, 1);
  EXPECT_TRUE(is_pipe.says("pipe.csv: error: output file: exists and is not a regular file")) << is_pipe.err;
  EXPECT_EQ(folder.names().size(), 3u);
}

TEST(Run, TellsPeopleASummary) {
  // Without --json people get the account of the run, and no bar where standard error is no terminal.
  const TemporaryFolder folder;
  const Ran ran =
      pantin({"run", folder.write("p.urdf", kPendulumUrdf), "--simulate", "all", "--duration", "1"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err, "");
  for (const char* text : {"bodies", "joints", "240 of 1/240 s with rk4", "61 samples", "energy drift",
                           "joint drift", "wall time"})
    EXPECT_NE(ran.out.find(text), std::string::npos) << text << "\n" << ran.out;
}

}  // namespace
}  // namespace pantin::test
