// Stiff springs between bodies whose lines turn with the motion, by radau in steps that are given.
#include <pantin/physics/integrators/stage_factors.hpp>

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <support/allocation_guard.hpp>
#include <support/four_bar.hpp>
#include <support/mechanisms.hpp>

#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/universal.hpp>
#include <pantin/physics/forces/constant_load.hpp>
#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/forces/torsion_spring.hpp>
#include <pantin/physics/integrators/radau.hpp>

namespace pantin {
namespace {

using test::facing;
using test::joint_here;
using test::lopsided_mass;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A spring without stretch from a point of a body, or of the world, to one of another, critical for 1 kg.
void tie(PhysicsManager& physics, BodyId a, const Vector3& p_BQa, BodyId b, const Vector3& p_BQb,
         double stiffness) {
  const Vector3 p_W = a ? physics.body(a).X_WB() * p_BQa : p_BQa;
  physics.forces().add(DampedSpring{.a = {a, p_BQa},
                                    .b = {b, p_BQb},
                                    .stiffness = stiffness,
                                    .damping = 2 * std::sqrt(stiffness),
                                    .rest_length = (physics.body(b).X_WB() * p_BQb - p_W).norm()});
}

/// A body on a joint at the world, or on none, under gravity, held by a stiff spring away from all axes; and
/// another, free, on a spring to it.
struct Held {
  PhysicsManager physics{};
  BodyId body{};

  template <class Settings>
  static Held on(double stiffness) {
    Held held;
    held.body = held.physics.add(RigidBodySettings{.X_WB = {{0.2, 0.1, 0}}, .mass = lopsided_mass(1.5)});
    if constexpr (!std::is_same_v<Settings, void>) {
      held.physics.add(
          joint_here<Settings>(held.physics, BodyId{}, held.body, {{0, 0, 0.1}, facing({1, 2, 1})}));
    }
    const BodyId free =
        held.physics.add(RigidBodySettings{.X_WB = {{0.9, -0.2, 0.4}}, .mass = lopsided_mass()});
    held.physics.forces().add(Gravity{.g_W = {1, -2, -9.81}});
    tie(held.physics, BodyId{}, {1, 0.7, 0.5}, held.body, {0.3, 0.1, -0.2}, stiffness);
    tie(held.physics, held.body, {0.1, -0.3, 0.1}, free, {0.1, 0.1, 0.2}, stiffness);
    held.physics.set_integrator(make_radau({.tolerance = kInfinite}));
    return held;
  }
};

struct HeldCase {
  const char* name;
  Held (*make)(double stiffness);
};
std::ostream& operator<<(std::ostream& out, const HeldCase& held) { return out << held.name; }
class StiffLines : public testing::TestWithParam<HeldCase> {};

TEST_P(StiffLines, TurnWithinAStepThatIsNotCut) {
  // In a step of 0.05 s the bodies move by millimetres, in which a spring of 1e10 N/m that kept its
  // direction would develop 1e4 N. The sweeps settle only if each stage knows how the spring lies among all
  // numbers: they do in every step, without cutting one. What they settle to is the motion that steps of a
  // tenth come to as well, whatever the stiffness, order seven apart.
  for (const double stiffness : {1e6, 1e10}) {
    Held coarse = GetParam().make(stiffness), fine = GetParam().make(stiffness);
    for (int i = 0; i < 3; ++i) {
      const StepReport report = coarse.physics.step(0.05);
      ASSERT_TRUE(report.ok()) << report.message;
      EXPECT_EQ(report.inner_steps, 1);
      EXPECT_EQ(report.refused_steps, 0);
    }
    ASSERT_TRUE(test::run(fine.physics, 0.005, 30));
    const Vector3 moved = fine.physics.body(fine.body).p_WBcm() - Vector3{0.3, 0.05, -0.2};
    EXPECT_GT(moved.norm(), 1e-3) << "it moves, or this shows little";
    EXPECT_LT((coarse.physics.body(coarse.body).p_WBcm() - fine.physics.body(fine.body).p_WBcm()).norm(),
              1e-7)
        << stiffness;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, StiffLines,
                         testing::Values(HeldCase{"Free", Held::on<void>},
                                         HeldCase{"Ball", Held::on<BallSettings>},
                                         HeldCase{"Universal", Held::on<UniversalSettings>},
                                         HeldCase{"Cylindrical", Held::on<CylindricalSettings>},
                                         HeldCase{"Planar", Held::on<PlanarSettings>}),
                         [](const auto& test) { return std::string{test.param.name}; });

TEST(StiffLine, TurnsADumbbellAsACircleDoes) {
  // Two masses on a spring of k turn at w: each on a circle whose radius the spring, stretched by m r w^2 /
  // k, gives it. In 40 steps of 0.025 s, a tenth of a radian each, nothing but the error of order seven is
  // left, for springs from 1e4 to 1e10 N/m alike.
  constexpr double kRate = 4, kRadius = 0.5;
  for (const double stiffness : {1e4, 1e7, 1e10}) {
    PhysicsManager physics;
    const double r = kRadius / (1 - kRate * kRate / (2 * stiffness));  // of masses of 1 kg
    BodyId ends[2];
    for (const int i : {0, 1}) {
      const double x = i == 0 ? -r : r;
      RigidBodySettings s{.name = "end", .X_WB = {{x, 0, 0}}, .v_WBcm = {0, x * kRate, 0}};
      s.mass.I_BBcm_B = Vector3{0.1, 0.1, 0.1}.asDiagonal();
      ends[i] = physics.add(std::move(s));
    }
    physics.forces().add(DampedSpring{.a = {ends[0], Vector3::Zero()},
                                      .b = {ends[1], Vector3::Zero()},
                                      .stiffness = stiffness,
                                      .damping = 2 * std::sqrt(stiffness),
                                      .rest_length = 2 * kRadius});
    physics.set_integrator(make_radau({.tolerance = kInfinite}));
    ASSERT_TRUE(test::run(physics, 0.025, 40)) << stiffness;
    const Vector3 then = r * Vector3{std::cos(kRate), std::sin(kRate), 0};
    EXPECT_LT((physics.body(ends[1]).p_WBcm() - then).norm(), 1e-7) << stiffness;
  }
}

TEST(StiffLine, HoldsATolerance) {
  // A bent chain whose tip is tied to the world. The tolerance is kept by an order of magnitude or more,
  // however stiff the tie is; the evaluations do not grow with it.
  const auto swung = [](double stiffness, double tolerance, int& evaluations) {
    PhysicsManager physics;
    physics.forces().add(Gravity{});
    BodyId last{};
    for (int i = 0; i < 4; ++i) {
      const Vector3 at{0.5 * i, 0, 0};
      const BodyId next = physics.add(RigidBodySettings{.X_WB = {at}, .mass = lopsided_mass()});
      physics.add(
          joint_here<PivotSettings>(physics, last, next, {at, facing({0.1 * i, 1, i % 2 == 0 ? 0.0 : 1.0})}));
      last = next;
    }
    tie(physics, BodyId{}, {2, 1, 0.3}, last, {0.5, 0, 0}, stiffness);
    physics.set_integrator(make_radau({.tolerance = tolerance}));
    const StepReport report = physics.step(1);
    EXPECT_TRUE(report.ok()) << report.message;
    evaluations = report.evaluations;
    return physics.body(last).p_WBcm();
  };
  int evaluations = 0, softer = 0;
  for (const double stiffness : {1e6, 1e8, 1e10}) {
    const Vector3 fine = swung(stiffness, 1e-10, evaluations);
    EXPECT_LT((swung(stiffness, 1e-6, evaluations) - fine).norm(), 1e-5) << stiffness;
    if (softer > 0) {
      EXPECT_LT(evaluations, 3 * softer) << stiffness;
    }
    softer = evaluations;
  }
}

/// Two bodies, free or on balls, that a stiff torsion spring keeps from twisting about an axis of the first
/// one, and a torque that swings the second one away from it.
struct Twisted {
  PhysicsManager physics{};
  BodyId b{};

  Twisted(double stiffness, bool on_balls) {
    physics.forces().add(Gravity{.g_W = {1, -2, -9.81}});
    const BodyId a = physics.add(RigidBodySettings{.X_WB = {{0.2, 0.1, 0}}, .mass = lopsided_mass(1.5)});
    b = physics.add(RigidBodySettings{.X_WB = {{0.9, -0.2, 0.4}}, .mass = lopsided_mass()});
    if (on_balls) {
      physics.add(joint_here<BallSettings>(physics, BodyId{}, a, {{0, 0, 0.1}, facing({1, 2, 1})}));
      physics.add(joint_here<BallSettings>(physics, a, b, {{0.6, -0.1, 0.2}, facing({1, 2, 1})}));
    }
    physics.forces().add(ConstantLoad{.body = b, .torque = {0.3, -0.2, 0.4}});
    physics.forces().add(TorsionSpring{.a = a,
                                       .b = b,
                                       .axis_A = Vector3{1, 2, 2} / 3,
                                       .stiffness = stiffness,
                                       .damping = 0.3 * std::sqrt(stiffness)});
    physics.set_integrator(make_radau({.tolerance = kInfinite}));
  }
};

TEST(StiffLine, TurnsWithTheAxisOfATorsionSpring) {
  // The gradient of the twist turns as the second body swings by a radian. Steps of 0.05 s need not be cut
  // for it, whatever the stiffness, and come to the attitude that steps of a tenth come to.
  for (const bool on_balls : {false, true}) {
    for (const double stiffness : {1e4, 1e7, 1e10}) {
      Twisted coarse{stiffness, on_balls}, fine{stiffness, on_balls};
      for (int i = 0; i < 8; ++i) {
        const StepReport report = coarse.physics.step(0.05);
        ASSERT_TRUE(report.ok()) << report.message;
        EXPECT_EQ(report.inner_steps, 1) << stiffness;
      }
      ASSERT_TRUE(test::run(fine.physics, 0.005, 80));
      const Quaternion q = fine.physics.body(fine.b).q_WB();
      EXPECT_GT(q.angularDistance(Quaternion::Identity()), 0.5) << "it swings, or this shows little";
      EXPECT_LT(coarse.physics.body(coarse.b).q_WB().angularDistance(q), 1e-6) << stiffness;
    }
  }
}

/// A four-bar with a free body on a spring to its coupler, out of the plane in which the bars move.
struct TiedCoupler {
  test::FourBar bar;
  PhysicsManager& physics{bar.physics};
  BodyId body{};

  TiedCoupler(double stiffness, bool moves) : bar{{0, 1, 2, 3}, 0, moves} {
    body = physics.add(RigidBodySettings{.X_WB = {{0.5, 1.2, 0.3}}, .mass = lopsided_mass()});
    tie(physics, bar.rods[1], {0.1, 0.1, 0.2}, body, {0.1, 0, 0.1}, stiffness);
    physics.set_integrator(make_radau({.tolerance = kInfinite}));
  }
  /// 0.1 s.
  StepReport advance(int steps) {
    StepReport all;
    for (int i = 0; i < steps; ++i) {
      const StepReport report = physics.step(0.1 / steps);
      EXPECT_TRUE(report.ok()) << report.message;
      all.inner_steps += report.inner_steps;
    }
    return all;
  }
  [[nodiscard]] Vector3 place() const { return bar.physics.body(body).p_WBcm(); }
};

TEST(StiffLine, TurnsWithAClosedLoop) {
  // What rounding of places makes of the stiffest spring is some 1e-9 m/s in short steps, and must not be
  // taken for sweeps that do not settle: no step is cut, be it long or short. Long and short ones come to the
  // same motion, whatever the stiffness, and the loop stays closed.
  for (const double stiffness : {1e6, 1e8, 1e10}) {
    TiedCoupler coarse{stiffness, false}, fine{stiffness, false};
    const Vector3 start = coarse.place();
    EXPECT_EQ(coarse.advance(5).inner_steps, 5) << stiffness;
    EXPECT_EQ(fine.advance(50).inner_steps, 50) << stiffness;
    EXPECT_GT((coarse.place() - start).norm(), 1e-2) << "it moves, or this shows little";
    EXPECT_LT((coarse.place() - fine.place()).norm(), 1e-8) << stiffness;
    EXPECT_LT(coarse.physics.joint_drift().distance, 1e-13);
  }
}

TEST(StiffLine, TakesABlowInShortPartsAndGrowsAgain) {
  // The coupler moves, the body on the spring rests: within microseconds both must come to one velocity. The
  // first step is cut for it, and its parts grow again, so that the cost does not grow as the blow shortens.
  for (const double stiffness : {1e6, 1e8, 1e10}) {
    TiedCoupler coarse{stiffness, true}, fine{stiffness, true};
    EXPECT_LT(coarse.advance(5).inner_steps, 20) << stiffness;
    static_cast<void>(fine.advance(50));
    EXPECT_LT((coarse.place() - fine.place()).norm(), 2e-6) << stiffness;
  }
}

TEST(StiffLine, AllocatesNothingInASteadyStep) {
  Held held = Held::on<BallSettings>(1e8);
  ASSERT_TRUE(test::run(held.physics, 0.05, 2));
  const auto before = test::allocations_so_far();
  ASSERT_TRUE(held.physics.step(0.05).ok());
  EXPECT_EQ(test::allocations_so_far(), before);
}

}  // namespace
}  // namespace pantin
