// EXT_mesh_gpu_instancing.
#include <gtest/gtest.h>

#include "support/gltf_files.hpp"

using namespace pantin;
using namespace pantin::test;

namespace {

/// A triangle (accessor 0) that a node carries as the attributes say.
std::string with_instances(const std::string& attributes) {
  return R"("nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": )" + attributes +
         R"(}}}], "scenes": [{"nodes": [0]}], "meshes": [{"name": "m", "primitives": [{"attributes": {"POSITION": 0}}]}])" +
         R"(, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "extensionsRequired": ["EXT_mesh_gpu_instancing"])";
}

TEST(GltfInstancing, PlacesACopyOfTheMeshForEachInstance) {
  // T R S by hand: the second copy is turned by 90 degrees about z, then doubled along its own x, then moved.
  GltfText text;
  text.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  text.floats({0, 0, 0, 5, 6, 7}, "VEC3");
  const float h = std::sqrt(0.5F);
  text.floats({0, 0, 0, 1, 0, 0, h, h}, "VEC4");
  text.floats({1, 1, 1, 2, 1, 1}, "VEC3");
  const Model model =
      sound(load_text(text.embedded(with_instances(R"({"TRANSLATION": 1, "ROTATION": 2, "SCALE": 3})"))));
  const auto& meshes = model.nodes.at(0).meshes;
  ASSERT_EQ(meshes.size(), 2U);
  EXPECT_EQ(meshes[0].mesh, meshes[1].mesh);
  EXPECT_TRUE(meshes[0].M_NS.matrix().isIdentity(0));
  EXPECT_LT((meshes[1].M_NS * Vector3{1, 0, 0} - Vector3{5, 8, 7}).norm(), 1e-6);  // h is a float
  EXPECT_LT((meshes[1].M_NS * Vector3{0, 1, 0} - Vector3{4, 6, 7}).norm(), 1e-6);
}

TEST(GltfInstancing, TellsOfOtherAttributes) {
  // Identifiers of instances say nothing about places.
  GltfText text;
  text.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  text.floats({0, 0, 0, 5, 6, 7}, "VEC3");
  const Loaded<Model> loaded = load_text(text.embedded(with_instances(R"({"TRANSLATION": 1, "_ID": 1})")));
  ASSERT_TRUE(loaded.value.has_value());
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_EQ(loaded.notes[0].subject, "instance attribute '_ID'");
}

TEST(GltfInstancing, RefusesAttributesOfDifferentLength) {
  // Which copy the missing numbers belong to cannot be told.
  GltfText text;
  text.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  text.floats({0, 0, 0, 5, 6, 7}, "VEC3");
  const Loaded<Model> loaded = load_text(text.embedded(with_instances(R"({"TRANSLATION": 1, "SCALE": 0})")));
  EXPECT_FALSE(loaded.value.has_value());
  EXPECT_NE(to_string(loaded.notes.at(0)).find("it has 3 instances where another attribute has 2"),
            std::string::npos)
      << to_string(loaded.notes[0]);
}

}  // namespace
