// Steady playing allocates nothing.
#include <gtest/gtest.h>

#include <support/allocation_guard.hpp>
#include <support/blends.hpp>

namespace pantin {
namespace {

TEST(Player, AllocatesNothingWhilePlaying) {
  // Blended, additive and linked nodes, events and root motion, for several laps: after the first advances
  // have made room, the allocator is never called, neither by advancing and writing nor by sampling.
  std::mt19937_64 random{96};
  Scene scene;
  const NodeId carrier = scene.create(scene.root(), "carrier"), hips = scene.create(carrier, "hips");
  const NodeId ball = scene.create(hips, "ball");
  Link link{.kind = LinkKind::Ball};
  link.value = zero_value(link.kind);
  scene.set_link(ball, link);
  Clip walk = test::random_clip(random);
  walk.tracks.push_back(test::random_cubic(Channel::LinkValue, 4, true, random));
  walk.tracks.back().target = 1;
  walk.events = {{0.25, "left"}, {0.75, "right"}};
  Player player;
  const PlayerSettings rooted{.root = RootMotion{.source = hips, .carrier = carrier}};
  const PlayId a = player.play(scene, walk, {hips, ball}, rooted);
  const PlayId b = player.play(scene, walk, {hips, ball}, {.weight = 0});
  player.play(scene, walk, {hips, ball}, {.weight = 0.3, .blend = Blend::Additive});
  player.cross_fade(a, b, {.begin = 0.5, .duration = 3});
  std::size_t passed = 0;
  const auto frame = [&] {
    player.advance(0.037);
    player.apply(scene);
    scene.update();
    passed += player.events().size();
    static_cast<void>(player.motion(hips, player.time() + 0.01));
    static_cast<void>(player.next_break(hips, player.time()));
  };
  for (int k = 0; k < 30; ++k) frame();
  const test::AllocationGuard guard;
  for (int k = 0; k < 100; ++k) frame();
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(passed, 20U);
}

}  // namespace
}  // namespace pantin
