// What load_model does with the help of assimp.
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include <pantin/bridge/loaders/load_model.hpp>

namespace pantin {
namespace {

TEST(LoadModelByAssimp, ReadsForeignFormats) {
  // The extension leads to assimp, whose models carry it as their format.
  const Loaded<Model> loaded = load_model(PANTIN_SOURCE_DIR "/assets/meshes/lever.fbx");
  ASSERT_TRUE(loaded.value.has_value());
  EXPECT_EQ(loaded.value->format, "fbx");
}

TEST(LoadModelByAssimp, ReadsTheMeshesOfRobots) {
  // load_model hands load_mesh to the robot's loader: the pedestal's 12 triangles and the flange's 32 arrive.
  const Loaded<Model> loaded = load_model(PANTIN_SOURCE_DIR "/assets/arm.urdf");
  if (!loaded.value && loaded.notes.at(0).problem.find("load-urdf") != std::string::npos) {
    GTEST_SKIP() << "built without the loader of robots";
  }
  ASSERT_TRUE(loaded.value.has_value());
  const auto& nodes = loaded.value->nodes;
  EXPECT_EQ(std::get<MeshShape>(nodes[0].shapes.at(0).geometry).mesh->triangles.size(), 12u);
  EXPECT_EQ(std::get<MeshShape>(nodes[6].shapes.at(0).geometry).mesh->triangles.size(), 32u);
  for (const ModelNode& node : nodes) {
    for (const Shape& shape : node.shapes) {
      EXPECT_FALSE(problem_with(shape).has_value()) << node.name;
      if (const auto* mesh = std::get_if<MeshShape>(&shape.geometry)) {
        EXPECT_FALSE(closedness_problem(*mesh->mesh).has_value()) << node.name;
      }
    }
  }
}

}  // namespace
}  // namespace pantin
