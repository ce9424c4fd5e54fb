#include <pantin/physics/forces/damped_spring.hpp>

#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <support/hand_made_bodies.hpp>
#include <support/problems.hpp>

namespace pantin {
namespace {

using test::expect_problem;
using test::near;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(DampedSpring, PullsWithStiffnessTimesStretchPlusDampingTimesItsRate) {
  // From the world's origin to a body 5 m off along (3, 4, 0), moving outward at 2 m/s: 10 (5 - 1) + 3 * 2 =
  // 46 N inward.
  test::HandMadeBodies bodies;
  const BodyId body = bodies.add({}, {.p_WBcm = {3, 4, 0}, .v_WBcm = {1.2, 1.6, 0}});
  const DampedSpring spring{.b = {.body = body}, .stiffness = 10, .damping = 3, .rest_length = 1};
  const Wrench wrench = test::wrenches_of(*make_law(spring), bodies)[0];
  EXPECT_TRUE(near(wrench.force, -46 * Vector3{0.6, 0.8, 0}, 1e-15, 46));
  EXPECT_EQ(wrench.torque, Vector3::Zero());
  // The same with its ends exchanged, and pushing where it is shorter than at rest.
  const DampedSpring turned{.a = {.body = body}, .stiffness = 10, .damping = 3, .rest_length = 1};
  EXPECT_TRUE(near(test::wrenches_of(*make_law(turned), bodies)[0].force, wrench.force, 1e-15, 46));
  const DampedSpring pushing{.b = {.body = body}, .stiffness = 10, .rest_length = 6};
  EXPECT_TRUE(
      near(test::wrenches_of(*make_law(pushing), bodies)[0].force, 10 * Vector3{0.6, 0.8, 0}, 1e-15, 10));
}

TEST(DampedSpring, DampsThePointsNotTheCentresOfGravity) {
  // A body that spins about z at 2 rad/s carries a point 1 m off its centre of gravity along y at 2 m/s along
  // -x; the spring runs along x from the world, so only the damper pulls: 5 * 2 = 10 N along +x at that
  // point, torque -10.
  test::HandMadeBodies bodies;
  const BodyId body =
      bodies.add({.mass = 1, .p_BBcm = {0, -1, 0}}, {.p_WBcm = {3, -1, 0}, .w_WB = {0, 0, 2}});
  const DampedSpring spring{.b = {.body = body}, .damping = 5};
  const Wrench wrench = test::wrenches_of(*make_law(spring), bodies)[0];
  EXPECT_TRUE(near(wrench.force, Vector3{10, 0, 0}, 1e-15, 10));
  EXPECT_TRUE(near(wrench.torque, Vector3{0, 0, -10}, 1e-15, 10));
}

/// Two bodies in any state with a spring between any two points.
struct SprungPair {
  explicit SprungPair(std::mt19937_64& random) {
    const BodyId a = bodies.add_random(random), b = bodies.add_random(random);
    settings = {{a, test::random_vector(random)}, {b, test::random_vector(random)}, 50, 3, 0.8};
  }
  test::HandMadeBodies bodies{};
  DampedSpring settings{};
};

TEST(DampedSpring, ActsEquallyAndOppositely) {
  // Third law: the forces cancel, and so do the torques about any point of the world.
  std::mt19937_64 random{11};
  for (int round = 0; round < 200; ++round) {
    SprungPair pair{random};
    const std::vector<Wrench> w = test::wrenches_of(*make_law(pair.settings), pair.bodies);
    EXPECT_EQ(w[0].force, -w[1].force);
    const Vector3 about = test::random_vector(random, 10);
    const Vector3 torque = w[0].torque + (pair.bodies.bodies[0].p_WBcm - about).cross(w[0].force) +
                           w[1].torque + (pair.bodies.bodies[1].p_WBcm - about).cross(w[1].force);
    EXPECT_TRUE(near(torque, Vector3::Zero(), 1e-14, 20 * w[0].force.norm()));
  }
}

TEST(DampedSpring, IsMinusTheGradientOfItsPotential) {
  // Without damper, for translation and rotation of both bodies.
  std::mt19937_64 random{12};
  for (int round = 0; round < 50; ++round) {
    SprungPair pair{random};
    pair.settings.damping = 0;
    test::expect_minus_gradient(*make_law(pair.settings), pair.bodies, 1000);
  }
}

TEST(DampedSpring, DamperTakesEnergy) {
  // Power of the damper alone over both bodies: -c (dl/dt)^2, never above zero.
  std::mt19937_64 random{13};
  for (int round = 0; round < 50; ++round) {
    SprungPair pair{random};
    pair.settings.stiffness = 0;
    const std::vector<Wrench> w = test::wrenches_of(*make_law(pair.settings), pair.bodies);
    double power = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      power += w[i].force.dot(pair.bodies.bodies[i].v_WBcm) + w[i].torque.dot(pair.bodies.bodies[i].w_WB);
    }
    const PointKinematics a = point_at(pair.bodies.at(), pair.settings.a);
    const PointKinematics b = point_at(pair.bodies.at(), pair.settings.b);
    const double rate = (b.p_WQ - a.p_WQ).normalized().dot(b.v_WQ - a.v_WQ);
    EXPECT_NEAR(power, -3 * rate * rate, 1e-12);
  }
}

TEST(DampedSpring, OfNoLengthExertsNothing) {
  // Where the ends coincide there is no direction; the energy is that of the full compression, k l0^2 / 2.
  test::HandMadeBodies bodies;
  const BodyId a = bodies.add({}, {.p_WBcm = {1, 2, 3}, .v_WBcm = {1, 0, 0}});
  const BodyId b = bodies.add({}, {.p_WBcm = {1, 2, 3}});
  const std::unique_ptr<ForceLaw> law =
      make_law(DampedSpring{.a = {a}, .b = {b}, .stiffness = 8, .damping = 1, .rest_length = 0.5});
  for (const Wrench& wrench : test::wrenches_of(*law, bodies)) {
    EXPECT_EQ(wrench.force, Vector3::Zero());
    EXPECT_EQ(wrench.torque, Vector3::Zero());
  }
  EXPECT_DOUBLE_EQ(law->potential_energy(bodies.at()), 1);
}

TEST(DampedSpring, OfNoRestLengthIsSmoothThroughZero) {
  // F = -k d: linear however short, also where squares of the length underflow.
  test::HandMadeBodies bodies;
  const BodyId body = bodies.add({}, {});
  const std::unique_ptr<ForceLaw> law = make_law(DampedSpring{.b = {body}, .stiffness = 8});
  for (const double d : {1e-3, 1e-100, 1e-200}) {
    bodies.bodies[0].p_WBcm = {d, -d, 0};
    EXPECT_TRUE(near(test::wrenches_of(*law, bodies)[0].force, Vector3{-8 * d, 8 * d, 0}, 1e-15, 8 * d));
  }
}

TEST(DampedSpring, HasEnergyWhereAnEndIsSimulated) {
  // 8 * (2 - 0)^2 / 2 = 16 J once, also between two simulated bodies; between animated bodies it is nobody's.
  test::HandMadeBodies bodies;
  const BodyId a = bodies.add({}, {.p_WBcm = {1, 0, 0}}), b = bodies.add({}, {.p_WBcm = {3, 0, 0}});
  const std::unique_ptr<ForceLaw> law = make_law(DampedSpring{.a = {a}, .b = {b}, .stiffness = 8});
  EXPECT_DOUBLE_EQ(law->potential_energy(bodies.at()), 16);
  bodies.kinds[0] = BodyKind::Animated;
  EXPECT_DOUBLE_EQ(law->potential_energy(bodies.at()), 16);
  bodies.kinds[1] = BodyKind::Static;
  EXPECT_EQ(law->potential_energy(bodies.at()), 0);
}

TEST(DampedSpring, NamesBothEndsAndLooksAtVelocitiesWhereItDamps) {
  // The world's end is the null body, which is no body to remove.
  const BodyId a{.index = 4, .generation = 2}, b{.index = 6, .generation = 1};
  const std::unique_ptr<ForceLaw> law = make_law(DampedSpring{.a = {a}, .b = {b}});
  EXPECT_TRUE(law->names(a));
  EXPECT_TRUE(law->names(b));
  EXPECT_FALSE(law->names({.index = 6, .generation = 2}));
  EXPECT_FALSE(make_law(DampedSpring{.a = {a}})->names({}));
  EXPECT_FALSE(law->depends_on_velocity());
  EXPECT_TRUE(make_law(DampedSpring{.a = {a}, .damping = 1})->depends_on_velocity());
}

const Attachment kEnd{.body = {.index = 1, .generation = 1}};

TEST(DampedSpringProblem, SaysWhereBothEndsAreOnTheWorld) {
  // Such a spring moves nothing; one end on a body is enough.
  EXPECT_FALSE(problem_with(DampedSpring{.a = kEnd}));
  EXPECT_FALSE(problem_with(DampedSpring{.b = kEnd}));
  expect_problem(problem_with(DampedSpring{}), ProblemCode::UnknownEntity, "both ends are on the world");
}

TEST(DampedSpringProblem, SaysWhereAPointIsNotFinite) {
  // Either end.
  const Attachment bad{.body = kEnd.body, .p_BQ = {0, kNaN, 0}};
  expect_problem(problem_with(DampedSpring{.a = bad}), ProblemCode::NotFinite,
                 "damped spring: point a is (0, nan, 0) m");
  expect_problem(problem_with(DampedSpring{.b = bad}), ProblemCode::NotFinite,
                 "damped spring: point b is (0, nan, 0) m");
}

TEST(DampedSpringProblem, SaysWhereTheStiffnessIsNegative) {
  // A spring of negative stiffness would push ever harder.
  expect_problem(problem_with(DampedSpring{.a = kEnd, .stiffness = -1}), ProblemCode::OutOfRange,
                 "damped spring: stiffness is -1 N/m");
}

TEST(DampedSpringProblem, SaysWhereTheDampingIsNegative) {
  // A damper that feeds energy in is none.
  expect_problem(problem_with(DampedSpring{.a = kEnd, .damping = -1}), ProblemCode::OutOfRange,
                 "damped spring: damping is -1 N s/m");
}

TEST(DampedSpringProblem, SaysWhereTheRestLengthIsNegative) {
  // Lengths are zero or more.
  expect_problem(problem_with(DampedSpring{.a = kEnd, .rest_length = -1}), ProblemCode::OutOfRange,
                 "damped spring: rest length is -1 m");
}

TEST(DampedSpringProblem, SaysWhereANumberIsNotFinite) {
  // NaN compares as neither negative nor positive.
  expect_problem(problem_with(DampedSpring{.a = kEnd, .stiffness = kNaN}), ProblemCode::NotFinite,
                 "stiffness is nan");
  expect_problem(problem_with(DampedSpring{.a = kEnd, .damping = kNaN}), ProblemCode::NotFinite,
                 "damping is nan");
  expect_problem(problem_with(DampedSpring{.a = kEnd, .rest_length = kNaN}), ProblemCode::NotFinite,
                 "rest length is nan");
}

}  // namespace
}  // namespace pantin
