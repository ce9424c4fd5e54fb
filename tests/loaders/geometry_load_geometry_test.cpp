// OBJ, STL and PLY by our own readers: files whose content was written down by hand.
#include <gtest/gtest.h>

#include <cstring>

#include <pantin/bridge/loaders/load_mesh.hpp>

#include "geometry_fixture.hpp"
#include "support/mesh_volume.hpp"

namespace pantin {
namespace {

namespace fs = std::filesystem;
using test::volume;

const fs::path kMeshes = PANTIN_SOURCE_DIR "/assets/meshes";

using LoadGeometry = test::LoadGeometry;

const std::vector<std::string> kTakenForZ{"note: up axis: is not stated by the file: Z is taken",
                                          "note: unit: is not stated by the file: 1 m is taken"};

TEST_F(LoadGeometry, SaysWhatItTookForGranted) {
  // STL and PLY say neither unit nor up axis and are drawn with Z up; OBJ says neither and is drawn with Y
  // up.
  EXPECT_EQ(said(load_geometry(kMeshes / "tetra.ply")), kTakenForZ);
  std::vector<std::string> with_normals = kTakenForZ;
  with_normals.push_back("note: file: not needed for physics and dropped: 12 normals");
  EXPECT_EQ(said(load_geometry(kMeshes / "pedestal.stl")), with_normals);
  const Loaded<Model> flange = load_geometry(kMeshes / "flange.obj");
  ASSERT_TRUE(flange.value.has_value());
  EXPECT_EQ(flange.value->up_axis, UpAxis::Y);
  EXPECT_EQ(flange.value->format, "obj");
  EXPECT_EQ(flange.value->nodes.at(0).name, "flange");
}

TEST_F(LoadGeometry, ReadsTextStl) {
  // An STL repeats the corners of each triangle: 12 triangles of a frustum over 8 corners, h/3 (A + a +
  // sqrt(A a)) with A = 0.24^2, a = 0.16^2.
  const Loaded<Model> pedestal = load_geometry(kMeshes / "pedestal.stl");
  ASSERT_TRUE(pedestal.value.has_value());
  ASSERT_EQ(pedestal.value->nodes.size(), 1u);
  const TriangleMesh& mesh = *pedestal.value->nodes[0].meshes.at(0).mesh;
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_NEAR(volume(mesh), 0.1 / 3 * (0.0576 + 0.0256 + 0.0384), 1e-15);
}

std::string binary_stl(const std::vector<std::array<float, 12>>& facets, std::uint32_t stated) {
  std::string bytes = "solid, though binary" + std::string(60, ' ');
  const auto put = [&](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  put(&stated, sizeof stated);
  for (const auto& facet : facets) {
    put(facet.data(), sizeof facet);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

TEST_F(LoadGeometry, ReadsBinaryStl) {
  // One facet; a header that begins with "solid" is no text where the length is that of a binary file.
  const std::array<float, 12> facet{0, 0, 1, 0, 0, 0, 0.5F, 0, 0, 0, 0.25F, 0};
  const Model one = model("a.stl", binary_stl({facet}, 1));
  const TriangleMesh& mesh = *one.nodes.at(0).meshes.at(0).mesh;
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[2], Vector3(0, 0.25, 0));
  EXPECT_EQ(one.nodes[0].name, "a");
}

TEST_F(LoadGeometry, ReadsShippedBinaryFiles) {
  // plinth.stl is a closed box of 0.4 x 0.3 x 0.2 m, wedge.ply the half of it with quads for sides; sizes are
  // floats in the files, 6e-8 relative each.
  const Loaded<Model> plinth = load_geometry(kMeshes / "plinth.stl");
  const Loaded<Model> wedge = load_geometry(kMeshes / "wedge.ply");
  for (const auto& [loaded, size] : {std::pair{&plinth, 0.024}, {&wedge, 0.012}}) {
    ASSERT_TRUE(loaded->value.has_value());
    const TriangleMesh& mesh = *loaded->value->nodes.at(0).meshes.at(0).mesh;
    EXPECT_FALSE(closedness_problem(mesh).has_value());
    EXPECT_NEAR(volume(mesh), size, 5e-9);
  }
}

TEST_F(LoadGeometry, NamesDamageOfStl) {
  // Each message of the two readers.
  EXPECT_EQ(
      refusal("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\nvertex 0 1 0\n"),
      "a.stl:6: a coordinate is wanted, but 'vertex' stands there");
  EXPECT_EQ(refusal("a.stl",
                    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 inf\n"),
            "a.stl:6: a coordinate is wanted, but 'inf' stands there");
  EXPECT_EQ(refusal("a.stl", "solid a\nfacet normal 0 0 1\nloop\n"),
            "a.stl:3: 'outer' is wanted, but 'loop' stands there");
  EXPECT_EQ(refusal("a.stl", "solid a\n"), "a.stl:2: 'facet' or 'endsolid' is wanted, but the file ends");
  EXPECT_EQ(refusal("a.stl", "solid a\nendsolid a\nmore\n"),
            "a.stl:3: 'solid' is wanted, but 'more' stands there");
  EXPECT_EQ(refusal("a.stl", "solid a\nendsolid a\n"), "a.stl: holds no triangle");
  EXPECT_EQ(refusal("a.stl", "nothing"),
            "a.stl: is neither text nor long enough for the header of a binary STL");
  std::string bytes = binary_stl({{}}, 3);
  bytes[0] = 'x';
  EXPECT_EQ(refusal("a.stl", bytes), "a.stl: says at byte 80 that it has 3 triangles, but holds 1");
  std::array<float, 12> facet{};
  facet[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal("a.stl", binary_stl({facet}, 1)),
            "a.stl: has a coordinate that is not finite at byte 100");
}

TEST_F(LoadGeometry, ReadsFormsOfObj) {
  // Slashes, negative indices, a continued line, a quad, vertices that come after the face, a comment.
  const Model cube =
      model("a.obj",
            "# a comment\nf 1/1/1 2//1 \\\n 3 4 # quad\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv +0 2e0 0\n"
            "f -4 -2 -1\n");
  const TriangleMesh& mesh = *cube.nodes.at(0).meshes.at(0).mesh;
  EXPECT_EQ(mesh.vertices.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[2], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

TEST_F(LoadGeometry, MakesANodeOfEachObject) {
  // Two objects share vertices of the file but not of their meshes; a group without faces is none.
  const Model two = model(
      "pair.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no first\nf 1 2 3\ng empty\no second one\nf 2 3 4\n");
  ASSERT_EQ(two.nodes.size(), 3u);
  EXPECT_EQ(two.nodes[0].name, "pair");
  EXPECT_EQ(two.nodes[1].name, "first");
  EXPECT_EQ(two.nodes[2].name, "second one");
  EXPECT_EQ(two.nodes[2].parent, 0);
  EXPECT_EQ(two.nodes[2].meshes.at(0).mesh->vertices.size(), 3u);
}

TEST_F(LoadGeometry, AccountsForWhatItReadsAndLeavesOut) {
  // Three vertices and a triangle are in the model; a statement that nobody knows, a normal and a group
  // without faces are not, each with its line.
  Account account;
  const Loaded<Model> loaded =
      load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\ng nothing\ng all\nf 1 2 3\nzorp 1\n",
           {.account = &account});
  ASSERT_TRUE(loaded.value.has_value());
  std::string told;
  for (const AccountEntry& e : account)
    told += std::string{to_string(e.fate)} + ' ' + std::to_string(e.count) + ' ' + e.item + ' ' +
            std::filesystem::path{e.place}.filename().string() + '\n';
  EXPECT_EQ(told,
            "read 3 vertices a.obj\nread 1 triangles a.obj\n"
            "dropped 1 groups without triangles a.obj:5\ndropped 1 normals a.obj:4\n"
            "dropped 1 statements 'zorp' a.obj:8\n");
}

TEST_F(LoadGeometry, ListsWhatItLeavesOut) {
  // What physics does not need is a note, what is lost a warning, each with its number.
  const Loaded<Model> loaded =
      load("a.obj",
           "mtllib a.mtl\nusemtl red\nv 0 0 0 1\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nvt 1 0\n"
           "s 1\nf 1 2 3\nf 1 2 2\nl 1 2\np 1\ncurv 0 1 1 2\nv 5 5 5\n");
  ASSERT_TRUE(loaded.value.has_value());
  const std::vector<std::string> notes = said(loaded);
  ASSERT_EQ(notes.size(), 4u);
  EXPECT_EQ(
      notes[2],
      "note: file: not needed for physics and dropped: 1 libraries of materials, 1 normals, 1 smoothing "
      "groups, "
      "2 texture coordinates, 1 triangles with two equal corners, 1 uses of materials, 1 vertices without "
      "triangle, 1 weights or colours of vertices");
  EXPECT_EQ(notes[3],
            "warning: file: dropped: 2 points or lines (first in line 12), 1 statements 'curv' (line 14)");
}

TEST_F(LoadGeometry, NamesDamageOfObj) {
  // Each message.
  EXPECT_EQ(refusal("a.obj", "v 0 0\n"), "a.obj:1: a coordinate is wanted, but the file ends");
  EXPECT_EQ(refusal("a.obj", "v 0 0 x\n"), "a.obj:1: a coordinate is wanted, but 'x' stands there");
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\n\nf 1 1 4\n"), "a.obj:3: a face names vertex 4 of 1");
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nf -2 1 1\n"), "a.obj:2: a face names vertex 0 of 1");
  EXPECT_EQ(refusal("a.obj", "f 0 1 2\n"), "a.obj:1: '0' is no corner of a face");
  EXPECT_EQ(refusal("a.obj", "f a b c\n"), "a.obj:1: 'a' is no corner of a face");
  EXPECT_EQ(refusal("a.obj", "f\n"), "a.obj:1: a face has no corner");
  std::string many = "v 0 0 0\nf";
  for (int i = 0; i < 1001; ++i) many += " 1";
  EXPECT_EQ(refusal("a.obj", many), "a.obj:2: a face has more than 1000 corners");
  EXPECT_EQ(refusal("a.obj", "hello\n"), "a.obj: holds no triangle");
}

TEST_F(LoadGeometry, CutsConcavePolygonsAlongTheirInside) {
  // An arrow head: the fan from its first corner would cover area outside. Its triangles all turn the same
  // way and their areas add up to that of the polygon, 3; in any of three planes, from either side.
  const std::array<std::array<double, 2>, 4> arrow{{{0, 0}, {3, 1}, {0, 2}, {1, 1}}};
  const double area = 0.5 * (3 * 2 - 1 * 2);  // triangle less notch
  for (int plane = 0; plane < 3; ++plane) {
    for (const bool turned : {false, true}) {
      std::string text;
      for (const auto& [x, y] : arrow) {
        std::array<double, 3> p{};
        p[static_cast<std::size_t>(plane)] = x;
        p[static_cast<std::size_t>((plane + 1) % 3)] = y;
        text += "v " + std::to_string(p[0]) + ' ' + std::to_string(p[1]) + ' ' + std::to_string(p[2]) + '\n';
      }
      const Model cut = model("a.obj", text + (turned ? "f 4 3 2 1\n" : "f 1 2 3 4\n"));
      const TriangleMesh& mesh = *cut.nodes.at(0).meshes.at(0).mesh;
      ASSERT_EQ(mesh.triangles.size(), 2u);
      double sum = 0;
      for (const auto& t : mesh.triangles) {
        const Vector3 n =
            (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
        const double signed_area = 0.5 * n[(plane + 2) % 3] * (turned ? -1 : 1);
        EXPECT_GT(signed_area, 0) << plane << turned;
        sum += signed_area;
      }
      EXPECT_NEAR(sum, area, 1e-12);
    }
  }
}

TEST_F(LoadGeometry, ReadsTheHierarchyAlone) {
  // Without geometry the nodes are the same and carry nothing.
  const Loaded<Model> loaded = load_geometry(kMeshes / "flange.obj", {.geometry = false});
  ASSERT_TRUE(loaded.value.has_value());
  EXPECT_TRUE(loaded.value->nodes.at(0).meshes.empty());
  EXPECT_EQ(loaded.notes.back().problem, "meshes are not kept, as asked for");
}

TEST_F(LoadGeometry, IsChosenByExtensionOrContent) {
  // In any case; a PLY by any other name begins with its own.
  const std::string ply = test::content_of(kMeshes / "tetra.ply");
  EXPECT_EQ(load_model(folder_.write("a.PLY", ply)).value->format, "ply");
  EXPECT_EQ(load_model(folder_.write("b.scan", ply)).value->format, "ply");
  EXPECT_EQ(load_model(kMeshes / "pedestal.stl").value->format, "stl");
}

TEST_F(LoadGeometry, ServesTheMeshesOfRobots) {
  // load_mesh joins all parts; what such files never say is not repeated.
  const auto pair = load_mesh(
      folder_.write("pair.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no a\nf 1 2 3\no b\nf 2 3 4\n"));
  ASSERT_TRUE(pair.value.has_value());
  EXPECT_EQ((*pair.value)->triangles.size(), 2u);
  EXPECT_TRUE(pair.notes.empty());
  const auto line = load_mesh(folder_.write("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"));
  EXPECT_FALSE(line.value.has_value());
  EXPECT_EQ(line.notes.back().problem, "holds no triangle");
}

}  // namespace
}  // namespace pantin
