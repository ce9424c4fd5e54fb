// The scanner itself: what it must see and what it must let pass.
#include "source_tree.hpp"

#include <gtest/gtest.h>

namespace pantin::test {
namespace {

TEST(SourceTree, SeesEveryWayToWriteAnInclude) {
  // By hand; the commented one is not one.
  const std::vector<Include> found =
      includes_of("#include <a>\n  #  include \"b/c.hpp\"  // why\n// #include <d>\n#include<e.h>\n");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].name, "a");
  EXPECT_FALSE(found[0].quoted);
  EXPECT_EQ(found[1].name, "b/c.hpp");
  EXPECT_TRUE(found[1].quoted);
  EXPECT_EQ(found[2].name, "e.h");
}

TEST(SourceTree, SeesConditionsOfThePreprocessor) {
  // By hand: #endif and #else come with the others, #include is none.
  EXPECT_EQ(conditions_of("#ifdef A\n# if B\n#elif C\n#else\n#endif\n#ifndef D\n#include <if>\n").size(), 4u);
}

TEST(SourceTree, BreaksNoRuleWhereLayersHold) {
  // One of each that DESIGN's drawing of layers allows.
  EXPECT_FALSE(broken_rule("scenegraph/scene.cpp", {"vector"}));
  EXPECT_FALSE(broken_rule("scenegraph/sweep.cpp", {"immintrin.h"}));
  EXPECT_FALSE(broken_rule("scenegraph/scene.cpp", {"Eigen/Core"}));
  EXPECT_FALSE(broken_rule("physics/a/b.hpp", {"pantin/physics/pose.hpp"}));
  EXPECT_FALSE(broken_rule("physics/a/b.cpp", {"b.hpp", true}));
  EXPECT_FALSE(broken_rule("bridge/bridge.hpp", {"pantin/physics/pose.hpp"}));
  EXPECT_FALSE(broken_rule("bridge/loaders/x.cpp", {"assimp/scene.h"}));
  EXPECT_FALSE(broken_rule("bridge/writers/x.cpp", {"nlohmann/json.hpp"}));
  EXPECT_FALSE(broken_rule("bridge/cli/x.hpp", {"CLI/CLI.hpp"}));
  EXPECT_FALSE(broken_rule("tests/cli/x_test.cpp", {"nlohmann/json.hpp"}));
}

TEST(SourceTree, BreaksTheRuleOfEachLayer) {
  // One of each that the drawing forbids.
  EXPECT_TRUE(broken_rule("scenegraph/scene.cpp", {"pantin/physics/pose.hpp"}));
  EXPECT_TRUE(broken_rule("scenegraph/scene.cpp", {"../physics/pose.hpp", true}));
  EXPECT_TRUE(broken_rule("physics/x.hpp", {"pantin/scenegraph/scene.hpp"}));
  EXPECT_TRUE(broken_rule("physics/x.hpp", {"pantin/bridge/drive.hpp"}));
  EXPECT_TRUE(broken_rule("physics/x.cpp", {"nlohmann/json.hpp"}));
  EXPECT_TRUE(broken_rule("physics/x.cpp", {"unistd.h"}));
  EXPECT_TRUE(broken_rule("physics/x.cpp", {"fcl/fcl.h"}));
  EXPECT_TRUE(broken_rule("physics/collision/fcl_index.hpp", {"fcl/fcl.h"}));
  EXPECT_FALSE(broken_rule("physics/collision/fcl_index.cpp", {"fcl/fcl.h"}));
  EXPECT_TRUE(broken_rule("bridge/bridge.cpp", {"fcl/fcl.h"}));
  EXPECT_TRUE(broken_rule("bridge/loaders/x.hpp", {"tinyxml2.h"}));
  EXPECT_TRUE(broken_rule("bridge/bridge.cpp", {"assimp/scene.h"}));
  EXPECT_TRUE(broken_rule("bridge/writers/x.hpp", {"nlohmann/json.hpp"}));
  EXPECT_TRUE(broken_rule("bridge/cli/x.cpp", {"nlohmann/json.hpp"}));
  EXPECT_TRUE(broken_rule("bridge/bridge.cpp", {"CLI/CLI.hpp"}));
  EXPECT_TRUE(broken_rule("bridge/bridge.cpp", {"pantin/bridge/cli/run.hpp"}));
  EXPECT_TRUE(broken_rule("bridge/bridge.cpp", {"gtest/gtest.h"}));
}

}  // namespace
}  // namespace pantin::test
