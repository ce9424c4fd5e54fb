#include "support/gltf_files.hpp"

using namespace pantin;
using namespace pantin::test;

namespace {

Loaded<Model> load_nodes(const std::string& content) { return load_text(GltfText{}.embedded(content)); }

std::string names_of(const Model& model) {
  std::string names;
  for (const ModelNode& node : model.nodes) names += node.name + '<' + std::to_string(node.parent) + ' ';
  return names;
}

TEST(GltfNodes, ComposeTranslationRotationScale) {
  // M = T R S by hand: a quarter turn about z takes x to y, after scaling by 2, 3, 4.
  const Model model = sound(load_nodes(R"("nodes": [{"name": "n", "translation": [1, 2, 3],
      "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "scale": [2, 3, 4]}], "scenes": [{"nodes": [0]}])"));
  Eigen::Matrix4d expected;
  expected << 0, -3, 0, 1, 2, 0, 0, 2, 0, 0, 4, 3, 0, 0, 0, 1;
  ASSERT_EQ(model.nodes.size(), 1U);
  // The square of the rounded sqrt(1/2) is 0.5 + 1 ulp: a few ulp of the greatest entry.
  EXPECT_LT((model.nodes[0].M_PN.matrix() - expected).cwiseAbs().maxCoeff(), 4e-15);
  EXPECT_EQ(model.nodes[0].M_PN.translation(), Vector3(1, 2, 3));
}

TEST(GltfNodes, KeepDoublesOfTheTextExactly) {
  // 0.1 and 1/3 are not floats: a reader that passes through float would be off by 1e-9.
  const Model model = sound(load_nodes(
      R"("nodes": [{"translation": [0.1, 0.3333333333333333, 1e-300], "scale": [0.7, 1, 1]}], "scenes": [{"nodes": [0]}])"));
  EXPECT_EQ(model.nodes[0].M_PN.translation(), Vector3(0.1, 0.3333333333333333, 1e-300));
  EXPECT_EQ(model.nodes[0].M_PN.linear(), Matrix3(Vector3(0.7, 1, 1).asDiagonal()));
}

TEST(GltfNodes, ReadMatricesByColumns) {
  // glTF 2.0, 3.5.2: column-major. The shear survives, which no translation, rotation and scale could hold.
  const Model model = sound(load_nodes(
      R"("nodes": [{"matrix": [1, 0, 0, 0, 0.25, 1, 0, 0, 0, 0, -2, 0, 5, 6, 7, 1]}], "scenes": [{"nodes": [0]}])"));
  Eigen::Matrix4d expected;
  expected << 1, 0.25, 0, 5, 0, 1, 0, 6, 0, 0, -2, 7, 0, 0, 0, 1;
  EXPECT_EQ(model.nodes[0].M_PN.matrix(), expected);
}

TEST(GltfNodes, TakeScaleOfZeroAndMirrors) {
  // Both are legal glTF: a node may be scaled away, and a negative scale mirrors.
  const Model model = sound(
      load_nodes(R"("nodes": [{"scale": [0, 0, 0]}, {"scale": [-1, 2, 1]}], "scenes": [{"nodes": [0, 1]}])"));
  EXPECT_EQ(model.nodes[0].M_PN.linear(), Matrix3::Zero());
  EXPECT_EQ(model.nodes[1].M_PN.linear().determinant(), -2);
}

TEST(GltfNodes, NormaliseQuaternionsAloud) {
  // [0, 0, 3, 3] is the quarter turn about z, three times too long; one warning tells of both nodes.
  const Loaded<Model> loaded = load_nodes(
      R"("nodes": [{"name": "a", "rotation": [0, 0, 3, 3]}, {"rotation": [0, 5, 0, 0]}], "scenes": [{"nodes": [0, 1]}])");
  EXPECT_EQ(
      ledger(loaded),
      "model.gltf#/nodes/0/rotation: warning: node 0 'a': a quaternion is not of unit length: normalised "
      "(2 times, first here); write unit quaternions x, y, z, w\n");
  EXPECT_LT((loaded.value->nodes[0].M_PN.linear() * Vector3::UnitX() - Vector3::UnitY()).norm(), 1e-15);
}

TEST(GltfNodes, StandDepthFirstWithGivenNames) {
  // The order is that of the scene and of the children lists, parents first; names are kept, equal and empty
  // ones too.
  const Loaded<Model> loaded = load_nodes(R"("nodes": [{"name": "leaf"}, {"name": "top", "children": [3, 0]},
      {"name": "leaf"}, {"children": [2]}, {"name": "other"}], "scenes": [{"nodes": [4, 1]}])");
  const Model model = sound(loaded);
  EXPECT_EQ(names_of(model), "other<-1 top<-1 <1 leaf<2 leaf<1 ");
  EXPECT_TRUE(model.nodes[3].place.ends_with("model.gltf#/nodes/2")) << model.nodes[3].place;
}

TEST(GltfNodes, TellUpAxisUnitFormatAndName) {
  // glTF 2.0, 3.4: +Y is up and lengths are metres.
  const Model model = sound(load_nodes(R"("nodes": [{}], "scenes": [{"nodes": [0]}])"));
  EXPECT_EQ(model.up_axis, UpAxis::Y);
  EXPECT_EQ(model.unit_m, 1.0);
  EXPECT_EQ(model.format, "gltf");
  EXPECT_EQ(model.name, "model");
}

TEST(GltfNodes, ComeFromTheDefaultScene) {
  // Scene 1 is the default; the node of scene 0 is left out and told of.
  const Loaded<Model> loaded = load_nodes(
      R"("nodes": [{"name": "a"}, {"name": "b"}], "scenes": [{"nodes": [0]}, {"name": "main", "nodes": [1]}], "scene": 1)");
  EXPECT_EQ(names_of(loaded.value.value()), "b<-1 ");
  EXPECT_EQ(ledger(loaded),
            "model.gltf#/scenes/1: note: scenes: of 2 scenes the default one, scene 1 'main', is loaded\n"
            "model.gltf#/nodes/0: note: nodes: not in the scene: not loaded; add them to the scene\n"
            "model.gltf: note: file: not needed for physics and dropped: 1 'name'\n");
}

TEST(GltfNodes, ComeFromTheFirstSceneWithoutADefault) {
  // No `scene`: the first is taken and said so.
  const Loaded<Model> loaded =
      load_nodes(R"("nodes": [{"name": "a"}], "scenes": [{"nodes": [0]}, {"nodes": [0]}])");
  EXPECT_EQ(names_of(loaded.value.value()), "a<-1 ");
  EXPECT_EQ(ledger(loaded),
            "model.gltf#/scenes/0: note: scenes: of 2 scenes the first one, scene 0, is loaded\n");
}

TEST(GltfNodes, AreAllTakenWithoutAnyScene) {
  // glTF 2.0 allows a document without scenes; its roots are the nodes that are no children.
  const Loaded<Model> loaded =
      load_nodes(R"("nodes": [{"name": "a"}, {"name": "b", "children": [0]}, {"name": "c"}])");
  EXPECT_EQ(names_of(loaded.value.value()), "b<-1 a<0 c<-1 ");
  EXPECT_EQ(ledger(loaded), "model.gltf: note: scene: the model has no scene: all its nodes are loaded\n");
}

TEST(GltfNodes, MakeAChainOfAnyLength) {
  // 100,000 nodes one below the other: a reader that recurses overflows its stack.
  constexpr int kLength = 100'000;
  std::string nodes;
  for (int i = 0; i < kLength - 1; ++i)
    nodes += "{\"translation\": [1, 0, 0], \"children\": [" + std::to_string(i + 1) + "]}, ";
  const Model model = sound(load_nodes("\"nodes\": [" + nodes + "{}], \"scenes\": [{\"nodes\": [0]}]"));
  ASSERT_EQ(model.nodes.size(), static_cast<std::size_t>(kLength));
  for (int i = 0; i < kLength; ++i) ASSERT_EQ(model.nodes[static_cast<std::size_t>(i)].parent, i - 1);
}

TEST(GltfNodes, AreRefusedInACycleOfAnyLength) {
  // 100,000 nodes in a ring: found without recursion, and the node named is one of the ring.
  constexpr int kLength = 100'000;
  std::string nodes;
  for (int i = 0; i < kLength; ++i)
    nodes += (i ? ", " : "") + ("{\"children\": [" + std::to_string((i + 1) % kLength)) + "]}";
  const Loaded<Model> ring = load_nodes("\"nodes\": [" + nodes + "]");
  EXPECT_FALSE(ring.value);
  EXPECT_NE(ledger(ring).find("the node is its own ancestor"), std::string::npos) << ledger(ring);
}

TEST(GltfNodes, TellOfEachBadOneUpToALimit) {
  // 30 bad nodes: the first 20 are told one by one, the rest is counted, so that a ledger stays readable.
  std::string nodes;
  for (int i = 0; i < 30; ++i) nodes += (i ? ", " : "") + std::string{R"({"scale": [1]})"};
  const Loaded<Model> loaded = load_nodes("\"nodes\": [" + nodes + "], \"scenes\": [{\"nodes\": [0]}]");
  EXPECT_FALSE(loaded.value);
  std::size_t errors = 0;
  for (const Diagnostic& finding : loaded.notes) errors += finding.severity == Severity::Error;
  EXPECT_EQ(errors, 21U);
  EXPECT_EQ(loaded.notes.back().problem, "has 10 more errors");
}

}  // namespace
