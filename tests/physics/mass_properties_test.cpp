#include <pantin/physics/mass_properties.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <support/contracts.hpp>
#include <support/meshes.hpp>
#include <support/near.hpp>
#include <support/problems.hpp>

namespace pantin {
namespace {

using test::near;

constexpr double kPi = std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

MassProperties diagonal(double mass, double x, double y, double z) {
  return {mass, Vector3::Zero(), Vector3(x, y, z).asDiagonal()};
}

TEST(MassProperties, OfSphereIsTheTextbookForm) {
  // 2/5 m r^2 about any diameter; the tolerance is a few roundings.
  const double mass = 3.0 * 4.0 / 3.0 * kPi * 8;
  EXPECT_TRUE(
      near(mass_of({SphereShape{2}, {}}, 3), diagonal(mass, 1.6 * mass, 1.6 * mass, 1.6 * mass), 1e-15));
  EXPECT_DOUBLE_EQ(volume_of(SphereShape{2}), 4.0 / 3.0 * kPi * 8);
}

TEST(MassProperties, OfBoxIsTheTextbookForm) {
  // m/12 (y^2 + z^2) about x, and so on; 2 x 3 x 4 m at 0.5 kg/m^3 has 12 kg.
  EXPECT_TRUE(near(mass_of({BoxShape{{2, 3, 4}}, {}}, 0.5), diagonal(12, 25, 20, 13), 1e-15));
  EXPECT_DOUBLE_EQ(volume_of(BoxShape{{2, 3, 4}}), 24);
}

TEST(MassProperties, OfCylinderIsTheTextbookForm) {
  // m r^2 / 2 about the axis, m (3 r^2 + h^2) / 12 across.
  const double mass = kPi * 4 * 5;
  const double across = mass * (3 * 4 + 25) / 12;
  EXPECT_TRUE(near(mass_of({CylinderShape{2, 5}, {}}, 1), diagonal(mass, across, across, 2 * mass), 1e-15));
}

TEST(MassProperties, OfCapsuleWithoutLengthIsThatOfTheSphere) {
  // Caps alone make a sphere.
  EXPECT_TRUE(near(mass_of({CapsuleShape{0.7, 0}, {}}, 9), mass_of({SphereShape{0.7}, {}}, 9), 1e-15));
}

TEST(MassProperties, OfCapsuleIsItsThreeParts) {
  // A half sphere of mass m has 83/320 m r^2 across and 2/5 m r^2 along its axis about its own centre of
  // gravity, which lies 3/8 r from the flat face: the parallel axis theorem (in combined) puts cylinder and
  // caps together.
  const double r = 0.4, length = 1.5, density = 7;
  const double cap = density * 2.0 / 3.0 * kPi * r * r * r;
  MassProperties top = diagonal(cap, 83.0 / 320 * cap * r * r, 83.0 / 320 * cap * r * r, 0.4 * cap * r * r);
  MassProperties bottom = top;
  top.p_BBcm = {0, 0, length / 2 + 3 * r / 8};
  bottom.p_BBcm = -top.p_BBcm;
  const MassProperties parts[] = {top, mass_of({CylinderShape{r, length}, {}}, density), bottom};
  EXPECT_TRUE(near(mass_of({CapsuleShape{r, length}, {}}, density), combined(parts), 1e-15));
}

/// Sample mean with its standard error, per number.
struct MonteCarlo {
  Eigen::Array<double, 10, 1> mean, error;
};

/// Volume, first and second moments (xx yy zz xy xz yz) of the points of a cube of edge 2 a for which
/// `inside` holds.
MonteCarlo sample(double a, const std::function<bool(const Vector3&)>& inside) {
  std::mt19937_64 random{20240611};
  constexpr int kSamples = 400000;
  Eigen::Array<double, 10, 1> sum = Eigen::Array<double, 10, 1>::Zero(), squares = sum;
  for (int i = 0; i < kSamples; ++i) {
    const Vector3 p = test::random_vector(random, a);
    if (!inside(p)) continue;
    Eigen::Array<double, 10, 1> value;
    value << 1, p.x(), p.y(), p.z(), p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), p.x() * p.y(),
        p.x() * p.z(), p.y() * p.z();
    sum += value;
    squares += value.square();
  }
  const double volume = 8 * a * a * a;
  const Eigen::Array<double, 10, 1> mean = sum / kSamples;
  return {volume * mean, volume * ((squares / kSamples - mean.square()) / kSamples).sqrt()};
}

/// Compares moments about the origin within five standard errors.
void expect_like_samples(const Shape& shape, double a, const std::function<bool(const Vector3&)>& inside) {
  const MassProperties solid = mass_of(shape, 1);
  const Matrix3 S = 0.5 * solid.I_BBcm_B.trace() * Matrix3::Identity() - solid.I_BBcm_B +
                    solid.mass * solid.p_BBcm * solid.p_BBcm.transpose();
  const Vector3 m = solid.mass * solid.p_BBcm;
  Eigen::Array<double, 10, 1> expected;
  expected << solid.mass, m.x(), m.y(), m.z(), S(0, 0), S(1, 1), S(2, 2), S(0, 1), S(0, 2), S(1, 2);
  const MonteCarlo samples = sample(a, inside);
  for (int k = 0; k < 10; ++k)
    EXPECT_NEAR(expected[k], samples.mean[k], 5 * samples.error[k]) << "moment " << k;
}

const Pose kTilted{{0.2, -0.1, 0.3}, Quaternion{0.8, 0.2, -0.4, 0.4}.normalized()};

TEST(MassProperties, OfSolidsAgreeWithSampledPoints) {
  // Seeded points in a cube know nothing of the closed forms; five standard errors are passed by chance once
  // in 1e6.
  expect_like_samples({SphereShape{0.8}, kTilted}, 1.5,
                      [](const Vector3& p) { return (p - kTilted.p).norm() < 0.8; });
  expect_like_samples({BoxShape{{0.5, 1, 1.6}}, kTilted}, 1.5, [](const Vector3& p) {
    const Vector3 s = (inverse(kTilted) * p).cwiseAbs();
    return s.x() < 0.25 && s.y() < 0.5 && s.z() < 0.8;
  });
  expect_like_samples({CylinderShape{0.5, 1.4}, kTilted}, 1.5, [](const Vector3& p) {
    const Vector3 s = inverse(kTilted) * p;
    return s.head<2>().norm() < 0.5 && std::abs(s.z()) < 0.7;
  });
  expect_like_samples({CapsuleShape{0.4, 1}, kTilted}, 1.5, [](const Vector3& p) {
    const Vector3 s = inverse(kTilted) * p;
    return (s - Vector3{0, 0, std::clamp(s.z(), -0.5, 0.5)}).norm() < 0.4;
  });
}

TEST(MassProperties, OfCornerTetrahedronIsTheHandCalculation) {
  // Over the simplex: integral of x^2 is V a^2/10, of x y V a b/20, centroid (a, b, c)/4; hence about the
  // centroid V a^2 3/80 and -V a b/80.
  const Vector3 legs{1, 2, 3};
  Matrix3 S = -legs * legs.transpose() / 80;
  S.diagonal() = legs.cwiseAbs2() * 3 / 80;
  const double volume = 1;
  const MassProperties expected{volume, legs / 4, S.trace() * Matrix3::Identity() - S};
  EXPECT_TRUE(near(mass_of({test::mesh_shape(test::corner_tetrahedron(legs)), {}}, 1), expected, 1e-15));
}

TEST(MassProperties, OfMeshBoxFarFromTheOriginKeepsAllDigits) {
  // The closed form of the box; at 1e7 m all vertices are still exact, so only the method could lose digits.
  const Vector3 centre{1e7, -3e7, 2e7};
  MassProperties expected = mass_of({BoxShape{{1, 2, 0.5}}, {}}, 2);
  expected.p_BBcm = centre;
  const MassProperties mesh = mass_of({test::mesh_shape(test::box_mesh({1, 2, 0.5}, centre)), {}}, 2);
  EXPECT_TRUE(near(mesh, expected, 1e-14));
}

TEST(MassProperties, OfTinyMeshKeepsAllDigits) {
  // Lengths of 1e-6 m make moments of 1e-30: nothing may be compared with a fixed number.
  const MassProperties mesh = mass_of({test::mesh_shape(test::box_mesh({1e-6, 2e-6, 3e-6})), {}}, 1000);
  EXPECT_TRUE(near(mesh, mass_of({BoxShape{{1e-6, 2e-6, 3e-6}}, {}}, 1000), 1e-14));
}

TEST(MassProperties, OfMeshBallsConvergeToTheSphere) {
  // A polyhedron with its vertices on the sphere lacks an amount proportional to the square of its edge
  // length.
  const MassProperties sphere = mass_of({SphereShape{0.5}, {}}, 1);
  double before = 0;
  for (int splits = 3; splits <= 5; ++splits) {
    const MassProperties ball = mass_of({test::mesh_shape(test::ball_mesh(0.5, splits)), {}}, 1);
    const double error = sphere.I_BBcm_B(0, 0) - ball.I_BBcm_B(0, 0);
    EXPECT_GT(error, 0);
    if (splits > 3) {
      EXPECT_NEAR(std::log2(before / error), 2, 0.05);
    }
    before = error;
  }
}

TEST(MassProperties, OfAngledMeshIsTheSumOfItsBoxes) {
  // An L of two boxes that share a face, as one closed mesh; additivity of integrals.
  const TriangleMesh mesh = test::joined(test::box_mesh({2, 1, 1}), test::box_mesh({1, 3, 1}, {1.5, 1, 0}));
  const MassProperties parts[] = {mass_of({BoxShape{{2, 1, 1}}, {}}, 1),
                                  mass_of({BoxShape{{1, 3, 1}}, {.p = {1.5, 1, 0}}}, 1)};
  EXPECT_TRUE(near(mass_of({test::mesh_shape(mesh), {}}, 1), combined(parts), 1e-14));
}

TEST(MassProperties, OfScaledMeshIsThatOfTheScaledBox) {
  // A scaled box mesh is the mesh of a scaled box, and a mirrored one has the mirrored centre and a positive
  // mass.
  const TriangleMesh mesh = test::box_mesh({1, 1, 1}, {0.5, 0.25, 1});
  for (const Vector3& scale :
       {Vector3{2, 3, 4}, Vector3{-2, 3, 4}, Vector3{-2, -3, 4}, Vector3{-1, -1, -1}}) {
    const MassProperties expected =
        mass_of({BoxShape{scale.cwiseAbs()}, {.p = scale.cwiseProduct(Vector3{0.5, 0.25, 1})}}, 5);
    EXPECT_TRUE(near(mass_of({test::mesh_shape(mesh, scale), {}}, 5), expected, 1e-14)) << scale.transpose();
  }
}

TEST(MassProperties, OfAnOpenMeshBreakTheContract) {
  // An open surface has no volume to integrate over.
  const test::ThrowOnContract guard;
  TriangleMesh mesh = test::box_mesh({1, 1, 1});
  mesh.triangles.pop_back();
  EXPECT_THROW((void)mass_of({test::mesh_shape(mesh), {}}, 1), test::ContractError);
  EXPECT_THROW((void)volume_of(test::mesh_shape(mesh)), test::ContractError);
}

TEST(MassProperties, OfABadShapeOrDensityBreakTheContract) {
  // Neither a negative radius nor a density that is negative or NaN makes a body.
  const test::ThrowOnContract guard;
  EXPECT_THROW((void)mass_of({SphereShape{-1}, {}}, 1), test::ContractError);
  EXPECT_THROW((void)mass_of({SphereShape{1}, {}}, -1), test::ContractError);
  EXPECT_THROW((void)mass_of({SphereShape{1}, {}}, kNaN), test::ContractError);
  EXPECT_EQ(mass_of({SphereShape{1}, {}}, 0).mass, 0);
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
