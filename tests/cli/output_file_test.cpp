#include <pantin/bridge/writers/output_file.hpp>

#include "program.hpp"

namespace pantin::test {
namespace {

TEST(OutputFile, AppearsWholeOrNotAtAll) {
  // Until it is committed the name holds what it held before; dropped without commit it leaves nothing.
  const Folder folder;
  const std::string file = folder.write("t.csv", "old");
  {
    Loaded<OutputFile> opened = OutputFile::open(file);
    ASSERT_TRUE(opened.value);
    opened.value->stream() << "new";
    opened.value->stream().flush();
    EXPECT_EQ(text_of(file), "old");
  }
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(folder.names().size(), 1u);
  Loaded<OutputFile> opened = OutputFile::open(file);
  ASSERT_TRUE(opened.value);
  opened.value->stream() << "new";
  EXPECT_FALSE(opened.value->commit());
  EXPECT_EQ(text_of(file), "new");
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(OutputFile, FollowsSymbolicLinks) {
  // The link stays a link, and what it names is replaced.
  const Folder folder;
  const std::string target = folder.write("target.csv", "old");
  fs::create_symlink(target, folder.path("link.csv"));
  Loaded<OutputFile> opened = OutputFile::open(folder.path("link.csv"));
  ASSERT_TRUE(opened.value);
  opened.value->stream() << "new";
  EXPECT_FALSE(opened.value->commit());
  EXPECT_TRUE(fs::is_symlink(folder.path("link.csv")));
  EXPECT_EQ(text_of(target), "new");
}

TEST(OutputFile, SaysWhenItCannotBePutInPlace) {
  // A folder that took the name meanwhile cannot be replaced by a file; the temporary file goes away.
  const Folder folder;
  {
    Loaded<OutputFile> opened = OutputFile::open(folder.path("t.csv"));
    ASSERT_TRUE(opened.value);
    fs::create_directory(folder.path("t.csv"));
    const std::optional<Diagnostic> problem = opened.value->commit();
    ASSERT_TRUE(problem);
    EXPECT_TRUE(problem->problem.starts_with("could not be put in place: ")) << problem->problem;
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"t.csv"});
}

}  // namespace
}  // namespace pantin::test
