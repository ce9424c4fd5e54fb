// Uniform, radial and magnetic fields, and forces given by functions.
#include <pantin/physics/forces/force_function.hpp>
#include <pantin/physics/forces/magnetic_field.hpp>
#include <pantin/physics/forces/radial_field.hpp>
#include <pantin/physics/forces/uniform_field.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <support/hand_made_bodies.hpp>
#include <support/hand_made_particles.hpp>
#include <support/law_order.hpp>
#include <support/problems.hpp>

namespace pantin {
namespace {

using test::expect_problem;
using test::near;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Some bodies and particles in any state.
struct Crowd {
  Crowd() {
    std::mt19937_64 random{41};
    for (int i = 0; i < 3; ++i) bodies.add_random(random);
    particles.add_random(random, 4);
  }
  test::HandMadeBodies bodies{};
  test::HandMadeParticles particles{};
};

TEST(UniformField, ActsOnMassOrCharge) {
  // F = m E, or c E where a charge is given.
  Crowd crowd;
  const Vector3 E{1, -2, 3};
  const std::unique_ptr<ForceLaw> by_mass = make_law(UniformField{.field_W = E});
  const std::unique_ptr<ForceLaw> by_charge = make_law(UniformField{.field_W = E, .charge = -0.5});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(test::wrenches_of(*by_mass, crowd.bodies)[i].force, (crowd.bodies.masses[i].mass * E).eval());
    EXPECT_EQ(test::wrenches_of(*by_charge, crowd.bodies)[i].force, (-0.5 * E).eval());
  }
  EXPECT_EQ(test::forces_of(*by_mass, crowd.particles)[1], (crowd.particles.at().mass[1] * E).eval());
  EXPECT_EQ(test::forces_of(*by_charge, crowd.particles)[1], (-0.5 * E).eval());
  EXPECT_FALSE(by_mass->depends_on_velocity());
}

TEST(Fields, AreMinusTheGradientsOfTheirPotentials) {
  // Uniform, and radial of several powers: falling as a point charge's, logarithmic, growing as a spring's.
  Crowd crowd;
  test::expect_minus_gradient(*make_law(UniformField{.field_W = {1, 2, 3}}), crowd.bodies, 100);
  test::expect_minus_gradient(*make_law(UniformField{.field_W = {1, 2, 3}}), crowd.particles, 100);
  for (const double exponent : {-2.0, -1.0, 0.0, 1.0, 2.5}) {
    const std::unique_ptr<ForceLaw> law = make_law(RadialField{.centre = {5, 5, 0},
                                                               .strength = 2,
                                                               .exponent = exponent,
                                                               .at_distance = 3,
                                                               .softening = 0.5,
                                                               .charge = 1.5});
    test::expect_minus_gradient(*law, crowd.bodies, 100);
    test::expect_minus_gradient(*law, crowd.particles, 100);
  }
}

TEST(RadialField, HasItsStrengthAtItsDistance) {
  // S outward at d0; at twice the distance 2^n of it; nothing, but no NaN, at the centre.
  test::HandMadeBodies bodies;
  bodies.add({.mass = 2}, {.p_WBcm = {1, 0, 3}});
  bodies.add({.mass = 2}, {.p_WBcm = {1, 0, 6}});
  bodies.add({.mass = 2}, {.p_WBcm = {1, 0, 0}});
  const std::unique_ptr<ForceLaw> law =
      make_law(RadialField{.centre = {1, 0, 0}, .strength = 5, .exponent = -2, .at_distance = 3});
  const std::vector<Wrench> wrenches = test::wrenches_of(*law, bodies);
  EXPECT_TRUE(near(wrenches[0].force, Vector3{0, 0, 10}, 1e-15, 10));
  EXPECT_TRUE(near(wrenches[1].force, Vector3{0, 0, 2.5}, 1e-15, 10));
  EXPECT_EQ(wrenches[2].force, Vector3::Zero());
  EXPECT_TRUE(std::isfinite(law->potential_energy(bodies.at())));
}

TEST(RadialField, LetsIntegratorsKeepTheirOrder) {
  // It is smooth away from its centre.
  test::expect_order_4(RadialField{.centre = {-2, 1, 5}, .strength = -4, .exponent = 1});
}

TEST(MagneticField, TurnsACharge) {
  // F = c v x B: closed form, and never any work.
  Crowd crowd;
  const Vector3 B{0.5, 1, -2};
  const std::unique_ptr<ForceLaw> law = make_law(MagneticField{.field_W = B, .charge = 3});
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 v = crowd.bodies.bodies[i].v_WBcm;
    EXPECT_TRUE(near(test::wrenches_of(*law, crowd.bodies)[i].force, 3 * v.cross(B), 1e-14, 10));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3 v = crowd.particles.at().v_WP(i);
    EXPECT_TRUE(near(test::forces_of(*law, crowd.particles)[i], 3 * v.cross(B), 1e-14, 10));
  }
  EXPECT_EQ(law->potential_energy(crowd.bodies.at()), 0);
  EXPECT_TRUE(law->depends_on_velocity());
  EXPECT_FALSE(make_law(MagneticField{.charge = 3})->depends_on_velocity());
}

TEST(MagneticField, KeepsAChargeOnItsCircle) {
  // The period is 2 pi m / (c B), whatever the speed; rk4 with 400 steps a turn errs by 1e-8.
  PhysicsManager physics;
  const BodyId body = physics.add(RigidBodySettings{.v_WBcm = {3, 0, 0}, .mass = {.mass = 2}});
  physics.forces().add(MagneticField{.field_W = {0, 0, 4}, .charge = 0.5, .body = body});
  ASSERT_TRUE(test::run(physics, 2 * std::numbers::pi / 400, 200));
  // Half a turn clockwise about +z: the circle's radius is m v / (c B) = 3.
  EXPECT_TRUE(near(physics.body(body).p_WBcm(), Vector3{0, -6, 0}, 1e-6));
  ASSERT_TRUE(test::run(physics, 2 * std::numbers::pi / 400, 200));
  EXPECT_TRUE(near(physics.body(body).p_WBcm(), Vector3::Zero(), 1e-6));
}

TEST(ForceFunction, DoesWhatTheLawDoesThatItWrites) {
  // A spring to the origin with drag, written as functions, against the same by closed form; energy likewise.
  Crowd crowd;
  const ForceFunction settings{
      .on_body =
          [](const BodiesAt& at, std::size_t i) {
            return Wrench{-2 * at.kinematics[i].p_WBcm - at.kinematics[i].v_WBcm, {at.t, 0, 0}};
          },
      .on_particle = [](const ParticleAt& p) { return Vector3{-2 * p.p_WP - p.mass * p.v_WP}; },
      .body_energy = [](const BodiesAt& at, std::size_t i) { return at.kinematics[i].p_WBcm.squaredNorm(); },
      .particle_energy = [](const ParticleAt& p) { return p.p_WP.squaredNorm(); }};
  crowd.bodies.kinds[1] = BodyKind::Static;
  const std::unique_ptr<ForceLaw> law = make_law(settings);
  std::vector<Wrench> wrenches(3);
  law->add_wrenches(crowd.bodies.at(7), wrenches);
  const BodyKinematics &k0 = crowd.bodies.bodies[0], &k2 = crowd.bodies.bodies[2];
  EXPECT_EQ(wrenches[0].force, (-2 * k0.p_WBcm - k0.v_WBcm).eval());
  EXPECT_EQ(wrenches[0].torque, Vector3(7, 0, 0));
  EXPECT_EQ(wrenches[1].force, Vector3::Zero());  // asked for what it moves only
  EXPECT_DOUBLE_EQ(law->potential_energy(crowd.bodies.at()),
                   k0.p_WBcm.squaredNorm() + k2.p_WBcm.squaredNorm());
  const ParticlesAt at = crowd.particles.at();
  double energy = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(test::forces_of(*law, crowd.particles)[i], (-2 * at.p_WP(i) - at.mass[i] * at.v_WP(i)).eval());
    energy += at.p_WP(i).squaredNorm();
  }
  EXPECT_DOUBLE_EQ(law->particle_energy(at), energy);
  EXPECT_TRUE(law->depends_on_velocity());
}

TEST(ForceFunction, IsCalledAtEveryStage) {
  // Else rk4 would lose its order.
  test::expect_order_4(
      ForceFunction{.on_body =
                        [](const BodiesAt& at, std::size_t i) {
                          return Wrench{-3 * at.kinematics[i].p_WBcm * std::cos(at.t), Vector3::Zero()};
                        },
                    .on_particle = [](const ParticleAt& p) { return Vector3{-p.p_WP * std::cos(p.t)}; }});
}

TEST(FieldProblems, SayWhatIsWrong) {
  // One text a rule.
  const BodyId body{.index = 1, .generation = 1};
  const ParticleSystemId system{.index = 1, .generation = 1};
  const char* both = "both a body and a particle system are named";
  EXPECT_FALSE(problem_with(UniformField{}));
  EXPECT_FALSE(problem_with(RadialField{}));
  EXPECT_FALSE(problem_with(MagneticField{}));
  expect_problem(problem_with(UniformField{.body = body, .particles = system}), ProblemCode::OutOfRange,
                 both);
  expect_problem(problem_with(RadialField{.body = body, .particles = system}), ProblemCode::OutOfRange, both);
  expect_problem(problem_with(MagneticField{.body = body, .particles = system}), ProblemCode::OutOfRange,
                 both);
  expect_problem(problem_with(UniformField{.field_W = {kNaN, 0, 0}}), ProblemCode::NotFinite,
                 "uniform field: field is (nan");
  expect_problem(problem_with(UniformField{.charge = kNaN}), ProblemCode::NotFinite,
                 "uniform field: charge is nan");
  expect_problem(problem_with(RadialField{.centre = {kNaN, 0, 0}}), ProblemCode::NotFinite,
                 "radial field: centre is (nan");
  expect_problem(problem_with(RadialField{.strength = kNaN}), ProblemCode::NotFinite,
                 "radial field: strength is nan");
  expect_problem(problem_with(RadialField{.exponent = kNaN}), ProblemCode::NotFinite,
                 "radial field: exponent is nan");
  expect_problem(problem_with(RadialField{.at_distance = 0}), ProblemCode::OutOfRange,
                 "radial field: distance is 0 m");
  expect_problem(problem_with(RadialField{.softening = -1}), ProblemCode::OutOfRange,
                 "radial field: softening is -1 m");
  expect_problem(problem_with(RadialField{.charge = kNaN}), ProblemCode::NotFinite,
                 "radial field: charge is nan");
  expect_problem(problem_with(MagneticField{.field_W = {kNaN, 0, 0}}), ProblemCode::NotFinite,
                 "magnetic field: field is (nan");
  expect_problem(problem_with(MagneticField{.charge = kNaN}), ProblemCode::NotFinite,
                 "magnetic field: charge is nan");
  expect_problem(problem_with(ForceFunction{}), ProblemCode::OutOfRange,
                 "force function: there is no function for what it acts on");
  const auto on_body = [](const BodiesAt&, std::size_t) { return Wrench{}; };
  EXPECT_FALSE(problem_with(ForceFunction{.on_body = on_body}));
  EXPECT_TRUE(problem_with(ForceFunction{.on_body = on_body, .particles = system}));
  expect_problem(problem_with(ForceFunction{.on_body = on_body, .body = body, .particles = system}),
                 ProblemCode::OutOfRange, both);
}

}  // namespace
}  // namespace pantin
