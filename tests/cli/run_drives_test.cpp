// `pantin run`: who moves what. The cart of cart_gltf() is carried along x at 2 m/s by its first clip.
#include "models.hpp"
#include "program.hpp"

namespace pantin::test {
namespace {

Json run(std::vector<std::string> arguments, const std::string& gravity = "0,0,0") {
  arguments.insert(arguments.begin(), {"run", "--json", "--gravity", gravity});
  const Ran ran = pantin(arguments);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return ran.json();
}

const Json& cart_at(const Json& result, double time) {
  for (const Json& sample : result["samples"])
    if (sample["t"] == time) return sample["bodies"].at("track/cart");
  throw std::runtime_error{"no sample at " + std::to_string(time)};
}

double x_at(const Json& result, double time) {
  return cart_at(result, time)["position_origin"][0].get<double>();
}
double y_at(const Json& result, double time) {
  return cart_at(result, time)["position_origin"][1].get<double>();
}

TEST(Drives, PlayTheFirstClipByDefault) {
  // The key frames say 2 m/s along x; velocity is the exact derivative of the clip. Keys are single precision
  // but whole numbers, so only round-off remains.
  const TemporaryFolder folder;
  const Json result = run({folder.write("cart.gltf", cart_gltf()), "--duration", "1", "--every", "0.25"});
  EXPECT_EQ(cart_at(result, 0.5)["drive"], "animated");
  EXPECT_NEAR(x_at(result, 0.5), 1, 1e-12);
  EXPECT_NEAR(cart_at(result, 0.5)["velocity_cog"][0].get<double>(), 2, 1e-12);
  EXPECT_EQ(result["summary"]["bodies"], 1);
  EXPECT_EQ(result["summary"]["bodies_simulated"], 0);
}

TEST(Drives, PlayTheClipNamed) {
  // "rise" moves along y at 1 m/s, whichever way it is named.
  const TemporaryFolder folder;
  const std::string file = folder.write("cart.gltf", cart_gltf());
  for (const char* argument : {"track=rise", "track/cart=rise", "track=[1]"}) {
    const Json result = run({file, "--animate", argument, "--duration", "1", "--every", "0.5"});
    EXPECT_NEAR(y_at(result, 1), 1, 1e-12) << argument;
    EXPECT_NEAR(x_at(result, 1), 0, 1e-12) << argument;
  }
}

TEST(Drives, PlayNothingIfToldSo) {
  // Without clips nothing is bound, so no body is there to be sampled.
  const TemporaryFolder folder;
  const Json result = run({folder.write("cart.gltf", cart_gltf()), "--animate", "none", "--duration", "0.5"});
  EXPECT_EQ(result["summary"]["bodies"], 0);
  EXPECT_TRUE(result["samples"][0]["bodies"].empty());
}

TEST(Drives, RefuseTwoClipsOnOneNode) {
  // One writer a node: the second clip is an error before anything runs.
  const TemporaryFolder folder;
  const Ran ran = pantin(
      {"run", folder.write("cart.gltf", cart_gltf()), "--animate", "track=go", "--animate", "track=rise"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_TRUE(ran.says("error")) << ran.err;
}

TEST(Drives, HandOverTheVelocityOfTheClip) {
  // Simulated from the start, without gravity: it flies on at the 2 m/s that the clip has at that instant.
  const TemporaryFolder folder;
  const Json result = run({folder.write("cart.gltf", cart_gltf()), "--simulate", "track/cart", "--duration",
                           "2", "--every", "0.5"});
  EXPECT_EQ(cart_at(result, 2)["drive"], "simulated");
  EXPECT_NEAR(x_at(result, 2), 4, 1e-12);
}

TEST(Drives, ToggleInFlightBothWays) {
  // Under gravity: animated until 0.5 s at 2 m/s along x, then a throw from (1, 0) with (2, 0) m/s, so at 1 s
  // it is at (2, -g/8); then animated again, and led back to the clip, which is never far below y = 0. RK4 is
  // exact here.
  const TemporaryFolder folder;
  const Json result = run({folder.write("cart.gltf", cart_gltf()), "--toggle", "0.5:track/cart=simulated",
                           "--toggle", "1:track/cart=animated", "--duration", "3.5", "--every", "0.25"},
                          "0,-9.81,0");
  EXPECT_EQ(cart_at(result, 0.25)["drive"], "animated");
  EXPECT_EQ(cart_at(result, 0.5)["drive"], "simulated");
  EXPECT_EQ(cart_at(result, 0.75)["drive"], "simulated");
  EXPECT_EQ(cart_at(result, 1)["drive"], "animated");
  EXPECT_NEAR(x_at(result, 0.5), 1, 1e-12);
  EXPECT_NEAR(x_at(result, 1), 2, 1e-12);
  EXPECT_NEAR(y_at(result, 1), -9.81 / 8, 1e-12);
  EXPECT_NEAR(y_at(result, 3.5), 0, 0.01);  // 10 time constants of the way back
  EXPECT_EQ(result["summary"]["toggles"], 2);
}

TEST(Drives, ToggleAtTimesBetweenSteps) {
  // 0.3137 s is no multiple of the step or of the samples: the clip is left at 2 * 0.3137 m, and the throw is
  // exact from there, so that at 1 s the cart is where the clip would be; y has fallen for 1 - 0.3137 s.
  const TemporaryFolder folder;
  const Json result = run(
      {folder.write("cart.gltf", cart_gltf()), "--toggle", "0.3137:track/cart=simulated", "--duration", "1"},
      "0,-9.81,0");
  EXPECT_NEAR(x_at(result, 1), 2, 1e-12);
  EXPECT_NEAR(y_at(result, 1), -9.81 / 2 * (1 - 0.3137) * (1 - 0.3137), 1e-12);
}

TEST(Drives, ToggleAtTimeZeroAndAtTheEnd) {
  // Both ends belong to the run: the first sample shows the toggle at 0, the last one that at the end.
  const TemporaryFolder folder;
  const Json result = run({folder.write("cart.gltf", cart_gltf()), "--toggle", "0:track/cart=simulated",
                           "--toggle", "1:track/cart=animated", "--duration", "1", "--every", "0.5"});
  EXPECT_EQ(cart_at(result, 0)["drive"], "simulated");
  EXPECT_EQ(cart_at(result, 0.5)["drive"], "simulated");
  EXPECT_EQ(cart_at(result, 1)["drive"], "animated");
}

TEST(Drives, SayWhenAToggleChangesNothing) {
  // What is animated stays animated, what is simulated stays simulated: most likely a slip of the user's.
  const TemporaryFolder folder;
  const std::string file = folder.write("cart.gltf", cart_gltf());
  const Json animated = run({file, "--toggle", "0.1:track/cart=animated", "--duration", "0.2"});
  EXPECT_NE(animated["ledger"].dump().find("changes nothing: no node at or below it was simulated"),
            std::string::npos);
  const Json simulated =
      run({file, "--simulate", "track/cart", "--toggle", "0.1:track/cart=simulated", "--duration", "0.2"});
  EXPECT_NE(simulated["ledger"].dump().find("changes nothing: it was simulated already"), std::string::npos);
}

TEST(Drives, MeasureTheDriftAfreshAfterAToggle) {
  // Handing over adds the cart's energy at once; that is no drift of the integrator.
  const TemporaryFolder folder;
  const Json summary =
      run({folder.write("cart.gltf", cart_gltf()), "--toggle", "0.5:track/cart=simulated", "--duration", "2"},
          "0,-9.81,0")["summary"];
  EXPECT_EQ(summary["energy_initial"], 0.0);
  EXPECT_NEAR(summary["energy_final"].get<double>(), 2, 1e-9);  // 1 kg at 2 m/s, let go at height 0
  EXPECT_EQ(summary["energy_conserved_expected"], true);
  EXPECT_LT(summary["energy_drift_relative"].get<double>(), 1e-12);
}

TEST(Samples, LandExactlyOnTheirTimes) {
  // k * every for as long as that is before the end, then the end itself: the same products of doubles.
  const TemporaryFolder folder;
  const Json result = run({folder.write("cart.gltf", cart_gltf()), "--duration", "1", "--every", "0.3"});
  std::vector<double> times;
  for (const Json& sample : result["samples"]) times.push_back(sample["t"].get<double>());
  EXPECT_EQ(times, (std::vector<double>{0, 0.3, 2 * 0.3, 3 * 0.3, 1}));
  EXPECT_EQ(result["summary"]["samples"], 5);
}

TEST(Samples, AreNotTakenTwiceAtTheEnd) {
  // 0.1 * 3 is not 0.3 in binary; the last sample is the end and stands once.
  const TemporaryFolder folder;
  const Json result = run({folder.write("cart.gltf", cart_gltf()), "--duration", "0.3", "--every", "0.1"});
  ASSERT_EQ(result["samples"].size(), 4u);
  EXPECT_EQ(result["samples"].back()["t"], 0.3);
}

}  // namespace
}  // namespace pantin::test
