#include <pantin/physics/convex_hull.hpp>

#include <random>

#include <gtest/gtest.h>
#include <support/contracts.hpp>
#include <support/meshes.hpp>
#include <support/near.hpp>

#include <pantin/physics/mesh_integrals.hpp>

namespace pantin {
namespace {

/// The greatest distance of a point outside the hull's planes.
double outside(const TriangleMesh& hull, const std::vector<Vector3>& points) {
  TriangleMesh with_points = hull;
  with_points.vertices.insert(with_points.vertices.end(), points.begin(), points.end());
  return bulge_of(with_points);
}

TEST(ConvexHull, HoldsAllPointsBetweenThem) {
  // What defines it: closed, convex, no point outside, every vertex one of the points, and Euler's count of
  // faces 2 V - 4 for a surface without holes. Clouds, balls, and grids with many points in one face and
  // twice in one place.
  std::mt19937_64 random{31};
  for (int k = 0; k < 60; ++k) {
    std::vector<Vector3> points;
    for (int i = 0; i < 4 + 10 * k; ++i) {
      Vector3 p = test::random_vector(random, 1);
      if (k % 3 == 1) p.normalize();
      if (k % 3 == 2) p = (3 * p).array().round();
      points.push_back(1e-3 * p + Vector3{1, -2, 0.5});
    }
    if (hull_problem(points)) continue;  // four points of a grid may lie in one plane
    const TriangleMesh hull = convex_hull(points);
    EXPECT_EQ(closedness_problem(hull), std::nullopt) << k;
    EXPECT_LT(outside(hull, points), 1e-14) << k;
    EXPECT_EQ(hull.triangles.size(), 2 * hull.vertices.size() - 4) << k;
    for (const Vector3& vertex : hull.vertices)
      EXPECT_NE(std::find(points.begin(), points.end(), vertex), points.end());
  }
}

TEST(ConvexHull, OfABoxFullOfPointsIsTheBox) {
  // All points of a 6 x 6 x 6 grid lie in the box of its corners: volume 2 x 3 x 4.
  std::vector<Vector3> points;
  for (int i = 0; i < 216; ++i) points.emplace_back(0.4 * (i % 6), 0.6 * (i / 6 % 6), 0.8 * (i / 36));
  const TriangleMesh hull = convex_hull(points);
  EXPECT_NEAR(integrals_of(hull).volume, 24, 1e-13);
  EXPECT_LT(hull.vertices.size(), 60U);
}

TEST(ConvexHull, RefusesPointsWithoutVolume) {
  // Too few, in a line, in a plane, all the same, not finite: each with its reason.
  const std::vector<Vector3> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 1e-12}};
  for (std::size_t count = 0; count <= flat.size(); ++count) {
    const auto problem = hull_problem(std::span{flat}.first(count));
    ASSERT_TRUE(problem) << count;
    EXPECT_NE(problem->text.find("the " + std::to_string(count) + " point(s) lie in one plane"),
              std::string::npos);
  }
  EXPECT_TRUE(hull_problem(std::vector<Vector3>(7, Vector3{1, 2, 3})));
  const auto problem = hull_problem(std::vector<Vector3>{{0, 0, 0}, {1, 0, std::nan("")}});
  EXPECT_EQ(problem->code, ProblemCode::NotFinite);
  EXPECT_NE(problem->text.find("point 1"), std::string::npos);
  const test::ThrowOnContract guard;
  EXPECT_THROW(static_cast<void>(convex_hull(flat)), test::ContractError);
}

}  // namespace
}  // namespace pantin
