// The choice of a loader, and what load_model adds to it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <pantin/bridge/loaders/load_model.hpp>

namespace pantin {
namespace {

namespace fs = std::filesystem;

class LoadModel : public testing::Test {
 protected:
  LoadModel() : folder_{fs::path{testing::TempDir()} / ("pantin_model_" + std::to_string(getpid()))} {
    fs::create_directories(folder_);
  }
  ~LoadModel() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream{folder_ / name, std::ios::binary} << text;
    return folder_ / name;
  }
  static std::string only_problem(const Loaded<Model>& loaded) {
    return loaded.notes.size() == 1 && !loaded.value ? loaded.notes[0].problem : "(other)";
  }
  static std::string format(const Loaded<Model>& loaded) {
    return loaded.value ? loaded.value->format : "(none)";
  }
  fs::path folder_;
};

constexpr const char* kRobot = "<?xml version=\"1.0\"?>\n<robot name=\"r\"><link name=\"a\"/></robot>\n";

TEST_F(LoadModel, ChoosesByExtensionInAnyCase) {
  // .urdf and .URDF are the same.
  EXPECT_EQ(format(load_model(write("a.urdf", kRobot))), "urdf");
  EXPECT_EQ(format(load_model(write("a.URDF", kRobot))), "urdf");
}

TEST_F(LoadModel, ChoosesByContentWhereTheExtensionSaysNothing) {
  // A robot by any other name; .xml is claimed by assimp, but a robot is a robot.
  EXPECT_EQ(format(load_model(write("a", kRobot))), "urdf");
  EXPECT_EQ(format(load_model(write("a.xml", kRobot))), "urdf");
  EXPECT_EQ(format(load_model(write("a.model", kRobot))), "urdf");
}

TEST_F(LoadModel, RefusesXacroWithARemedy) {
  // Macros need ROS's own program.
  const Loaded<Model> loaded = load_model(write("a.urdf.xacro", kRobot));
  EXPECT_EQ(only_problem(loaded), "is a xacro file, not a robot description yet");
  EXPECT_EQ(loaded.notes.at(0).remedy, "expand it first: xacro FILE > robot.urdf");
}

TEST_F(LoadModel, NamesFilesThatCannotBeRead) {
  // The same words for every format.
  EXPECT_EQ(only_problem(load_model(folder_ / "nothing.urdf")), "does not exist");
  EXPECT_EQ(only_problem(load_model(folder_)), "is a folder");
  EXPECT_EQ(only_problem(load_model(write("empty.urdf", ""))), "is empty");
  EXPECT_EQ(only_problem(load_model("")), "does not exist");
}

}  // namespace
}  // namespace pantin
