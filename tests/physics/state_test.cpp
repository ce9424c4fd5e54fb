#include <pantin/physics/state.hpp>

#include <gtest/gtest.h>

#include <thread>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::joint_here;
using test::lopsided_mass;
using test::run;
using test::thrown_body;

TEST(State, RewindsBitForBit) {
  // The state is everything that is integrated: from an equal state follow equal bits.
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  const BodyId a = physics.add(thrown_body());
  const BodyId b = physics.add(RigidBodySettings{.name = "b", .X_WB = {{1, 2, 4}}, .mass = lopsided_mass()});
  physics.add(joint_here<BallSettings>(physics, a, b, {{1, 2, 3.5}, Quaternion::Identity()}));
  ASSERT_TRUE(run(physics, 0.01, 20));
  physics.apply_force(b, {0, 3, 0});
  physics.apply_impulse(a, {1, 0, 0});
  const State middle = physics.snapshot();
  ASSERT_TRUE(run(physics, 0.01, 30));
  const State first = physics.snapshot();
  physics.restore(middle);
  ASSERT_TRUE(run(physics, 0.01, 30));
  EXPECT_TRUE(physics.snapshot() == first);
  EXPECT_EQ(hash(physics.snapshot()), hash(first));
  EXPECT_NE(hash(middle), hash(first));
}

TEST(State, OfManagersInTwoThreadsIsTheirOwn) {
  // Two managers share nothing: run side by side they give the bits that each gives alone (and no race under
  // tsan).
  const auto simulate = [](State& out) {
    PhysicsManager physics;
    physics.forces().add(Gravity{});
    const BodyId a = physics.add(thrown_body());
    physics.add(joint_here<BallSettings>(physics, BodyId{}, a, {{1, 2, 4}, Quaternion::Identity()}));
    static_cast<void>(run(physics, 0.01, 100));
    out = physics.snapshot();
  };
  State alone, first, second;
  simulate(alone);
  std::thread other{simulate, std::ref(first)};
  simulate(second);
  other.join();
  EXPECT_TRUE(first == alone);
  EXPECT_TRUE(second == alone);
}

}  // namespace
}  // namespace pantin
