#include <pantin/physics/mesh_integrals.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <support/meshes.hpp>
#include <support/near.hpp>

namespace pantin {
namespace {

using test::near;

TEST(MeshIntegrals, OfABoxAreTheTextbookForms) {
  // V = x y z, and V x^2 / 12 for the second moment along x about the centroid.
  const MeshIntegrals box = integrals_of(test::box_mesh({1, 2, 3}, {4, 5, 6}));
  EXPECT_NEAR(box.volume, 6, 1e-14);
  EXPECT_TRUE(near(box.centroid, Vector3{4, 5, 6}, 1e-14));
  const Matrix3 expected = Vector3(0.5, 2, 4.5).asDiagonal();
  EXPECT_TRUE(near(box.second_moments, expected, 1e-14));
}

TEST(MeshIntegrals, OfAnInsideOutMeshAreNegativeAroundTheSameCentroid) {
  // Turning all triangles round changes the sign of every term, and of nothing that is a quotient of them.
  const TriangleMesh mesh = test::corner_tetrahedron({1, 2, 3});
  const MeshIntegrals out = integrals_of(mesh), in = integrals_of(test::turned_inside_out(mesh));
  EXPECT_DOUBLE_EQ(in.volume, -out.volume);
  EXPECT_TRUE(near(in.centroid, out.centroid, 1e-15));
  EXPECT_TRUE(near(in.second_moments, Matrix3{-out.second_moments}, 1e-15));
}

TEST(MeshIntegrals, ScaleWithTheMesh) {
  // Volume by |det D|, centroid by D, second moments by |det D| D S D, for diagonal D, mirrors included.
  const TriangleMesh mesh = test::corner_tetrahedron({1, 2, 3});
  const MeshIntegrals plain = integrals_of(mesh);
  for (const Vector3& scale : {Vector3{2, 0.5, 3}, Vector3{-2, 0.5, 3}, Vector3{-2, -0.5, -3}}) {
    const MeshIntegrals scaled = integrals_of(mesh, scale);
    const Matrix3 D = scale.asDiagonal();
    EXPECT_NEAR(scaled.volume, 3 * plain.volume, 1e-14);
    EXPECT_TRUE(near(scaled.centroid, D * plain.centroid, 1e-14));
    EXPECT_TRUE(near(scaled.second_moments, 3 * D * plain.second_moments * D, 1e-14, 10));
  }
}

TEST(MeshIntegrals, BoundTheirRoundOff) {
  // A tilted flat double triangle encloses nothing: what is left of its volume is round-off, and the bound is
  // tight enough to tell a needle of 1e-12 m^3 from it.
  const TriangleMesh flat{{{0.1, 0.2, 0.3}, {1.3, 0.7, 0.2}, {0.4, 1.9, 0.8}}, {{0, 1, 2}, {0, 2, 1}}};
  const MeshIntegrals nothing = integrals_of(flat);
  EXPECT_LE(std::abs(nothing.volume), nothing.volume_round_off);
  TriangleMesh needle = test::box_mesh({1, 1e-6, 1e-6});
  const Quaternion tilt = Quaternion{0.8, 0.3, -0.4, 0.3}.normalized();
  for (Vector3& vertex : needle.vertices) vertex = tilt * vertex;
  const MeshIntegrals thin = integrals_of(needle);
  EXPECT_NEAR(thin.volume, 1e-12, thin.volume_round_off);
  EXPECT_LT(thin.volume_round_off, 1e-14);
}

}  // namespace
}  // namespace pantin
