// Local matrices with derivatives, through the products of the channels and through links.
#include <gtest/gtest.h>

#include <support/blends.hpp>

namespace pantin {
namespace {

using test::AnimatedScene;
using test::clip;
using test::expect_derivatives;
using test::random_cubic;
using test::track;
using Matrix3x4 = Eigen::Matrix<double, 3, 4>;

TEST(Motion, IsTranslationTimesRotationTimesScale) {
  // Values at a key, multiplied by hand.
  std::mt19937_64 random{60};
  const Quaternion q = test::random_rotation(random);
  AnimatedScene it{clip({track(Channel::Translation, Interpolation::Step, {0}, {1, 2, 3}),
                         track(Channel::Rotation, Interpolation::Step, {0}, {q.w(), q.x(), q.y(), q.z()}),
                         track(Channel::Scale, Interpolation::Step, {0}, {2, -3, 4})},
                        0)};
  const LocalMotion at = it.player.motion(it.node, 0);
  EXPECT_LT((at.value.leftCols<3>() - q.toRotationMatrix() * Vector3{2, -3, 4}.asDiagonal()).norm(), 1e-14);
  EXPECT_EQ(at.value.col(3), Vector3(1, 2, 3));
  EXPECT_EQ(at.first, Matrix3x4::Zero());
  EXPECT_EQ(at.second, Matrix3x4::Zero());
}

TEST(Motion, SlerpGivesAConstantAngularVelocity) {
  // Turning about z at 2 rad/s with scale 3: R' = w x R, R'' = w x (w x R), in closed form.
  const double quarter = std::cos(0.5);
  AnimatedScene it{clip({track(Channel::Rotation, Interpolation::Linear, {0, 0.5},
                               {1, 0, 0, 0, quarter, 0, 0, std::sin(0.5)})},
                        0.5),
                   {},
                   Affine{Eigen::Scaling(3.0)}};
  const LocalMotion at = it.player.motion(it.node, 0.2);
  const Matrix3 R = Eigen::AngleAxisd{0.4, Vector3::UnitZ()}.toRotationMatrix();
  Matrix3 W = Matrix3::Zero();
  W(1, 0) = 2;
  W(0, 1) = -2;
  EXPECT_LT((at.value.leftCols<3>() - 3 * R).norm(), 1e-14);
  EXPECT_LT((at.first.leftCols<3>() - 3 * W * R).norm(), 1e-13);
  EXPECT_LT((at.second.leftCols<3>() - 3 * W * W * R).norm(), 1e-13);
}

TEST(Motion, ChannelsHaveExactDerivatives) {
  // All three channels vary at once, so that the mixed terms of the product count; any speed, forwards and
  // backwards.
  std::mt19937_64 random{61};
  for (int k = 0; k < 100; ++k) {
    const Clip moving = clip(
        {random_cubic(Channel::Translation, 3, false, random),
         random_cubic(Channel::Rotation, 4, true, random), random_cubic(Channel::Scale, 3, false, random)},
        1);
    AnimatedScene it{moving, {.offset = 0.5, .speed = k % 2 == 0 ? 1.0 : -0.5}};
    expect_derivatives(it.player, it.node, test::uniform(random, -0.4, 0.4));
  }
}

TEST(Motion, LinksHaveExactDerivatives) {
  // Value -> T -> M_PJ T M_JN with sheared frames, for each kind that has a value.
  std::mt19937_64 random{62};
  for (const LinkKind kind : {LinkKind::Pivot, LinkKind::Slider, LinkKind::Ball, LinkKind::Cylindrical,
                              LinkKind::Universal, LinkKind::Planar, LinkKind::Screw, LinkKind::Free})
    for (int k = 0; k < 50; ++k) {
      Scene scene;
      const NodeId node = scene.create(scene.root(), "node");
      Link link;
      link.kind = kind;
      link.axis = test::random_vector(random).normalized();
      link.axis2 = link.axis.cross(test::random_vector(random)).normalized();
      link.pitch = 0.4;
      link.M_PJ = test::random_affine(random);
      link.M_JN = test::random_affine(random);
      link.value = zero_value(kind);
      scene.set_link(node, link);
      const int width = value_size(kind);
      const Clip moving = clip({random_cubic(Channel::LinkValue, width, width > 3, random)}, 1);
      const Player player{scene, moving, {node}, {.speed = 0.5}};
      const double t = test::uniform(random, 0.1, 1.9);
      expect_derivatives(player, node, t);
      const TrackSample value = sample(moving.tracks[0], t / 2);
      const LinkValue numbers{std::span<const double>{value.value.data(), std::size_t(width)}};
      ASSERT_LT((player.motion(node, t).value - local_matrix(link, numbers).affine()).norm(), 1e-13);
    }
}

TEST(Motion, APivotAtConstantRateTurnsAboutItsAxis) {
  // Closed form: angle 3 t about z, the node 2 m out: speed 6 m/s across, acceleration 18 m/s^2 inwards.
  Scene scene;
  const NodeId node = scene.create(scene.root(), "node");
  Link link;
  link.kind = LinkKind::Pivot;
  link.M_JN.translation() = Vector3{2, 0, 0};
  link.value = 0.0;
  scene.set_link(node, link);
  const Player player{
      scene, clip({track(Channel::LinkValue, Interpolation::Linear, {0, 10}, {0, 30})}, 10), {node}};
  const LocalMotion at = player.motion(node, 1);
  const Vector3 out{std::cos(3), std::sin(3), 0};
  const Vector3 across{-std::sin(3), std::cos(3), 0};
  EXPECT_LT((at.value.col(3) - 2 * out).norm(), 1e-14);
  EXPECT_LT((at.first.col(3) - 6 * across).norm(), 1e-14);
  EXPECT_LT((at.second.col(3) + 18 * out).norm(), 1e-13);
}

}  // namespace
}  // namespace pantin
