#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/gltf_files.hpp"

using namespace pantin;
using namespace pantin::test;

namespace {

const std::filesystem::path kAssets = std::filesystem::path{PANTIN_SOURCE_DIR} / "assets";

std::size_t position_of(const Model& model, const std::string& name) {
  const auto found = std::ranges::find(model.nodes, name, &ModelNode::name);
  EXPECT_NE(found, model.nodes.end()) << name;
  return static_cast<std::size_t>(found - model.nodes.begin());
}

const Track& track_of(const Model& model, const std::string& name, Channel channel) {
  const std::size_t node = position_of(model, name);
  const auto& tracks = model.clips.at(0).tracks;
  return *std::ranges::find_if(tracks,
                               [&](const Track& t) { return t.target == node && t.channel == channel; });
}

std::string path_of(const Model& model, std::size_t node) {
  std::string path = model.nodes[node].name;
  for (std::int32_t up = model.nodes[node].parent; up >= 0;
       up = model.nodes[static_cast<std::size_t>(up)].parent)
    path = model.nodes[static_cast<std::size_t>(up)].name + '/' + path;
  return path;
}

void expect_closed_meshes(const Model& model) {
  for (const ModelNode& node : model.nodes) {
    for (const ModelMesh& mesh : node.meshes) {
      EXPECT_FALSE(closedness_problem(*mesh.mesh)) << node.name;
      EXPECT_GT(volume_of(MeshShape{.mesh = mesh.mesh}), 0.0) << node.name;  // turned outward
    }
  }
}

TEST(MobileAsset, IsTheCraneItIsSaidToBe) {
  // What assets/make_assets.py builds and README names: a hierarchy of five levels, closed meshes, one clip.
  const Model model = sound(load_gltf(kAssets / "mobile.gltf"));
  EXPECT_EQ(model.nodes.size(), 15U);
  EXPECT_EQ(path_of(model, position_of(model, "blade")), "tower/head/rotor/blade");
  EXPECT_EQ(path_of(model, position_of(model, "crate")), "tower/jib/cable/hook/crate");
  EXPECT_LT(model.nodes[position_of(model, "counterweight")].M_PN.linear().determinant(), 0.0);
  EXPECT_EQ(model.nodes[position_of(model, "crate")].mass->mass, 40.0);
  expect_closed_meshes(model);
  ASSERT_EQ(model.clips.size(), 1U);
  EXPECT_EQ(model.clips[0].name, "turn");
  EXPECT_EQ(model.clips[0].duration, 8.0);
  EXPECT_EQ(model.clips[0].tracks.size(), 6U);
}

TEST(MobileAsset, MovesAsItsFormulasSay) {
  // Rotor: 90 degrees a second about z, exact under slerp. Signal: steps of 30 degrees. Cable: 2 + sin(2 pi t
  // / 8) with exact tangents every 2 s; a cubic Hermite curve is off by at most d^4 / 384 * max |x''''| = 16
  // / 384 * (pi/4)^4.
  const Model model = sound(load_gltf(kAssets / "mobile.gltf"));
  const double omega = 2 * std::numbers::pi / 8;
  for (double t = 0.05; t < 8; t += 0.1) {
    const TrackSample rotor = sample(track_of(model, "rotor", Channel::Rotation), t);
    EXPECT_NEAR(std::abs(rotor.value[0]), std::abs(std::cos(t * std::numbers::pi / 4)),
                1e-7);  // keys are floats
    const double signal = t < 2 ? 15 : t < 4 ? 45 : t < 6 ? 75 : 45;
    EXPECT_NEAR(sample(track_of(model, "signal", Channel::Rotation), t).value[0],
                std::cos(signal * std::numbers::pi / 360), 1e-7);
    EXPECT_NEAR(sample(track_of(model, "cable", Channel::Translation), t).value[0], 2 + std::sin(omega * t),
                16.0 / 384 * std::pow(omega, 4) + 1e-7);
  }
}

TEST(MobileAsset, IsTheSameWithItsBufferApartAndAsGlb) {
  // The three forms of one document hold the same numbers to the last bit.
  const TemporaryFolder folder;
  std::ifstream stream{kAssets / "mobile.gltf"};
  std::string text{std::istreambuf_iterator<char>{stream}, {}};
  const std::string head = "data:application/octet-stream;base64,";
  const std::size_t start = text.find(head);
  const std::size_t end = text.find('"', start);
  const std::string data = text.substr(start + head.size(), end - start - head.size());
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : data.substr(0, data.find('='))) {
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    bits = bits << 6 | static_cast<std::uint32_t>(alphabet.find(c));
    held += 6;
    if (held >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 255U);
  }
  const std::string with_file = text.substr(0, start) + "part.bin" + text.substr(end);
  const std::size_t uri = text.rfind(", \"uri\"", start);
  const std::string without = text.substr(0, uri) + text.substr(end + 1);
  folder.write("part.bin", bytes);
  const Model embedded = sound(load_gltf(kAssets / "mobile.gltf"));
  for (const std::filesystem::path& file :
       {folder.write("a.gltf", with_file),
        folder.write("a.glb", glb(chunk("JSON", without) + chunk(std::string{"BIN\0", 4}, bytes)))}) {
    const Model other = sound(load_gltf(file));
    ASSERT_EQ(other.nodes.size(), embedded.nodes.size());
    for (std::size_t i = 0; i < other.nodes.size(); ++i) {
      const ModelNode& a = embedded.nodes[i];
      const ModelNode& b = other.nodes[i];
      EXPECT_EQ(a.name, b.name);
      EXPECT_EQ(a.parent, b.parent);
      EXPECT_EQ(a.M_PN.matrix(), b.M_PN.matrix());
      ASSERT_EQ(a.meshes.size(), b.meshes.size());
      for (std::size_t k = 0; k < a.meshes.size(); ++k) {
        EXPECT_EQ(a.meshes[k].mesh->vertices, b.meshes[k].mesh->vertices);
        EXPECT_EQ(a.meshes[k].mesh->triangles, b.meshes[k].mesh->triangles);
      }
    }
    for (std::size_t k = 0; k < embedded.clips.at(0).tracks.size(); ++k) {
      EXPECT_EQ(embedded.clips[0].tracks[k].times, other.clips.at(0).tracks.at(k).times);
      EXPECT_EQ(embedded.clips[0].tracks[k].values, other.clips[0].tracks[k].values);
    }
  }
}

TEST(PendulumRoomAsset, SwingsAsItsFormulaSays) {
  // The angle is 0.7 cos(pi t), given by keys with exact tangents every 0.25 s. With q = (cos a/2, 0, 0, sin
  // a/2) the fourth derivative of its numbers is below 0.35 pi^4 (1 + 0.35)^3 < 84, so the spline is off by
  // at most 0.25^4 / 384 * 84 < 9e-4; the rate by a few times that per quarter second.
  const Model model = sound(load_gltf(kAssets / "pendulum_room.glb"));
  EXPECT_EQ(model.format, "glb");
  EXPECT_EQ(model.clips.at(0).name, "swing");
  EXPECT_EQ(model.clips[0].duration, 2.0);
  expect_closed_meshes(model);
  const Track& track = track_of(model, "pivot", Channel::Rotation);
  EXPECT_EQ(track.interpolation, Interpolation::CubicSpline);
  for (double t = 0.03; t < 2; t += 0.07) {
    const double angle = 0.7 * std::cos(std::numbers::pi * t);
    const double rate = -0.7 * std::numbers::pi * std::sin(std::numbers::pi * t);
    const TrackSample swing = sample(track, t);
    EXPECT_NEAR(swing.value[3], std::sin(angle / 2), 9e-4);
    EXPECT_NEAR(swing.first[3], std::cos(angle / 2) * rate / 2, 2e-2);
  }
}

}  // namespace
