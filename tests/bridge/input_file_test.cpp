#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <pantin/bridge/input_file.hpp>

namespace pantin {
namespace {

namespace fs = std::filesystem;

/// A fresh folder that goes away with the test.
class InputFile : public testing::Test {
 protected:
  InputFile() : folder_{fs::path{testing::TempDir()} / ("pantin_input_" + std::to_string(getpid()))} {
    fs::create_directories(folder_);
  }
  ~InputFile() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name, const std::string& content) const {
    std::ofstream{folder_ / name, std::ios::binary} << content;
    return folder_ / name;
  }
  static std::string problem(const fs::path& path, std::uintmax_t max_bytes = 1 << 20) {
    const auto found = problem_with_file(path, max_bytes);
    return found ? found->problem : "";
  }
  fs::path folder_;
};

TEST_F(InputFile, IsReadByteForByte) {
  // Round trip with bytes that text modes change.
  const std::string bytes{"a\r\n\0\xff z", 8};
  const Loaded<std::string> read = read_file(file("bytes", bytes), 1 << 20);
  ASSERT_TRUE(read.value.has_value());
  EXPECT_EQ(*read.value, bytes);
  EXPECT_TRUE(read.notes.empty());
}

TEST_F(InputFile, ThatIsMissingIsNamed) {
  // Nothing is there.
  const auto found = problem_with_file(folder_ / "nothing", 1);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(to_string(*found),
            (folder_ / "nothing").string() + ": error: file: does not exist; check the path");
  EXPECT_TRUE(has_error(read_file(folder_ / "nothing", 1).notes));
}

TEST_F(InputFile, ThatIsAFolderIsNamed) {
  // A folder exists but has no bytes.
  EXPECT_EQ(problem(folder_), "is a folder");
}

TEST_F(InputFile, ThatIsEmptyIsNamed) {
  // Zero bytes are no model of any format.
  EXPECT_EQ(problem(file("empty", "")), "is empty");
}

TEST_F(InputFile, ThatIsTooLargeIsNamed) {
  // 2 MiB + 1 against a limit of 2 MiB, and exactly the limit passes.
  EXPECT_EQ(problem(file("large", std::string((2 << 20) + 1, ' ')), 2 << 20),
            "is larger than the 2 MiB that are read");
  EXPECT_EQ(problem(file("fits", std::string(2 << 20, ' ')), 2 << 20), "");
}

TEST_F(InputFile, ThatIsAPipeIsRefusedWithoutWaiting) {
  // Opening a pipe without writer would block for ever.
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(problem(pipe), "is not a regular file");
}

TEST_F(InputFile, ThatCannotBeExaminedIsNamed) {
  // A path through a plain file is an error of the system, not an exception.
  const std::string text = problem(file("plain", "x") / "below");
  EXPECT_TRUE(text == "does not exist" || text.starts_with("cannot be examined")) << text;
}

TEST(LowerExtension, HasItsPointAndNoCapitals) {
  // What comes after the last point of the name, as std::filesystem defines it.
  EXPECT_EQ(lower_extension("folder.X/Part.Old.STL"), ".stl");
  EXPECT_EQ(lower_extension("folder.X/part"), "");
}

}  // namespace
}  // namespace pantin
