// Files of foreign formats, made for these tests, whose content was written down by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <pantin/bridge/loaders/load_assimp.hpp>
#include <pantin/bridge/loaders/load_mesh.hpp>

#include "support/mesh_volume.hpp"
#include "support/temporary_folder.hpp"

namespace pantin {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::replaced;
using test::volume;

const fs::path kMeshes = PANTIN_SOURCE_DIR "/assets/meshes";
constexpr double kSingle = 1e-6;  ///< assimp is single precision: 6e-8 relative, over values of about 3 m

Model model(const std::string& name) {
  Loaded<Model> loaded = load_assimp(kMeshes / name);
  if (!loaded.value) throw std::runtime_error{to_string(loaded.notes.at(0))};
  return *std::move(loaded.value);
}

/// What assimp itself says of crane.dae.
const std::string kByAssimp = "note: file: is read by assimp, which does not tell what it passes over itself";
const std::string kNoMaterial =
    "note: parser: says: Collada: No material specified for subgroup <> in geometry <wedge>.";

std::vector<std::string> problems(const std::vector<Diagnostic>& notes) {
  std::vector<std::string> all;
  for (const Diagnostic& note : notes)
    all.push_back(std::string{to_string(note.severity)} + ": " + note.subject + ": " + note.problem);
  return all;
}

/// Whether a vertex stands near `p`.
testing::AssertionResult has_vertex(const TriangleMesh& mesh, const Vector3& p) {
  for (const Vector3& v : mesh.vertices) {
    if ((v - p).norm() < kSingle) return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "no vertex at " << p.transpose();
}

/// Files that go away with the test.
class LoadAssimp : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const { return folder_.write(name, text); }
  test::TemporaryFolder folder_{};
};

TEST_F(LoadAssimp, AppliesTheUnitOfColladaToLengthsAlone) {
  // crane.dae is in centimetres: 50 becomes 0.5, and no matrix gets a scale, so rigid nodes stay rigid.
  const Model crane = model("crane.dae");
  EXPECT_EQ(crane.unit_m, 0.01);
  EXPECT_EQ(crane.format, "dae");
  EXPECT_EQ(crane.name, "crane");
  ASSERT_EQ(crane.nodes.size(), 3u);
  EXPECT_TRUE(crane.nodes[0].M_PN.isApprox(Affine::Identity(), 0));
  EXPECT_EQ(crane.nodes[1].name, "mast");
  EXPECT_LT((crane.nodes[1].M_PN.translation() - Vector3(0, 0, 0.5)).norm(), kSingle);
  EXPECT_EQ(crane.nodes[2].name, "jib");
  EXPECT_EQ(crane.nodes[2].parent, 1);
  EXPECT_LT((crane.nodes[2].M_PN.translation() - Vector3(0.1, 0.2, 0.3)).norm(), kSingle);
  for (const ModelNode& node : crane.nodes) {
    EXPECT_LT((node.M_PN.linear() - Matrix3::Identity()).norm(), kSingle) << node.name;
  }
  const TriangleMesh& wedge = *crane.nodes[1].meshes.at(0).mesh;
  EXPECT_EQ(wedge.vertices.size(), 4u);
  EXPECT_EQ(wedge.triangles.size(), 4u);
  EXPECT_TRUE(has_vertex(wedge, {1, 0, 0}));
  EXPECT_TRUE(has_vertex(wedge, {0, 2, 0}));
  EXPECT_TRUE(has_vertex(wedge, {0, 0, 3}));
  EXPECT_EQ(crane.nodes[1].meshes[0].mesh, crane.nodes[2].meshes.at(0).mesh);  // one geometry, two uses
  EXPECT_EQ(problems(load_assimp(kMeshes / "crane.dae").notes),
            (std::vector<std::string>{"note: unit: lengths are multiplied by 0.01 to be metres", kNoMaterial,
                                      kByAssimp}));
}

TEST_F(LoadAssimp, KeepsTheUpAxisOfCollada) {
  // Whatever axis the file calls up, the numbers of its nodes and vertices stay as written.
  const std::string text = content_of(kMeshes / "crane.dae");
  for (const auto& [name, axis] : {std::pair{"X_UP", UpAxis::X}, {"Y_UP", UpAxis::Y}, {"Z_UP", UpAxis::Z}}) {
    const Loaded<Model> loaded = load_assimp(write("up.dae", replaced(text, "Z_UP", name)));
    ASSERT_TRUE(loaded.value.has_value()) << name;
    EXPECT_EQ(loaded.value->up_axis, axis) << name;
    EXPECT_EQ(loaded.value->unit_m, 0.01);
    EXPECT_LT((loaded.value->nodes[1].M_PN.translation() - Vector3(0, 0, 0.5)).norm(), kSingle) << name;
    EXPECT_TRUE(has_vertex(*loaded.value->nodes[1].meshes.at(0).mesh, {0, 2, 0})) << name;
  }
}

TEST_F(LoadAssimp, ReadsAnimationInSecondsAndMetres) {
  // The jib turns by 90 degrees about z from 0 to 2 s; its translation stays at (10, 20, 30) cm.
  const Model crane = model("crane.dae");
  ASSERT_EQ(crane.clips.size(), 1u);
  const Clip& clip = crane.clips[0];
  EXPECT_NEAR(clip.duration, 2, kSingle);
  bool turned = false;
  for (const Track& track : clip.tracks) {
    EXPECT_EQ(track.target, 2u);
    EXPECT_EQ(track.interpolation, Interpolation::Linear);
    EXPECT_EQ(problem_with(track), "");
    const TrackSample end = sample(track, 2.0);
    if (track.channel == Channel::Rotation) {
      turned = true;
      EXPECT_NEAR(std::abs(end.value[0]), std::sqrt(0.5), kSingle);
      EXPECT_NEAR(end.value[3] * end.value[0], 0.5, kSingle);
      EXPECT_NEAR(2 * std::acos(std::abs(sample(track, 1.0).value[0])), std::numbers::pi / 4, 10 * kSingle);
    } else if (track.channel == Channel::Translation) {
      EXPECT_NEAR(end.value[0], 0.1, kSingle);
      EXPECT_NEAR(end.value[2], 0.3, kSingle);
    }
  }
  EXPECT_TRUE(turned);
}

TEST_F(LoadAssimp, ReadsUnitAndUpAxisOfFbx) {
  // lever.fbx: 2.54 cm a unit, Z up. The pivot's pre-rotation by 90 degrees about x is part of its matrix,
  // not of nodes of its own.
  const Model lever = model("lever.fbx");
  EXPECT_EQ(lever.unit_m, 0.0254);
  EXPECT_EQ(lever.up_axis, UpAxis::Z);
  ASSERT_EQ(lever.nodes.size(), 3u);
  EXPECT_EQ(lever.nodes[1].name, "pivot");
  EXPECT_LT((lever.nodes[1].M_PN.translation() - Vector3(2.54, 0, 0)).norm(), kSingle);
  EXPECT_LT((lever.nodes[1].M_PN.linear() * Vector3::UnitY() - Vector3::UnitZ()).norm(), kSingle);
  EXPECT_LT((lever.nodes[2].M_PN.translation() - Vector3(0, 0, 0.254)).norm(), kSingle);
  EXPECT_TRUE(has_vertex(*lever.nodes[2].meshes.at(0).mesh, {0, 0.508, 0}));
}

TEST_F(LoadAssimp, ReadsTheHierarchyAlone) {
  // Without geometry the nodes are the same and carry nothing.
  const Loaded<Model> loaded = load_assimp(kMeshes / "crane.dae", {.geometry = false});
  ASSERT_TRUE(loaded.value.has_value());
  EXPECT_EQ(loaded.value->nodes.size(), 3u);
  for (const ModelNode& node : loaded.value->nodes) EXPECT_TRUE(node.meshes.empty());
  const std::vector<std::string> said = problems(loaded.notes);
  EXPECT_NE(std::find(said.begin(), said.end(), "note: file: meshes are not read, as asked for"), said.end());
}

/// The track of one channel of a node in the model's only clip.
const Track& track_of(const Model& m, const std::string& node, Channel channel) {
  for (const Track& track : m.clips.at(0).tracks) {
    if (m.nodes.at(track.target).name == node && track.channel == channel) return track;
  }
  throw std::runtime_error{"no such track of " + node};
}

TEST_F(LoadAssimp, ReadsAnimationOfFbxAtItsTimes) {
  // swing.fbx: the arm turns about z to 90 degrees in 1 s and back until 3 s, the post rises from 1 to 1.5 m
  // in 3 s. Keys stand at these times; between them a turn about one axis at even speed is the same in Euler
  // angles and on the sphere.
  const Model swing = model("swing.fbx");
  EXPECT_EQ(swing.unit_m, 0.01);
  EXPECT_EQ(swing.up_axis, UpAxis::Y);
  ASSERT_EQ(swing.clips.size(), 1u);
  EXPECT_EQ(swing.clips[0].name, "swing");
  EXPECT_NEAR(swing.clips[0].duration, 3, kSingle);
  const Track& turn = track_of(swing, "arm", Channel::Rotation);
  for (const auto& [time, degrees] :
       {std::pair{0.0, 0.0}, {0.5, 45.0}, {1.0, 90.0}, {2.0, 45.0}, {3.0, 0.0}}) {
    const TrackSample at = sample(turn, time);
    EXPECT_NEAR(2 * std::atan2(at.value[3], at.value[0]), degrees * std::numbers::pi / 180, 10 * kSingle)
        << time;
  }
  const Track& rise = track_of(swing, "post", Channel::Translation);
  for (const double time : {0.0, 0.75, 1.5, 3.0})
    EXPECT_NEAR(sample(rise, time).value[1], 1 + time / 6, kSingle) << time;
}

TEST_F(LoadAssimp, ReadsMotionCaptureAtItsTimes) {
  // waver.bvh: four frames a quarter of a second apart; the hips rise by 0.1 m and the arm turns by 30
  // degrees about z from each to the next. Nothing but the joints is there: assimp's skeleton mesh is not
  // wanted.
  const Model waver = model("waver.bvh");
  ASSERT_EQ(waver.nodes.size(), 4u);
  for (const ModelNode& node : waver.nodes) EXPECT_TRUE(node.meshes.empty()) << node.name;
  EXPECT_LT((waver.nodes[1].M_PN.translation() - Vector3(0, 0.5, 0)).norm(), kSingle);
  const Track& turn = track_of(waver, "arm", Channel::Rotation);
  const Track& rise = track_of(waver, "hips", Channel::Translation);
  ASSERT_EQ(rise.times.size(), 4u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(rise.times[static_cast<std::size_t>(k)], 0.25 * k, kSingle);
    EXPECT_NEAR(sample(rise, 0.25 * k).value[1], 1 + 0.1 * k, kSingle);
    const TrackSample at = sample(turn, 0.25 * k);
    EXPECT_NEAR(2 * std::atan2(at.value[3], at.value[0]), k * std::numbers::pi / 6, 10 * kSingle);
  }
}

TEST_F(LoadAssimp, WarnsOfAmbiguousTargets) {
  // Channels find nodes by name. Two joints of this motion file have one name: both channels move the first,
  // and it is said for each. Frames 0.5 s apart give keys at 0 and 0.5 s.
  const std::string joint =
      "JOINT arm { OFFSET 1 0 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 1 0 0 } }\n";
  const Loaded<Model> loaded = load_assimp(
      write("two.bvh", "HIERARCHY\nROOT hips {\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n" +
                           joint + joint +
                           "}\nMOTION\nFrames: 2\nFrame Time: 0.5\n0 0 0 0 0 0 0 0 0\n90 0 0 0 0 0 0 0 0\n"));
  ASSERT_TRUE(loaded.value.has_value()) << to_string(loaded.notes.at(0));
  int warnings = 0;
  for (const std::string& said : problems(loaded.notes)) {
    if (said.find("moves node 'arm', a name that 2 nodes bear; the first is moved") != std::string::npos)
      ++warnings;
  }
  EXPECT_EQ(warnings, 2);
  ASSERT_EQ(loaded.value->clips.size(), 1u);
  EXPECT_NEAR(loaded.value->clips[0].duration, 0.5, kSingle);
}

TEST_F(LoadAssimp, NamesFilesThatCannotBeRead) {
  // What assimp says about a file without any content, and what the file system says.
  const Loaded<Model> damaged = load_assimp(write("a.dae", "nothing here"));
  EXPECT_FALSE(damaged.value.has_value());
  EXPECT_TRUE(damaged.notes.at(0).problem.starts_with("cannot be read by assimp: "))
      << damaged.notes[0].problem;
  EXPECT_EQ(damaged.notes[0].severity, Severity::Error);
  EXPECT_EQ(load_assimp("/nowhere/a.dae").notes.at(0).problem, "does not exist");
  EXPECT_EQ(load_mesh("/nowhere/a.dae").notes.at(0).problem, "does not exist");
}

TEST_F(LoadAssimp, KnowsWhatAssimpReads) {
  // The extension decides, in any case; .xml may be anything, .txt is nothing.
  EXPECT_TRUE(assimp_reads("a.stl"));
  EXPECT_TRUE(assimp_reads("a.DAE"));
  EXPECT_TRUE(assimp_reads("folder.x/a.fbx"));
  EXPECT_FALSE(assimp_reads("a.txt"));
  EXPECT_FALSE(assimp_reads("a.xml"));
  EXPECT_FALSE(assimp_reads("a"));
  EXPECT_FALSE(assimp_reads(""));
}

TEST_F(LoadAssimp, KnowsTheExtensionsOfTheAssimpInUse) {
  // The list of the library, which does not link assimp, is the one that the helper prints
  // ("*.3ds;*.ac;...").
  FILE* helper = popen(PANTIN_BINARY_DIR "/libexec/pantin-import --extensions", "r");
  ASSERT_NE(helper, nullptr);
  std::string printed(4096, '\0');
  printed.resize(std::fread(printed.data(), 1, printed.size(), helper));
  EXPECT_EQ(pclose(helper), 0);
  for (const std::string_view extension : assimp_extensions()) {
    EXPECT_NE((';' + printed).find(";*" + std::string{extension}), std::string::npos) << extension;
  }
  EXPECT_EQ(std::count(printed.begin(), printed.end(), ';') + 1,
            static_cast<std::ptrdiff_t>(assimp_extensions().size()));
  EXPECT_TRUE(std::is_sorted(assimp_extensions().begin(), assimp_extensions().end()));
}

TEST_F(LoadAssimp, ReadsMeshesForUrdfAsRosDoes) {
  // Unit and node transforms are applied, the up axis is not: both wedges stand where the nodes put them,
  // whatever axis the file calls up. jib = (0, 0, 50) + (10, 20, 30) cm.
  const std::string text = content_of(kMeshes / "crane.dae");
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
    const auto loaded = load_mesh(write("up.dae", replaced(text, "Z_UP", up)));
    ASSERT_TRUE(loaded.value.has_value()) << up;
    const TriangleMesh& mesh = **loaded.value;
    EXPECT_EQ(mesh.triangles.size(), 8u);
    EXPECT_EQ(mesh.vertices.size(), 8u);
    EXPECT_TRUE(has_vertex(mesh, {1, 0, 0.5}));
    EXPECT_TRUE(has_vertex(mesh, {0.1, 2.2, 0.8}));
    EXPECT_NEAR(volume(mesh), 2 * 1.0, 10 * kSingle);  // each wedge is 1 x 2 x 3 / 6
    EXPECT_EQ(
        problems(loaded.notes),
        (std::vector<std::string>{"note: unit: lengths are multiplied by 0.01 to be metres", kNoMaterial}));
  }
}

TEST_F(LoadAssimp, TurnsTheWindingOfMirroredMeshes) {
  // A node scaled by (-1, 1, 1) turns triangles inside out; their winding is turned back, so the volume stays
  // positive.
  const std::string mirrored =
      replaced(content_of(kMeshes / "crane.dae"), "<rotate sid=\"swing\">0 0 1 0</rotate>",
               "<rotate sid=\"swing\">0 0 1 0</rotate><scale>-1 1 1</scale>");
  const auto loaded = load_mesh(write("mirrored.dae", mirrored));
  ASSERT_TRUE(loaded.value.has_value());
  EXPECT_NEAR(volume(**loaded.value), 2 * 1.0, 10 * kSingle);
  EXPECT_TRUE(has_vertex(**loaded.value, {-0.9, 0.2, 0.8}));
}

}  // namespace
}  // namespace pantin
