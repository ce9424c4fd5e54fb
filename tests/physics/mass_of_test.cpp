// mass_of and volume_of; what else mass_properties.hpp holds is tested in mass_properties_test.cpp.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <support/contracts.hpp>
#include <support/meshes.hpp>
#include <support/near.hpp>

#include <pantin/physics/convex_hull.hpp>
#include <pantin/physics/mass_properties.hpp>

namespace pantin {
namespace {

using test::near;

constexpr double kPi = std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const Pose kTilted{{0.2, -0.1, 0.3}, Quaternion{0.8, 0.2, -0.4, 0.4}.normalized()};

MassProperties diagonal(double mass, double x, double y, double z) {
  return {mass, Vector3::Zero(), Vector3(x, y, z).asDiagonal()};
}

TEST(MassOf, SphereIsTheTextbookForm) {
  // 2/5 m r^2 about any diameter; the tolerance is a few roundings.
  const double mass = 3.0 * 4.0 / 3.0 * kPi * 8;
  EXPECT_TRUE(
      near(mass_of({SphereShape{2}, {}}, 3), diagonal(mass, 1.6 * mass, 1.6 * mass, 1.6 * mass), 1e-15));
  EXPECT_DOUBLE_EQ(volume_of(SphereShape{2}), 4.0 / 3.0 * kPi * 8);
}

TEST(MassOf, BoxIsTheTextbookForm) {
  // m/12 (y^2 + z^2) about x, and so on; 2 x 3 x 4 m at 0.5 kg/m^3 has 12 kg.
  EXPECT_TRUE(near(mass_of({BoxShape{{2, 3, 4}}, {}}, 0.5), diagonal(12, 25, 20, 13), 1e-15));
  EXPECT_DOUBLE_EQ(volume_of(BoxShape{{2, 3, 4}}), 24);
}

TEST(MassOf, CylinderIsTheTextbookForm) {
  // m r^2 / 2 about the axis, m (3 r^2 + h^2) / 12 across.
  const double mass = kPi * 4 * 5;
  const double across = mass * (3 * 4 + 25) / 12;
  EXPECT_TRUE(near(mass_of({CylinderShape{2, 5}, {}}, 1), diagonal(mass, across, across, 2 * mass), 1e-15));
}

TEST(MassOf, CapsuleWithoutLengthIsThatOfTheSphere) {
  // Caps alone make a sphere.
  EXPECT_TRUE(near(mass_of({CapsuleShape{0.7, 0}, {}}, 9), mass_of({SphereShape{0.7}, {}}, 9), 1e-15));
}

TEST(MassOf, CapsuleIsItsThreeParts) {
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

TEST(MassOf, ConeIsTheTextbookForm) {
  // 3/10 m r^2 about the axis; 3/20 m r^2 + 3/5 m h^2 across through the tip, the centre of gravity 3/4 h
  // away from it.
  const double r = 0.6, h = 2, mass = 5 * kPi / 3 * r * r * h;
  const MassProperties cone = mass_of({ConeShape{r, h}, {}}, 5);
  const double through_tip = mass * (3.0 / 20 * r * r + 3.0 / 5 * h * h);
  MassProperties expected = diagonal(mass, 0, 0, 0.3 * mass * r * r);
  expected.p_BBcm = {0, 0, h / 2 - 3 * h / 4};
  expected.I_BBcm_B(0, 0) = expected.I_BBcm_B(1, 1) = through_tip - mass * 9.0 / 16 * h * h;
  EXPECT_TRUE(near(cone, expected, 1e-14));
}

TEST(MassOf, EllipsoidIsADeformedSphere) {
  // Stretching a ball takes its second moments along; the mass grows by the product of the factors.
  const Vector3 radii{0.5, 2, 1.25};
  MassProperties ball = mass_of({SphereShape{1}, {}}, 3);
  ball.mass *= radii.prod();
  ball.I_BBcm_B *= radii.prod();
  EXPECT_TRUE(near(mass_of({EllipsoidShape{radii}, {}}, 3), deformed(radii.asDiagonal(), ball), 1e-15));
  EXPECT_TRUE(near(mass_of({EllipsoidShape{{2, 2, 2}}, {}}, 3), mass_of({SphereShape{2}, {}}, 3), 1e-15));
}

TEST(MassOf, ConvexIsTheSolidBetweenItsTriangles) {
  // The hull of a box' corners is the box, scaled and mirrored alike.
  const TriangleMesh box = test::box_mesh({1, 2, 3}, {0.5, 0.25, 1});
  const auto hull = std::make_shared<const TriangleMesh>(convex_hull(box.vertices));
  const Vector3 scale{-2, 1, 0.5};
  EXPECT_TRUE(near(mass_of({ConvexShape{hull, scale}, kTilted}, 4),
                   mass_of({test::mesh_shape(box, scale), kTilted}, 4), 1e-14));
}

TEST(MassOf, CompoundIsTheSumOfItsParts) {
  // Additivity, wherever the parts stand: a box cut in two is the box.
  const Pose left{{-0.5, 0, 0}, Quaternion::Identity()}, right{{0.5, 0, 0}, Quaternion::Identity()};
  const CompoundShape halves{std::make_shared<const std::vector<Shape>>(
      std::vector<Shape>{{BoxShape{{1, 2, 3}}, left}, {BoxShape{{1, 2, 3}}, right}})};
  EXPECT_TRUE(near(mass_of({halves, kTilted}, 7), mass_of({BoxShape{{2, 2, 3}}, kTilted}, 7), 1e-14));
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

TEST(MassOf, SolidsAgreeWithSampledPoints) {
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
  expect_like_samples({ConeShape{0.6, 1.4}, kTilted}, 1.5, [](const Vector3& p) {
    const Vector3 s = inverse(kTilted) * p;
    return std::abs(s.z()) < 0.7 && s.head<2>().norm() < 0.6 * (0.7 - s.z()) / 1.4;
  });
  expect_like_samples({EllipsoidShape{{0.3, 0.6, 0.9}}, kTilted}, 1.5, [](const Vector3& p) {
    return (inverse(kTilted) * p).cwiseQuotient(Vector3{0.3, 0.6, 0.9}).norm() < 1;
  });
}

TEST(MassOf, CornerTetrahedronIsTheHandCalculation) {
  // Over the simplex: integral of x^2 is V a^2/10, of x y V a b/20, centroid (a, b, c)/4; hence about the
  // centroid V a^2 3/80 and -V a b/80.
  const Vector3 legs{1, 2, 3};
  Matrix3 S = -legs * legs.transpose() / 80;
  S.diagonal() = legs.cwiseAbs2() * 3 / 80;
  const double volume = 1;
  const MassProperties expected{volume, legs / 4, S.trace() * Matrix3::Identity() - S};
  EXPECT_TRUE(near(mass_of({test::mesh_shape(test::corner_tetrahedron(legs)), {}}, 1), expected, 1e-15));
}

TEST(MassOf, MeshBoxFarFromTheOriginKeepsAllDigits) {
  // The closed form of the box; at 1e7 m all vertices are still exact, so only the method could lose digits.
  const Vector3 centre{1e7, -3e7, 2e7};
  MassProperties expected = mass_of({BoxShape{{1, 2, 0.5}}, {}}, 2);
  expected.p_BBcm = centre;
  const MassProperties mesh = mass_of({test::mesh_shape(test::box_mesh({1, 2, 0.5}, centre)), {}}, 2);
  EXPECT_TRUE(near(mesh, expected, 1e-14));
}

TEST(MassOf, TinyMeshKeepsAllDigits) {
  // Lengths of 1e-6 m make moments of 1e-30: nothing may be compared with a fixed number.
  const MassProperties mesh = mass_of({test::mesh_shape(test::box_mesh({1e-6, 2e-6, 3e-6})), {}}, 1000);
  EXPECT_TRUE(near(mesh, mass_of({BoxShape{{1e-6, 2e-6, 3e-6}}, {}}, 1000), 1e-14));
}

TEST(MassOf, MeshBallsConvergeToTheSphere) {
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

TEST(MassOf, AngledMeshIsTheSumOfItsBoxes) {
  // An L of two boxes that share a face, as one closed mesh; additivity of integrals.
  const TriangleMesh mesh = test::joined(test::box_mesh({2, 1, 1}), test::box_mesh({1, 3, 1}, {1.5, 1, 0}));
  const MassProperties parts[] = {mass_of({BoxShape{{2, 1, 1}}, {}}, 1),
                                  mass_of({BoxShape{{1, 3, 1}}, {.p = {1.5, 1, 0}}}, 1)};
  EXPECT_TRUE(near(mass_of({test::mesh_shape(mesh), {}}, 1), combined(parts), 1e-14));
}

TEST(MassOf, ScaledMeshIsThatOfTheScaledBox) {
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

TEST(MassOf, AnOpenMeshBreaksTheContract) {
  // An open surface has no volume to integrate over.
  const test::ThrowOnContract guard;
  TriangleMesh mesh = test::box_mesh({1, 1, 1});
  mesh.triangles.pop_back();
  EXPECT_THROW((void)mass_of({test::mesh_shape(mesh), {}}, 1), test::ContractError);
  EXPECT_THROW((void)volume_of(test::mesh_shape(mesh)), test::ContractError);
}

TEST(MassOf, ABadShapeOrDensityBreaksTheContract) {
  // Neither a negative radius nor a density that is negative or NaN makes a body.
  const test::ThrowOnContract guard;
  EXPECT_THROW((void)mass_of({SphereShape{-1}, {}}, 1), test::ContractError);
  EXPECT_THROW((void)mass_of({SphereShape{1}, {}}, -1), test::ContractError);
  EXPECT_THROW((void)mass_of({SphereShape{1}, {}}, kNaN), test::ContractError);
  EXPECT_EQ(mass_of({SphereShape{1}, {}}, 0).mass, 0);
}

}  // namespace
}  // namespace pantin
