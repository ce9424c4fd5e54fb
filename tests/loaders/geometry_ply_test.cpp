// PLY by our own reader: files whose content was written down by hand.
#include <gtest/gtest.h>

#include <cstring>
#include <tuple>

#include "geometry_fixture.hpp"

namespace pantin {
namespace {

using PlyGeometry = test::LoadGeometry;

constexpr const char* kPlyFaces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

TEST_F(PlyGeometry, ReadsPlyOfAllThreeForms) {
  // The same triangle as text and with both byte orders; a colour and a foreign element are left out.
  const std::string vertex =
      "element vertex 3\nproperty float x\nproperty double y\nproperty short z\nproperty uchar red\n";
  const std::string rest = "element edge 1\nproperty int a\n" + std::string{kPlyFaces};
  const Loaded<Model> text = load("a.ply", "ply\nformat ascii 1.0\ncomment c\n" + vertex + rest +
                                               "0 0 0 9\n0.5 0 0 9\n0 0.25 -7 9\n5\n3 0 1 2\n");
  for (const bool big : {false, true}) {
    std::string bytes =
        std::string{"ply\nformat binary_"} + (big ? "big" : "little") + "_endian 1.0\n" + vertex + rest;
    const auto put = [&](auto value) {
      std::string raw(sizeof value, '\0');
      std::memcpy(raw.data(), &value, sizeof value);
      bytes += big ? std::string{raw.rbegin(), raw.rend()} : raw;
    };
    for (const auto& [x, y, z] : {std::tuple{0.F, 0., 0}, {0.5F, 0., 0}, {0.F, 0.25, -7}}) {
      put(x);
      put(y);
      put(static_cast<std::int16_t>(z));
      put(std::uint8_t{9});
    }
    put(5);
    put(std::uint8_t{3});
    for (const int index : {0, 1, 2}) put(index);
    const Loaded<Model> binary = load("a.ply", bytes);
    for (const Loaded<Model>* loaded : {&text, &binary}) {
      ASSERT_TRUE(loaded->value.has_value()) << to_string(loaded->notes.at(0));
      const TriangleMesh& mesh = *loaded->value->nodes.at(0).meshes.at(0).mesh;
      ASSERT_EQ(mesh.vertices.size(), 3u);
      EXPECT_EQ(mesh.vertices[1], Vector3(0.5, 0, 0));
      EXPECT_EQ(mesh.vertices[2], Vector3(0, 0.25, -7));
      EXPECT_EQ(said(*loaded).at(2),
                "note: file: not needed for physics and dropped: 3 property 'red' of vertices");
      EXPECT_EQ(said(*loaded).at(3), "warning: file: dropped: 1 element 'edge'");
    }
  }
}

TEST_F(PlyGeometry, NamesDamageOfPly) {
  // Each message; assimp 5.2 crashed or hung on some of these.
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string vertices = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(refusal("a.ply", "no"), "a.ply:1: does not begin with 'ply'");
  EXPECT_EQ(refusal("a.ply", head + "element v"), "a.ply:3: element 'v' has no number");
  EXPECT_EQ(refusal("a.ply", head), "a.ply:3: the header does not end");
  EXPECT_EQ(refusal("a.ply", head + "who\n"), "a.ply:3: 'who' is no statement of a header");
  EXPECT_EQ(refusal("a.ply", "ply\nend_header\n"), "a.ply:2: the header does not say the format");
  EXPECT_EQ(refusal("a.ply", "ply\nformat odd 1.0\n"), "a.ply:2: format 'odd' is not known");
  EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 2\n"), "a.ply:2: version '2' of PLY is not known");
  EXPECT_EQ(refusal("a.ply", head + "property int x\n"),
            "a.ply:3: a property stands before the first element");
  EXPECT_EQ(refusal("a.ply", head + "element v 1\nproperty odd x\n"),
            "a.ply:4: 'odd' is no type of a property");
  EXPECT_EQ(refusal("a.ply", head + "element v 1\nproperty list float int x\n"),
            "a.ply:4: the length of a list is no integer");
  EXPECT_EQ(refusal("a.ply", head + "element vertex 1\nproperty float x\nend_header\n0\n"),
            "a.ply: has vertices without x, y or z");
  EXPECT_EQ(refusal("a.ply", head + vertices + vertices + "end_header\n0 0 0\n0 0 0\n"),
            "a.ply: has vertices twice");
  EXPECT_EQ(refusal("a.ply", head + vertices + kPlyFaces + "0 0 z\n"),
            "a.ply:10: a number is wanted, but 'z' stands there");
  EXPECT_EQ(refusal("a.ply", head + vertices + kPlyFaces + "0 0 0\n3 0 0 1\n"),
            "a.ply:11: a face names a vertex that is not one of 1");
  EXPECT_EQ(refusal("a.ply", head + vertices + kPlyFaces + "0 0 0\n-1 0\n"),
            "a.ply:11: a list has no length");
  EXPECT_EQ(refusal("a.ply", head + vertices + kPlyFaces + "0 0 0\n99 0\n"),
            "a.ply:11: a list is longer than the file");
  EXPECT_EQ(refusal("a.ply", head + vertices + "element face 1\nproperty int n\nend_header\n0 0 0\n1\n"),
            "a.ply: has faces without vertex_indices");
  EXPECT_EQ(refusal("a.ply", head + "element vertex 99999\nproperty float x\nend_header\n0\n"),
            "a.ply: says that it has 99999 of element 'vertex', more than it can hold");
  const std::string binary = "ply\nformat binary_little_endian 1.0\n" + vertices + "end_header\n";
  EXPECT_EQ(refusal("a.ply", binary + "1234"), "a.ply: ends at byte 119, too early");
  EXPECT_EQ(refusal("a.ply", binary + std::string("\0\0\x80\x7f", 4)),
            "a.ply: a number is not finite before byte 119");
}

}  // namespace
}  // namespace pantin
