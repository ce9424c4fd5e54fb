#include <pantin/physics/constraints/constraint_manager.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pantin/physics/integrators/dormand_prince.hpp>

#include "support/contracts.hpp"
#include "support/mechanisms.hpp"
#include "support/mixed_tree.hpp"

namespace pantin {
namespace {

using test::facing;
using test::joint_here;
using test::lopsided_mass;
using test::mixed_tree;
using test::run;

TEST(ConstraintManager, KeepsTheEnergyOfAMixedTree) {
  // Ideal joints do no work, so energy is constant; RK4's drift falls with h^4 or faster: 16 times and more
  // by halving.
  const auto drift = [](bool floating, double h) {
    PhysicsManager physics = mixed_tree(floating);
    for (const JointId id : physics.joints()) {
      if (physics.joint_rate(id).size() == 1) physics.set_joint_rate(id, 2.0);
    }
    const double start = physics.energy().total();
    EXPECT_TRUE(run(physics, h, static_cast<int>(std::lround(1.0 / h))));
    return std::abs(physics.energy().total() - start);
  };
  for (const bool floating : {false, true}) {
    const double coarse = drift(floating, 4e-3), fine = drift(floating, 2e-3);
    EXPECT_LT(fine, 1e-4);
    EXPECT_GT(coarse / fine, 12);
  }
}

TEST(ConstraintManager, EveryIntegratorKeepsItsOrderWithJoints) {
  // Against the same integrator family's own limit (RK4 with a 16 times smaller step) the error of each
  // integrator must fall with its stated order; a constraint evaluated once per step would break that.
  const auto tip_after = [](const std::string& name, double h) {
    PhysicsManager physics = mixed_tree(false);
    const bool controls = name == "dormand-prince";  // without control, its steps are those asked for
    physics.set_integrator(controls
                               ? make_dormand_prince({.tolerance = std::numeric_limits<double>::infinity()})
                               : make_integrator(name));
    EXPECT_TRUE(run(physics, h, static_cast<int>(std::lround(0.4 / h))));
    return Vector3{physics.body(physics.bodies()[6]).p_WBcm()};
  };
  const Vector3 exact = tip_after("rk4", 0.4 / 6400);
  for (const std::string& name : integrator_names()) {
    const int order = make_integrator(name)->order();
    if (order > 5) continue;  // nothing here is as exact; see Gauss
    const double h = 0.4 / (order >= 4 ? 100 : 800);
    const double coarse = (tip_after(name, h) - exact).norm(), fine = (tip_after(name, h / 2) - exact).norm();
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.05 * order + 0.05) << name;
  }
}

TEST(ConstraintManager, CarriesAnyMassRatio) {
  // Elimination is exact at any mass ratio: a chain with a tip of 1e8 kg keeps joints closed and energy as
  // well as RK4 can (relative to the energy in play).
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  BodyId last{};
  for (int i = 0; i < 6; ++i) {
    RigidBodySettings s{.X_WB = {{0.2 * i, 0, 0}}, .mass = lopsided_mass(i == 5 ? 1e8 : 1)};
    const BodyId id = physics.add(std::move(s));
    const Vector3 axis = i % 2 == 0 ? Vector3{0, 1, 0} : Vector3{1, 0, 1};
    physics.add(joint_here<PivotSettings>(physics, last, id, {{0.2 * i, 0, 0}, facing(axis)}));
    last = id;
  }
  const double start = physics.energy().total();
  ASSERT_TRUE(run(physics, 1e-6, 3000));
  EXPECT_LT(physics.joint_drift().distance, 1e-14);
  EXPECT_LT(std::abs(physics.energy().total() - start), 1e-6 * physics.energy().kinetic);
}

TEST(ConstraintManager, CarriesMasslessLinksBetweenBodies) {
  // Two crossed pivots with nothing between them are a universal joint: a massless cross must give the limit
  // of a very light one.
  const auto swing = [](double mass) {
    PhysicsManager physics;
    physics.forces().add(Gravity{});
    MassProperties light;
    light.mass = mass;
    light.I_BBcm_B = 1e-2 * mass * Matrix3::Identity();
    const BodyId cross = physics.add(RigidBodySettings{.name = "cross", .mass = light});
    const BodyId bob =
        physics.add(RigidBodySettings{.name = "bob", .X_WB = {{0.5, 0, 0}}, .mass = lopsided_mass()});
    physics.add(joint_here<PivotSettings>(physics, BodyId{}, cross, {Vector3::Zero(), facing({0, 1, 0})}));
    physics.add(joint_here<PivotSettings>(physics, cross, bob, {Vector3::Zero(), facing({1, 0, 0})}));
    EXPECT_TRUE(physics.singular_joints().empty());
    EXPECT_TRUE(run(physics, 1e-3, 1000));
    return Vector3{physics.body(bob).p_WBcm()};
  };
  EXPECT_LT((swing(0) - swing(1e-10)).norm(), 1e-8);
}

TEST(ConstraintManager, NamesJointsThatMoveNothing) {
  // A massless leaf on a pivot has no inertia in the joint's direction: named with the body and a remedy.
  PhysicsManager physics;
  MassProperties nothing{.mass = 0, .I_BBcm_B = Matrix3::Zero()};
  const BodyId arm = physics.add(RigidBodySettings{.name = "arm", .mass = lopsided_mass()});
  const BodyId leaf = physics.add(RigidBodySettings{.name = "leaf", .mass = nothing});
  const JointId base = physics.add(joint_here<PivotSettings>(physics, BodyId{}, arm, Pose{}, "base"));
  EXPECT_TRUE(physics.contains(base));
  const JointId wrist = physics.add(joint_here<PivotSettings>(physics, arm, leaf, Pose{}, "wrist"));
  const auto singular = physics.singular_joints();
  ASSERT_EQ(singular.size(), 1u);
  EXPECT_EQ(singular[0].first, wrist);
  EXPECT_EQ(singular[0].second.code, ProblemCode::SingularMass);
  EXPECT_NE(singular[0].second.text.find("'wrist'"), std::string::npos);
  EXPECT_NE(singular[0].second.text.find("'leaf'"), std::string::npos);
  EXPECT_FALSE(physics.step(0.01).ok()) << "and the step says so instead of writing NaN";
  EXPECT_TRUE(physics.body(arm).p_WBcm().allFinite());

  PhysicsManager free;
  free.add(RigidBodySettings{.name = "ghost", .mass = nothing});
  ASSERT_EQ(free.singular_joints().size(), 1u);
  EXPECT_NE(free.singular_joints()[0].second.text.find("'ghost'"), std::string::npos);
}

TEST(ConstraintManager, SeesLoopsBeforeTheyAreClosed) {
  // Truth table on a chain ground - a - b - c and a loose d.
  PhysicsManager physics;
  std::vector<BodyId> ids;
  for (int i = 0; i < 4; ++i) ids.push_back(physics.add(RigidBodySettings{.mass = lopsided_mass()}));
  physics.add(joint_here<PivotSettings>(physics, BodyId{}, ids[0], Pose{}));
  physics.add(joint_here<PivotSettings>(physics, ids[0], ids[1], Pose{}));
  physics.add(joint_here<PivotSettings>(physics, ids[1], ids[2], Pose{}));
  EXPECT_TRUE(physics.closes_loop(BodyId{}, ids[2]));
  EXPECT_TRUE(physics.closes_loop(ids[2], ids[0]));
  EXPECT_FALSE(physics.closes_loop(ids[2], ids[3]));
  EXPECT_FALSE(physics.closes_loop(BodyId{}, ids[3]));
  EXPECT_FALSE(physics.closes_loop(ids[3], BodyId{})) << "nothing simulated is joined to anything";
  // A static body in the middle splits the chain.
  physics.make_static(ids[1]);
  EXPECT_FALSE(physics.closes_loop(ids[0], ids[3]));
  EXPECT_TRUE(physics.closes_loop(ids[1], ids[0])) << "both its ends are ground then";
}

TEST(ConstraintManager, BuildsAndMovesALongChain) {
  // 20,000 links: no recursion, linear time; a straight chain in free fall falls as one.
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  BodyId last{};
  for (int i = 0; i < 20000; ++i) {
    const BodyId id = physics.add(RigidBodySettings{.X_WB = {{0.1 * i, 0, 0}}, .mass = lopsided_mass()});
    if (last) physics.add(joint_here<PivotSettings>(physics, last, id, {{0.1 * i, 0, 0}, facing({0, 1, 0})}));
    last = id;
  }
  ASSERT_TRUE(run(physics, 1e-3, 2));
  EXPECT_NEAR(physics.body(last).v_WBcm().z(), -9.81 * 2e-3, 1e-8);
}

TEST(ConstraintManager, TeleportsAFloatingTreeAsOne) {
  // Setting the pose of the root carries the tree: joint values, rates and the root's velocity stay.
  PhysicsManager physics = mixed_tree(true);
  ASSERT_TRUE(run(physics, 1e-3, 100));
  std::vector<JointNumbers> values, rates;
  for (const JointId id : physics.joints()) {
    values.push_back(physics.joint_value(id));
    rates.push_back(physics.joint_rate(id));
  }
  const BodyId root = physics.bodies()[0];
  const Vector3 v = physics.body(root).v_WBcm();
  physics.set_pose(root, {{5, 6, 7}, Quaternion{Eigen::AngleAxisd{1, Vector3::UnitX()}}});
  EXPECT_LT((physics.body(root).X_WB().p - Vector3{5, 6, 7}).norm(), 1e-14);
  EXPECT_LT((physics.body(root).v_WBcm() - v).norm(), 1e-13);
  for (std::size_t j = 0; j < values.size(); ++j) {
    const JointNumbers value = physics.joint_value(physics.joints()[j]),
                       rate = physics.joint_rate(physics.joints()[j]);
    for (int k = 0; k < values[j].size(); ++k) EXPECT_NEAR(value[k], values[j][k], 1e-14);
    for (int k = 0; k < rates[j].size(); ++k) EXPECT_NEAR(rate[k], rates[j][k], 1e-12);
  }
  EXPECT_LT(physics.joint_drift().distance, 1e-13);
}

TEST(ConstraintManager, PutsBodiesBackOnTheirJoints) {
  // Joints added between bodies that do not meet draw them together at the next step; the drift is gone
  // afterwards.
  PhysicsManager physics;
  const BodyId a = physics.add(RigidBodySettings{.name = "a", .mass = lopsided_mass()});
  const BodyId b = physics.add(RigidBodySettings{.name = "b", .X_WB = {{1, 0, 0}}, .mass = lopsided_mass()});
  physics.add(PivotSettings{.b = a});
  physics.add(PivotSettings{.a = a, .b = b, .X_AJ = {.p = {0.9, 0, 0}}});
  EXPECT_NEAR(physics.joint_drift().distance, 0.1, 1e-15);
  ASSERT_TRUE(run(physics, 1e-3, 1));
  EXPECT_LT(physics.joint_drift().distance, 1e-15);
  EXPECT_EQ(physics.moved().size(), 1u);
}

}  // namespace
}  // namespace pantin
