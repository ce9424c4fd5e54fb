// The bytes between pantin-import and the library.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include <pantin/bridge/loaders/import_wire.hpp>

namespace pantin {
namespace {

Loaded<Model> sample() {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}};
  mesh->triangles = {{0, 1, 2}};
  Model model{.name = "m", .format = "fbx", .up_axis = UpAxis::Y, .unit_m = 0.01};
  Affine M = Affine::Identity();
  M.linear() << 1, 2, 3, 0, -1, 4, 0, 0, 5;
  M.translation() << 6, 7, 8;
  model.nodes.push_back({.name = "top", .parent = -1, .place = "f"});
  model.nodes.push_back({.name = "a", .parent = 0, .M_PN = M, .meshes = {{"x", mesh, M}}, .place = "f"});
  model.nodes.push_back({.name = "", .parent = 1, .meshes = {{"y", mesh, Affine::Identity()}}, .place = "f"});
  model.clips.push_back({.name = "c",
                         .duration = 2,
                         .tracks = {{.target = 1,
                                     .channel = Channel::Rotation,
                                     .width = 4,
                                     .times = {0, 2},
                                     .values = {1, 0, 0, 0, 0, 1, 0, 0}}}});
  return {std::move(model), {{Severity::Warning, "f", "s", "p", "r"}, {Severity::Note, "f", "", "", ""}}};
}

TEST(ImportWire, BringsEverythingBack) {
  // A round trip; every number is a copy of its bits.
  const Loaded<Model> there = sample();
  const Loaded<Model> back = decode(encode(there), "f");
  ASSERT_TRUE(back.value.has_value());
  EXPECT_EQ(encode(back), encode(there));
  const Model& model = *back.value;
  EXPECT_EQ(model.up_axis, UpAxis::Y);
  EXPECT_EQ(model.unit_m, 0.01);
  ASSERT_EQ(model.nodes.size(), 3u);
  EXPECT_TRUE(model.nodes[1].M_PN.isApprox(there.value->nodes[1].M_PN, 0));
  EXPECT_EQ(model.nodes[1].place, "f");
  EXPECT_EQ(model.nodes[1].meshes.at(0).mesh, model.nodes[2].meshes.at(0).mesh);  // shared as before
  EXPECT_EQ(model.clips.at(0).tracks.at(0).values, there.value->clips[0].tracks[0].values);
  EXPECT_EQ(back.notes.at(0).remedy, "r");
}

TEST(ImportWire, BringsErrorsBack) {
  // A ledger alone.
  const Loaded<Model> back = decode(encode({{}, {{Severity::Error, "f", "s", "p", "r"}}}), "f");
  EXPECT_FALSE(back.value.has_value());
  EXPECT_EQ(back.notes.at(0).problem, "p");
}

TEST(ImportWire, RefusesEveryTruncation) {
  // The length stands in the header, so no beginning of an answer is one.
  const std::string whole = encode(sample());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Loaded<Model> back = decode(std::string_view{whole}.substr(0, size), "f");
    ASSERT_FALSE(back.value.has_value()) << size;
    ASSERT_TRUE(has_error(back.notes)) << size;
  }
  EXPECT_FALSE(decode(whole + 'x', "f").value.has_value());
}

TEST(ImportWire, SurvivesEveryDamagedByte) {
  // Each byte replaced by each of five values: what is still accepted keeps the rules that users rely on.
  const std::string whole = encode(sample());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int value : {0, 1, 0x7f, 0x80, 0xff}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(value);
      const Loaded<Model> back = decode(damaged, "f");
      ASSERT_NE(back.value.has_value(), has_error(back.notes)) << at;
      if (!back.value) continue;
      const auto nodes = static_cast<std::int32_t>(back.value->nodes.size());
      for (std::int32_t i = 0; i < nodes; ++i) {
        const ModelNode& node = back.value->nodes[static_cast<std::size_t>(i)];
        ASSERT_LT(node.parent, i);
        ASSERT_GE(node.parent, -1);
        ASSERT_TRUE(node.M_PN.matrix().allFinite());
        for (const ModelMesh& mesh : node.meshes) {
          for (const auto& triangle : mesh.mesh->triangles)
            for (const std::uint32_t index : triangle) ASSERT_LT(index, mesh.mesh->vertices.size());
        }
      }
      for (const Clip& clip : back.value->clips)
        for (const Track& track : clip.tracks) ASSERT_EQ(problem_with(track), "");
    }
  }
}

TEST(ImportWire, RefusesCountsThatTheBytesCannotHold) {
  // 2^60 notes are not reserved memory for, but refused.
  std::string bytes = encode(sample());
  const std::uint64_t lie = std::uint64_t{1} << 60;
  std::memcpy(bytes.data() + 24, &lie, sizeof lie);
  EXPECT_EQ(decode(bytes, "f").notes.at(0).problem,
            "pantin-import gave no usable answer: a count is beyond the end");
}

}  // namespace
}  // namespace pantin
