#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <support/expect_contract.hpp>
#include <support/random_affine.hpp>

#include <pantin/scenegraph/link.hpp>

namespace pantin {
namespace {

/// A link with sheared, scaled and mirrored frames on both sides of the joint.
Link random_link(LinkKind kind, std::mt19937_64& random) {
  Link link;
  link.kind = kind;
  link.axis = test::random_vector(random).normalized();
  link.axis2 = link.axis.cross(test::random_vector(random)).normalized();
  link.pitch = test::uniform(random, -0.3, 0.3);
  link.M_PJ = test::random_affine(random);
  link.M_JN = test::random_affine(random);
  link.value = zero_value(kind);
  return link;
}

LinkValue random_value(LinkKind kind, std::mt19937_64& random) {
  const Quaternion q = test::random_rotation(random);
  const Vector3 t = test::random_vector(random);
  switch (kind) {
    case LinkKind::Fixed:
      return {};
    case LinkKind::Pivot:
    case LinkKind::Slider:
    case LinkKind::Screw:
      return test::uniform(random, -20, 20);
    case LinkKind::Cylindrical:
    case LinkKind::Universal:
      return {20 * t.x(), 20 * t.y()};
    case LinkKind::Planar:
      return {20 * t.x(), 20 * t.y(), 20 * t.z()};
    case LinkKind::Ball:
      return {q.w(), q.x(), q.y(), q.z()};
    case LinkKind::Free:
      return {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()};
  }
  return {};
}

double greatest_difference(const LinkValue& a, const LinkValue& b) {
  double greatest = 0;
  for (int i = 0; i < a.size(); ++i) greatest = std::max(greatest, std::abs(a[i] - b[i]));
  return greatest;
}

TEST(FitLink, GivesBackTheValue) {
  // Value -> matrix -> value, near to the value itself, so turns and signs are kept too. Frames have
  // conditions below 100, so inverses cost two digits of 1e-16 times the size of the value.
  std::mt19937_64 random{21};
  for (const LinkKind kind :
       {LinkKind::Fixed, LinkKind::Pivot, LinkKind::Slider, LinkKind::Ball, LinkKind::Cylindrical,
        LinkKind::Universal, LinkKind::Planar, LinkKind::Screw, LinkKind::Free})
    for (int k = 0; k < 500; ++k) {
      const Link link = random_link(kind, random);
      const LinkValue value = random_value(kind, random);
      const LinkFit fit = fit_link(link, local_matrix(link, value), value);
      ASSERT_EQ(fit.value.size(), value.size());
      ASSERT_LT(greatest_difference(fit.value, value), 2e-12) << to_string(kind);
      ASSERT_LT(fit.residual, 2e-12);
    }
}

TEST(FitLink, KeepsWholeTurns) {
  // A matrix does not know turns: the angle is the one within half a turn of where the link was.
  Link link;
  link.kind = LinkKind::Pivot;
  const double turn = 2 * std::numbers::pi;
  for (const double turns : {-1000.0, -1.0, 0.0, 3.0}) {
    const Affine M = local_matrix(link, 0.7 + turns * turn);
    EXPECT_NEAR(fit_link(link, M, 0.5 + turns * turn).value[0], 0.7 + turns * turn,
                1e-12 * (1 + std::abs(turns)));
    EXPECT_NEAR(fit_link(link, M, 0.7 + (turns + 0.49) * turn).value[0], 0.7 + turns * turn, 1e-11);
    EXPECT_NEAR(fit_link(link, M, 0.7 + (turns + 0.51) * turn).value[0], 0.7 + (turns + 1) * turn, 1e-11);
  }
}

TEST(FitLink, KeepsTheSignOfAQuaternion) {
  // q and -q are one rotation; the one nearer to the value before is given.
  Link link;
  link.kind = LinkKind::Ball;
  const Affine M = local_matrix(link, {0.6, 0.8, 0, 0});
  EXPECT_LT(greatest_difference(fit_link(link, M, {1, 0, 0, 0}).value, {0.6, 0.8, 0, 0}), 1e-15);
  EXPECT_LT(greatest_difference(fit_link(link, M, {-1, 0, 0, 0}).value, {-0.6, -0.8, 0, 0}), 1e-15);
}

TEST(FitLink, MeasuresWhatItDoesNotExplain) {
  // A slider pushed 0.3 along its axis and 0.4 across: the residual is the part across. Fixed explains
  // nothing.
  Link link;
  link.kind = LinkKind::Slider;
  link.axis = Vector3::UnitX();
  const Affine M{Eigen::Translation3d{0.3, 0.4, 0}};
  const LinkFit slider = fit_link(link, M, 0.0);
  EXPECT_DOUBLE_EQ(slider.value[0], 0.3);
  EXPECT_DOUBLE_EQ(slider.residual, 0.4);
  link.kind = LinkKind::Fixed;
  EXPECT_DOUBLE_EQ(fit_link(link, M, {}).residual, 0.4);
}

TEST(FitLink, FindsTheNearestPivotAngle) {
  // The angle minimises the distance to a matrix that is no pivot's: no angle a little to either side is
  // nearer, nor any of a hundred around the circle.
  std::mt19937_64 random{22};
  for (int k = 0; k < 200; ++k) {
    Link link;
    link.kind = LinkKind::Pivot;
    link.axis = test::random_vector(random).normalized();
    const Affine M = test::random_affine(random);
    const double angle = fit_link(link, M, 0.0).value[0];
    const auto distance = [&](double a) { return (local_matrix(link, a).linear() - M.linear()).norm(); };
    for (int step = 1; step < 100; ++step)
      ASSERT_LE(distance(angle), distance(angle + step * 0.0628) + 1e-14);
    ASSERT_LE(distance(angle), distance(angle + 1e-4) + 1e-14);
    ASSERT_LE(distance(angle), distance(angle - 1e-4) + 1e-14);
  }
}

TEST(FitLink, ReadsTheTurnsOfAScrewFromItsPlace) {
  // 100 turns of a thread are 100 pitches away: the value is found whatever one is near to. Without pitch a
  // screw is a pivot, whose turns only the neighbour tells.
  Link link;
  link.kind = LinkKind::Screw;
  link.pitch = -0.002;
  const double angle = 200 * std::numbers::pi + 0.3;
  EXPECT_NEAR(fit_link(link, local_matrix(link, angle), 0.0).value[0], angle, 1e-12 * angle);
  link.pitch = 0;
  EXPECT_NEAR(fit_link(link, local_matrix(link, angle), 0.0).value[0], 0.3, 1e-12);
}

TEST(FitLink, FindsTheNearestScrewAndUniversalAngles) {
  // Of a matrix that no value makes, none of the values around the one found is nearer (rotation and
  // translation entries alike for the screw).
  std::mt19937_64 random{25};
  for (int k = 0; k < 200; ++k) {
    Link link = random_link(k % 2 == 0 ? LinkKind::Screw : LinkKind::Universal, random);
    link.M_PJ = link.M_JN = Affine::Identity();
    const Affine M = test::random_affine(random);
    const LinkValue found = fit_link(link, M, link.value).value;
    const auto distance = [&](const LinkValue& v) {
      return (local_matrix(link, v).matrix() - M.matrix()).norm();
    };
    for (const double step : {1e-4, 1e-2, 0.2})
      for (int i = 0; i < found.size(); ++i)
        for (const double sign : {-1.0, 1.0}) {
          // A screw's other parts of the matrix do not depend on it; its translation across is left over.
          LinkValue other = found;
          other[i] += sign * step;
          ASSERT_LE(distance(found), distance(other) + 1e-13) << to_string(link.kind) << " " << step;
        }
  }
}

TEST(FitLink, FindsTheNearestRotation) {
  // For a ball the rotation minimises the distance to any matrix, mirrored ones too; small and large turns
  // away from it are never nearer.
  std::mt19937_64 random{23};
  for (int k = 0; k < 200; ++k) {
    Link link;
    link.kind = LinkKind::Ball;
    const Affine M = test::random_affine(random);
    const LinkFit fit = fit_link(link, M, zero_value(link.kind));
    const Matrix3 R = local_matrix(link, fit.value).linear();
    ASSERT_NEAR(R.determinant(), 1, 1e-14);
    for (int j = 0; j < 50; ++j) {
      const double angle = j % 2 == 0 ? 1e-3 : 1.0;
      const Matrix3 turn =
          Eigen::AngleAxisd{angle, test::random_vector(random).normalized()}.toRotationMatrix();
      ASSERT_LE((R - M.linear()).norm(), (turn * R - M.linear()).norm() + 1e-14);
    }
  }
}

TEST(FitLink, KeepsTheAngleWhereTheMatrixSaysNothing) {
  // Half a turn about an axis across the pivot's is equally far from every angle of the pivot.
  Link link;
  link.kind = LinkKind::Pivot;
  Affine M = Affine::Identity();
  M.linear() = Vector3{1, -1, -1}.asDiagonal();
  EXPECT_EQ(fit_link(link, M, 1.25).value[0], 1.25);
}

TEST(FitLink, RefusesAnUnfitNeighbour) {
  // The value to be near to has the size that the kind has.
  Link link;
  link.kind = LinkKind::Ball;
  test::expect_contract([&] { static_cast<void>(fit_link(link, Affine::Identity(), 1.0)); },
                        "the value to be near to: a ball link's value has 4 numbers, not 1");
}

}  // namespace
}  // namespace pantin
