#include <gtest/gtest.h>

#include <support/random_affine.hpp>

#include <pantin/scenegraph/rotation.hpp>
#include <pantin/scenegraph/trs.hpp>

namespace pantin {
namespace {

Affine product(const Trs& trs) {
  Affine M = Affine::Identity();
  M.linear() = trs.rotation.toRotationMatrix() * trs.scale.asDiagonal();
  M.translation() = trs.translation;
  return M;
}

TEST(Decompose, GivesFactorsOfTheMatrix) {
  // The product of the factors is the matrix, whatever the signs of the scales; the scale is mirrored in x if
  // at all.
  std::mt19937_64 random{40};
  for (int k = 0; k < 1000; ++k) {
    Trs trs{test::random_vector(random), test::random_rotation(random), test::random_vector(random)};
    if (trs.scale.cwiseAbs().minCoeff() < 0.01) continue;
    const Affine M = product(trs);
    const std::optional<Trs> found = decompose(M);
    ASSERT_TRUE(found);
    ASSERT_LT(test::relative_error(product(*found), M), 1e-14);
    ASSERT_EQ(found->scale.x() < 0, M.linear().determinant() < 0);
    ASSERT_GT(found->scale.y(), 0);
    ASSERT_GT(found->scale.z(), 0);
  }
}

TEST(Decompose, GivesBackPositiveScales) {
  // With positive scales the factors are unique, up to the quaternion's sign.
  std::mt19937_64 random{41};
  const Quaternion q = test::random_rotation(random);
  const std::optional<Trs> found = decompose(product({Vector3{1, 2, 3}, q, Vector3{4, 0.5, 1}}));
  ASSERT_TRUE(found);
  EXPECT_LT((found->scale - Vector3{4, 0.5, 1}).norm(), 1e-14);
  EXPECT_NEAR(std::abs(found->rotation.dot(q)), 1, 1e-15);
}

TEST(Decompose, StandsScalesOfZero) {
  // A flattened node (one, two or three scales 0) still is a product; rotation of the other axes is kept.
  std::mt19937_64 random{42};
  for (const Vector3& scale : {Vector3{2, 0, 1}, Vector3{0, 0, 3}, Vector3{0, 5, 0}, Vector3{0, 0, 0}}) {
    const Affine M = product({Vector3::Zero(), test::random_rotation(random), scale});
    const std::optional<Trs> found = decompose(M);
    ASSERT_TRUE(found);
    EXPECT_LT(test::relative_error(product(*found), M), 1e-14);
    EXPECT_NEAR(found->rotation.norm(), 1, 1e-15);
  }
}

TEST(Decompose, RefusesShearButNotSinglePrecision) {
  // A shear of 1e-5 is no product; rounding all entries to float, as files do, is let pass.
  std::mt19937_64 random{43};
  const Affine M = product({Vector3::Zero(), test::random_rotation(random), Vector3{1, 2, 3}});
  Affine sheared = M;
  sheared.linear().col(1) += 1e-5 * 2 * M.linear().col(0);
  EXPECT_FALSE(decompose(sheared));
  Affine rounded = M;
  rounded.linear() = M.linear().cast<float>().cast<double>();
  EXPECT_TRUE(decompose(rounded));
}

TEST(NearestRotation, LeavesRotationsAlone) {
  // A rotation is nearest to itself, scaled or not.
  std::mt19937_64 random{44};
  for (int k = 0; k < 100; ++k) {
    const Quaternion q = test::random_rotation(random);
    ASSERT_NEAR(std::abs(nearest_rotation(3 * q.toRotationMatrix()).dot(q)), 1, 1e-15);
  }
}

}  // namespace
}  // namespace pantin
