#include <pantin/physics/forces/buoyancy.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <support/hand_made_bodies.hpp>
#include <support/hand_made_particles.hpp>
#include <support/meshes.hpp>
#include <support/problems.hpp>

#include <pantin/physics/physics_manager.hpp>
#include <pantin/physics/submerged_volume.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::expect_problem;
using test::near;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<Shape> solids() {
  const Pose X{{0.3, -0.2, 0.1}, Quaternion{0.5, 0.1, -0.7, 0.5}.normalized()};
  const Shape box{BoxShape{{1, 0.6, 0.4}}, X};
  std::vector<Shape> out{box, Shape{SphereShape{0.7}, X}, Shape{EllipsoidShape{{0.9, 0.5, 0.3}}, X},
                         Shape{test::mesh_shape(test::ball_mesh(0.6, 1), {1, -1.5, 0.5}), X}};
  const std::vector<Shape> parts{out[0], out[1]};
  out.push_back(Shape{CompoundShape{std::make_shared<const std::vector<Shape>>(parts)}, X});
  return out;
}

TEST(SubmergedVolume, OfBothSidesMakesTheWhole) {
  // What lies below a plane and what lies below the same plane turned round are the solid: volume and first
  // moment, at any plane, and the whole is that of volume_of.
  std::mt19937_64 random{51};
  for (const Shape& shape : solids()) {
    const Immersible solid{shape};
    const VolumeMoment whole = solid.whole();
    for (int round = 0; round < 50; ++round) {
      const HalfSpace space{test::random_vector(random).normalized(), test::random_vector(random).x()};
      const VolumeMoment below = solid.below(space), above = solid.below({-space.normal, -space.offset});
      EXPECT_NEAR(below.volume + above.volume, whole.volume, 1e-14);
      EXPECT_TRUE(near(below.moment + above.moment, whole.moment, 1e-14));
      EXPECT_GE(below.volume, -1e-15);
    }
    if (!std::holds_alternative<CompoundShape>(shape.geometry)) {
      EXPECT_NEAR(whole.volume, volume_of(shape.geometry), 1e-14);
    }
  }
}

TEST(SubmergedVolume, IsThatOfTheClosedForms) {
  // Of a tetrahedron with three legs of 1 m along the axes, cut at z = s: 1/6 - (1 - s)^3 / 6. Of a sphere of
  // 2 m sunk by 1 m: pi h^2 (3 R - h) / 3 = 5 pi / 3, its centroid 27/20 m below the centre.
  const Immersible corner{Shape{test::mesh_shape(test::corner_tetrahedron({1, 1, 1}))}};
  for (const double s : {0.1, 0.5, 0.9}) {
    EXPECT_NEAR(corner.below({Vector3::UnitZ(), s}).volume, (1 - std::pow(1 - s, 3)) / 6, 1e-15);
  }
  const VolumeMoment cap = Immersible{Shape{SphereShape{2}}}.below({Vector3::UnitZ(), -1});
  EXPECT_NEAR(cap.volume, 5 * std::numbers::pi / 3, 1e-14);
  EXPECT_NEAR(cap.moment.z() / cap.volume, -1.35, 1e-14);
}

TEST(SubmergedVolume, OfAFineMeshIsThatOfTheSphere) {
  // A ball of triangles misses the sphere by the square of their size: the closed form and the polyhedron are
  // found in different ways.
  const Immersible ball{Shape{test::mesh_shape(test::ball_mesh(1, 5))}}, sphere{Shape{SphereShape{1}}};
  for (const double offset : {-0.7, -0.1, 0.4}) {
    const HalfSpace space{Vector3{1, 2, 2} / 3, offset};
    EXPECT_NEAR(ball.below(space).volume, sphere.below(space).volume, 0.005);
    EXPECT_TRUE(near(ball.below(space).moment, sphere.below(space).moment, 0.005));
  }
}

TEST(Buoyancy, IsMinusTheGradientOfItsPotential) {
  // For places and attitudes of a body with each solid, above, in and below the surface: force and torque, so
  // volume and centroid.
  std::mt19937_64 random{52};
  for (const Shape& shape : solids()) {
    for (int round = 0; round < 8; ++round) {
      test::HandMadeBodies bodies;
      const BodyId body = bodies.add_random(random);
      const Buoyancy water{.body = body,
                           .shape = shape,
                           .p_WS = 0.2 * test::random_vector(random),
                           .up_W = test::random_vector(random).normalized(),
                           .density = 100};
      bodies.bodies[0].p_WBcm *= 0.3;
      test::expect_minus_gradient(*make_law(water), bodies, 1e5);
    }
  }
}

TEST(Buoyancy, OfParticlesIsThatOfSpheres) {
  // The same sphere on a body and on a particle at the same place.
  std::mt19937_64 random{53};
  test::HandMadeParticles particles;
  particles.add_random(random, 6);
  const Shape sphere{SphereShape{1.5}};
  const std::unique_ptr<ForceLaw> law =
      make_law(Buoyancy{.particles = particles.system(), .shape = sphere, .density = 10, .drag = 2});
  const std::vector<Vector3> forces = test::forces_of(*law, particles);
  double energy = 0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    test::HandMadeBodies bodies;
    const BodyId body = bodies.add({}, {.p_WBcm = particles.at().p_WP(i), .v_WBcm = particles.at().v_WP(i)});
    const std::unique_ptr<ForceLaw> of_body =
        make_law(Buoyancy{.body = body, .shape = sphere, .density = 10, .drag = 2});
    EXPECT_TRUE(near(forces[i], test::wrenches_of(*of_body, bodies)[0].force, 1e-14, 1000));
    energy += of_body->potential_energy(bodies.at());
  }
  EXPECT_NEAR(law->particle_energy(particles.at()), energy, 1e-9);
  EXPECT_TRUE(law->depends_on_velocity());
}

TEST(Buoyancy, FloatsABoxByArchimedes) {
  // A raft of 0.8 x 0.8 x 0.4 m and 160 kg displaces 0.16 m^3, a draught of 0.25 m: its middle comes to rest
  // 0.05 m under the surface, damped by the fluid, and so flat that it stays upright.
  PhysicsManager physics;
  const Shape raft{BoxShape{{0.8, 0.8, 0.4}}};
  const BodyId body =
      physics.add(RigidBodySettings{.X_WB = {{0, 0, 0.1}}, .mass = mass_of(raft, 160 / 0.256)});
  physics.forces().add(Gravity{});
  physics.forces().add(Buoyancy{.body = body, .shape = raft, .drag = 5000});
  ASSERT_TRUE(test::run(physics, 1e-2, 2000));
  EXPECT_NEAR(physics.body(body).p_WBcm().z(), -0.05, 1e-9);
}

TEST(Buoyancy, KeepsEnergyWithoutDrag) {
  // A tumbling ellipsoid that bobs: kinetic, gravity's and the fluid's energy together stay, to rk4's error.
  PhysicsManager physics;
  const Shape solid{EllipsoidShape{{0.5, 0.3, 0.2}}, {{0.05, 0, 0.1}}};
  const BodyId body = physics.add(RigidBodySettings{.w_WB = {1, 2, 0.5}, .mass = test::lopsided_mass(60)});
  physics.forces().add(Gravity{});
  physics.forces().add(Buoyancy{.body = body, .shape = solid});
  const double energy = physics.energy().total();
  ASSERT_TRUE(test::run(physics, 1e-3, 2000));
  EXPECT_NEAR(physics.energy().total(), energy, 1e-5);
}

TEST(BuoyancyProblem, SaysWhatIsWrong) {
  // One text a rule.
  const BodyId body{.index = 1, .generation = 1};
  const ParticleSystemId system{.index = 1, .generation = 1};
  EXPECT_FALSE(problem_with(Buoyancy{.body = body}));
  const auto with = [&](const auto& change) {
    Buoyancy settings{.body = body};
    change(settings);
    return problem_with(settings);
  };
  expect_problem(problem_with(Buoyancy{}), ProblemCode::UnknownEntity,
                 "buoyancy: neither a body nor a particle system is named");
  expect_problem(with([&](Buoyancy& s) { s.particles = system; }), ProblemCode::OutOfRange,
                 "both a body and a particle system are named");
  expect_problem(problem_with(Buoyancy{.particles = system, .shape = Shape{BoxShape{}}}),
                 ProblemCode::OutOfRange, "buoyancy: the shape of particles is no sphere around them");
  expect_problem(with([](Buoyancy& s) { s.shape = {SphereShape{-1}}; }), ProblemCode::OutOfRange, "radius");
  for (const ShapeGeometry& geometry :
       std::initializer_list<ShapeGeometry>{CapsuleShape{}, CylinderShape{}, ConeShape{}}) {
    expect_problem(with([&](Buoyancy& s) { s.shape = {geometry}; }), ProblemCode::OutOfRange,
                   std::string{kind_of(geometry)} + ": the part of it below a plane is not computed");
  }
  TriangleMesh open = test::box_mesh({1, 1, 1});
  open.triangles.pop_back();
  expect_problem(with([&](Buoyancy& s) { s.shape = {test::mesh_shape(open)}; }), ProblemCode::NotClosed, "");
  expect_problem(with([](Buoyancy& s) { s.p_WS.x() = kNaN; }), ProblemCode::NotFinite,
                 "buoyancy: surface is (nan");
  expect_problem(with([](Buoyancy& s) {
                   s.up_W = {0, 0, 2};
                 }),
                 ProblemCode::NotUnit, "buoyancy: up is (0, 0, 2)");
  expect_problem(with([](Buoyancy& s) { s.density = -1; }), ProblemCode::OutOfRange,
                 "buoyancy: density is -1 kg/m^3");
  expect_problem(with([](Buoyancy& s) { s.gravity = -1; }), ProblemCode::OutOfRange,
                 "buoyancy: gravity is -1 m/s^2");
  expect_problem(with([](Buoyancy& s) { s.drag = -1; }), ProblemCode::OutOfRange, "buoyancy: drag is -1");
  expect_problem(with([](Buoyancy& s) { s.current.x() = kNaN; }), ProblemCode::NotFinite,
                 "buoyancy: current is (nan");
}

}  // namespace
}  // namespace pantin
