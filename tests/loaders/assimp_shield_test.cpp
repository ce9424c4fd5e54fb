// The process that parses foreign formats: what it does to itself stays its own affair. Its misdeeds are
// played by shell scripts in its place, and by files that do crash, hang or swell assimp 5.2.
#include <dirent.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <vector>

#include <pantin/bridge/loaders/import_place.hpp>
#include <pantin/bridge/loaders/load_assimp.hpp>
#include <pantin/bridge/loaders/load_mesh.hpp>

#include "support/temporary_folder.hpp"

namespace pantin {
namespace {

namespace fs = std::filesystem;

const fs::path kCrane = PANTIN_SOURCE_DIR "/assets/meshes/crane.dae";

class Shield : public testing::Test {
 protected:
  /// What load_assimp says with a script in the helper's place.
  std::vector<Diagnostic> notes_with(const std::string& lines, ImportSettings import = {}) const {
    import.helper = folder_.script("helper", lines);
    const Loaded<Model> loaded = load_assimp(kCrane, {.import = import});
    EXPECT_FALSE(loaded.value.has_value());
    return loaded.notes;
  }
  test::TemporaryFolder folder_{};
};

int open_descriptors() {
  int count = 0;
  DIR* folder = opendir("/proc/self/fd");
  while (folder != nullptr && readdir(folder) != nullptr) ++count;
  closedir(folder);
  return count;
}

TEST_F(Shield, NamesTheSignalOfACrash) {
  // A helper that dies of SIGSEGV is an error at the file, not the end of this process.
  const auto notes = notes_with("kill -SEGV $$\n");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].severity, Severity::Error);
  EXPECT_EQ(notes[0].place, kCrane.string());
  EXPECT_EQ(notes[0].problem, "its parser crashed: SIGSEGV (Segmentation fault)");
}

TEST_F(Shield, SurvivesAFileThatCrashesAssimp) {
  // A count of -1 makes assimp 5.2's COLLADA parser read where nothing is.
  const fs::path file = folder_.write(
      "a.dae", test::replaced(test::content_of(kCrane), "<float_array id=\"wedge-p-array\" count=\"12\"",
                              "<float_array id=\"wedge-p-array\" count=\"-1\""));
  const Loaded<Model> loaded = load_assimp(file);
  EXPECT_FALSE(loaded.value.has_value());
  ASSERT_TRUE(has_error(loaded.notes));
  EXPECT_TRUE(loaded.notes[0].problem.starts_with("its parser crashed: SIG")) << loaded.notes[0].problem;
}

TEST_F(Shield, EndsAFileThatHangsAssimp) {
  // assimp 5.2 never ends on a PLY cut within its header (our own reader takes files that are called .ply).
  const fs::path file = folder_.write("cut", "ply\nformat ascii 1.0\nelement v");
  const Loaded<Model> loaded = load_assimp(file, {.import = {.cpu_s = 1, .wall_s = 60}});
  ASSERT_TRUE(has_error(loaded.notes));
  EXPECT_EQ(loaded.notes[0].problem, "its parser met the limit of 1.0 s of CPU time");
}

TEST_F(Shield, NamesTheLimitOfElapsedTime) {
  // A helper that sleeps uses no CPU time.
  const auto notes = notes_with("exec sleep 100\n", {.wall_s = 0.2});
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].problem, "its parser met the limit of 0.2 s of elapsed time");
}

TEST_F(Shield, EndsAHelperThatClosesItsPipesAndStays) {
  // No pipe is left to wait for, so the process itself is waited for, and no longer than the limit.
  const auto notes = notes_with("exec sleep 100 1>&- 2>&- 3>&-\n", {.wall_s = 0.3});
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].problem, "its parser met the limit of 0.3 s of elapsed time");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(Shield, NamesTheLimitOfMemory) {
  // assimp reserves as many floats as an array says it has: 10^9 of them take 4 GB.
  const fs::path file = folder_.write(
      "a.dae", test::replaced(test::content_of(kCrane), "<float_array id=\"wedge-p-array\" count=\"12\"",
                              "<float_array id=\"wedge-p-array\" count=\"1000000000\""));
  const Loaded<Model> loaded = load_assimp(file, {.import = {.memory_bytes = std::uint64_t{256} << 20}});
  ASSERT_TRUE(has_error(loaded.notes));
  const Diagnostic& last = loaded.notes[0];
  EXPECT_EQ(last.problem, "its parser met the limit of 256 MiB of memory");
}
#endif

TEST_F(Shield, PutsWhatIsPrintedIntoTheLedger) {
  // Standard output and error of the helper are collected, also when it fails; long noise is cut.
  const auto notes = notes_with("echo one; echo two >&2; echo; echo three; echo four; echo five; exit 7\n");
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_TRUE(notes[0].problem.ends_with("ended with code 7")) << notes[0].problem;
  EXPECT_EQ(notes[1].severity, Severity::Note);
  EXPECT_EQ(notes[1].problem, "printed: one | two | three (and 2 more lines)");
}

TEST_F(Shield, ReadsNoiseWithoutEnd) {
  // 10 MB of noise would block a helper whose pipe nobody empties; only its beginning is kept.
  const auto notes = notes_with("head -c 10000000 /dev/zero | tr '\\0' 'x'; exit 7\n");
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_LT(notes[1].problem.size(), 70'000u);
}

TEST_F(Shield, DoesNotTrustTheAnswer) {
  // No answer, another text, and a header of another version.
  const std::string prefix = "pantin-import gave no usable answer: ";
  EXPECT_EQ(notes_with("exit 0\n").at(0).problem, prefix + "it ends too early");
  EXPECT_EQ(notes_with("echo 'something else altogether' >&3\n").at(0).problem, prefix + "it is not one");
  EXPECT_EQ(notes_with("printf 'PANTIMPT\\377\\0\\0\\0................' >&3\n").at(0).problem,
            prefix + "it is of another version");
}

TEST_F(Shield, SaysWhereItLookedForTheHelper) {
  // A helper that is asked for by name and is not there is not replaced by another.
  const Loaded<Model> loaded = load_assimp(kCrane, {.import = {.helper = "/nowhere/pantin-import"}});
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_EQ(loaded.notes[0].problem,
            "needs the helper pantin-import, which is not there; looked for /nowhere/pantin-import");
  EXPECT_EQ(loaded.notes[0].remedy, "install it, or name it in the environment variable PANTIN_IMPORT");
}

TEST_F(Shield, SaysWhyTheHelperCannotBeStarted) {
  // A file that is no program.
  const fs::path text = folder_.write("text", "hello");
  const auto notes = load_assimp(kCrane, {.import = {.helper = text}}).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].problem, "the helper " + text.string() + " cannot be started: Permission denied");
}

TEST_F(Shield, FindsTheHelperBesideTheProgramOrWhereToldTo) {
  // Programs are in bin, the helper in libexec beside it; the environment comes before, the option first.
  EXPECT_EQ(find_import_helper({}).path, fs::path{PANTIN_BINARY_DIR "/libexec/pantin-import"});
  const fs::path other = folder_.write("other", "x");
  setenv("PANTIN_IMPORT", other.c_str(), 1);
  EXPECT_EQ(find_import_helper({}).path, other);
  EXPECT_EQ(find_import_helper(kCrane).path, kCrane);
  setenv("PANTIN_IMPORT", "/nowhere", 1);
  EXPECT_TRUE(find_import_helper({}).path.empty());
  unsetenv("PANTIN_IMPORT");
}

TEST_F(Shield, RefusesUnusableSettings) {
  // Each rule of ImportSettings, and that a load says it.
  EXPECT_EQ(problem_with(ImportSettings{}), std::nullopt);
  EXPECT_EQ(problem_with(ImportSettings{.cpu_s = -1}), "cpu_s is not between 0 and 1e6 s");
  EXPECT_EQ(problem_with(ImportSettings{.wall_s = std::nan("")}), "wall_s is not between 0 and 1e6 s");
  EXPECT_EQ(problem_with(ImportSettings{.memory_bytes = 1}), "memory_bytes is below 64 MiB");
  EXPECT_EQ(load_assimp(kCrane, {.import = {.memory_bytes = 1}}).notes.at(0).problem,
            "the settings of the import are unusable: memory_bytes is below 64 MiB");
}

TEST_F(Shield, LeavesNoDescriptorAndNoZombie) {
  // After loads that worked, crashed and timed out there are as many descriptors as before and no child.
  (void)load_assimp(kCrane);
  const int before = open_descriptors();
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(load_assimp(kCrane).value.has_value());
    (void)notes_with("kill -ABRT $$\n");
    (void)notes_with("exec sleep 100\n", {.wall_s = 0.05});
    (void)load_assimp(kCrane, {.import = {.helper = "/dev/null"}});
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST_F(Shield, HandsNoDescriptorToTheHelper) {
  // A descriptor that stays open over exec here is not open there.
  FILE* file = std::fopen(kCrane.c_str(), "r");
  ASSERT_EQ(dup2(fileno(file), 77), 77);
  const auto notes =
      notes_with("[ -e /proc/$$/fd/3 ] && echo answer; [ -e /proc/$$/fd/77 ] && echo leak; exit 1\n");
  close(77);
  std::fclose(file);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[1].problem, "printed: answer");
}

TEST_F(Shield, WorksWhereTheHostIgnoresSignals) {
  // A host that ignores SIGCHLD reaps children by itself, and one that blocks signals must not pass that on.
  const auto old = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_TRUE(load_assimp(kCrane).value.has_value());
  EXPECT_EQ(notes_with("kill -SEGV $$\n").at(0).problem,
            "pantin-import gave no usable answer: it ends too early");
  std::signal(SIGCHLD, old);
  const auto old_pipe = std::signal(SIGPIPE, SIG_IGN);
  EXPECT_TRUE(load_assimp(kCrane).value.has_value());
  std::signal(SIGPIPE, old_pipe);
}

TEST_F(Shield, LoadsConcurrently) {
  // Four threads, five loads each: all see the same model.
  std::vector<std::thread> threads;
  std::array<int, 4> good{};
  for (std::size_t t = 0; t < good.size(); ++t) {
    threads.emplace_back([&good, t] {
      for (int i = 0; i < 5; ++i) {
        const Loaded<Model> loaded = load_assimp(kCrane);
        good[t] += loaded.value && loaded.value->nodes.size() == 3 && loaded.value->clips.size() == 1;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, (std::array{5, 5, 5, 5}));
}

TEST_F(Shield, CoversMeshesOfRobots) {
  // load_mesh reads COLLADA by the same helper.
  const auto loaded = load_mesh(kCrane, {.import = {.helper = folder_.script("helper", "kill -BUS $$\n")}});
  ASSERT_TRUE(has_error(loaded.notes));
  EXPECT_EQ(loaded.notes[0].problem, "its parser crashed: SIGBUS (Bus error)");
}

}  // namespace
}  // namespace pantin
