#include "support/gltf_files.hpp"

using namespace pantin;
using namespace pantin::test;

namespace {

std::string one_node_and(const std::string& rest) {
  return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], )" + rest + "}";
}

TEST(GltfInventory, CountsEachKindThatIsLeftOut) {
  // Looks are left out on purpose and only noted; what would change shapes is a warning.
  const Loaded<Model> loaded = load_text(one_node_and(R"("nodes": [{"camera": 0, "skin": 0}],
      "materials": [{}, {}, {}], "textures": [{}], "images": [{"uri": "no_such.png"}], "samplers": [{}],
      "cameras": [{}, {}], "skins": [{}])"));
  ASSERT_TRUE(loaded.value);
  const std::string looks = "not loaded: physics has no use for appearance";
  EXPECT_EQ(ledger(loaded),
            "model.gltf#/materials: note: materials: " + looks + " (3 times, first here)\n" +
                "model.gltf#/textures: note: textures: " + looks + "\n" +
                "model.gltf#/images: note: images: " + looks + "\n" +
                "model.gltf#/samplers: note: samplers: " + looks + "\n" +
                "model.gltf#/cameras: note: cameras: " + looks + " (2 times, first here)\n" +
                "model.gltf#/skins: warning: skins: not loaded: skinned meshes keep the shape they have "
                "in the file\n" +
                "model.gltf: note: file: not needed for physics and dropped: 1 'camera', 1 'skin'\n");
}

TEST(GltfInventory, CountsVertexDataAndMorphTargets) {
  // Positions are all that physics needs of vertices; morph targets would move them, so that is a warning.
  GltfText text;
  text.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const std::string primitive =
      R"({"attributes": {"POSITION": 0, "NORMAL": 0, "_HEAT": 0}, "targets": [{"POSITION": 0}]})";
  const Loaded<Model> loaded = load_text(
      text.embedded(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [)" +
                    primitive + ", " + primitive + "]}]"));
  const std::string primitives = "model.gltf#/meshes/0/primitives/0/";
  EXPECT_EQ(
      ledger(loaded),
      primitives +
          "attributes/NORMAL: note: vertex attribute 'NORMAL': not loaded: physics needs positions only (2 "
          "times, first here)\n" +
          primitives +
          "attributes/_HEAT: note: vertex attribute '_HEAT': not loaded: physics needs positions only (2 "
          "times, first here)\n" +
          primitives +
          "targets: warning: morph targets: not loaded: the mesh keeps its base shape (2 times, first "
          "here)\n");
}

TEST(GltfInventory, TellsKnownLooksFromUnknownExtensions) {
  // Lights and materials are looks: a note. Nobody knows what an unknown extension means: a warning.
  // Extensions that are only named in extensionsUsed count as well.
  const Loaded<Model> loaded =
      load_text(one_node_and(R"("extensionsUsed": ["ACME_gears", "KHR_lights_punctual"],
      "extensions": {"KHR_lights_punctual": {"lights": [{}]}},
      "nodes": [{"extensions": {"ACME_gears": {"teeth": 12}, "KHR_lights_punctual": {"light": 0}}}])"));
  EXPECT_EQ(ledger(loaded),
            "model.gltf#/extensions/KHR_lights_punctual: note: extension 'KHR_lights_punctual': not loaded: "
            "physics has no "
            "use for appearance (3 times, first here)\n"
            "model.gltf#/nodes/0/extensions/ACME_gears: warning: extension 'ACME_gears': not known to "
            "Pantin: what it says "
            "is dropped (2 times, first here); express it in core glTF 2.0 if it matters\n");
}

TEST(GltfInventory, TellsOfMisspeltPropertiesAndExtras) {
  // A misspelt member would otherwise just have no effect.
  const Loaded<Model> loaded = load_text(one_node_and(
      R"("nodes": [{"translate": [1, 2, 3], "extras": {"a": 1}}], "extras": [], "asset_copy": 1)"));
  EXPECT_EQ(ledger(loaded),
            "model.gltf: warning: property 'asset_copy': glTF 2.0 does not know it here: dropped; check its "
            "spelling\n"
            "model.gltf#/extras: note: extras: not read: data of applications (2 times, first here)\n"
            "model.gltf#/nodes/0: warning: property 'translate': glTF 2.0 does not know it here: dropped; "
            "check its "
            "spelling\n");
}

TEST(GltfInventory, KnowsEveryPropertyOfCoreGltf) {
  // All properties of glTF 2.0 (chapter 5) of the objects that are gone through, each used once: nothing is
  // unknown.
  GltfText text;
  const std::size_t view = text.view(packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}),
                                     R"(, "byteStride": 12, "target": 34962, "name": "v")");
  const std::size_t indices = text.view(packed<std::uint8_t>({0}));
  const std::size_t values = text.view(packed<float>({0, 0, 0}));
  text.accessor("\"name\": \"a\", \"bufferView\": " + std::to_string(view) +
                ", \"byteOffset\": 0, \"componentType\": 5126, \"normalized\": false, "
                "\"count\": 3, \"type\": \"VEC3\", \"min\": [0, 0, 0], \"max\": [1, 1, 0], "
                "\"sparse\": {\"count\": 1, \"indices\": {\"bufferView\": " +
                std::to_string(indices) +
                ", \"byteOffset\": 0, \"componentType\": 5121}, \"values\": {\"bufferView\": " +
                std::to_string(values) + ", \"byteOffset\": 0}}");
  text.floats({0}, "SCALAR");
  text.floats({1, 1, 1}, "VEC3");
  const Loaded<Model> loaded = load_text(text.embedded(R"("scene": 0, "scenes": [{"nodes": [0], "name": "s"}],
      "extensionsUsed": [], "extensionsRequired": [], "materials": [], "textures": [], "images": [], "samplers": [],
      "cameras": [], "skins": [],
      "nodes": [{"name": "n", "mesh": 0, "children": [1], "translation": [0, 0, 0], "rotation": [0, 0, 0, 1],
                 "scale": [1, 1, 1], "weights": [], "camera": 0, "skin": 0},
                {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}],
      "meshes": [{"name": "m", "weights": [], "primitives": [{"attributes": {"POSITION": 0}, "mode": 4, "material": 0}]}],
      "animations": [{"name": "c", "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}],
                      "samplers": [{"input": 1, "interpolation": "STEP", "output": 2}]}])"));
  EXPECT_EQ(sound(loaded).nodes.size(), 2U);
}

TEST(GltfInventory, StaysShortWhateverTheFileHolds) {
  // 10,000 different unknown properties: 200 kinds are told, the rest is counted in one line.
  std::string members;
  for (int i = 0; i < 10'000; ++i) members += ", \"p" + std::to_string(i) + "\": 0";
  const Loaded<Model> loaded = load_text(one_node_and("\"nodes\": [{\"name\": \"n\"" + members + "}]"));
  ASSERT_TRUE(loaded.value);
  ASSERT_EQ(loaded.notes.size(), 201U);
  EXPECT_EQ(loaded.notes.back().problem, "there are findings of further kinds (9800 times, first here)");
}

TEST(GltfDocument, ReadsLaterMinorVersions) {
  // glTF 2.0, 3.2: a reader of 2.0 may read any 2.x unless minVersion forbids it.
  const Loaded<Model> loaded = load_text(
      R"({"asset": {"version": "2.7", "minVersion": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{}]})");
  EXPECT_TRUE(loaded.value);
  EXPECT_EQ(ledger(loaded),
            "model.gltf#/asset/version: note: 'asset': the model is glTF 2.7 and is read as glTF 2.0\n");
}

}  // namespace
