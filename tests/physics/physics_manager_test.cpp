#include <pantin/physics/physics_manager.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/allocation_guard.hpp"
#include "support/contracts.hpp"
#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::joint_here;
using test::lopsided_mass;
using test::run;
using test::thrown_body;

TEST(PhysicsManager, GivesTheAbsoluteMatrixFromCentreOfGravityAndRotation) {
  // By definition the body origin is Pos - R * GravityCenter; a round trip through add must give the pose
  // back.
  PhysicsManager physics;
  const Pose X_WB = thrown_body().X_WB;
  const RigidBody body = physics.body(physics.add(thrown_body()));
  EXPECT_LT((body.X_WB().p - X_WB.p).norm(), 1e-15);
  EXPECT_LT((body.p_WBcm() - body.R_WB() * body.p_BBcm() - X_WB.p).norm(), 1e-15);
  EXPECT_LT((body.v_WB() - (body.v_WBcm() - body.w_WB().cross(body.R_WB() * body.p_BBcm()))).norm(), 1e-15);
}

TEST(PhysicsManager, KeepsDerivedValuesTrueToTheState) {
  // I_W = R I R^T, v = P / m, w = I_W^-1 L are definitions; they must hold after any step, to round-off.
  PhysicsManager physics;
  const BodyId id = physics.add(thrown_body());
  ASSERT_TRUE(run(physics, 0.01, 50));
  const RigidBody body = physics.body(id);
  EXPECT_LT((body.v_WBcm() - body.linear_momentum() / 2.5).norm(), 1e-15);
  EXPECT_LT((body.w_WB() - body.I_BBcm_W_inverse() * body.angular_momentum()).norm(), 1e-13);
  EXPECT_LT((body.I_BBcm_W() * body.I_BBcm_W_inverse() - Matrix3::Identity()).norm(), 1e-13);
  EXPECT_LT((body.R_WB() - body.q_WB().toRotationMatrix()).norm(), 1e-15);
  EXPECT_LT(std::abs(body.q_WB().norm() - 1), 1e-15);
}

TEST(PhysicsManager, KeepsMomentaOfFreeBodiesToTheBit) {
  // Without forces P and L are constants of motion and are integrated as such: no bit may change.
  PhysicsManager physics;
  const BodyId id = physics.add(thrown_body());
  const Vector3 P = physics.body(id).linear_momentum(), L = physics.body(id).angular_momentum();
  ASSERT_TRUE(run(physics, 0.004, 1000));
  EXPECT_EQ(physics.body(id).linear_momentum(), P);
  EXPECT_EQ(physics.body(id).angular_momentum(), L);
}

TEST(PhysicsManager, FollowsTheParabolaOfFreeFall) {
  // Under uniform gravity the centre of gravity moves on p0 + v t + g t^2 / 2, which RK4 integrates exactly.
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  const BodyId id = physics.add(thrown_body());
  const Vector3 p0 = physics.body(id).p_WBcm();
  ASSERT_TRUE(run(physics, 0.01, 200));
  const Vector3 expected = p0 + 2.0 * Vector3{2, -1, 4} + 0.5 * 4.0 * Vector3{0, 0, -9.81};
  EXPECT_LT((physics.body(id).p_WBcm() - expected).norm(), 1e-12);
  EXPECT_NEAR(physics.time(), 2.0, 1e-15);
}

TEST(PhysicsManager, AppliesImpulsesOnceAtTheEndOfTheStep) {
  // P and L change by the impulse and its moment about the centre of gravity (definition), after the motion
  // of the step.
  PhysicsManager physics;
  const BodyId id = physics.add(RigidBodySettings{.mass = lopsided_mass(2)});
  const Vector3 j{1, 2, 3}, p = physics.body(id).p_WBcm() + Vector3{0.5, 0, 0};
  physics.apply_impulse(id, j, p);
  physics.apply_angular_impulse(id, {0, 0, 1});
  const Pose before = physics.body(id).X_WB();
  ASSERT_TRUE(run(physics, 0.01, 1));
  EXPECT_EQ(physics.body(id).X_WB().p, before.p);
  EXPECT_LT((physics.body(id).linear_momentum() - j).norm(), 1e-15);
  EXPECT_LT((physics.body(id).angular_momentum() - (Vector3{0.5, 0, 0}.cross(j) + Vector3{0, 0, 1})).norm(),
            1e-15);
  EXPECT_LT((physics.body(id).v_WBcm() - j / 2).norm(), 1e-15);
  ASSERT_TRUE(run(physics, 0.01, 1));
  EXPECT_LT((physics.body(id).linear_momentum() - j).norm(), 1e-15) << "an impulse acts once";
}

TEST(PhysicsManager, KeepsForcesUntilTheyAreCleared) {
  // A constant force gives P = F t, torque L = T t, for as long as the accumulators hold them.
  PhysicsManager physics;
  const BodyId id = physics.add(RigidBodySettings{});
  physics.apply_force(id, {1, 0, 0}, {0, 1, 0});
  physics.apply_torque(id, {0, 2, 0});
  EXPECT_EQ(physics.body(id).force(), Vector3(1, 0, 0));
  EXPECT_EQ(physics.body(id).torque(), Vector3(0, 2, -1));
  ASSERT_TRUE(run(physics, 0.25, 4));
  EXPECT_LT((physics.body(id).linear_momentum() - Vector3{1, 0, 0}).norm(), 1e-14);
  EXPECT_LT((physics.body(id).angular_momentum() - Vector3{0, 2, -1}).norm(), 1e-14);
  physics.clear_accumulators();
  ASSERT_TRUE(run(physics, 0.25, 4));
  EXPECT_LT((physics.body(id).linear_momentum() - Vector3{1, 0, 0}).norm(), 1e-14);
}

TEST(PhysicsManager, ReportsEnergyOfTheStateReached) {
  // Kinetic energy of a known state is m v^2 / 2 + w I w / 2, potential -m g p: closed forms.
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  const BodyId id = physics.add(thrown_body());
  const StepReport report = physics.step(0.01);
  const RigidBody body = physics.body(id);
  const double kinetic =
      0.5 * 2.5 * body.v_WBcm().squaredNorm() + 0.5 * body.w_WB().dot(body.I_BBcm_W() * body.w_WB());
  EXPECT_NEAR(report.energy.kinetic, kinetic, 1e-12 * kinetic);
  EXPECT_NEAR(report.energy.potential, 2.5 * 9.81 * body.p_WBcm().z(), 1e-12);
  EXPECT_EQ(report.evaluations, 4);
  EXPECT_EQ(report.moved, 1u);
}

TEST(PhysicsManager, LeavesIdleBodiesUntouched) {
  // A body with neither momentum nor wrench has nothing to integrate: pose bits stay, and it is not among the
  // moved.
  PhysicsManager physics;
  RigidBodySettings still = thrown_body();
  still.v_WBcm.setZero();
  still.w_WB.setZero();
  // A quaternion whose norm is off by round-off, as users give it, must not be touched either.
  still.X_WB.q.coeffs() *= 1 + 2e-16;
  const BodyId id = physics.add(std::move(still));
  const BodyId arm =
      physics.add(RigidBodySettings{.name = "arm", .X_WB = {{0, 0, 1}}, .mass = lopsided_mass()});
  physics.add(joint_here<PivotSettings>(physics, BodyId{}, arm, {{0, 0.3, 1}, test::facing({1, 1, 0})}));
  const State start = physics.snapshot();
  ASSERT_TRUE(run(physics, 0.01, 1000));
  EXPECT_TRUE(physics.moved().empty());
  for (const BodyId b : {id, arm}) {
    const std::size_t i = b == id ? 0 : 1;
    EXPECT_EQ(physics.body(b).p_WBcm(), start.bodies[i].p_WBcm);
    EXPECT_EQ(physics.body(b).q_WB().coeffs(), start.bodies[i].q_WB.coeffs());
  }
}

/// Pushes a body with a force that is not a number once it is past a height.
class PoisonLaw final : public ForceLaw {
 public:
  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    if (at.t > 0.05) wrenches[0].force.x() = std::numeric_limits<double>::quiet_NaN();
  }
};

TEST(PhysicsManager, KeepsTheStateWhenNumbersGoWrong) {
  // A failed step is undone: the state before it stays, to the bit, and the report names the body.
  PhysicsManager physics;
  physics.add(thrown_body());
  ASSERT_TRUE(run(physics, 0.02, 2));
  physics.forces().add_law(std::make_unique<PoisonLaw>());
  const State before = physics.snapshot();
  const StepReport report = physics.step(0.02);
  EXPECT_FALSE(report.ok());
  EXPECT_EQ(report.status, StepStatus::NotFinite);
  EXPECT_NE(report.message.find("'thrown'"), std::string::npos) << report.message;
  EXPECT_TRUE(physics.snapshot() == before);
}

TEST(PhysicsManager, RemovesJointsAndLawsWithTheBody) {
  // What names a body cannot outlive it; other ids stay valid.
  PhysicsManager physics;
  const BodyId a = physics.add(thrown_body());
  const BodyId b = physics.add(thrown_body());
  const BodyId c = physics.add(thrown_body());
  const JointId ab = physics.add(FixedSettings{.a = a, .b = b});
  const JointId wc = physics.add(joint_here<BallSettings>(physics, BodyId{}, c, Pose{}));
  physics.remove(a);
  EXPECT_FALSE(physics.contains(a));
  EXPECT_FALSE(physics.contains(ab));
  EXPECT_TRUE(physics.contains(b));
  EXPECT_TRUE(physics.contains(wc));
  ASSERT_TRUE(run(physics, 0.01, 3));
  const BodyId d = physics.add(thrown_body());
  EXPECT_EQ(d.index, a.index) << "the slot is used again";
  EXPECT_FALSE(physics.contains(a)) << "with another generation";
}

TEST(PhysicsManager, RefusesStaleIdsAndBadSteps) {
  // Broken contracts reach the handler with values; none is ignored.
  test::ThrowOnContract guard;
  PhysicsManager physics;
  const BodyId id = physics.add(thrown_body());
  physics.remove(id);
  EXPECT_THROW(static_cast<void>(physics.body(id)), test::ContractError);
  EXPECT_THROW(static_cast<void>(physics.body(BodyId{})), test::ContractError);
  EXPECT_THROW(static_cast<void>(physics.step(0)), test::ContractError);
  EXPECT_THROW(static_cast<void>(physics.step(-1)), test::ContractError);
  EXPECT_THROW(static_cast<void>(physics.step(std::numeric_limits<double>::quiet_NaN())),
               test::ContractError);
  RigidBodySettings nan = thrown_body();
  nan.v_WBcm.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(physics.add(std::move(nan)), test::ContractError);
  RigidBodySettings impossible = thrown_body();
  impossible.mass.I_BBcm_B = Vector3{1, 1, 3}.asDiagonal();
  EXPECT_THROW(physics.add(std::move(impossible)), test::ContractError);
}

TEST(PhysicsManager, TakesInertiasThatNoBodyHasOnRequest) {
  // Euler's equations need a positive inertia only; textbook problems use others.
  PhysicsManager physics;
  RigidBodySettings s = thrown_body();
  s.mass.I_BBcm_B = Vector3{0.7, 2, 3}.asDiagonal();
  s.inertia_check = InertiaCheck::Solvable;
  const BodyId id = physics.add(std::move(s));
  EXPECT_TRUE(physics.contains(id));
}

TEST(PhysicsManager, TeleportsWithItsHistory) {
  // A teleport is no motion: the previous pose is the new one, both velocities stay.
  PhysicsManager physics;
  const BodyId id = physics.add(thrown_body());
  const Pose X{{9, 9, 9}, Quaternion::Identity()};
  physics.set_pose(id, X);
  EXPECT_EQ(physics.body(id).X_WB().p, X.p);
  EXPECT_EQ(physics.body(id).p_WBcm_previous(), physics.body(id).p_WBcm());
  EXPECT_EQ(physics.body(id).v_WBcm(), Vector3(2, -1, 4));
  EXPECT_EQ(physics.body(id).w_WB(), Vector3(3, -5, 2));
}

TEST(PhysicsManager, PutsDrivenBodiesWhereTheyAreAtASetTime) {
  // An animated body stands where its driver says for the time that is set, and carries what hangs on it.
  PhysicsManager physics;
  RigidBodySettings base{.name = "base", .kind = BodyKind::Animated};
  base.driver = std::make_unique<test::FunctionDriver>([](double t, Side) {
    return RigidMotion{.X_AB = {.p = {2 * t, 0, 0}}, .v_AB = {2, 0, 0}};
  });
  const BodyId ground = physics.add(std::move(base));
  const BodyId bob =
      physics.add(RigidBodySettings{.name = "bob", .X_WB = {{0, 0, -1}}, .mass = lopsided_mass()});
  const JointId ball = physics.add(joint_here<BallSettings>(physics, ground, bob, Pose{}));
  physics.set_time(3);
  EXPECT_EQ(physics.time(), 3);
  EXPECT_EQ(physics.body(ground).X_WB().p, Vector3(6, 0, 0));
  EXPECT_LT((physics.body(bob).X_WB().p - Vector3{6, 0, -1}).norm(), 1e-14);
  EXPECT_LT(physics.joint_drift().distance, 1e-14);
  EXPECT_TRUE(physics.contains(ball));
}

TEST(PhysicsManager, AllocatesNothingInASteadyStep) {
  // Counted, not timed: after a first step the work space is there.
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  for (int i = 0; i < 100; ++i) physics.add(thrown_body());
  BodyId last{};
  for (int i = 0; i < 10; ++i) {
    const BodyId id = physics.add(RigidBodySettings{.X_WB = {{0.2 * i, 0, 0}}, .mass = lopsided_mass()});
    const Pose here{{0.2 * i, 0, 0}, test::facing({0, 1, 0})};
    if (i % 3 == 0) physics.add(joint_here<PivotSettings>(physics, last, id, here));
    if (i % 3 == 1) physics.add(joint_here<BallSettings>(physics, last, id, here));
    if (i % 3 == 2) physics.add(joint_here<SliderSettings>(physics, last, id, here));
    last = id;
  }
  for (const std::string& name : integrator_names()) {
    if (name == "radau") continue;  // its matrices are factored by a library that takes room of its own
    physics.set_integrator(make_integrator(name));
    ASSERT_TRUE(run(physics, 1e-3, 2));
    const test::AllocationGuard guard;
    const bool ok = run(physics, 1e-3, 10);
    const std::size_t allocations = guard.count();
    EXPECT_EQ(allocations, 0u) << name;
    EXPECT_TRUE(ok);
  }
}

}  // namespace
}  // namespace pantin
