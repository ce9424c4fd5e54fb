#include <pantin/physics/forces/central_attraction.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <support/hand_made_bodies.hpp>
#include <support/hand_made_particles.hpp>
#include <support/law_order.hpp>
#include <support/problems.hpp>

#include <pantin/physics/integrators/dormand_prince.hpp>

namespace pantin {
namespace {

using test::expect_problem;
using test::near;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(CentralAttraction, FallsWithTheSquareOfTheDistance) {
  // At 5 m along (3, 4, 0) / 5 with mu = 50: 2 m/s^2 inward, times the mass; energy -m mu / 5. Softened by 12
  // m the distance is 13 m.
  test::HandMadeBodies bodies;
  bodies.add({.mass = 3}, {.p_WBcm = {4, 4, 0}});
  test::HandMadeParticles particles;
  particles.add({4, 4, 0}, Vector3::Zero(), 3);
  const CentralAttraction pull{.centre = {.p_BQ = {1, 0, 0}}, .mu = 50};
  EXPECT_TRUE(near(test::wrenches_of(*make_law(pull), bodies)[0].force, Vector3{-3.6, -4.8, 0}, 1e-15, 6));
  EXPECT_TRUE(near(test::forces_of(*make_law(pull), particles)[0], Vector3{-3.6, -4.8, 0}, 1e-15, 6));
  EXPECT_DOUBLE_EQ(make_law(pull)->potential_energy(bodies.at()), -30);
  EXPECT_DOUBLE_EQ(make_law(pull)->particle_energy(particles.at()), -30);
  const CentralAttraction soft{.centre = {.p_BQ = {1, 0, 0}}, .mu = 50, .softening = 12};
  const Vector3 expected = -150 / std::pow(13, 3) * Vector3{3, 4, 0};
  EXPECT_TRUE(near(test::wrenches_of(*make_law(soft), bodies)[0].force, expected, 1e-15, 1));
  EXPECT_DOUBLE_EQ(make_law(soft)->potential_energy(bodies.at()), -150 / 13.0);
}

TEST(CentralAttraction, IsMinusTheGradientOfItsPotential) {
  // Towards a point of the world, and towards a point of a body, whose own place and turn count too.
  std::mt19937_64 random{31};
  for (int round = 0; round < 20; ++round) {
    test::HandMadeBodies bodies;
    const BodyId centre = bodies.add_random(random);
    bodies.add_random(random);
    bodies.add_random(random);
    const Vector3 point = test::random_vector(random);
    test::expect_minus_gradient(
        *make_law(CentralAttraction{.centre = {.p_BQ = point}, .mu = 2, .softening = 0.5}), bodies, 100);
    test::expect_minus_gradient(
        *make_law(CentralAttraction{.centre = {centre, point}, .mu = 2, .softening = 0.5}), bodies, 100);
    test::HandMadeParticles particles;
    particles.add_random(random, 5);
    test::expect_minus_gradient(
        *make_law(CentralAttraction{.centre = {.p_BQ = point}, .mu = 2, .softening = 0.5}), particles, 100);
  }
}

TEST(CentralAttraction, ExertsNothingAtItsCentre) {
  // There is no direction there, and what is not finite must not get into the state.
  test::HandMadeBodies bodies;
  bodies.add({}, {.p_WBcm = {1, 2, 3}});
  for (const double softening : {0.0, 0.1}) {
    const std::unique_ptr<ForceLaw> law =
        make_law(CentralAttraction{.centre = {.p_BQ = {1, 2, 3}}, .mu = 2, .softening = softening});
    EXPECT_EQ(test::wrenches_of(*law, bodies)[0].force, Vector3::Zero());
    EXPECT_TRUE(std::isfinite(law->potential_energy(bodies.at())));
  }
}

TEST(CentralAttraction, KeepsAParticleOnItsOrbit) {
  // An ellipse of half axis 1, mu = 1 and eccentricity 0.5 closes after 2 pi (Kepler). Dormand-Prince at
  // 1e-12 a second: a few 1e-11 after the turn, in one call of step.
  PhysicsManager physics;
  physics.set_integrator(make_dormand_prince({.tolerance = 1e-12}));
  const ParticleSystemId system = physics.particles().add(ParticleSystemSettings{});
  physics.particles().add_particle(system, {.p_WP = {0.5, 0, 0}, .v_WP = {0, std::sqrt(3.0), 0}});
  physics.forces().add(CentralAttraction{.mu = 1, .particles = system});
  ASSERT_TRUE(physics.step(2 * std::numbers::pi).ok());
  EXPECT_LT((physics.particles().system(system).p_WP(0) - Vector3{0.5, 0, 0}).norm(), 1e-9);
}

TEST(CentralAttraction, OfABodyIsPulledBack) {
  // A light planet, a particle and a heavy star: what they gain the star loses, so the momentum of all is
  // kept to rounding and the energy to the integrator's error.
  PhysicsManager physics;
  const BodyId star = physics.add(RigidBodySettings{.mass = test::lopsided_mass(10)});
  const BodyId planet = physics.add(
      RigidBodySettings{.X_WB = {{2, 0, 0}}, .v_WBcm = {0, 1, 0}, .mass = test::lopsided_mass(1)});
  const ParticleSystemId system = physics.particles().add(ParticleSystemSettings{.mass = 0.5});
  physics.particles().add_particle(system, {.p_WP = {0, -3, 0}, .v_WP = {1, 0, 0.2}});
  physics.forces().add(CentralAttraction{.centre = {star, {0.1, 0.2, 0}}, .mu = 4});
  const auto momenta = [&] {
    test::Momenta sum = test::momenta_of(physics);
    const ParticleSystem now = physics.particles().system(system);
    sum.linear += 0.5 * now.v_WP(0);
    sum.angular += now.p_WP(0).cross(Vector3{0.5 * now.v_WP(0)});
    return sum;
  };
  const auto energy = [&] { return physics.energy().total() + physics.particles().energy().total(); };
  const test::Momenta before = momenta();
  const double energy_before = energy();
  ASSERT_TRUE(test::run(physics, 2e-3, 1000));
  EXPECT_LT((momenta().linear - before.linear).norm(), 1e-12);
  EXPECT_LT((momenta().angular - before.angular).norm(), 1e-9);
  EXPECT_NEAR(energy(), energy_before, 1e-9);
  EXPECT_GT(physics.body(star).v_WBcm().norm(), 1e-3);
  physics.remove(star);
  EXPECT_EQ(physics.forces().size(), 0u);
  static_cast<void>(planet);
}

TEST(CentralAttraction, LetsIntegratorsKeepTheirOrder) {
  // It is smooth away from the centre.
  test::expect_order_4(CentralAttraction{.centre = {.p_BQ = {-2, 1, 5}}, .mu = 40});
}

TEST(CentralAttractionProblem, SaysWhatIsWrong) {
  // One text a rule.
  EXPECT_FALSE(problem_with(CentralAttraction{}));
  expect_problem(problem_with(CentralAttraction{.body = {1, 1}, .particles = {1, 1}}),
                 ProblemCode::OutOfRange, "central attraction: both a body and a particle system are named");
  expect_problem(problem_with(CentralAttraction{.centre = {.body = {1, 1}}, .body = {1, 1}}),
                 ProblemCode::OutOfRange, "central attraction: the centre's own body is attracted");
  expect_problem(problem_with(CentralAttraction{.centre = {.p_BQ = {kNaN, 0, 0}}}), ProblemCode::NotFinite,
                 "central attraction: centre is (nan");
  expect_problem(problem_with(CentralAttraction{.mu = kNaN}), ProblemCode::NotFinite,
                 "central attraction: mu is nan");
  expect_problem(problem_with(CentralAttraction{.softening = -1}), ProblemCode::OutOfRange,
                 "central attraction: softening is -1 m");
}

}  // namespace
}  // namespace pantin
