#include <gtest/gtest.h>

#include "support/contracts.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::moved;
using test::Stage;
using test::turned;

TEST(Presented, LiesBetweenTheLastTwoPoses) {
  // A body flying and turning at constant rates about its off-centre centre of gravity: half way between two
  // updates it is where it was half a step ago, in closed form (linear path, constant rate about one axis).
  Stage s{0.01};
  const NodeId id = s.scene.create(s.scene.root(), "a", test::scaled({1, 2, 3}));
  s.bridge.set_node_body(id, {.mass = MassProperties{1, {0.2, 0, 0}, Matrix3::Identity()}});
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  const BodyId body = s.bridge.body_of(id);
  s.physics.set_mass_properties(body, {1, {0.2, 0, 0}, Matrix3::Identity()});
  s.physics.set_velocity(body, {1, 2, 0}, {0, 0, 3});
  static_cast<void>(s.bridge.advance(0.02));
  for (const double alpha : {0.0, 0.25, 0.5, 1.0}) {
    const double t = 0.01 + 0.01 * alpha;
    const Affine R = turned(3 * t, {0, 0, 1});
    Affine want = R * test::scaled({1, 2, 3});
    want.translation() = Vector3{0.2, 0, 0} + t * Vector3{1, 2, 0} - R * Vector3{0.2, 0, 0};
    EXPECT_LT((s.bridge.presented(id, alpha).affine() - want.affine()).norm(), 1e-9)
        << alpha;  // rk4: 0.03^5 / 120
  }
}

TEST(Presented, TakesUnboundNodesAlongWithTheirBody) {
  // A child without a body is rigid on the presented parent: it has no history of its own.
  Stage s{0.1};
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId child = s.scene.create(id, "child", moved({0, 0, 1}) * turned(1, {1, 0, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  s.physics.set_velocity(s.bridge.body_of(id), {1, 0, 0}, {2, 3, 4});
  static_cast<void>(s.bridge.advance(0.1));
  const Affine want = s.bridge.presented(id, 0.5) * s.scene.local(child);
  EXPECT_EQ(s.bridge.presented(child, 0.5).matrix(), want.matrix());
  const NodeId free = s.scene.create(s.scene.root(), "free", moved({1, 2, 3}));
  EXPECT_EQ(s.bridge.presented(free, 0.5).matrix(), moved({1, 2, 3}).matrix());
}

TEST(Presented, IsNeverStored) {
  // Asking for presented matrices in every frame changes no bit of physics and scene: two runs, with and
  // without.
  std::array<std::uint64_t, 2> hashes{};
  std::array<std::vector<Affine>, 2> scenes{};
  for (std::size_t run = 0; run < 2; ++run) {
    Stage s{1.0 / 240};
    s.physics.forces().add(Gravity{});
    const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
    const NodeId b = box(s, a, "b", Affine::Identity(), 1, {0.3, 0, 0});
    s.scene.set_link(b, test::pivot_link("j", moved({0, 0, 1}), {0, 1, 0}));
    ASSERT_FALSE(has_error(s.bridge.hand_over(a, Scope::Subtree)));
    for (int frame = 0; frame < 50; ++frame) {
      static_cast<void>(s.bridge.advance(0.017));
      for (const NodeId id : {a, b}) {
        if (run == 1) static_cast<void>(s.bridge.presented(id, s.bridge.clock().rest() * 240 * 0.999));
      }
    }
    hashes[run] = hash(s.physics.snapshot());
    scenes[run] = test::locals(s.scene);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_TRUE(test::same_bits(scenes[0], scenes[1]));
}

TEST(Presented, TakesAlphaBetweenNoughtAndOne) {
  // Extrapolation is refused.
  const test::ThrowOnContract guard;
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "a");
  EXPECT_THROW(static_cast<void>(s.bridge.presented(id, 1.5)), test::ContractError);
  EXPECT_THROW(static_cast<void>(s.bridge.presented(id, std::nan(""))), test::ContractError);
}

}  // namespace
}  // namespace pantin
