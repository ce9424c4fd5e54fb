#include <pantin/physics/deflectors/mesh.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <pantin/physics/collision/fcl_triangle_index.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <support/allocation_guard.hpp>
#include <support/expect_contract.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::expect_contract;
using test::run;

/// A sphere of this radius as rings of triangles.
MeshShape ball(double radius, int rings) {
  auto mesh = std::make_shared<TriangleMesh>();
  const int sectors = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      const double a = std::numbers::pi * i / rings, b = 2 * std::numbers::pi * j / sectors;
      mesh->vertices.push_back(radius *
                               Vector3{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * sectors + j % sectors); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      mesh->triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh->triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return {.mesh = mesh};
}

/// A level square of two triangles.
MeshShape square(double size) {
  auto mesh = std::make_shared<TriangleMesh>();
  const double a = 0.5 * size;
  mesh->vertices = {{-a, -a, 0}, {a, -a, 0}, {a, a, 0}, {-a, a, 0}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  return {.mesh = mesh};
}

TEST(TriangleIndex, FindsWhatALookAtAllTrianglesFinds) {
  // Bounds of a triangle touch a box or they do not: the index must list exactly those triangles, in any case
  // once.
  const std::shared_ptr<const TriangleIndex> index = make_fcl_triangle_index(ball(1, 20));
  const TriangleMesh& mesh = index->mesh();
  std::mt19937 random{3};
  std::uniform_real_distribution<double> place{-1.2, 1.2}, size{0, 0.4};
  std::size_t total = 0;
  for (int k = 0; k < 300; ++k) {
    const Vector3 low{place(random), place(random), place(random)};
    const Vector3 high = low + Vector3{size(random), size(random), size(random)};
    std::vector<std::uint32_t> found, expected;
    index->find(low, high, found);
    std::sort(found.begin(), found.end());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& c = mesh.triangles[t];
      const Vector3 &p = mesh.vertices[c[0]], &q = mesh.vertices[c[1]], &r = mesh.vertices[c[2]];
      const Vector3 least = p.cwiseMin(q).cwiseMin(r), most = p.cwiseMax(q).cwiseMax(r);
      if ((least.array() <= high.array()).all() && (most.array() >= low.array()).all()) expected.push_back(t);
    }
    // FCL rounds boxes outwards by nothing: equality holds.
    EXPECT_EQ(found, expected);
    total += expected.size();
  }
  EXPECT_GT(total, 1000u);
}

TEST(TriangleIndex, IsNotDisturbedByNumbersThatAreNotFinite) {
  // Such a box touches nothing; nothing aborts.
  const std::shared_ptr<const TriangleIndex> index = make_fcl_triangle_index(square(1));
  std::vector<std::uint32_t> found;
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  index->find({nan, 0, 0}, {1, 1, 1}, found);
  index->find({-inf, -1, -1}, {inf, 1, 1}, found);
  EXPECT_TRUE(found.empty());
}

TEST(TriangleIndex, AppliesScaleAndRefusesBadMeshes) {
  // Scale goes into the vertices, a mirror turns the winding; a mesh with a problem breaks the contract.
  MeshShape shape = square(1);
  shape.scale = {-2, 1, 1};
  const std::shared_ptr<const TriangleIndex> index = make_fcl_triangle_index(shape);
  EXPECT_EQ(index->mesh().vertices[0], Vector3(1, -0.5, 0));
  const auto& t = index->mesh().triangles[0];
  const auto& v = index->mesh().vertices;
  EXPECT_GT((v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).z(), 0);
  expect_contract([] { static_cast<void>(make_fcl_triangle_index(MeshShape{})); },
                  "mesh: there are no triangles");
}

TEST(MeshDeflector, ReturnsASquaredShareOfTheHeight) {
  // Like a plane: from H to e^2 H. The path goes in straight pieces that leave out up to a thousandth of what
  // moves, which here is the ball of 5 cm: hence the tolerance of 1e-3 m at coarse steps.
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  physics.deflectors().add(
      MeshDeflector{.triangles = make_fcl_triangle_index(square(10)), .surface = {.restitution = 0.6}});
  const ParticleSystemId system = physics.particles().add(ParticleSystemSettings{.radius = 0.05});
  physics.particles().add_particle(system, {.p_WP = {1, 0.3, 1.30}});
  const double fall = std::sqrt(2 * 1.25 / 10);
  const double top = fall * 1.6;
  ASSERT_TRUE(run(physics, top / 80, 80));
  EXPECT_NEAR(physics.particles().system(system).p_WP(0).z(), 0.05 + 0.36 * 1.25, 1e-3);
}

TEST(MeshDeflector, TurnsBackEverythingThatIsShotAtIt) {
  // A closed mesh is shot at from all sides at a hundred radii a step, by points and balls, through faces,
  // along edges and at corners (the poles are corners of many triangles): nothing comes through, nothing
  // turns in empty air.
  for (const double radius : {0.0, 0.1}) {
    PhysicsManager physics;
    physics.deflectors().add(
        MeshDeflector{.triangles = make_fcl_triangle_index(ball(1, 12)), .surface = {.restitution = 1}});
    const ParticleSystemId system = physics.particles().add(ParticleSystemSettings{.radius = radius});
    const int n = 600;
    for (int i = 0; i < n; ++i) {
      const double z = 1 - 2.0 * i / (n - 1), phi = 2.399963 * i, s = std::sqrt(std::max(0.0, 1 - z * z));
      const Vector3 from{s * std::cos(phi), s * std::sin(phi), z};
      const bool hits = i % 2 == 0;
      const double miss = hits ? (i % 4 == 0 ? 0 : 0.9) : 1.01 * (1 + radius);
      physics.particles().add_particle(
          system, {.p_WP = 50 * from + miss * from.unitOrthogonal(), .v_WP = -100 * from});
    }
    const StepReport report = physics.step(1);
    EXPECT_EQ(report.particles.deflections, 300u);
    const ParticleSystem now = physics.particles().system(system);
    for (std::size_t i = 0; i < now.size(); ++i) EXPECT_GT(now.p_WP(i).norm(), 10) << i;
  }
}

TEST(MeshDeflector, HoldsWhatLiesOnIt) {
  // A particle at rest on a level mesh stays there, and one on a slope below the angle of friction too; a
  // bowl keeps what rolls in it: never below the surface over 600 steps.
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -9.81}});
  physics.deflectors().add(MeshDeflector{.triangles = make_fcl_triangle_index(ball(1, 24)),
                                         .surface = {.restitution = 0, .friction = 0.1}});
  const ParticleSystemId system = physics.particles().add(ParticleSystemSettings{.radius = 0.02});
  for (int i = 0; i < 20; ++i)
    physics.particles().add_particle(system, {.p_WP = {0.04 * i, 0, -0.5}, .v_WP = {0, 1, 0}});
  ASSERT_TRUE(run(physics, 1.0 / 120, 600));
  const ParticleSystem now = physics.particles().system(system);
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_LT(now.p_WP(i).norm(), 1.0) << i;
    EXPECT_LT(now.p_WP(i).z(), -0.9) << i;
  }
}

TEST(MeshDeflector, SweepsWithItsMotionAndAllocatesNothing) {
  // A paddle of two triangles that turns a whole turn a step strikes a resting particle; steady steps use
  // kept lists.
  PhysicsManager physics;
  const double w = 2 * std::numbers::pi;
  const BodyId rotor = physics.add(RigidBodySettings{
      .kind = BodyKind::Animated,
      .driver = std::make_unique<test::FunctionDriver>([=](double t, Side) {
        return RigidMotion{{Vector3::Zero(), Quaternion{Eigen::AngleAxisd{w * t, Vector3::UnitX()}}},
                           Vector3::Zero(),
                           {w, 0, 0}};
      })});
  physics.deflectors().add(
      MeshDeflector{.on = {.body = rotor}, .triangles = make_fcl_triangle_index(square(2))});
  const ParticleSystemId system = physics.particles().add(ParticleSystemSettings{.radius = 0.01});
  physics.particles().add_particle(system, {.p_WP = {0.2, 0, 0.8}});
  physics.particles().add_particle(system, {.p_WP = {0.2, 0, 1.2}});
  ASSERT_TRUE(physics.step(1).ok());
  EXPECT_GT(physics.particles().system(system).v_WP(0).norm(), 1);
  EXPECT_EQ(physics.particles().system(system).v_WP(1).norm(), 0);
  ASSERT_TRUE(run(physics, 0.1, 3));
  const test::AllocationGuard guard;
  ASSERT_TRUE(run(physics, 0.1, 5));
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace pantin
