#include <pantin/bridge/links_to_joints.hpp>

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <pantin/bridge/polar.hpp>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::affine_of;
using test::moved;
using test::scaled;
using test::turned;

Pose body_of(const Affine& M) { return {M.translation(), polar(M.linear()).q}; }

/// Moves the joint to `value` of the link and compares the body with the node that the link moves.
double difference_at(const Link& link, const Affine& M_WP, const LinkValue& value) {
  const Affine M_PN = local_matrix(link, link.value);
  const Pose X_WB = body_of(M_WP * M_PN);
  const std::optional<LinkJoint> joint = joint_of_link(link, {M_WP, M_PN, Pose{}, X_WB});
  EXPECT_TRUE(joint.has_value());
  const Matrix3 S = X_WB.rotation().transpose() * (M_WP * M_PN).linear();
  const Pose X_WB_moved = joint->definition.X_AJ *
                          joint_pose(joint->definition, joint_numbers(value, joint->metres_per_value)) *
                          inverse(joint->definition.X_BJ);
  Affine by_joint = affine_of(X_WB_moved);
  by_joint.linear() *= S;
  return test::relative_difference(by_joint, M_WP * local_matrix(link, value));
}

TEST(LinksToJoints, MoveTheBodyAsTheLinkMovesItsNode) {
  // Under a parent that turns, shifts, scales evenly or mirrors, a link's motion is rigid in the world: the
  // joint must make the same motion, with the same zero and sign, at every value. Tolerance: round-off of a
  // few products.
  const Affine pose = moved({1, -2, 3}) * turned(0.8, {1, 2, -1});
  for (const Affine& M_WP : {Affine::Identity(), pose, pose * scaled({2, 2, 2}), pose * scaled({1, 1, -1}),
                             pose * scaled({-0.5, -0.5, -0.5}), scaled({-1, 1, 1}) * pose}) {
    for (const Vector3& axis : {Vector3{0, 0, 1}, Vector3{0, 1, 0}, Vector3{-1, 0, 0}, Vector3{1, 2, 3}}) {
      Link pivot = test::pivot_link("p", moved({0.1, 0.2, 0.3}) * turned(0.3, {0, 1, 1}), axis, 0.4);
      pivot.M_JN = moved({0.5, 0, 0.1}) * turned(0.2, {1, 0, 0});
      for (const double value : {-2.0, 0.0, 0.4, 1.7})
        EXPECT_LT(difference_at(pivot, M_WP, value), 1e-14) << value;
      Link slider = test::slider_link("s", pivot.M_PJ, axis, -0.6);
      slider.M_JN = pivot.M_JN;
      for (const double value : {-2.0, 0.0, 1.7})
        EXPECT_LT(difference_at(slider, M_WP, value), 1e-14) << value;
    }
  }
}

TEST(LinksToJoints, MoveTheBodyAsLinksOfSeveralNumbersDo) {
  // The same for the kinds with two axes, with a pitch or with several numbers; uneven scale is left out,
  // where a node's turn is no rotation.
  const Affine pose = moved({1, -2, 3}) * turned(0.8, {1, 2, -1});
  for (const Affine& M_WP : {Affine::Identity(), pose, pose * scaled({2, 2, 2}), pose * scaled({1, 1, -1}),
                             pose * scaled({-0.5, -0.5, -0.5}), scaled({-1, 1, 1}) * pose}) {
    for (const LinkKind kind :
         {LinkKind::Cylindrical, LinkKind::Universal, LinkKind::Planar, LinkKind::Screw}) {
      Link link{.kind = kind, .name = "l", .M_PJ = moved({0.1, 0.2, 0.3}) * turned(0.3, {0, 1, 1})};
      link.M_JN = moved({0.5, 0, 0.1}) * turned(0.2, {1, 0, 0});
      link.axis = Vector3{1, 2, 2} / 3;
      link.axis2 = Vector3{2, 1, -2} / 3;
      link.pitch = 0.1;
      const LinkValue value{0.4, -1.1, 2.0}, start{-0.2, 0.3, 0.5};
      const auto size = static_cast<std::size_t>(value_size(kind));
      link.value = LinkValue{start.numbers().first(size)};
      EXPECT_LT(difference_at(link, M_WP, LinkValue{value.numbers().first(size)}), 2e-14) << to_string(kind);
      EXPECT_LT(difference_at(link, M_WP, link.value), 2e-14) << to_string(kind);
    }
  }
}

TEST(LinksToJoints, NumbersGoBothWays) {
  // joint_numbers and link_value are inverses, at scales of any sign; of two quaternions the nearer is given.
  const std::array<double, 3> scale{2, -0.5, 1};
  const LinkValue value{0.3, 0.4, 0.5};
  EXPECT_EQ(link_value(joint_numbers(value, scale), scale, value), value);
  const LinkValue q{0.6, 0, 0, 0.8}, opposite{-0.6, 0, 0, -0.8};
  EXPECT_EQ(link_value(joint_numbers(q, scale), scale, q), q);
  EXPECT_EQ(link_value(joint_numbers(q, scale), scale, opposite), opposite);
}

TEST(LinksToJoints, SlidersMoveByTheScaledAxisUnderAnyParent) {
  // A translation stays a translation under scale and shear: by L n for each unit of value.
  Affine M_WP = moved({1, 2, 3}) * turned(0.5, {1, 1, 0}) * scaled({0.5, 2, -3});
  M_WP.linear() *= Matrix3{{1, 0.3, 0}, {0, 1, -0.4}, {0, 0, 1}};
  const Link slider = test::slider_link("s", turned(0.7, {0, 0, 1}), {1, 2, 2}, 0.3);
  EXPECT_LT(difference_at(slider, M_WP, -1.2), 1e-14);
}

TEST(LinksToJoints, PivotsTurnAboutTheLineThatStaysUnderAnyParent) {
  // Under shear the node's motion is not rigid, but its fixed line is: points on it must stay when the joint
  // turns.
  Affine M_WP = moved({1, 2, 3}) * scaled({0.5, 2, 1});
  M_WP.linear() *= Matrix3{{1, 0.3, 0}, {0, 1, -0.4}, {0, 0, 1}};
  const Link link = test::pivot_link("p", moved({0, 1, 0}), {1, 2, 2});
  const Affine M_PN = local_matrix(link, link.value);
  const std::optional<LinkJoint> joint = joint_of_link(link, {M_WP, M_PN, Pose{}, body_of(M_WP * M_PN)});
  for (const double along : {-1.0, 0.0, 2.5}) {
    const Vector3 p_W = M_WP * (link.M_PJ * Vector3{along * link.axis});
    const Vector3 p_J = inverse(joint->definition.X_AJ) * p_W;
    EXPECT_LT(p_J.head<2>().norm(), 1e-14);
  }
}

TEST(LinksToJoints, BallsKeepTheirQuaternion) {
  // The relative rotation of the joint's two frames at the present pose is the link's value, evenly scaled or
  // mirrored.
  const Quaternion q = Quaternion{0.5, 0.1, -0.7, 0.3}.normalized();
  Link link{.kind = LinkKind::Ball, .M_PJ = turned(0.4, {1, 0, 1}), .value = {q.w(), q.x(), q.y(), q.z()}};
  for (const double s : {1.0, 3.0, -2.0}) {
    const Affine M_WP = turned(1.1, {1, 2, 3}) * scaled({s, s, s});
    const Affine M_PN = local_matrix(link, link.value);
    const Pose X_WB = body_of(M_WP * M_PN);
    const LinkJoint joint = *joint_of_link(link, {M_WP, M_PN, Pose{}, X_WB});
    const Quaternion got = joint.definition.X_AJ.q.conjugate() * (X_WB.q * joint.definition.X_BJ.q);
    EXPECT_LT(got.angularDistance(q), 1e-14);
    const Affine moved_node = M_WP * local_matrix(link, LinkValue{1, 0, 0, 0});
    const Pose X_WB_zero = joint.definition.X_AJ * inverse(joint.definition.X_BJ);
    EXPECT_LT(X_WB_zero.q.angularDistance(body_of(moved_node).q), 1e-14);
  }
}

TEST(LinksToJoints, RefusesAParentThatIsFlat) {
  // Without an image of the axis there is no joint.
  const Link link = test::pivot_link("p", Affine::Identity(), {0, 0, 1});
  EXPECT_FALSE(joint_of_link(link, {scaled({1, 1, 0}), Affine::Identity(), Pose{}, Pose{}}).has_value());
}

TEST(LinksToJoints, MeasuresAMatrixThatTheLinkCannotMake) {
  // A clip may move a linked node off its link; the misfit is what is left over, and the pose is still the
  // joint's.
  const Link link = test::pivot_link("p", Affine::Identity(), {0, 0, 1});
  const Affine M_PN = moved({0, 0, 0.1}) * turned(0.5, {0, 0, 1});
  const LinkJoint joint = *joint_of_link(link, {Affine::Identity(), M_PN, Pose{}, body_of(M_PN)});
  EXPECT_NEAR(joint.misfit, 0.1, 1e-12);
  EXPECT_NEAR(joint.value[0], 0.5, 1e-15);
}

}  // namespace
}  // namespace pantin
