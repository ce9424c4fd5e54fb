#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <pantin/bridge/loaders/resolve_package.hpp>

namespace pantin {
namespace {

namespace fs = std::filesystem;

/// A folder of packages that goes away with the test; the environment starts without package paths.
class ResolvePackage : public testing::Test {
 protected:
  ResolvePackage() : root_{fs::path{testing::TempDir()} / ("pantin_package_" + std::to_string(getpid()))} {
    fs::remove_all(root_);
    unsetenv("ROS_PACKAGE_PATH");
    unsetenv("AMENT_PREFIX_PATH");
  }
  ~ResolvePackage() override {
    fs::remove_all(root_);
    unsetenv("ROS_PACKAGE_PATH");
    unsetenv("AMENT_PREFIX_PATH");
  }

  fs::path make(const fs::path& name, const std::string& content = "x") const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream{root_ / name} << content;
    return root_ / name;
  }
  fs::path model() const { return make("work/robots/robot.urdf"); }
  static fs::path found(const std::string& uri, const fs::path& model,
                        const std::vector<fs::path>& paths = {}) {
    return resolve_package(uri, model, paths).path;
  }
  fs::path root_;
};

TEST_F(ResolvePackage, FollowsPathsRelativeToTheModel) {
  // A name without scheme starts where the model lies, not where the program runs.
  const fs::path mesh = make("work/robots/meshes/a.stl");
  EXPECT_EQ(found("meshes/a.stl", model()), mesh);
  EXPECT_EQ(found("./meshes/../meshes/a.stl", model()), mesh);
  EXPECT_EQ(found(mesh.string(), model()), mesh);
  EXPECT_EQ(found("meshes", model()), "");  // a folder is no file
}

TEST_F(ResolvePackage, FollowsFileNames) {
  // file:// with an absolute path; a blank may be written as %20.
  const fs::path mesh = make("work/my meshes/a.stl");
  EXPECT_EQ(found("file://" + mesh.string(), model()), mesh);
  EXPECT_EQ(found("file://" + (root_ / "work/my%20meshes/a.stl").string(), model()), mesh);
  EXPECT_EQ(found("file://" + mesh.string() + "%", model()), "");
}

TEST_F(ResolvePackage, WalksUpFromTheModel) {
  // The model's own folder may be the package, a folder above may be it, or may hold it.
  EXPECT_EQ(found("package://robots/a.stl", model()), "");
  const fs::path own = make("work/robots/a.stl");
  EXPECT_EQ(found("package://robots/a.stl", model()), own);
  const fs::path beside = make("work/hand/meshes/b.stl");
  EXPECT_EQ(found("package://hand/meshes/b.stl", model()), beside);
  EXPECT_EQ(found("package:///hand/meshes/b.stl", model()), beside);  // three slashes are met in the wild
}

TEST_F(ResolvePackage, BelievesThePackageFile) {
  // package.xml names the package whatever its folder is called.
  make("work/package.xml", "<package format=\"2\"><name>arm_description</name></package>");
  const fs::path mesh = make("work/meshes/c.stl");
  EXPECT_EQ(found("package://arm_description/meshes/c.stl", model()), mesh);
  EXPECT_EQ(found("package://other/meshes/c.stl", model()), "");
}

TEST_F(ResolvePackage, SearchesGivenPathsThenTheEnvironmentThenUpwards) {
  // The same package stands in four places; they are taken away in the order of the search.
  const fs::path model_file = model();
  const fs::path given = make("given/p/m.stl");
  const fs::path ros = make("ros/p/m.stl");
  const fs::path ament = make("ament/share/p/m.stl");
  const fs::path above = make("work/p/m.stl");
  setenv("ROS_PACKAGE_PATH", (":/nowhere:" + (root_ / "ros").string()).c_str(), 1);
  setenv("AMENT_PREFIX_PATH", (root_ / "ament").c_str(), 1);
  const std::vector<fs::path> paths{root_ / "given"};
  for (const fs::path& expected : {given, ros, ament, above}) {
    EXPECT_EQ(found("package://p/m.stl", model_file, paths), expected);
    fs::remove(expected);
  }
  EXPECT_EQ(found("package://p/m.stl", model_file, paths), "");
}

TEST_F(ResolvePackage, TakesAPathThatIsThePackageItself) {
  // --package-path may name the package's own folder.
  const fs::path mesh = make("given/p/m.stl");
  EXPECT_EQ(found("package://p/m.stl", model(), {root_ / "given/p"}), mesh);
  EXPECT_EQ(found("package://p/m.stl", model(), {root_ / "given/p/"}),
            mesh);  // a slash at the end changes nothing
}

TEST_F(ResolvePackage, TellsWhereItLooked) {
  // Three places stand in full, the others are counted; each place once.
  const ResolvedFile file = resolve_package("package://ghost/m.stl", model(), std::vector{root_ / "given"});
  EXPECT_EQ(file.package, "ghost");
  EXPECT_EQ(file.problem, "package 'ghost' or the file in it was not found");
  ASSERT_GE(file.tried.size(), 4u);
  EXPECT_EQ(file.tried[0], root_ / "given/ghost/m.stl");
  EXPECT_EQ(file.tried[1], root_ / "work/robots/ghost/m.stl");
  EXPECT_EQ(tried_text(file), file.tried[0].string() + ", " + file.tried[1].string() + ", " +
                                  file.tried[2].string() + " and " + std::to_string(file.tried.size() - 3) +
                                  " more places");
}

TEST_F(ResolvePackage, RefusesWhatItCannotFollow) {
  // Names that no search can help.
  EXPECT_EQ(resolve_package("http://example.org/m.stl", model(), {}).problem, "'http://' is not followed");
  EXPECT_EQ(resolve_package("package://p", model(), {}).problem, "names no file in a package");
  EXPECT_EQ(resolve_package("package://", model(), {}).problem, "names no file in a package");
  EXPECT_EQ(resolve_package("m.stl", model(), {}).problem, "does not exist or is no file");
}

}  // namespace
}  // namespace pantin
