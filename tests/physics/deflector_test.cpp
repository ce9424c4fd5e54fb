#include <pantin/physics/deflector.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <pantin/physics/deflectors/box.hpp>
#include <pantin/physics/deflectors/capsule.hpp>
#include <pantin/physics/deflectors/mesh.hpp>
#include <pantin/physics/deflectors/plane.hpp>
#include <pantin/physics/deflectors/sphere.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <support/expect_contract.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::expect_contract;
using test::run;

struct Yard {
  explicit Yard(double g = 9.81, double radius = 0) {
    if (g > 0) physics.forces().add(Gravity{.g_W = {0, 0, -g}});
    system = physics.particles().add(ParticleSystemSettings{.mass = 0.1, .radius = radius});
  }
  void throw_one(const Vector3& p, const Vector3& v) {
    physics.particles().add_particle(system, {.p_WP = p, .v_WP = v});
  }
  Vector3 p(std::size_t i = 0) const { return physics.particles().system(system).p_WP(i); }
  Vector3 v(std::size_t i = 0) const { return physics.particles().system(system).v_WP(i); }
  PhysicsManager physics{};
  ParticleSystemId system{};
};

TEST(Deflector, ReturnsASquaredShareOfTheHeight) {
  // Dropped from H on a plane of restitution e a ball of radius r rises to e^2 H, e^4 H, ...: after the time
  // of the fall, sqrt(2H/g), and e times that up, it stands still at r + e^2 H. The path within a step is the
  // exact parabola, so only rounding is left, however coarse the step.
  const double H = 1.25, e = 0.7, r = 0.05, g = 10;
  const double fall = std::sqrt(2 * H / g);
  for (const double h : {0.001, 0.013, 0.1}) {
    Yard yard{g, r};
    yard.physics.deflectors().add(PlaneDeflector{.surface = {.restitution = e}});
    yard.throw_one({0, 0, H + r}, {0.5, 0, 0});
    const double top = fall * (1 + e), second = top + fall * e * (1 + e);
    while (yard.physics.time() + h < top) ASSERT_TRUE(yard.physics.step(h).ok());
    ASSERT_TRUE(yard.physics.step(top - yard.physics.time()).ok());
    EXPECT_NEAR(yard.p().z(), r + e * e * H, 1e-11) << h;
    EXPECT_NEAR(yard.v().z(), 0, 1e-10) << h;
    EXPECT_NEAR(yard.p().x(), 0.5 * top, 1e-12) << h;
    while (yard.physics.time() + h < second) ASSERT_TRUE(yard.physics.step(h).ok());
    ASSERT_TRUE(yard.physics.step(second - yard.physics.time()).ok());
    EXPECT_NEAR(yard.p().z(), r + std::pow(e, 4) * H, 1e-11) << h;
  }
}

TEST(Deflector, MirrorsTheVelocityAtASphere) {
  // Without gravity and friction v' = v - 2 (v . n) n at the point where the line meets the sphere, which is
  // known in closed form; the speed stays. One step of a hundred radii.
  Yard yard{0};
  const double R = 0.5, b = 0.3;
  yard.physics.deflectors().add(SphereDeflector{.radius = R, .surface = {.restitution = 1}});
  yard.throw_one({-25, b, 0}, {50, 0, 0});
  const StepReport report = yard.physics.step(1);
  EXPECT_EQ(report.particles.deflections, 1u);
  const Vector3 hit{-std::sqrt(R * R - b * b), b, 0}, n = hit / R;
  const Vector3 out = Vector3{50, 0, 0} - 2 * 50 * n.x() * n;
  EXPECT_LT((yard.v() - out).norm(), 1e-9);
  EXPECT_LT((yard.p() - (hit + (1 - (25 + hit.x()) / 50) * out)).norm(), 1e-9);
}

TEST(Deflector, TurnsBackEverythingThatIsShotAtIt) {
  // Each solid is shot at from many directions at a hundred of its radii a step, by points and by balls. A
  // line that comes nearer to the centre than the inscribed ball must be turned back, one that stays out of
  // the bounding ball must not: seeded by a golden spiral.
  const auto count = [](const auto& deflector, double inner, double outer, double radius) {
    Yard yard{0, radius};
    yard.physics.deflectors().add(deflector);
    const int n = 400;
    int must = 0;
    for (int i = 0; i < n; ++i) {
      const double z = 1 - (2 * i + 1.0) / n, phi = 2.399963 * i, s = std::sqrt(1 - z * z);
      const Vector3 from{s * std::cos(phi), s * std::sin(phi), z};
      const Vector3 aside = from.unitOrthogonal();
      const bool hits = i % 2 == 0;
      const double miss = hits ? 0.99 * (inner + radius) : 1.01 * (outer + radius);
      yard.throw_one(50 * from + miss * aside, -100 * from);
      must += hits ? 1 : 0;
    }
    const StepReport report = yard.physics.step(1);
    EXPECT_EQ(report.particles.unresolved, 0u);
    return static_cast<int>(report.particles.deflections) - must;
  };
  for (const double radius : {0.0, 0.1}) {
    EXPECT_EQ(count(SphereDeflector{.radius = 1}, 1, 1, radius), 0);
    EXPECT_EQ(count(BoxDeflector{.size = {2, 2, 2}}, 1, std::sqrt(3), radius), 0);
    EXPECT_EQ(count(BoxDeflector{.size = {2, 2, 0.02}}, 0.01, std::sqrt(2.0001), radius), 0);
    EXPECT_EQ(count(CapsuleDeflector{.radius = 0.5, .length = 1}, 0.5, 1, radius), 0);
  }
}

TEST(Deflector, MeetsFacesEdgesAndCapsWhereTheyAre) {
  // A ball of radius r that falls on a box stops at half the height plus r; on an edge, at the distance r
  // from it; on the cap of a capsule, at both radii from the cap's centre. With restitution 0 the contact is
  // where it stays for the rest of a step without gravity.
  const double r = 0.1;
  const auto landing = [&](const auto& deflector, const Vector3& from) {
    Yard yard{0, r};
    yard.physics.deflectors().add(deflector);
    yard.throw_one(from, {0, 0, -8});
    EXPECT_TRUE(yard.physics.step(1).ok());
    return yard.p();
  };
  const SurfaceSettings dead{.restitution = 0, .friction = 100};
  EXPECT_LT(
      (landing(BoxDeflector{.size = {2, 1, 0.5}, .surface = dead}, {0.3, 0.2, 3}) - Vector3{0.3, 0.2, 0.35})
          .norm(),
      1e-10);
  EXPECT_LT((landing(BoxDeflector{.size = {2, 1, 0.5}, .surface = dead}, {1.06, 0.2, 3}) -
             Vector3{1.06, 0.2, 0.25 + 0.08})
                .norm(),
            1e-10);
  EXPECT_LT((landing(CapsuleDeflector{.radius = 0.3, .length = 1, .surface = dead}, {0.24, 0, 3}) -
             Vector3{0.24, 0, 0.5 + 0.32})
                .norm(),
            1e-10);
}

/// How fast a particle slides after a second on a plane inclined by this angle.
double sliding_speed(double angle, double friction, double start) {
  Yard yard;
  const Quaternion tilt{Eigen::AngleAxisd{angle, Vector3::UnitY()}};
  yard.physics.deflectors().add(
      PlaneDeflector{.on = {.X_BD = {{0, 0, 0}, tilt}}, .surface = {.restitution = 0, .friction = friction}});
  const Vector3 downhill = tilt * Vector3::UnitX();
  yard.throw_one({0, 0, 0}, start * downhill);
  EXPECT_TRUE(run(yard.physics, 0.01, 100));
  const Vector3 n = tilt * Vector3::UnitZ();
  EXPECT_NEAR(yard.p().dot(n), 0, 1e-9);
  return yard.v().dot(downhill);
}

TEST(Deflector, LetsParticlesSlideAboveTheAngleOfFriction) {
  // Coulomb: on a slope of angle a a particle stays where tan a < mu, and else gains g (sin a - mu cos a) a
  // second.
  const double mu = 0.5, g = 9.81;
  const double below = std::atan(mu) - 0.01, above = std::atan(mu) + 0.2;
  EXPECT_NEAR(sliding_speed(below, mu, 0), 0, 1e-9);
  EXPECT_NEAR(sliding_speed(above, mu, 0), g * (std::sin(above) - mu * std::cos(above)), 1e-6);
  EXPECT_NEAR(sliding_speed(0.3, 0, 0), g * std::sin(0.3), 1e-6);
}

TEST(Deflector, BrakesWhatSlidesUntilItStops) {
  // On level ground a particle of speed v stops after v^2 / (2 mu g), in the middle of a step, and stays.
  Yard yard;
  yard.physics.deflectors().add(PlaneDeflector{.surface = {.restitution = 0, .friction = 0.4}});
  yard.throw_one({0, 0, 0}, {2, 0, 0});
  ASSERT_TRUE(run(yard.physics, 0.01, 100));
  EXPECT_NEAR(yard.p().x(), 4 / (2 * 0.4 * 9.81), 1e-6);
  EXPECT_EQ(yard.v().x(), 0);
  const Vector3 rest = yard.p();
  ASSERT_TRUE(run(yard.physics, 0.01, 100));
  EXPECT_NEAR((yard.p() - rest).norm(), 0, 1e-12);
}

TEST(Deflector, TakesSpeedFromAGlancingBlow) {
  // In a bounce the tangential impulse is mu (1 + e) m v_n while the particle slides on: v_t' = v_t - mu (1 +
  // e) v_n.
  Yard yard{0};
  yard.physics.deflectors().add(PlaneDeflector{.surface = {.restitution = 0.5, .friction = 0.2}});
  yard.throw_one({0, 0, 1}, {6, 0, -2});
  ASSERT_TRUE(yard.physics.step(1).ok());
  EXPECT_NEAR(yard.v().x(), 6 - 0.2 * 1.5 * 2, 1e-12);
  EXPECT_NEAR(yard.v().z(), 1, 1e-12);
}

TEST(Deflector, FollowsSeveralContactsInAStep) {
  // Between two walls at distance 1 with restitution 1 a particle of 10 m/s meets a wall ten times a second;
  // after one step it is where the unfolded line says.
  Yard yard{0};
  const Quaternion right = Quaternion::FromTwoVectors(Vector3::UnitZ(), Vector3::UnitX());
  const Quaternion left = Quaternion::FromTwoVectors(Vector3::UnitZ(), -Vector3::UnitX());
  const DeflectorId a = yard.physics.deflectors().add(
      PlaneDeflector{.on = {.X_BD = {{0, 0, 0}, right}}, .surface = {.restitution = 1}});
  const DeflectorId b = yard.physics.deflectors().add(
      PlaneDeflector{.on = {.X_BD = {{1, 0, 0}, left}}, .surface = {.restitution = 1}});
  yard.throw_one({0.25, 0, 0}, {10, 3, 0});
  StepReport report = yard.physics.step(1);
  EXPECT_EQ(report.particles.deflections, 10u);
  EXPECT_EQ(yard.physics.deflectors().hits(a), 5u);
  EXPECT_EQ(yard.physics.deflectors().hits(b), 5u);
  EXPECT_LT((yard.p() - Vector3{0.25, 3, 0}).norm(), 1e-10);
  report = yard.physics.step(3);
  EXPECT_EQ(report.particles.unresolved, 1u);  // thirty contacts are more than are followed
  EXPECT_GE(yard.p().x(), -1e-12);
  EXPECT_LE(yard.p().x(), 1 + 1e-12);
}

TEST(Deflector, KeepsWhatSticks) {
  // A particle that would leave slowly enough stays on a sticky deflector and is carried with it; let go, it
  // keeps the velocity of the place.
  Yard yard{0};
  const double rate = 2;
  const BodyId wheel = yard.physics.add(RigidBodySettings{
      .kind = BodyKind::Animated,
      .driver = std::make_unique<test::FunctionDriver>([=](double t, Side) {
        return RigidMotion{{Vector3::Zero(), Quaternion{Eigen::AngleAxisd{rate * t, Vector3::UnitZ()}}},
                           Vector3::Zero(),
                           {0, 0, rate}};
      })});
  yard.physics.deflectors().add(BoxDeflector{
      .on = {.body = wheel}, .size = {2, 2, 2}, .surface = {.restitution = 0.5, .stickiness = 100}});
  yard.throw_one({3, 0, 0}, {-1.9, 0, 0});
  StepReport report;
  std::uint64_t stuck = 0;
  for (int i = 0; i < 300; ++i) stuck += yard.physics.step(0.01).particles.stuck;
  EXPECT_EQ(stuck, 1u);
  const Vector3 p = yard.p(), v = yard.v();
  EXPECT_NEAR(p.z(), 0, 1e-12);
  EXPECT_NEAR(std::max(std::abs(p.dot(Vector3{std::cos(6), std::sin(6), 0})),
                       std::abs(p.dot(Vector3{-std::sin(6), std::cos(6), 0}))),
              1, 1e-9);  // on a face, in the frame of the wheel
  EXPECT_LT((v - Vector3{0, 0, rate}.cross(p)).norm(), 1e-9);
  const ParticleSystem now = yard.physics.particles().system(yard.system);
  ASSERT_EQ(now.stuck().size(), 1u);
  yard.physics.particles().unstick(now.id(0));
  ASSERT_TRUE(yard.physics.step(0.5).ok());
  EXPECT_LT((yard.p() - (p + 0.5 * v)).norm(), 1e-9);
}

TEST(Deflector, SaysWhatIsWrongWithItsSettings) {
  // One text a rule; a mesh without an index names the component that brings one.
  PhysicsManager physics;
  DeflectorManager& d = physics.deflectors();
  expect_contract([&] { d.add(SphereDeflector{.radius = 0}); }, "sphere deflector: radius is 0 m");
  expect_contract([&] { d.add(BoxDeflector{.size = {1, 0, 1}}); }, "box deflector: size along y is 0 m");
  expect_contract([&] { d.add(CapsuleDeflector{.length = -1}); }, "capsule deflector: length is -1 m");
  expect_contract([&] { d.add(PlaneDeflector{.surface = {.restitution = 1.5}}); },
                  "plane deflector: restitution is 1.5; it must be at most 1");
  expect_contract([&] { d.add(PlaneDeflector{.surface = {.restitution = -1}}); }, "restitution is -1");
  expect_contract([&] { d.add(PlaneDeflector{.surface = {.friction = -1}}); }, "friction is -1");
  expect_contract([&] { d.add(PlaneDeflector{.surface = {.stickiness = -1}}); }, "stickiness is -1 m/s");
  expect_contract(
      [&] {
        d.add(PlaneDeflector{.on = {.X_BD = {{0, 0, 0}, Quaternion{2, 0, 0, 0}}}});
      },
      "plane deflector: orientation");
  expect_contract([&] { d.add(MeshDeflector{}); },
                  "mesh deflector: there is no index of its triangles; link component collision_fcl");
  expect_contract([&] { d.remove(DeflectorId{}); }, "deflector 0 is null or was removed");
  expect_contract([&] { d.add(PlaneDeflector{.on = {.body = BodyId{3, 1}}}); }, "body 3.1 does not exist");
}

}  // namespace
}  // namespace pantin
