#include <pantin/physics/mass_properties.hpp>

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <support/meshes.hpp>
#include <support/near.hpp>
#include <support/problems.hpp>

namespace pantin {
namespace {

using test::near;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

MassProperties diagonal(double mass, double x, double y, double z) {
  return {mass, Vector3::Zero(), Vector3(x, y, z).asDiagonal()};
}

TEST(MassProperties, OfTwoHalvesCombineToTheWhole) {
  // A box cut in two, its pieces put together again, also far from the origin where the offset is exact.
  const Vector3 far{4096, -1024, 512};
  const MassProperties halves[] = {mass_of({BoxShape{{1, 3, 4}}, {.p = far + Vector3{-0.5, 0, 0}}}, 2),
                                   mass_of({BoxShape{{1, 3, 4}}, {.p = far + Vector3{0.5, 0, 0}}}, 2)};
  EXPECT_TRUE(near(combined(halves), mass_of({BoxShape{{2, 3, 4}}, {.p = far}}, 2), 1e-15));
}

TEST(MassProperties, CombineWithMasslessPartsAndNothing) {
  // A massless part changes nothing; nothing at all has no mass; one alone stays itself to the last bit.
  const MassProperties body = mass_of({BoxShape{{1, 2, 3}}, {.p = {0.1, 0.2, 0.3}}}, 1);
  const MassProperties massless{0, {7, 8, 9}, Matrix3::Zero()};
  const MassProperties parts[] = {massless, body};
  EXPECT_TRUE(near(combined(parts), body, 1e-15));
  const MassProperties alone = combined({&body, 1});
  EXPECT_EQ(alone.p_BBcm, body.p_BBcm);
  EXPECT_EQ(alone.I_BBcm_B, body.I_BBcm_B);
  const MassProperties nothing = combined({});
  EXPECT_EQ(nothing.mass, 0);
  EXPECT_EQ(nothing.I_BBcm_B, Matrix3::Zero());
  EXPECT_EQ(combined({&massless, 1}).p_BBcm, massless.p_BBcm);
}

TEST(MassProperties, CombineInAnyOrderAndGrouping) {
  // Sums are associative and commutative; random solids.
  std::mt19937_64 random{7};
  for (int round = 0; round < 100; ++round) {
    const MassProperties a = test::random_mass(random), b = test::random_mass(random),
                         c = test::random_mass(random);
    const MassProperties abc[] = {a, b, c}, cb[] = {c, b};
    const MassProperties grouped[] = {combined(cb), a};
    EXPECT_TRUE(near(combined(abc), combined(grouped), 1e-14));
  }
}

TEST(MassProperties, InAnotherFrameAndBackAreTheSame) {
  // X_BA X_AB = 1, and principal moments do not depend on axes.
  std::mt19937_64 random{8};
  for (int round = 0; round < 100; ++round) {
    const MassProperties in_B = test::random_mass(random);
    const Pose X_AB{test::random_vector(random), test::random_rotation(random)};
    const MassProperties in_A = in_frame(X_AB, in_B);
    EXPECT_TRUE(near(in_A.p_BBcm, X_AB * in_B.p_BBcm, 1e-15));
    EXPECT_NEAR(in_A.I_BBcm_B.determinant(), in_B.I_BBcm_B.determinant(),
                1e-13 * in_B.I_BBcm_B.determinant());
    EXPECT_EQ(in_A.I_BBcm_B, in_A.I_BBcm_B.transpose());
    EXPECT_TRUE(near(in_frame(inverse(X_AB), in_A), in_B, 1e-14));
  }
}

TEST(MassProperties, DeformedByRotationAreTurned) {
  // A rotation is a linear map of the frame.
  std::mt19937_64 random{9};
  for (int round = 0; round < 100; ++round) {
    const MassProperties body = test::random_mass(random);
    const Pose X_AB{Vector3::Zero(), test::random_rotation(random)};
    EXPECT_TRUE(near(deformed(X_AB.rotation(), body), in_frame(X_AB, body), 1e-14));
  }
}

TEST(MassProperties, DeformedByScaleAreThoseOfTheScaledBoxOfTheSameMass) {
  // A box of 1 x 2 x 3 scaled by (3, 2, 5) is one of 3 x 4 x 15; the mass is kept, so density falls by 30.
  const MassProperties box = mass_of({BoxShape{{1, 2, 3}}, {.p = {1, 1, 1}}}, 30);
  const MassProperties expected = mass_of({BoxShape{{3, 4, 15}}, {.p = {3, 2, 5}}}, 1);
  EXPECT_TRUE(near(deformed(Vector3(3, 2, 5).asDiagonal(), box), expected, 1e-14));
}

TEST(MassProperties, DeformedByMirrorAreThoseOfTheMirroredMesh) {
  // The mesh with its x negated (and triangles turned round) is the mirrored solid.
  const TriangleMesh mesh = test::corner_tetrahedron({1, 2, 3});
  const MassProperties expected = mass_of({test::mesh_shape(mesh, {-1, 1, 1}), {}}, 4);
  const MassProperties body = mass_of({test::mesh_shape(mesh), {}}, 4);
  EXPECT_TRUE(near(deformed(Vector3(-1, 1, 1).asDiagonal(), body), expected, 1e-15));
}

TEST(MassProperties, DeformedByShearAreThoseOfTheShearedMesh) {
  // Any linear map of all vertices; its determinant is 1, so the mass at one density is kept.
  Matrix3 M = Matrix3::Identity();
  M(0, 1) = 0.7;
  M(2, 0) = -0.4;
  TriangleMesh mesh = test::corner_tetrahedron({1, 2, 3});
  const MassProperties body = mass_of({test::mesh_shape(mesh), {}}, 4);
  for (Vector3& vertex : mesh.vertices) vertex = M * vertex;
  EXPECT_TRUE(near(deformed(M, body), mass_of({test::mesh_shape(mesh), {}}, 4), 1e-14));
}

// One test a message of problem_with.

void expect_problem(const MassProperties& mass, ProblemCode code, const std::string& text) {
  test::expect_problem(problem_with(mass), code, text);
}

TEST(MassPropertiesProblem, NothingWithBodies) {
  // Solids, point masses, thin plates (A + B = C), massless frames and very small bodies all exist.
  std::mt19937_64 random{10};
  for (int round = 0; round < 100; ++round) EXPECT_FALSE(problem_with(test::random_mass(random)));
  EXPECT_FALSE(problem_with(diagonal(1, 0, 0, 0)));
  EXPECT_FALSE(problem_with(diagonal(1, 1, 2, 3)));
  EXPECT_FALSE(problem_with(diagonal(1, 1e-30, 1e-30, 2e-30)));
  EXPECT_FALSE(problem_with(diagonal(0, 0, 0, 0)));
}

TEST(MassPropertiesProblem, ToleratesRoundingOfTheTriangleInequality) {
  // The bound is 1e-9 relative: 5e-10 over is rounding, 2e-9 over is no body.
  EXPECT_FALSE(problem_with(diagonal(1, 1, 1, 2 * (1 + 5e-10))));
  EXPECT_TRUE(problem_with(diagonal(1, 1, 1, 2 * (1 + 2e-9))));
}

TEST(MassPropertiesProblem, WaivesOnlyTheTriangleRule) {
  // Solvable lets 1 + 1 < 3 pass, which equations of motion can do with; a negative moment still makes them
  // explode.
  EXPECT_FALSE(problem_with(diagonal(1, 3, 1, 1), InertiaCheck::Solvable));
  EXPECT_TRUE(problem_with(diagonal(1, 3, 1, -1), InertiaCheck::Solvable));
  EXPECT_TRUE(problem_with(diagonal(0, 3, 1, 1), InertiaCheck::Solvable));
}

TEST(MassPropertiesProblem, SaysWhereMassIsNotFinite) {
  // NaN is no mass.
  expect_problem(diagonal(kNaN, 1, 1, 1), ProblemCode::NotFinite, "mass is nan kg");
}

TEST(MassPropertiesProblem, SaysWhereCentreOfGravityIsNotFinite) {
  // Infinity is no place.
  MassProperties mass = diagonal(1, 1, 1, 1);
  mass.p_BBcm.y() = std::numeric_limits<double>::infinity();
  expect_problem(mass, ProblemCode::NotFinite, "centre of gravity is (0, inf, 0) m");
}

TEST(MassPropertiesProblem, SaysWhereInertiaIsNotFinite) {
  // One NaN among nine numbers is found.
  MassProperties mass = diagonal(1, 1, 1, 1);
  mass.I_BBcm_B(2, 1) = kNaN;
  expect_problem(mass, ProblemCode::NotFinite, "inertia is [(1, 0, 0), (0, 1, 0), (0, nan, 1)]");
}

TEST(MassPropertiesProblem, SaysWhereMassIsNegative) {
  // Mass is zero or more.
  expect_problem(diagonal(-2, 1, 1, 1), ProblemCode::Unphysical, "mass is -2 kg");
}

TEST(MassPropertiesProblem, SaysWhereInertiaHasNoMass) {
  // What has no mass cannot resist turning.
  expect_problem(diagonal(0, 1, 1, 1), ProblemCode::Unphysical, "but mass is zero");
}

TEST(MassPropertiesProblem, SaysWhereInertiaIsNotSymmetric) {
  // Ixy and Iyx are one number.
  MassProperties mass = diagonal(1, 1, 1, 1);
  mass.I_BBcm_B(0, 1) = 0.1;
  expect_problem(mass, ProblemCode::Unphysical, "is not symmetric");
}

TEST(MassPropertiesProblem, SaysWhereAPrincipalMomentIsNegative) {
  // Ixy = 2 between unit moments has the eigenvalue -1, with a positive diagonal.
  MassProperties mass = diagonal(1, 1, 1, 1);
  mass.I_BBcm_B(0, 1) = mass.I_BBcm_B(1, 0) = 2;
  expect_problem(mass, ProblemCode::Unphysical, "none may be negative");
}

TEST(MassPropertiesProblem, SaysWhereOneMomentExceedsTheSumOfTheOthers) {
  // 1 + 1 < 3, seen in turned axes too.
  expect_problem(diagonal(1, 3, 1, 1), ProblemCode::Unphysical, "exceeds the sum of the others");
  const Pose X_AB{Vector3::Zero(), Quaternion{1, 2, 3, 4}.normalized()};
  expect_problem(in_frame(X_AB, diagonal(1, 1, 3, 1)), ProblemCode::Unphysical, "exceeds the sum");
}

}  // namespace
}  // namespace pantin
