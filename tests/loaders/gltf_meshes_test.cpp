#include "support/gltf_files.hpp"

using namespace pantin;
using namespace pantin::test;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// One node with one mesh of these primitives.
std::string with_mesh(const std::string& primitives) {
  return "\"nodes\": [{\"mesh\": 0}], \"scenes\": [{\"nodes\": [0]}], \"meshes\": [{\"name\": \"m\", "
         "\"primitives\": [" +
         primitives + "]}]";
}

const TriangleMesh& only_mesh(const Model& model) { return *model.nodes.at(0).meshes.at(0).mesh; }

/// Five corners on a line of x, so that a vertex tells its number.
std::vector<float> row(int count) {
  std::vector<float> numbers;
  for (int i = 0; i < count; ++i) numbers.insert(numbers.end(), {static_cast<float>(i), 0.1F, -2.5F});
  return numbers;
}

TEST(GltfMeshes, TakeFloatPositionsExactly) {
  // A float is a double: 0.1f comes out as the double nearest to the float, not to 0.1.
  GltfText text;
  text.floats(row(3), "VEC3");
  const Model model = sound(load_text(text.embedded(with_mesh(R"({"attributes": {"POSITION": 0}})"))));
  ASSERT_EQ(model.nodes[0].meshes.size(), 1U);
  EXPECT_EQ(model.nodes[0].meshes[0].name, "m");
  EXPECT_EQ(model.nodes[0].meshes[0].M_NS.matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(only_mesh(model).vertices,
            (std::vector<Vector3>{{0, 0.1F, -2.5}, {1, 0.1F, -2.5}, {2, 0.1F, -2.5}}));
  EXPECT_EQ(only_mesh(model).triangles, (Triangles{{0, 1, 2}}));
}

TEST(GltfMeshes, ReadIndicesOfAllThreeTypes) {
  // The same two triangles in bytes, shorts and ints.
  const Triangles expected{{0, 1, 2}, {2, 1, 3}};
  for (const int type : {5121, 5123, 5125}) {
    GltfText text;
    text.floats(row(4), "VEC3");
    const std::string bytes = type == 5121   ? packed<std::uint8_t>({0, 1, 2, 2, 1, 3})
                              : type == 5123 ? packed<std::uint16_t>({0, 1, 2, 2, 1, 3})
                                             : packed<std::uint32_t>({0, 1, 2, 2, 1, 3});
    text.accessor(bytes, type, "SCALAR", 6);
    const Model model =
        sound(load_text(text.embedded(with_mesh(R"({"attributes": {"POSITION": 0}, "indices": 1})"))));
    EXPECT_EQ(only_mesh(model).triangles, expected) << type;
  }
}

TEST(GltfMeshes, TurnStripsAndFansIntoTriangles) {
  // glTF 2.0, 3.7.2.1: strip p_i = {v_i, v_(i+1+i%2), v_(i+2-i%2)}, fan p_i = {v_(i+1), v_(i+2), v_0}; all
  // keep the winding of the first. Corners 2, 2 are the seam of two strips: no triangle with two equal
  // corners is made.
  GltfText text;
  text.floats(row(5), "VEC3");
  text.accessor(packed<std::uint8_t>({0, 1, 2, 2, 3, 4}), 5121, "SCALAR", 6);
  const auto triangles = [&](const std::string& members) {
    return only_mesh(sound(load_text(
                         text.embedded(with_mesh("{\"attributes\": {\"POSITION\": 0}, " + members + "}")))))
        .triangles;
  };
  EXPECT_EQ(triangles("\"mode\": 5"), (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(triangles("\"mode\": 6"), (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
  EXPECT_EQ(triangles("\"mode\": 5, \"indices\": 1"), (Triangles{{0, 1, 2}, {2, 4, 3}}));
}

TEST(GltfMeshes, MergePrimitives) {
  // Two primitives on one accessor share its vertices; a third brings its own, whose indices count on from
  // there.
  GltfText text;
  text.floats(row(4), "VEC3");
  text.floats(row(3), "VEC3");
  text.accessor(packed<std::uint8_t>({1, 2, 3}), 5121, "SCALAR", 3);
  text.accessor(packed<std::uint8_t>({0, 1, 2}), 5121, "SCALAR", 3);
  const Model model = sound(load_text(text.embedded(with_mesh(
      R"({"attributes": {"POSITION": 0}, "indices": 2}, {"attributes": {"POSITION": 1}, "indices": 3},
         {"attributes": {"POSITION": 0}, "indices": 3})"))));
  EXPECT_EQ(only_mesh(model).vertices.size(), 7U);
  EXPECT_EQ(only_mesh(model).triangles, (Triangles{{1, 2, 3}, {4, 5, 6}, {0, 1, 2}}));
}

TEST(GltfMeshes, AreSharedByNodes) {
  // Two nodes with the same mesh hold the same object, not copies.
  GltfText text;
  text.floats(row(3), "VEC3");
  const Model model = sound(load_text(text.embedded(
      R"("nodes": [{"mesh": 0}, {"mesh": 0}], "scenes": [{"nodes": [0, 1]}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])")));
  EXPECT_EQ(model.nodes[0].meshes.at(0).mesh.get(), model.nodes[1].meshes.at(0).mesh.get());
}

TEST(GltfMeshes, ReadInterleavedVertices) {
  // byteStride 16 and byteOffset 4: one number of something else before each position, none after the last.
  GltfText text;
  const std::size_t view =
      text.view(packed<float>({9, 1, 2, 3, 9, 4, 5, 6, 9, 7, 8, 9}), ", \"byteStride\": 16");
  text.accessor("\"bufferView\": " + std::to_string(view) +
                ", \"byteOffset\": 4, \"componentType\": 5126, \"type\": \"VEC3\", \"count\": 3");
  const Model model = sound(load_text(text.embedded(with_mesh(R"({"attributes": {"POSITION": 0}})"))));
  EXPECT_EQ(only_mesh(model).vertices, (std::vector<Vector3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST(GltfMeshes, ReadSparseAccessors) {
  // Element 1 is replaced; without a bufferView the others are zero (glTF 2.0, 3.6.2.3).
  for (const bool has_base : {true, false}) {
    GltfText text;
    const std::size_t base = text.view(packed(row(3)));
    const std::size_t indices = text.view(packed<std::uint16_t>({1}));
    const std::size_t values = text.view(packed<float>({7, 8, 9}));
    text.accessor(
        (has_base ? "\"bufferView\": " + std::to_string(base) + ", " : "") +
        "\"componentType\": 5126, \"type\": \"VEC3\", \"count\": 3, \"sparse\": {\"count\": 1, \"indices\": "
        "{\"bufferView\": " +
        std::to_string(indices) +
        ", \"componentType\": 5123}, \"values\": {\"bufferView\": " + std::to_string(values) + "}}");
    const Model model = sound(load_text(text.embedded(with_mesh(R"({"attributes": {"POSITION": 0}})"))));
    const Vector3 first = has_base ? Vector3{0, 0.1F, -2.5} : Vector3::Zero();
    const Vector3 last = has_base ? Vector3{2, 0.1F, -2.5} : Vector3::Zero();
    EXPECT_EQ(only_mesh(model).vertices, (std::vector<Vector3>{first, {7, 8, 9}, last}));
  }
}

TEST(GltfMeshes, ReadQuantisedPositions) {
  // KHR_mesh_quantization allows integers; normalised ones are c / 127 and c / 32767, at least -1.
  GltfText text;
  text.accessor(packed<std::int8_t>({0, 127, -128, 64, 0, 0, 0, -127, 1}), 5120, "VEC3", 3,
                ", \"normalized\": true");
  text.accessor(packed<std::uint16_t>({0, 1, 65535, 2, 3, 4, 5, 6, 7}), 5123, "VEC3", 3);
  const Model model = sound(load_text(text.embedded(
      R"("extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"], )" +
      with_mesh(R"({"attributes": {"POSITION": 0}}, {"attributes": {"POSITION": 1}})"))));
  EXPECT_EQ(only_mesh(model).vertices,
            (std::vector<Vector3>{
                {0, 1, -1}, {64 / 127.0, 0, 0}, {0, -1, 1 / 127.0}, {0, 1, 65535}, {2, 3, 4}, {5, 6, 7}}));
}

TEST(GltfMeshes, SayWhatIsNoTriangle) {
  // Lines, a primitive without positions and a cut-off triangle leave something out, each with its own
  // warning; the one whole triangle stays.
  GltfText text;
  text.floats(row(4), "VEC3");
  const Loaded<Model> loaded = load_text(text.embedded(with_mesh(
      R"({"attributes": {"POSITION": 0}, "mode": 1}, {"attributes": {}}, {"attributes": {"POSITION": 0}})")));
  EXPECT_EQ(
      ledger(loaded),
      "model.gltf#/meshes/0/primitives/0: warning: mesh 0 'm': points and lines have no volume: not loaded\n"
      "model.gltf#/meshes/0/primitives/1: warning: mesh 0 'm': a primitive without POSITION is not loaded\n"
      "model.gltf#/meshes/0/primitives/2: warning: mesh 0 'm': it ends within a triangle, which is not "
      "loaded; "
      "export the model again\n");
  EXPECT_EQ(only_mesh(loaded.value.value()).triangles, (Triangles{{0, 1, 2}}));
}

TEST(GltfMeshes, SayWhatGltfDoesNotAllowButCanBeRead) {
  // Integer positions without the extension, and an accessor with no bytes at all.
  GltfText text;
  text.accessor(packed<std::int16_t>({0, 1, 2, 3, 4, 5, 6, 7, 8}), 5122, "VEC3", 3);
  text.accessor("\"componentType\": 5126, \"type\": \"VEC3\", \"count\": 3");
  const Loaded<Model> loaded = load_text(
      text.embedded(with_mesh(R"({"attributes": {"POSITION": 0}}, {"attributes": {"POSITION": 1}})")));
  EXPECT_EQ(
      ledger(loaded),
      "model.gltf#/accessors/0: warning: accessor 0: integers stand where glTF 2.0 wants floats; read as "
      "they "
      "are; export the model again\n"
      "model.gltf#/accessors/1: warning: accessor 1: it has no bufferView: all its numbers are 0; export the "
      "model again\n");
  EXPECT_EQ(only_mesh(loaded.value.value()).vertices.at(2), Vector3(6, 7, 8));
}

TEST(GltfMeshes, AreLeftOutOnRequest) {
  // Without geometry not even the buffer is touched: its file does not exist.
  const std::string text =
      R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "accessors": [{"bufferView": 0, "count": 3,
      "componentType": 5126, "type": "VEC3"}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "buffers": [{"uri": "no_such_file.bin", "byteLength": 36}]})";
  EXPECT_TRUE(sound(load_text(text, {.geometry = false})).nodes.at(0).meshes.empty());
  EXPECT_FALSE(load_text(text).value);
}

TEST(GltfMeshes, OnNoNodeAreToldOf) {
  // Mesh 1 is on no node; its bytes are not read, so its wrong accessor does not matter.
  GltfText text;
  text.floats(row(3), "VEC3");
  const Loaded<Model> loaded = load_text(text.embedded(
      R"("nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]},
         {"name": "spare", "primitives": [{"attributes": {"POSITION": 9}}]}])"));
  EXPECT_TRUE(loaded.value);
  EXPECT_EQ(ledger(loaded), "model.gltf#/meshes/1: note: meshes: on no node of the scene: not loaded\n");
}

}  // namespace
