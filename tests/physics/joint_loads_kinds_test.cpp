// Springs, rotors and motors on joints of every kind with numbers of its own.
#include <pantin/physics/constraints/joint_loads.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <support/allocation_guard.hpp>
#include <support/mechanisms.hpp>

#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/screw.hpp>
#include <pantin/physics/constraints/universal.hpp>
#include <pantin/physics/integrators/gauss.hpp>

namespace pantin {
namespace {

using test::joint_here;
using test::lopsided_mass;
using test::run;

/// x, y, z in a row, with joints x-y and z-y of one kind: the tree begins at whichever of x and z is added
/// first, and runs through one joint from A to B and through the other from B to A.
template <class Settings>
PhysicsManager pair_of(bool z_first, auto load) {
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0.3, -0.2, 0.1}});
  BodyId ids[3];
  for (const int i : z_first ? std::array{2, 1, 0} : std::array{0, 1, 2}) {
    RigidBodySettings s{.name = std::string{"xyz"[i]}, .X_WB = {{0.4 * i, 0.1, 0}}};
    s.w_WB = {0.1 * i, 0.3, 0.2};
    s.mass = lopsided_mass(1 + i);
    ids[i] = physics.add(std::move(s));
  }
  for (const int end : {0, 2}) {
    Settings joint =
        joint_here<Settings>(physics, ids[end], ids[1], {{0.2 * end, 0, 0.1}, test::facing({1, 2, 1})});
    load(physics, joint);
  }
  return physics;
}

/// Springs, damping and motors along all numbers; rotors too.
template <class Settings>
void load_all(PhysicsManager& physics, Settings joint) {
  JointDefinition definition = define(std::move(joint));
  const int count = axis_count(definition.kind);
  definition.pitch = definition.kind == JointKind::Screw ? 0.1 : 0;
  definition.damping = {0.3, 0.2, 0.1};
  // Of a planar joint's distances rotors are seen from the body nearer to the root.
  const bool all_rotors = definition.kind != JointKind::Planar;
  for (int i = 0; i < count; ++i) {
    definition.axes[static_cast<std::size_t>(i)] = {
        .stiffness = 4.0 + i, .rest = 0.3 - 0.2 * i, .armature = all_rotors || i == 2 ? 0.1 + 0.05 * i : 0};
  }
  const JointId id = physics.add_joint(std::move(definition));
  for (int i = 0; i < count; ++i)
    physics.set_motor(id, {.effort = 0.2, .value = 0.5, .rate = -0.3, .stiffness = 2, .damping = 0.4 + i}, i);
}

template <class Settings>
class LoadedJoint : public testing::Test {};
using LoadedJoints = testing::Types<PivotSettings, SliderSettings, CylindricalSettings, UniversalSettings,
                                    PlanarSettings, ScrewSettings>;
TYPED_TEST_SUITE(LoadedJoint, LoadedJoints);

TYPED_TEST(LoadedJoint, ActsTheSameWhicheverWayTheTreeRuns) {
  // One mechanism laid out from either end: the same bodies must move alike, though numbers of links turn
  // their sign, order or frame.
  PhysicsManager one = pair_of<TypeParam>(false, load_all<TypeParam>),
                 other = pair_of<TypeParam>(true, load_all<TypeParam>);
  for (PhysicsManager* physics : {&one, &other}) {
    physics->set_integrator(make_gauss({.stages = 8, .tolerance = 1e-12}));
    ASSERT_TRUE(run(*physics, 0.25, 4));
  }
  for (const BodyId id : one.bodies()) {
    const RigidBody a = one.body(id);
    for (const BodyId found : other.bodies()) {
      const RigidBody b = other.body(found);
      if (a.name() == b.name()) {
        EXPECT_LT((a.p_WBcm() - b.p_WBcm()).norm(), 1e-10) << a.name();
        EXPECT_LT((a.w_WB() - b.w_WB()).norm(), 1e-9) << a.name();
      }
    }
  }
}

TYPED_TEST(LoadedJoint, KeepsEnergyWithSpringsAndRotors) {
  // Without damping and motors the sum of kinetic and potential energy, springs and rotors counted, is an
  // integral of the motion.
  const auto conservative = [](PhysicsManager& physics, TypeParam joint) {
    JointDefinition definition = define(std::move(joint));
    definition.pitch = definition.kind == JointKind::Screw ? 0.1 : 0;
    for (int i = 0; i < axis_count(definition.kind); ++i)
      definition.axes[static_cast<std::size_t>(i)] = {
          .stiffness = 4.0 + i, .rest = 0.3, .armature = 0.1 + 0.2 * i};
    physics.add_joint(std::move(definition));
  };
  PhysicsManager physics = pair_of<TypeParam>(false, conservative);
  physics.set_integrator(make_gauss({.stages = 8, .tolerance = 1e-12}));
  static_cast<void>(physics.snapshot());  // velocities are made to agree with the joints
  const double start = physics.energy().total(), kinetic = physics.energy().kinetic;
  ASSERT_TRUE(run(physics, 0.1, 10));
  EXPECT_NEAR(physics.energy().total(), start, 1e-10);
  EXPECT_GT(std::abs(physics.energy().kinetic - kinetic), 1e-3);
}

TYPED_TEST(LoadedJoint, MovesInLanesAsInTheScalarKernel) {
  // Four and eight stages are computed in lanes, seven by the scalar kernel; all solve the same equations.
  std::vector<Vector3> ends[3];
  for (int i = 0; i < 3; ++i) {
    PhysicsManager physics = pair_of<TypeParam>(false, load_all<TypeParam>);
    physics.set_integrator(
        make_gauss({.stages = std::array{7, 4, 8}[static_cast<std::size_t>(i)], .tolerance = 1e-13}));
    ASSERT_TRUE(physics.step(1).ok());
    for (const BodyId id : physics.bodies()) ends[i].push_back(physics.body(id).p_WBcm());
  }
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_LT((ends[1][b] - ends[0][b]).norm(), 1e-11);
    EXPECT_LT((ends[2][b] - ends[0][b]).norm(), 1e-11);
  }
}

TYPED_TEST(LoadedJoint, LeavesIntegratorsTheirOrder) {
  // Efforts are functions of the stage: halving the step of rk4 divides the error by 16.
  const auto end = [](std::unique_ptr<Integrator> integrator, int steps) {
    PhysicsManager physics = pair_of<TypeParam>(false, load_all<TypeParam>);
    physics.set_integrator(std::move(integrator));
    EXPECT_TRUE(run(physics, 0.5 / steps, steps));
    return physics.body(physics.bodies()[2]).p_WBcm();
  };
  const Vector3 exact = end(make_gauss({.stages = 8, .tolerance = 1e-13}), 1);
  const double coarse = (end(make_integrator("rk4"), 40) - exact).norm(),
               fine = (end(make_integrator("rk4"), 80) - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.2) << coarse << ' ' << fine;
}

TEST(JointLoads, ContinueFromSnapshotsBitForBitAndWithoutAllocating) {
  // Rates of rotors and turns of springs are those of the joints, which are State; steps of a loaded tree
  // take no memory in any of the ways through the kernels.
  for (const char* name : {"rk4", "gauss8", "gauss16", "dormand-prince"}) {
    PhysicsManager physics = pair_of<CylindricalSettings>(false, load_all<CylindricalSettings>);
    physics.set_integrator(make_integrator(name));
    ASSERT_TRUE(run(physics, 0.05, 3));
    const State middle = physics.snapshot();
    ASSERT_TRUE(run(physics, 0.05, 3));
    const State end = physics.snapshot();
    physics.restore(middle);
    const std::size_t before = test::allocations_so_far();
    const bool ok = run(physics, 0.05, 3);
    EXPECT_EQ(test::allocations_so_far() - before, 0u) << name;
    EXPECT_TRUE(ok && physics.snapshot() == end) << name;
  }
}

}  // namespace
}  // namespace pantin
