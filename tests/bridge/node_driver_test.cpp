#include <pantin/bridge/node_driver.hpp>

#include <gtest/gtest.h>

#include <limits>

#include "support/slope.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::slope;

using test::moved;
using test::turned;

/// root / a (played) / b (stands) / c (played), all under scale and shear.
struct Chain {
  Scene scene{};
  NodeId a = scene.create(scene.root(), "a", test::scaled({2, 1, 1}));
  NodeId b = scene.create(a, "b", moved({1, 0, 2}) * turned(0.5, {1, 1, 0}));
  NodeId c = scene.create(b, "c", moved({0, 1, 0}) * test::scaled({1, 1, 3}));
  Player player_a{scene, test::swinging_clip(), {a}};
  Player player_c{scene, test::swinging_clip(), {c}, {.begin = -0.3, .speed = 1.5}};
  NodeMotion motion{};

  explicit Chain(const Offset* blend = nullptr) {
    motion.set_chain(moved({0, 0, 1}), {{.player = &player_a, .node = a},
                                        {.node = b, .rest = constant_motion(scene.local(b))},
                                        {.player = &player_c, .node = c, .blend = blend}});
  }
  [[nodiscard]] Matrix3 rotation(double t) const { return motion.split_at(t, Side::After).X.X_AB.rotation(); }
};

void expect_consistent(const NodeMotion& motion, double t) {
  // Oracle: fourth-order differences with h = 1e-3 inside one span of the keys: truncation h^4 / 30 times a
  // fifth derivative of some 1e2.
  const double h = 1e-3;
  const auto at = [&](double x) { return motion.split_at(x, Side::After); };
  const RigidMotion m = at(t).X;
  const Vector3 v = slope([&](double x) { return Vector3{at(x).X.X_AB.p}; }, t, h);
  const Vector3 a = slope([&](double x) { return Vector3{at(x).X.v_AB}; }, t, h);
  const Matrix3 R1 = slope([&](double x) { return Matrix3{at(x).X.X_AB.rotation()}; }, t, h);
  const Vector3 alpha = slope([&](double x) { return Vector3{at(x).X.w_AB}; }, t, h);
  EXPECT_LT((v - m.v_AB).norm(), 1e-8);
  EXPECT_LT((a - m.a_AB).norm(), 1e-7);
  EXPECT_LT((R1 - cross_matrix(m.w_AB) * m.X_AB.rotation()).norm(), 1e-8);
  EXPECT_LT((alpha - m.alpha_AB).norm(), 1e-6);
}

TEST(NodeMotion, IsTheProductOfTheLocalsAlongTheChain) {
  // The scene's own world matrix at the same play time is the oracle.
  Chain chain;
  for (const double t : {0.0, 0.4, 1.1, 1.7}) {
    for (Player* player : {&chain.player_a, &chain.player_c}) {
      player->set_time(t);
      player->apply(chain.scene);
    }
    Affine M = Affine::Identity();
    M.affine() = chain.motion.affine(t, Side::After).value;
    EXPECT_LT(test::relative_difference(M, moved({0, 0, 1}) * chain.scene.world(chain.c)), 1e-14);
    M.affine() = chain.motion.parent(t, Side::After).value;
    EXPECT_LT(test::relative_difference(M, moved({0, 0, 1}) * chain.scene.world(chain.b)), 1e-14);
  }
}

TEST(NodeMotion, HasExactDerivativesUnderScaleAndShear) {
  // Two clips in one chain, scaled unevenly in between: velocity and acceleration are those of the polar
  // factors.
  const Chain chain;
  for (const double t : {0.1, 0.5, 0.7, 1.3, 1.6}) expect_consistent(chain.motion, t);
}

TEST(NodeMotion, HasExactDerivativesOnTheWayBack) {
  // The same with a blend on the last node, which changes pose and residual.
  const Chain plain;
  RigidMotion from;
  from.X_AB = {{3, 1, -1}, Quaternion{0.5, 0.5, 0.5, 0.5}};
  from.v_AB = {1, 2, 3};
  from.w_AB = {-1, 0, 2};
  Offset blend{Fade::Critical, 0, 0.4, from, plain.motion.in_parent(0, Side::After).X};
  blend.set_residual(Matrix3::Identity(), plain.motion.in_parent(0, Side::After).S);
  const Chain chain{&blend};
  for (const double t : {0.1, 0.5, 0.7, 1.3}) expect_consistent(chain.motion, t);
}

TEST(NodeMotion, BreaksWhereAnyPlayerOrMoveDoes) {
  // The next break is the nearest of the keys of both clips and the end of the user's move; infinity without
  // either.
  Chain chain;
  EXPECT_NEAR(chain.motion.next_break(0), (1 - 0.3 * 1.5) / 1.5, 1e-14);  // player c is at 0.45 s of its clip
  EXPECT_NEAR(chain.motion.next_break(0.5), 1, 1e-14);
  chain.motion.set_move(Offset{Fade::Linear, 0, 0.2, RigidMotion{}, RigidMotion{}});
  EXPECT_EQ(chain.motion.next_break(0), 0.2);
  EXPECT_GT(chain.motion.next_break(0.2), 0.2);
  NodeMotion still;
  still.set_chain(Affine::Identity(), {{.rest = constant_motion(moved({1, 2, 3}))}});
  EXPECT_EQ(still.next_break(0), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(still.is_played());
  EXPECT_TRUE(chain.motion.is_played());
  EXPECT_TRUE(chain.motion.begins_at(-0.3));
  EXPECT_FALSE(chain.motion.begins_at(0.1));
}

}  // namespace
}  // namespace pantin
