// `pantin check`, and what all commands have in common: exit codes, usage, strictness, broken output.
#include <unistd.h>

#include "models.hpp"
#include "program.hpp"

namespace pantin::test {
namespace {

TEST(Check, GivesOneEntryAFile) {
  // One file is good, one is broken, one is not there: the bad ones do not keep the good one from being
  // checked.
  const TemporaryFolder folder;
  const std::string good = folder.write("good.urdf", kPendulumUrdf);
  const std::string broken = folder.write("broken.urdf", kBrokenUrdf);
  const std::string missing = folder.path("missing.urdf");
  const Ran ran = pantin({"check", "--json", broken, good, missing});
  EXPECT_EQ(ran.code, 1);
  const Json checked = ran.json();
  ASSERT_EQ(checked.size(), 3u);
  EXPECT_EQ(checked[0]["file"], broken);
  EXPECT_EQ(checked[0]["ok"], false);
  EXPECT_EQ(checked[1]["file"], good);
  EXPECT_EQ(checked[1]["ok"], true);
  EXPECT_EQ(checked[2]["ok"], false);
  Json finding;
  for (const Json& note : checked[0]["ledger"])
    if (note["severity"] == "error") finding = note;
  EXPECT_NE(finding["place"].get<std::string>().find("broken.urdf:3"), std::string::npos) << finding;
  for (const char* key : {"severity", "place", "subject", "problem", "remedy"})
    EXPECT_TRUE(finding.contains(key)) << key;
}

TEST(Check, PutsErrorsOnStandardError) {
  // Whoever reads standard output gets results only.
  const TemporaryFolder folder;
  const Ran ran = pantin({"check", folder.write("broken.urdf", kBrokenUrdf)});
  EXPECT_EQ(ran.code, 1);
  EXPECT_TRUE(ran.says("broken.urdf:3: error: ")) << ran.err;
  EXPECT_NE(ran.out.find("broken.urdf: failed, 1 error"), std::string::npos) << ran.out;
  EXPECT_EQ(ran.out.find("palm"), std::string::npos) << ran.out;
}

TEST(Check, IsFineWithGoodFiles) {
  // A file without any finding is one line.
  const TemporaryFolder folder;
  const std::string file = folder.write("pendulum.urdf", kPendulumUrdf);
  const Ran ran = pantin({"check", file});
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.out, file + ": ok\n");
  EXPECT_EQ(ran.err, "");
}

TEST(Check, TreatsWarningsAsErrorsWhenStrict) {
  // A mass of zero is doubtful, not wrong: fine without --strict, refused with it.
  const TemporaryFolder folder;
  const std::string file = folder.write("light.urdf", kMasslessUrdf);
  const Ran lenient = pantin({"check", "--json", file});
  EXPECT_EQ(lenient.code, 0);
  EXPECT_EQ(lenient.json()[0]["ok"], true);
  EXPECT_NE(lenient.out.find("\"warning\""), std::string::npos) << lenient.out;
  const Ran strict = pantin({"check", "--json", "--strict", file});
  EXPECT_EQ(strict.code, 1);
  EXPECT_EQ(strict.json()[0]["ok"], false);
  EXPECT_EQ(strict.out.find("\"warning\""), std::string::npos) << strict.out;
  EXPECT_EQ(pantin({"info", "--strict", file}).code, 1);
  EXPECT_EQ(pantin({"run", "--strict", file}).code, 1);
}

TEST(Check, OutlivesAParserThatCrashes) {
  // A count of -1 in this COLLADA file crashes assimp 5.2; the next file is checked all the same.
  const TemporaryFolder folder;
  std::ifstream crane{PANTIN_SOURCE_DIR "/assets/meshes/crane.dae"};
  std::string text{std::istreambuf_iterator<char>{crane}, {}};
  const std::string count = "<float_array id=\"wedge-p-array\" count=\"";
  const std::size_t at = text.find(count + "12");
  ASSERT_NE(at, std::string::npos);
  const std::string dae = folder.write("bad.dae", text.replace(at + count.size(), 2, "-1"));
  const Ran ran = pantin({"check", "--json", dae, folder.write("pendulum.urdf", kPendulumUrdf)});
  EXPECT_EQ(ran.code, 1) << ran.err;
  const Json checked = ran.json();
  EXPECT_NE(checked[0]["ledger"].dump().find("its parser crashed: SIG"), std::string::npos) << checked;
  EXPECT_EQ(checked[1]["ok"], true);
}

TEST(Check, SurvivesAMeshThatCrashesItsParser) {
  // A robot that names such a file loses the mesh with a warning: it too is parsed by the helper alone.
  const TemporaryFolder folder;
  std::string text = content_of(PANTIN_SOURCE_DIR "/assets/meshes/crane.dae");
  folder.write("bad.dae", replaced(text, "<float_array id=\"wedge-p-array\" count=\"12",
                                   "<float_array id=\"wedge-p-array\" count=\"-1"));
  const std::string robot = folder.write("robot.urdf", R"(<robot name="r"><link name="a"><collision><geometry>
<mesh filename="bad.dae"/></geometry></collision></link></robot>)");
  const Ran ran = pantin({"check", "--json", robot});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const Json checked = ran.json()[0];
  EXPECT_NE(checked["ledger"].dump().find("its parser crashed: SIG"), std::string::npos) << checked;
  EXPECT_EQ(checked["counts"]["dropped"], 4);  // collision, geometry, mesh and its file name
}

TEST(Check, CountsWhatBecameOfEverything) {
  // Six elements and seven attributes, counted by hand; an unknown one more is dropped, and is an error under
  // --strict. All are listed where that is asked for.
  const TemporaryFolder folder;
  const std::string good =
      folder.write("good.urdf",
                   "<robot name='r'>\n<link name='a'/>\n<link name='b'/>\n"
                   "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint></robot>");
  const std::string odd =
      folder.write("odd.urdf", replaced(content_of(good), "<link name='b'/>", "<link name='b' zorp='1'/>"));
  const Json counts = pantin({"check", "--json", good, odd}).json();
  EXPECT_EQ(counts[0]["counts"]["read"], 13);
  EXPECT_EQ(counts[0]["counts"]["dropped"], 0);
  EXPECT_EQ(counts[1]["counts"]["dropped"], 1);
  EXPECT_FALSE(counts[0].contains("account"));
  EXPECT_EQ(pantin({"check", "--json", "--verbose", good}).json()[0]["account"].size(), 13u);
  EXPECT_EQ(pantin({"check", "--strict", odd}).code, 1);
  const std::string all = pantin({"check", "--verbose", odd}).out;
  EXPECT_NE(all.find("14 elements and attributes: 13 read, 1 dropped\n"), std::string::npos) << all;
  EXPECT_NE(all.find("odd.urdf:3: dropped: link 'b': link@zorp: is unknown\n"), std::string::npos) << all;
}

TEST(Check, TakesProblems) {
  // The same for a problem: a planted key is a warning, and an error under --strict; `solve` says it too.
  const TemporaryFolder folder;
  Json problem = Json::parse(content_of(PANTIN_SOURCE_DIR "/assets/problems/welded_pendulum.json"));
  problem["bodies"][0]["zorp"] = 1;
  const std::string file = folder.write("p.json", problem.dump(1));
  const Ran lenient = pantin({"check", "--json", "--verbose", file});
  EXPECT_EQ(lenient.code, 0) << lenient.err;
  std::size_t found = 0;
  const Json checked = lenient.json();
  for (const Json& entry : checked[0]["account"])
    found += entry["place"] == file + "#/bodies/0/zorp" && entry["fate"] == "dropped" ? 1 : 0;
  EXPECT_EQ(found, 1u);
  EXPECT_EQ(pantin({"check", "--strict", file}).code, 1);
  EXPECT_NE(pantin({"solve", "--json", file}).out.find("'zorp': the reader does not know this key"),
            std::string::npos);
  EXPECT_EQ(pantin({"solve", "--strict", file}).code, 1);
}

TEST(Usage, AnswersHelpAndVersion) {
  // Answers go to standard output and are no errors.
  const Ran version = pantin({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_TRUE(version.out.starts_with("pantin ")) << version.out;
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"--help"}, {"info", "--help"}, {"check", "--help"}, {"run", "--help"}}) {
    const Ran help = pantin(arguments);
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("--help"), std::string::npos);
    EXPECT_EQ(help.err, "");
  }
}

TEST(Usage, HelpNamesEveryOptionOfRun) {
  // The options that are promised; a forgotten one would not be found here.
  const std::string help = pantin({"run", "--help"}).out;
  for (const char* option :
       {"--simulate", "--animate", "--toggle", "--duration", "--step", "--integrator", "--up", "--gravity",
        "--fixed-base", "--floating-base", "--joint", "--every", "--out", "--json", "--strict"})
    EXPECT_NE(help.find(option), std::string::npos) << option;
}

struct Misuse {
  std::vector<std::string> arguments{};
  std::string says{};
};

TEST(Usage, RefusesWhatMakesNoSense) {
  // The command line itself is wrong: exit 2 before any file is opened, so the model need not exist.
  const std::vector<Misuse> misuses{
      {{}, "subcommand"},
      {{"fly"}, "'fly' is no command"},
      {{"info"}, "MODEL"},
      {{"info", "m.urdf", "--fast"}, "--fast"},
      {{"info", "m.urdf", "--joint", "hinge"}, "'hinge' is not NAME=VALUE"},
      {{"info", "m.urdf", "--joint", "hinge=much"}, "'hinge=much' is not NAME=VALUE"},
      {{"info", "m.urdf", "--joint", "=1"}, "'=1' is not NAME=VALUE"},
      {{"info", "m.urdf", "--time", "1"}, "--clip"},
      {{"info", "m.urdf", "--clip", "go", "--time", "soon"}, "'soon' is not a finite number"},
      {{"info", "m.urdf", "--clip", "go", "--time", "nan"}, "'nan' is not a finite number"},
      {{"run", "m.urdf", "--duration", "0"}, "'0' is not a number greater than 0"},
      {{"run", "m.urdf", "--duration", "inf"}, "'inf' is not a number greater than 0"},
      {{"run", "m.urdf", "--step", "-1"}, "'-1' is not a number greater than 0"},
      {{"run", "m.urdf", "--step", "1/0"}, "'1/0' is not a number greater than 0"},
      {{"run", "m.urdf", "--every", "x"}, "'x' is not a number greater than 0"},
      {{"run", "m.urdf", "--integrator", "magic"}, "magic not in {euler,"},
      {{"run", "m.urdf", "--up", "W"}, "'W' is not one of X, Y, Z"},
      {{"run", "m.urdf", "--gravity", "0,0"}, "'0,0' is not three numbers X,Y,Z"},
      {{"run", "m.urdf", "--fixed-base", "--floating-base"}, "excludes"},
      {{"run", "m.urdf", "--toggle", "1:a"}, "'1:a' is not T:PATH=simulated or T:PATH=animated"},
      {{"run", "m.urdf", "--toggle", "1:a=static"}, "'1:a=static' is not T:PATH=simulated"},
      {{"run", "m.urdf", "--toggle", "-1:a=simulated"}, "'-1:a=simulated' is not T:PATH=simulated"},
      {{"run", "m.urdf", "--toggle", "9:a=simulated"}, "the toggle of 'a' lies beyond the duration"},
      {{"run", "m.urdf", "--out", "t.xml"}, "'t.xml' is not a file name that ends in .csv or .json"},
  };
  for (const Misuse& misuse : misuses) {
    const Ran ran = pantin(misuse.arguments);
    EXPECT_EQ(ran.code, 2) << misuse.says << ran.err;
    EXPECT_TRUE(ran.says(misuse.says)) << misuse.says << "\n" << ran.err;
    EXPECT_EQ(ran.out, "");
  }
}

TEST(Output, ThatCannotBeWrittenIsAnError) {
  // /dev/full takes nothing: the result is lost, and that must show.
  const TemporaryFolder folder;
  const Ran ran = pantin({"info", "--json", folder.write("pendulum.urdf", kPendulumUrdf)}, "/dev/full");
  EXPECT_EQ(ran.code, 1);
  EXPECT_TRUE(ran.says("standard output could not be written completely")) << ran.err;
}

TEST(Output, OfWhichNobodyReadsIsNoError) {
  // `pantin ... | head` closes the pipe early; the file of --out is written all the same, and nothing dies.
  const TemporaryFolder folder;
  const std::string file = folder.write("pendulum.urdf", kPendulumUrdf);
  const std::string command = std::string{PANTIN_BINARY_DIR "/bin/pantin run --json --simulate all "} + file +
                              " --out " + folder.path("t.json") + " 2>" + folder.path("err") + "; echo $? >" +
                              folder.path("code");
  FILE* pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  pclose(pipe);
  EXPECT_EQ(content_of(folder.path("code")), "0\n");
  EXPECT_EQ(content_of(folder.path("err")), "");
  EXPECT_FALSE(Json::parse(content_of(folder.path("t.json")), nullptr, false).is_discarded());
}

TEST(Output, DoesNotDependOnTheLocale) {
  // A locale with a decimal comma must not reach files or arguments; where it is not installed nothing is
  // shown.
  const TemporaryFolder folder;
  const std::string file = folder.write("pendulum.urdf", kPendulumUrdf);
  const std::string plain = pantin({"info", "--json", file, "--joint", "hinge=0.5"}).out;
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  const std::string german = pantin({"info", "--json", file, "--joint", "hinge=0.5"}).out;
  unsetenv("LC_ALL");
  EXPECT_EQ(plain, german);
  EXPECT_NE(plain.find("0.5"), std::string::npos);
}

}  // namespace
}  // namespace pantin::test
