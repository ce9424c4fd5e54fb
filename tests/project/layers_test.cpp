// The sources keep the shape they were given: layers, sizes, what stands where.
#include <gtest/gtest.h>

#include <set>

#include "source_tree.hpp"

namespace pantin::test {
namespace {

const std::vector<std::string> kModules{"scenegraph", "physics", "bridge"};

TEST(Layers, Hold) {
  // Each include of each file is judged by the rule of its layer (source_tree_test.cpp proves that the rule
  // can be broken); there must be files to judge.
  const std::vector<SourceFile> files = files_in(kModules, {".hpp", ".cpp"});
  EXPECT_GT(files.size(), 50u);
  for (const SourceFile& file : files) {
    for (const Include& include : includes_of(file.text)) {
      const std::optional<std::string> rule = broken_rule(file.path, include);
      EXPECT_FALSE(rule.has_value()) << file.path << " includes " << include.name << ": "
                                     << rule.value_or("");
    }
  }
}

TEST(Layers, HeadersDoNotDependOnBuildOptions) {
  // Whoever includes a header sees the same text however Pantin was built. The one guard is the contract
  // macro's, whose text stands in two modules.
  for (const SourceFile& file : files_in(kModules, {".hpp"})) {
    for (const std::string& line : conditions_of(file.text)) {
      EXPECT_TRUE(file.path.ends_with("/expects.hpp") && line == "#ifndef PANTIN_EXPECTS")
          << file.path << ": " << line;
    }
  }
}

TEST(Layers, HeadersAreIncludedOnce) {
  // Every header begins so; nothing else guards it.
  for (const SourceFile& file : files_in({"scenegraph", "physics", "bridge", "tests"}, {".hpp"})) {
    EXPECT_TRUE(file.text.starts_with("#pragma once\n")) << file.path;
  }
}

TEST(Layers, BothModulesBreakContractsAlike) {
  // The two never include each other, so the text stands twice; a program that includes both gets one
  // handler.
  std::set<std::string> texts;
  for (const SourceFile& file : files_in({"scenegraph", "physics"}, {".hpp"})) {
    if (file.path.ends_with("/expects.hpp")) texts.insert(file.text);
  }
  EXPECT_EQ(texts.size(), 1u);
}

TEST(Sources, AreShort) {
  // One concept a file: 300 lines at most.
  for (const SourceFile& file :
       files_in({"scenegraph", "physics", "bridge", "tests", "assets"}, {".hpp", ".cpp", ".py", ".cmake"})) {
    EXPECT_LE(lines_of(file.text).size(), 300u) << file.path;
  }
}

TEST(Sources, LieWhereTheyAreLookedFor) {
  // The top holds the three modules, tests, assets, README and what tools want there; what git ignores may
  // lie about.
  const std::set<std::string> allowed{"CMakeLists.txt",
                                      "scenegraph",
                                      "physics",
                                      "bridge",
                                      "tests",
                                      "assets",
                                      "README.md",
                                      "CMakePresets.json",
                                      "LICENSE",
                                      "build",
                                      "compile_commands.json",
                                      "__pycache__"};
  const std::filesystem::path top{PANTIN_SOURCE_DIR};
  for (const auto& entry : std::filesystem::directory_iterator{top}) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name.starts_with(".") || allowed.contains(name)) << name;
  }
}

}  // namespace
}  // namespace pantin::test
