// load_urdf on input that is large, hostile or read at the same time.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include <pantin/bridge/loaders/load_urdf.hpp>

namespace pantin {
namespace {

namespace fs = std::filesystem;

/// Writes robots to a file that goes away with the test.
class LoadUrdf : public testing::Test {
 protected:
  LoadUrdf() : file_{fs::path{testing::TempDir()} / ("pantin_" + std::to_string(getpid()) + ".urdf")} {}
  ~LoadUrdf() override { fs::remove(file_); }

  Loaded<Model> load(const std::string& text, const LoadOptions& options = {}) const {
    std::ofstream{file_, std::ios::binary} << text;
    return load_urdf(file_, options);
  }
  static std::string arm_text() {
    std::ifstream stream{PANTIN_SOURCE_DIR "/assets/arm.urdf", std::ios::binary};
    return {std::istreambuf_iterator<char>{stream}, {}};
  }
  fs::path file_;
};

std::string chain(int links) {
  std::string text = "<robot name=\"chain\">\n";
  for (int i = 0; i < links; ++i) text += "<link name=\"l" + std::to_string(i) + "\"/>\n";
  for (int i = 1; i < links; ++i) {
    text += "<joint name=\"j" + std::to_string(i) + "\" type=\"continuous\"><parent link=\"l" +
            std::to_string(i - 1) + "\"/><child link=\"l" + std::to_string(i) +
            "\"/><axis xyz=\"0 0 1\"/></joint>\n";
  }
  return text + "</robot>\n";
}

void add_to_joint(std::string& text, const std::string& joint, const std::string& element) {
  text.insert(text.find("</joint>", text.find("name=\"" + joint + '"')), element);
}

TEST_F(LoadUrdf, TakesAChainOfAnyLength) {
  // 50,000 links in a row: recursion over the tree, here or in urdfdom's destructor, would overflow the
  // stack.
  constexpr int kLinks = 50'000;
  const Loaded<Model> loaded = load(chain(kLinks));
  ASSERT_TRUE(loaded.value.has_value());
  ASSERT_EQ(loaded.value->nodes.size(), static_cast<std::size_t>(kLinks));
  for (int i = 0; i < kLinks; ++i) ASSERT_EQ(loaded.value->nodes[static_cast<std::size_t>(i)].parent, i - 1);
}

TEST_F(LoadUrdf, StartsMimicsWhereTheirLeadersHaveThem) {
  // j3 = 2 j2 + 0.5 and j2 = -j1 + 0.25, with j1 = 0: they start at 0.25 and 1, and so do their nodes.
  std::string text = chain(4);
  add_to_joint(text, "j3", "<mimic joint=\"j2\" multiplier=\"2\" offset=\"0.5\"/>");
  add_to_joint(text, "j2", "<mimic joint=\"j1\" multiplier=\"-1\" offset=\"0.25\"/>");
  const Loaded<Model> loaded = load(text);
  ASSERT_TRUE(loaded.value.has_value());
  for (const auto& [node, value] : {std::pair{1, 0.0}, {2, 0.25}, {3, 1.0}}) {
    const ModelNode& at = loaded.value->nodes[static_cast<std::size_t>(node)];
    EXPECT_DOUBLE_EQ(at.link->value[0], value);
    EXPECT_NEAR(std::atan2(at.M_PN(1, 0), at.M_PN(0, 0)), value, 1e-15);
  }
}

TEST_F(LoadUrdf, RefusesMimicsThatOverflow) {
  // Each number is finite, the value that they give is not.
  std::string text = chain(4);
  add_to_joint(text, "j3", "<mimic joint=\"j2\" multiplier=\"1e200\" offset=\"0\"/>");
  add_to_joint(text, "j2", "<mimic joint=\"j1\" multiplier=\"1\" offset=\"1e200\"/>");
  const Loaded<Model> loaded = load(text);
  EXPECT_FALSE(loaded.value.has_value());
  EXPECT_EQ(loaded.notes.at(0).problem, "its mimic starts at a value that is not finite");
}

TEST_F(LoadUrdf, RefusesDeepNesting) {
  // 10,000 elements in each other take urdfdom's parser quadratic time; the pre-flight stops at its limit.
  std::string text = "<robot name=\"r\">\n";
  for (int i = 0; i < 10'000; ++i) text += "<a>";
  const Loaded<Model> loaded = load(text);
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_EQ(to_string(loaded.notes[0]), file_.string() +
                                            ":2: error: file: elements are nested more than 100 deep; "
                                            "check the XML near this line");
}

TEST_F(LoadUrdf, RefusesCrowdedElements) {
  // Attributes of one element are compared with each other; 100,000 of them would take minutes.
  std::string text = "<robot name=\"r\">\n<link";
  for (int i = 0; i < 100'000; ++i) text += " a" + std::to_string(i) + "=\"\"";
  const Loaded<Model> loaded = load(text + "/>\n</robot>");
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_EQ(to_string(loaded.notes[0]), file_.string() +
                                            ":2: error: file: an element has more than 1000 attributes; "
                                            "check that this is a robot description");
}

TEST_F(LoadUrdf, NamesFilesThatCannotBeRead) {
  // The message of problem_with_file comes through.
  const Loaded<Model> loaded = load_urdf("/nowhere/robot.urdf");
  EXPECT_FALSE(loaded.value.has_value());
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_EQ(to_string(loaded.notes[0]), "/nowhere/robot.urdf: error: file: does not exist; check the path");
}

TEST_F(LoadUrdf, CollectsAllErrorsAtOnce) {
  // Three faults in three lines give three errors in the order of the file.
  const Loaded<Model> loaded = load(
      "<robot name=\"r\">\n"
      "<link name=\"a\"><inertial><mass value=\"x\"/></inertial></link>\n"
      "<link name=\"b\"/>\n"
      "<joint name=\"j\" type=\"screw\"><parent link=\"a\"/><child link=\"b\"/></joint>\n"
      "<joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child link=\"c\"/></joint>\n"
      "</robot>");
  std::vector<std::string> errors;
  for (const Diagnostic& note : loaded.notes) {
    if (note.severity == Severity::Error) errors.push_back(note.place.substr(file_.string().size()));
  }
  EXPECT_EQ(errors, (std::vector<std::string>{":2", ":4", ":5"}));
}

TEST_F(LoadUrdf, CountsAlikeFindings) {
  // Seven zero masses: five in full, the last of which tells of two more.
  std::string text = "<robot name=\"r\"><link name=\"root\"/>\n";
  for (int i = 0; i < 7; ++i) {
    const std::string n = std::to_string(i);
    text += "<link name=\"l" + n +
            "\"><inertial><mass value=\"0\"/><inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" "
            "izz=\"0\"/>"
            "</inertial></link><joint name=\"j" +
            n + "\" type=\"fixed\"><parent link=\"root\"/><child link=\"l" + n + "\"/></joint>\n";
  }
  const Loaded<Model> loaded = load(text + "</robot>");
  ASSERT_TRUE(loaded.value.has_value());
  ASSERT_EQ(loaded.notes.size(), 5u);
  EXPECT_EQ(loaded.notes[3].problem, "mass and inertia are 0; kept as read");
  EXPECT_EQ(loaded.notes[4].problem, "mass and inertia are 0; kept as read (and 2 more alike)");
}

TEST_F(LoadUrdf, ReadsAPlanarJoint) {
  // The axis is the plane's normal; the two directions of the plane are at right angles to it, and damping is
  // kept. A plane has no one range, so <limit> means nothing, as for a floating joint.
  const Loaded<Model> loaded = load(
      "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"j\" type=\"planar\">"
      "<parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0.6 0.8\"/><dynamics damping=\"0.5\"/>"
      "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint></robot>");
  ASSERT_TRUE(loaded.value.has_value());
  const Link& link = *loaded.value->nodes[1].link;
  EXPECT_EQ(link.kind, LinkKind::Planar);
  EXPECT_LT((link.axis - Vector3{0, 0.6, 0.8}).norm(), 1e-15);
  EXPECT_LT(std::abs(link.axis.dot(link.axis2)), 1e-15);
  EXPECT_EQ(link.limits[0], LinkLimits{});
  EXPECT_EQ(loaded.value->nodes[1].dynamics->damping, 0.5);
  EXPECT_TRUE(std::any_of(loaded.notes.begin(), loaded.notes.end(), [](const Diagnostic& note) {
    return note.problem.find("<limit> of a planar joint means nothing") != std::string::npos;
  }));
}

TEST_F(LoadUrdf, KeepsNamesOfAnyCharacters) {
  // Entities and UTF-8 survive the way through both XML parsers: the names are those that XML defines.
  const Loaded<Model> loaded = load(
      "<robot name=\"a &amp; b\"><link name=\"&lt;1&gt; &quot;x&quot;\"/><link name=\"\xc3\xa9/~ &#233;\"/>"
      "<joint name=\"it's\" type=\"fixed\"><parent link=\"&lt;1&gt; &quot;x&quot;\"/>"
      "<child link=\"\xc3\xa9/~ \xc3\xa9\"/></joint></robot>");
  ASSERT_TRUE(loaded.value.has_value());
  EXPECT_EQ(loaded.value->name, "a & b");
  EXPECT_EQ(loaded.value->nodes[0].name, "<1> \"x\"");
  EXPECT_EQ(loaded.value->nodes[1].name, "\xc3\xa9/~ \xc3\xa9");
  EXPECT_EQ(loaded.value->nodes[1].link->name, "it's");
}

TEST_F(LoadUrdf, ReadsNumbersHoweverTheyAreSpaced) {
  // Tabs, line breaks, a plus sign and blanks at the ends are numbers to XML tools, but not to urdfdom.
  const Loaded<Model> loaded = load(
      "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"j\" type=\"prismatic\">"
      "<origin xyz=\" 1\t2\n+3 \" rpy=\"0  0 0\"/><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1 "
      "\"/>"
      "<limit lower=\" -1 \" upper=\"+1\" effort=\" 1\" velocity=\"1 \"/></joint></robot>");
  ASSERT_TRUE(loaded.value.has_value());
  const Link& link = *loaded.value->nodes[1].link;
  EXPECT_EQ(Vector3{link.M_PJ.translation()}, Vector3(1, 2, 3));
  EXPECT_EQ(link.limits[0].lower, -1);
  EXPECT_EQ(link.limits[0].upper, 1);
}

TEST_F(LoadUrdf, SaysNothingOnTheConsole) {
  // urdfdom prints errors to stderr by itself; what it says belongs into the ledger.
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  (void)load_urdf(PANTIN_SOURCE_DIR "/assets/broken/number_nan.urdf");
  (void)load_urdf(PANTIN_SOURCE_DIR "/assets/arm.urdf");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST_F(LoadUrdf, SurvivesAnyDamage) {
  // Seeded random damage to the arm: every outcome is a model or an error, never both or neither, and every
  // model is one that can be used: parents first, links valid.
  const std::string arm = arm_text();
  std::mt19937 random{20240611};
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>{0, n - 1}(random);
  };
  const std::vector<std::string> pieces{
      "\"",    "<",         ">",     "/>",   "nan",       "-1",
      "0 0 0", "base",      "1e999", "&#0;", "</link>",   "<link name=\"base\"/>",
      "<!--",  "<![CDATA[", "\xff",  ",",    "continuous"};
  int loads = 0;
  for (int round = 0; round < 300; ++round) {
    std::string text = arm;
    for (std::size_t hits = 1 + below(3); hits > 0; --hits) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text.erase(at, below(40));
          break;
        case 1:
          text.insert(at, pieces[below(pieces.size())]);
          break;
        case 2:
          text[at] = static_cast<char>(below(256));
          break;
        default:
          text.insert(at, text.substr(below(text.size()), below(300)));
          break;
      }
    }
    const Loaded<Model> loaded = load(text);
    ASSERT_NE(loaded.value.has_value(), has_error(loaded.notes)) << "round " << round;
    if (!loaded.value) continue;
    ++loads;
    for (std::size_t i = 0; i < loaded.value->nodes.size(); ++i) {
      const ModelNode& node = loaded.value->nodes[i];
      ASSERT_LT(node.parent, static_cast<std::int32_t>(i));
      ASSERT_TRUE(node.M_PN.matrix().allFinite());
      if (node.link) {
        ASSERT_EQ(problem_with(*node.link), "") << "round " << round;
      }
    }
  }
  EXPECT_GT(loads, 25);  // else the damage would test the XML parser alone
}

TEST_F(LoadUrdf, WorksInSeveralThreads) {
  // urdfdom reports through one global handler; every thread must get its own ledger, the same as alone.
  const fs::path broken = PANTIN_SOURCE_DIR "/assets/broken/axis_not_unit.urdf";
  const fs::path arm = PANTIN_SOURCE_DIR "/assets/arm.urdf";
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) {
        const Loaded<Model> one = load_urdf(broken);
        const Loaded<Model> two = load_urdf(arm);
        if (one.notes.size() != 1 || !two.value || two.value->nodes.size() != 10) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST_F(LoadUrdf, LeavesOutMeshesWhereAskedFor) {
  // Without geometry no reader is called, and the ledger says so.
  LoadOptions options{.geometry = false};
  options.mesh_reader = [](const fs::path&) -> Loaded<std::shared_ptr<const TriangleMesh>> {
    ADD_FAILURE() << "read although not asked for";
    return {};
  };
  const Loaded<Model> loaded = load_urdf(PANTIN_SOURCE_DIR "/assets/arm.urdf", options);
  ASSERT_TRUE(loaded.value.has_value());
  ASSERT_EQ(loaded.notes.size(), 3u);  // before it: names of collisions are not kept
  EXPECT_EQ(loaded.notes[1].problem, "meshes are not read, as asked for (and 3 more alike)");
}

TEST_F(LoadUrdf, SurvivesAReaderThatThrows) {
  // What a reader throws becomes a warning at the line of the robot's file; the robot loads.
  LoadOptions options;
  options.mesh_reader = [](const fs::path&) -> Loaded<std::shared_ptr<const TriangleMesh>> {
    throw std::runtime_error{"out of ink"};
  };
  const Loaded<Model> loaded = load_urdf(PANTIN_SOURCE_DIR "/assets/arm.urdf", options);
  ASSERT_TRUE(loaded.value.has_value());
  EXPECT_NE(loaded.notes.at(1).problem.find("out of ink; dropped"), std::string::npos);
  EXPECT_EQ(loaded.notes[1].severity, Severity::Warning);
}

}  // namespace
}  // namespace pantin
