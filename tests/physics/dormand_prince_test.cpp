#include <pantin/physics/integrators/dormand_prince.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <support/contracts.hpp>
#include <support/mechanisms.hpp>
#include <support/order_of_convergence.hpp>

#include <pantin/physics/constraints/pivot.hpp>

namespace pantin {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(DormandPrince, IsOfFifthOrderForEveryKindOfState) {
  // Without control every step asked for is one step; against closed forms and tight solutions.
  test::expect_order(*make_dormand_prince({.tolerance = kInf}), 5, 20, 0.7);
}

TEST(DormandPrince, KeepsItsToleranceAndNoMoreStepsThanItNeeds) {
  // On a Kepler ellipse of eccentricity 0.7 the speed changes 5.7-fold: the error after one orbit stays
  // within a modest multiple of tolerance x time (the orbit's own growth of errors), falls with the
  // tolerance, and the number of steps grows as tolerance^(-1/4) for a fifth-order method controlled per unit
  // time.
  test::ToyBody sky{{.load = [](const test::ToyBody::Motion& m) {
    return Wrench{-m.p / std::pow(m.p.norm(), 3), Vector3::Zero()};
  }}};
  const test::State start =
      test::ToyBody::state({.p = {1.7, 0, 0}}, {0, std::sqrt(0.3 / 1.7), 0}, Vector3::Zero());
  const double orbit = 2 * std::acos(-1.0);
  int steps[3];
  double errors[3];
  const double tolerances[] = {1e-5, 1e-7, 1e-9};
  for (int k = 0; k < 3; ++k) {
    const std::unique_ptr<Integrator> integrator = make_dormand_prince({.tolerance = tolerances[k]});
    test::State state = start;
    integrator->step(sky, 0, orbit, state.q, state.v);
    errors[k] = std::hypot(state.q[0] - start.q[0], state.q[1] - start.q[1]);
    steps[k] = integrator->control()->accepted;
    EXPECT_LT(errors[k], 100 * tolerances[k] * orbit);
    EXPECT_LT(integrator->control()->shortest, orbit / steps[k]);
  }
  EXPECT_GT(errors[0] / errors[1], 10);
  EXPECT_NEAR(std::log(1.0 * steps[2] / steps[1]) / std::log(100.0), 0.25, 0.05);
}

TEST(DormandPrince, GrowsAtRestAndShrinksWhereForcesAct) {
  // A free body in empty space: the derivative is constant or zero, every error estimate is zero, so the step
  // proposed grows five-fold a step; a stiff push makes it short.
  const std::unique_ptr<Integrator> integrator = make_dormand_prince({.tolerance = 1e-8});
  test::ToyBody free{{}};
  test::State state = test::ToyBody::state(test::kToyPose, {0, 0, 0}, {0, 0, 0});
  integrator->control()->memory.next = 1e-3;
  integrator->step(free, 0, 100, state.q, state.v);
  EXPECT_LE(integrator->control()->accepted, 9);  // 5^8 = 390,625
  test::Oscillator stiff{{.omega = 1000}};
  test::State fast{{1}, {0}};
  integrator->step(stiff, 0, 1, fast.q, fast.v);
  EXPECT_GT(integrator->control()->accepted, 1000);
  EXPECT_LT(integrator->control()->memory.next, 1e-3);
}

TEST(DormandPrince, MeasuresErrorsOfTreesAtTheirBodies) {
  // Two pendulums alike but for size: angles move alike where lengths are as squares of times, so the same
  // angular error is 100 times the distance on the large one: at equal tolerance it takes more steps a swing.
  const auto steps_a_swing = [](double length) {
    PhysicsManager physics;
    physics.forces().add(Gravity{.g_W = {0, 0, -length}});  // sqrt(l/g) = 1 s for both
    RigidBodySettings s{.name = "bob", .X_WB = {{length, 0, 0}}};
    s.mass = {1, Vector3::Zero(), 1e-3 * length * length * Matrix3::Identity()};
    const BodyId bob = physics.add(std::move(s));
    physics.add(test::joint_here<PivotSettings>(physics, BodyId{}, bob,
                                                Pose{Vector3::Zero(), test::facing({0, 1, 0})}));
    physics.set_integrator(make_dormand_prince({.tolerance = 1e-8}));
    const StepReport report = physics.step(5);
    EXPECT_TRUE(report.ok());
    return report.inner_steps;
  };
  const int small = steps_a_swing(1), large = steps_a_swing(100);
  EXPECT_NEAR(std::log(1.0 * large / small) / std::log(100.0), 0.25, 0.05);
}

TEST(DormandPrince, ContinuesBitForBitFromASnapshot) {
  // The step to be tried next is part of the state: what follows does not depend on how one came here.
  PhysicsManager physics;
  physics.add(test::thrown_body());
  physics.forces().add(Gravity{});
  physics.set_integrator(make_dormand_prince({.tolerance = 1e-10}));
  ASSERT_TRUE(test::run(physics, 0.1, 5));
  const State here = physics.snapshot();
  ASSERT_TRUE(test::run(physics, 0.1, 5));
  const State there = physics.snapshot();
  physics.restore(here);
  ASSERT_TRUE(test::run(physics, 0.1, 5));
  EXPECT_EQ(hash(physics.snapshot()), hash(there));
  EXPECT_EQ(physics.snapshot().memories.front().next, there.memories.front().next);
}

TEST(DormandPrince, SaysSoWhereNoStepIsShortEnough) {
  // Free fall into a centre of attraction ends in a singularity that no step reaches: the manager keeps the
  // state before and names the body.
  PhysicsManager physics;
  RigidBodySettings s{.name = "comet", .X_WB = {{1, 0, 0}}};
  s.mass = {1, Vector3::Zero(), Matrix3::Identity()};
  const BodyId comet = physics.add(std::move(s));
  class Centre final : public ForceLaw {
   public:
    void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
      const Vector3& p = at.kinematics[0].p_WBcm;
      wrenches[0].force -= p / std::pow(p.norm(), 3);
    }
  };
  physics.forces().add_law(std::make_unique<Centre>());
  physics.set_integrator(make_dormand_prince({.tolerance = 1e-9}));
  const StepReport report = physics.step(2);  // it falls in after pi / (2 sqrt 2) = 1.11 s
  EXPECT_EQ(report.status, StepStatus::NotFinite);
  EXPECT_EQ(report.body, comet);
  EXPECT_NE(report.message.find("'comet'"), std::string::npos);
  EXPECT_EQ(physics.body(comet).p_WBcm(), Vector3(1, 0, 0));
}

TEST(DormandPrinceContract, RefusesAToleranceThatIsNotPositive) {
  // Zero error needs infinitely many steps.
  const test::ThrowOnContract guard;
  EXPECT_THROW(static_cast<void>(make_dormand_prince({.tolerance = 0})), test::ContractError);
}

}  // namespace
}  // namespace pantin
