#include <pantin/physics/particles/emitter.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <support/expect_contract.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::expect_contract;
using test::run;

ParticleSystemId a_system(PhysicsManager& physics, std::size_t capacity = 10000) {
  return physics.particles().add(ParticleSystemSettings{.capacity = capacity});
}

TEST(Emitter, GivesBirthAtItsRateWhateverTheStep) {
  // Births are at start + k / rate: 0.1, 0.14, ... so 16 until (not at) 0.74 s; each has then moved for its
  // own age, which under gravity is a parabola exactly.
  for (const double h : {0.01, 0.0371, 0.2}) {
    PhysicsManager physics;
    physics.forces().add(Gravity{.g_W = {0, 0, -10}});
    const ParticleSystemId spray = a_system(physics);
    physics.particles().add_emitter(spray, EmitterSettings{.speed = {2, 2}, .rate = 25, .start = 0.1});
    while (physics.time() + h < 0.735) ASSERT_TRUE(physics.step(h).ok());
    ASSERT_TRUE(physics.step(0.735 - physics.time()).ok());
    const ParticleSystem now = physics.particles().system(spray);
    ASSERT_EQ(now.size(), 16u) << h;
    for (std::size_t k = 0; k < now.size(); ++k) {
      const double age = 0.735 - (0.1 + 0.04 * static_cast<double>(k));
      EXPECT_NEAR(now.p_WP(k).z(), 2 * age - 5 * age * age, 1e-12);
      EXPECT_NEAR(now.v_WP(k).z(), 2 - 10 * age, 1e-12);
    }
  }
}

TEST(Emitter, DrawsTheSameParticlesWhateverTheStep) {
  // What the n-th particle is born with is a function of seed and n alone; without forces it flies straight
  // from there.
  const auto places = [](double h, int steps, std::uint64_t seed) {
    PhysicsManager physics;
    const ParticleSystemId spray = a_system(physics);
    physics.particles().add_emitter(spray, EmitterSettings{.region = EmitterRegion::Sphere,
                                                           .size = {1, 0, 0},
                                                           .speed = {1, 3},
                                                           .spread = 1,
                                                           .rate = 100,
                                                           .seed = seed});
    EXPECT_TRUE(run(physics, h, steps));
    Matrix3 out;
    for (int k = 0; k < 3; ++k)
      out.col(k) = physics.particles().system(spray).p_WP(static_cast<std::size_t>(10 * k));
    return out;
  };
  const Matrix3 coarse = places(0.25, 2, 3), fine = places(0.03125, 16, 3), other = places(0.25, 2, 4);
  EXPECT_LT((coarse - fine).norm(), 1e-13);
  EXPECT_GT((coarse - other).norm(), 0.1);
}

TEST(Emitter, FillsConeAndBallEvenly) {
  // Over a cap of half angle a the mean of cos(theta) is (1 + cos a) / 2; within a ball of radius R the mean
  // of r^2 is 3 R^2 / 5; speeds between 1 and 3 have mean 2. 40,000 draws leave a standard error below 0.4 %
  // of each.
  const EmitterSettings settings{
      .region = EmitterRegion::Sphere, .size = {2, 0, 0}, .speed = {1, 3}, .spread = 0.8, .seed = 11};
  double cosine = 0, square = 0, speed = 0;
  Vector3 centre = Vector3::Zero();
  constexpr int kDraws = 40000;
  for (std::uint64_t n = 0; n < kDraws; ++n) {
    const Birth birth = birth_of(settings, n);
    cosine += birth.v_EP.z() / birth.v_EP.norm() / kDraws;
    square += birth.p_EP.squaredNorm() / kDraws;
    speed += birth.v_EP.norm() / kDraws;
    centre += birth.p_EP / kDraws;
    ASSERT_LE(birth.p_EP.norm(), 2);
    ASSERT_GE(birth.v_EP.z() / birth.v_EP.norm(), std::cos(0.8) - 1e-12);
  }
  EXPECT_NEAR(cosine, 0.5 * (1 + std::cos(0.8)), 0.003);
  EXPECT_NEAR(square, 2.4, 0.03);
  EXPECT_NEAR(speed, 2, 0.02);
  EXPECT_LT(centre.norm(), 0.04);
}

TEST(Emitter, StaysWithinDiscAndBox) {
  // A disc lies in z = 0, mean r^2 = R^2 / 2; a box has variance a^2 / 12 along each edge.
  double disc = 0;
  Vector3 box = Vector3::Zero();
  constexpr int kDraws = 40000;
  for (std::uint64_t n = 0; n < kDraws; ++n) {
    const Vector3 d = birth_of({.region = EmitterRegion::Disc, .size = {2, 0, 0}, .seed = 1}, n).p_EP;
    ASSERT_EQ(d.z(), 0);
    disc += d.squaredNorm() / kDraws;
    const Vector3 b = birth_of({.region = EmitterRegion::Box, .size = {1, 2, 3}, .seed = 1}, n).p_EP;
    box += b.cwiseAbs2() / kDraws;
  }
  EXPECT_NEAR(disc, 2, 0.03);
  EXPECT_LT((box - Vector3{1, 4, 9} / 12).norm(), 0.02);
}

TEST(Emitter, TakesTheVelocityOfItsBodyAlong) {
  // On a body that moves at u and turns at w, a particle born at r is born with u + w x r besides its own
  // velocity, at the place where the body is at that instant.
  PhysicsManager physics;
  const Vector3 u{1, 0, 0}, w{0, 0, 2};
  const BodyId wheel = physics.add(RigidBodySettings{
      .kind = BodyKind::Animated,
      .driver = std::make_unique<test::FunctionDriver>([&](double t, Side) {
        return RigidMotion{{t * u, Quaternion{Eigen::AngleAxisd{2 * t, Vector3::UnitZ()}}}, u, w};
      })});
  const ParticleSystemId spray = a_system(physics);
  EmitterSettings settings{.body = wheel, .speed = {0, 0}, .bursts = {{.time = 0.25, .count = 1}}};
  settings.X_BE.p = {0, 1, 0};
  physics.particles().add_emitter(spray, settings);
  ASSERT_TRUE(physics.step(0.5).ok());
  const ParticleSystem now = physics.particles().system(spray);
  ASSERT_EQ(now.size(), 1u);
  const Vector3 r{-std::sin(0.5), std::cos(0.5), 0}, v = u + w.cross(r);
  EXPECT_LT((now.v_WP(0) - v).norm(), 1e-12);
  EXPECT_LT((now.p_WP(0) - (0.25 * u + r + 0.25 * v)).norm(), 1e-12);
  physics.remove(wheel);
  ASSERT_TRUE(physics.step(0.5).ok());
}

TEST(Emitter, StopsWhereThereIsNoRoom) {
  // A full system drops births and says how many; bursts count like the rate.
  PhysicsManager physics;
  const ParticleSystemId spray = a_system(physics, 30);
  physics.particles().add_emitter(spray,
                                  EmitterSettings{.rate = 100, .bursts = {{.time = 0.15, .count = 20}}});
  StepReport report = physics.step(0.1);
  EXPECT_EQ(report.particles.born, 10u);
  report = physics.step(0.1);
  EXPECT_EQ(report.particles.born, 20u);
  EXPECT_EQ(report.particles.dropped, 10u);
  EXPECT_EQ(report.particles.count, 30u);
}

TEST(Emitter, LetsParticlesDieOfAge) {
  // With a lifetime of 0.2 s and a rate of 50 /s there are 10 alive in the steady state.
  PhysicsManager physics;
  const ParticleSystemId spray = a_system(physics);
  const EmitterId id =
      physics.particles().add_emitter(spray, EmitterSettings{.rate = 50, .lifetime = {0.2, 0.2}});
  ASSERT_TRUE(run(physics, 0.0125, 80));
  EXPECT_NEAR(static_cast<double>(physics.particles().system(spray).size()), 10, 1);
  physics.particles().remove(id);
  ASSERT_TRUE(run(physics, 0.0125, 20));
  EXPECT_EQ(physics.particles().system(spray).size(), 0u);
}

TEST(Emitter, SaysWhatIsWrongWithItsSettings) {
  // One text a rule.
  PhysicsManager physics;
  const ParticleSystemId spray = a_system(physics);
  const auto add = [&](EmitterSettings settings) {
    return [&physics, spray, settings] { physics.particles().add_emitter(spray, settings); };
  };
  expect_contract(add({.size = {-1, 0, 0}}), "emitter: size is -1 m");
  expect_contract(add({.speed = {2, 1}}), "emitter: speed goes from 2 to 1");
  expect_contract(add({.speed = {-2, 1}}), "emitter: speed is -2 m/s");
  expect_contract(add({.spread = 4}), "emitter: spread is 4 rad");
  expect_contract(add({.rate = -1}), "emitter: rate is -1 1/s");
  expect_contract(add({.start = 2, .stop = 1}), "emitter: it stops at 1 s, before it starts at 2 s");
  expect_contract(add({.bursts = {{.time = 2}, {.time = 1}}}), "emitter: burst 1 is at 1 s");
  expect_contract(add({.lifetime = {0, 1}}), "emitter: lifetime is 0 s");
  expect_contract([&] { physics.particles().remove(EmitterId{}); }, "emitter 0 is null or was removed");
}

}  // namespace
}  // namespace pantin
