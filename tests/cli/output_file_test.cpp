#include <pantin/bridge/writers/output_file.hpp>

#include "models.hpp"
#include "program.hpp"

namespace pantin::test {
namespace {

TEST(OutputFile, AppearsWholeOrNotAtAll) {
  // Until it is committed the name holds what it held before; dropped without commit it leaves nothing.
  const TemporaryFolder folder;
  const std::string file = folder.write("t.csv", "old");
  {
    Loaded<OutputFile> opened = OutputFile::open(file);
    ASSERT_TRUE(opened.value);
    opened.value->stream() << "new";
    opened.value->stream().flush();
    EXPECT_EQ(content_of(file), "old");
  }
  EXPECT_EQ(content_of(file), "old");
  EXPECT_EQ(folder.names().size(), 1u);
  Loaded<OutputFile> opened = OutputFile::open(file);
  ASSERT_TRUE(opened.value);
  opened.value->stream() << "new";
  EXPECT_FALSE(opened.value->commit());
  EXPECT_EQ(content_of(file), "new");
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(OutputFile, FollowsSymbolicLinks) {
  // The link stays a link, and what it names is replaced.
  const TemporaryFolder folder;
  const std::string target = folder.write("target.csv", "old");
  fs::create_symlink(target, folder.path("link.csv"));
  Loaded<OutputFile> opened = OutputFile::open(folder.path("link.csv"));
  ASSERT_TRUE(opened.value);
  opened.value->stream() << "new";
  EXPECT_FALSE(opened.value->commit());
  EXPECT_TRUE(fs::is_symlink(folder.path("link.csv")));
  EXPECT_EQ(content_of(target), "new");
}

TEST(OutputFile, SaysWhenItCannotBePutInPlace) {
  // A folder that took the name meanwhile cannot be replaced by a file; the temporary file goes away.
  const TemporaryFolder folder;
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

TEST(OutputFile, LeavesNothingWhereTheUserBreaksOff) {
  // A run of a million seconds gets the signal once its temporary file is there: it ends by it, as any
  // program does, and what the name held before is untouched.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const std::string model = folder.write("p.urdf", kPendulumUrdf);
    const std::string out = folder.write("t.csv", "old");
    Running running{{"run", model, "--simulate", "all", "--duration", "1e6", "--out", out}};
    for (int k = 0; k < 2000 && folder.names().size() < 3; ++k) usleep(10'000);
    ASSERT_EQ(folder.names().size(), 3u);
    running.send(signal);
    EXPECT_EQ(running.ended().signal, signal);
    EXPECT_EQ(folder.names().size(), 2u);
    EXPECT_EQ(content_of(out), "old");
  }
}

}  // namespace
}  // namespace pantin::test
