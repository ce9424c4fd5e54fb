#include <pantin/physics/shape.hpp>

#include <limits>

#include <gtest/gtest.h>
#include <support/meshes.hpp>
#include <support/problems.hpp>

namespace pantin {
namespace {

using test::expect_problem;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Shape, KnowsTheNameOfItsKind) {
  // The names of the header, in the order of the variant.
  EXPECT_EQ(kind_of(SphereShape{}), "sphere");
  EXPECT_EQ(kind_of(BoxShape{}), "box");
  EXPECT_EQ(kind_of(CapsuleShape{}), "capsule");
  EXPECT_EQ(kind_of(CylinderShape{}), "cylinder");
  EXPECT_EQ(kind_of(MeshShape{}), "mesh");
  EXPECT_EQ(kind_of(ConeShape{}), "cone");
  EXPECT_EQ(kind_of(EllipsoidShape{}), "ellipsoid");
  EXPECT_EQ(kind_of(ConvexShape{}), "convex");
  EXPECT_EQ(kind_of(CompoundShape{}), "compound");
}

TEST(ShapeProblem, NothingWithGoodShapes) {
  // Defaults are shapes, a capsule may have no length, a mesh may be scaled, mirrored and open (its mass may
  // be given).
  EXPECT_FALSE(problem_with({SphereShape{}, {}}));
  EXPECT_FALSE(problem_with({BoxShape{}, {}}));
  EXPECT_FALSE(problem_with({CapsuleShape{1, 0}, {}}));
  EXPECT_FALSE(problem_with({CylinderShape{}, {}}));
  TriangleMesh open = test::box_mesh({1, 1, 1});
  open.triangles.pop_back();
  EXPECT_FALSE(problem_with({test::mesh_shape(open, {-1, 2, 1e-3}), {}}));
}

TEST(ShapeProblem, NothingWithConvexHullsAndCompounds) {
  // A box is convex, scaled and mirrored too; a compound holds any other shapes.
  const ConvexShape box{std::make_shared<const TriangleMesh>(test::box_mesh({1, 2, 3})), {-1, 2, 3}};
  EXPECT_FALSE(problem_with({box, {}}));
  EXPECT_FALSE(problem_with({ConeShape{}, {}}));
  EXPECT_FALSE(problem_with({EllipsoidShape{}, {}}));
  const CompoundShape both{
      std::make_shared<const std::vector<Shape>>(std::vector<Shape>{{box, {}}, {ConeShape{}, {}}})};
  EXPECT_FALSE(problem_with({both, {}}));
}

// One test a message.

TEST(ShapeProblem, SaysWhatIsWrongWithAConeOrEllipsoid) {
  // Each size is looked at.
  expect_problem(problem_with({ConeShape{0, 1}, {}}), ProblemCode::OutOfRange, "cone: radius is 0 m");
  expect_problem(problem_with({ConeShape{1, -1}, {}}), ProblemCode::OutOfRange, "cone: length is -1 m");
  expect_problem(problem_with({EllipsoidShape{{0, 1, 1}}, {}}), ProblemCode::OutOfRange,
                 "ellipsoid: radius along x is 0 m");
  expect_problem(problem_with({EllipsoidShape{{1, 1, kNaN}}, {}}), ProblemCode::NotFinite,
                 "ellipsoid: radius along z is nan m");
}

TEST(ShapeProblem, SaysWhereAHullIsNotConvexOrNotClosed) {
  // An L of two boxes: the far corner of one is one metre outside the plane of the other's side.
  const auto shared = [](const TriangleMesh& mesh) { return std::make_shared<const TriangleMesh>(mesh); };
  const TriangleMesh angle = test::joined(test::box_mesh({2, 1, 1}), test::box_mesh({1, 3, 1}, {1.5, 1, 0}));
  expect_problem(problem_with({ConvexShape{shared(angle)}, {}}), ProblemCode::OutOfRange,
                 "m outside the plane of a triangle");
  TriangleMesh open = test::box_mesh({1, 1, 1});
  open.triangles.pop_back();
  expect_problem(problem_with({ConvexShape{shared(open)}, {}}), ProblemCode::NotClosed, "one side only");
  expect_problem(problem_with({ConvexShape{}, {}}), ProblemCode::OutOfRange, "there are no triangles");
}

TEST(ShapeProblem, SaysWhichPartOfACompoundIsWrong) {
  // Without parts, of compounds, with a bad part: the part is named.
  const auto of = [](std::vector<Shape> parts) {
    return CompoundShape{std::make_shared<const std::vector<Shape>>(std::move(parts))};
  };
  expect_problem(problem_with({CompoundShape{}, {}}), ProblemCode::OutOfRange,
                 "compound: there are no parts");
  expect_problem(problem_with({of({}), {}}), ProblemCode::OutOfRange, "compound: there are no parts");
  expect_problem(problem_with({of({{SphereShape{}, {}}, {of({{SphereShape{}, {}}}), {}}}), {}}),
                 ProblemCode::OutOfRange, "compound: part 1: it is a compound itself");
  expect_problem(problem_with({of({{SphereShape{-1}, {}}}), {}}), ProblemCode::OutOfRange,
                 "compound: part 0: sphere: radius is -1 m");
}

TEST(ShapeProblem, SaysWhereARadiusIsNotPositive) {
  // A sphere, capsule or cylinder of no or negative radius has no volume.
  expect_problem(problem_with({SphereShape{0}, {}}), ProblemCode::OutOfRange, "sphere: radius is 0 m");
  expect_problem(problem_with({CapsuleShape{-1, 1}, {}}), ProblemCode::OutOfRange, "capsule: radius is -1 m");
  expect_problem(problem_with({CylinderShape{-2, 1}, {}}), ProblemCode::OutOfRange,
                 "cylinder: radius is -2 m");
}

TEST(ShapeProblem, SaysWhereALengthIsNotPositive) {
  // A cylinder needs a height, a capsule only none below zero.
  expect_problem(problem_with({CylinderShape{1, 0}, {}}), ProblemCode::OutOfRange, "cylinder: length is 0 m");
  expect_problem(problem_with({CapsuleShape{1, -1}, {}}), ProblemCode::OutOfRange, "capsule: length is -1 m");
}

TEST(ShapeProblem, SaysWhereABoxHasNoSize) {
  // Each edge is looked at.
  expect_problem(problem_with({BoxShape{{0, 1, 1}}, {}}), ProblemCode::OutOfRange,
                 "box: size along x is 0 m");
  expect_problem(problem_with({BoxShape{{1, -1, 1}}, {}}), ProblemCode::OutOfRange,
                 "box: size along y is -1 m");
  expect_problem(problem_with({BoxShape{{1, 1, -2}}, {}}), ProblemCode::OutOfRange,
                 "box: size along z is -2 m");
}

TEST(ShapeProblem, SaysWhereASizeIsNotFinite) {
  // NaN is neither above nor below zero and must not slip through a comparison.
  expect_problem(problem_with({SphereShape{kNaN}, {}}), ProblemCode::NotFinite, "sphere: radius is nan m");
  expect_problem(problem_with({CapsuleShape{1, kNaN}, {}}), ProblemCode::NotFinite,
                 "capsule: length is nan m");
}

TEST(ShapeProblem, SaysWhereThereIsNoMesh) {
  // Neither a null mesh nor one without triangles is a surface.
  expect_problem(problem_with({MeshShape{}, {}}), ProblemCode::OutOfRange, "there are no triangles");
  expect_problem(problem_with({test::mesh_shape({}), {}}), ProblemCode::OutOfRange, "there are no triangles");
}

TEST(ShapeProblem, SaysWhereAScaleIsZero) {
  // A scale of zero flattens the mesh.
  expect_problem(problem_with({test::mesh_shape(test::box_mesh({1, 1, 1}), {1, 0, 1}), {}}),
                 ProblemCode::OutOfRange, "mesh: scale is (1, 0, 1)");
}

TEST(ShapeProblem, SaysWhereAScaleIsNotFinite) {
  // As above, for NaN.
  expect_problem(problem_with({test::mesh_shape(test::box_mesh({1, 1, 1}), {1, kNaN, 1}), {}}),
                 ProblemCode::NotFinite, "mesh: scale is (1, nan, 1)");
}

TEST(ShapeProblem, SaysWhereAPositionIsNotFinite) {
  // The subject is the kind of the shape.
  expect_problem(problem_with({BoxShape{}, {.p = {kNaN, 0, 0}}}), ProblemCode::NotFinite,
                 "box: position is (nan, 0, 0) m");
}

TEST(ShapeProblem, SaysWhereAnOrientationIsNotOfUnitLength) {
  // 1e-9 is allowed, 1e-6 is not a rounding.
  const Pose nearly{.q = Quaternion{1 + 1e-10, 0, 0, 0}}, off{.q = Quaternion{1 + 1e-6, 0, 0, 0}};
  EXPECT_FALSE(problem_with({SphereShape{}, nearly}));
  expect_problem(problem_with({SphereShape{}, off}), ProblemCode::NotUnit,
                 "sphere: orientation is (1.000001, 0, 0, 0)");
}

TEST(ShapeProblem, SaysWhereAnOrientationIsNotFinite) {
  // As above, for NaN.
  expect_problem(problem_with({SphereShape{}, {.q = Quaternion{kNaN, 0, 0, 0}}}), ProblemCode::NotFinite,
                 "sphere: orientation is (nan, 0, 0, 0)");
}

TEST(Closedness, HoldsForSolids) {
  // Closed surfaces by construction.
  EXPECT_FALSE(closedness_problem(test::box_mesh({1, 2, 3})));
  EXPECT_FALSE(closedness_problem(test::corner_tetrahedron({1, 1, 1})));
  EXPECT_FALSE(closedness_problem(test::ball_mesh(1, 3)));
}

TEST(Closedness, WeldsVerticesAtTheSamePlace) {
  // Files that give each triangle three vertices of its own describe the same solid; 0 and -0 are one place.
  const TriangleMesh box = test::box_mesh({1, 1, 1}, {0.5, 0.5, 0.5});
  TriangleMesh soup;
  for (const std::array<std::uint32_t, 3>& t : box.triangles) {
    const std::uint32_t first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t k : t) soup.vertices.push_back(box.vertices[k]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  soup.vertices[0] = soup.vertices[0].unaryExpr([](double x) { return x == 0 ? -0.0 : x; });
  EXPECT_FALSE(closedness_problem(soup));
}

TEST(Closedness, HoldsWhereSolidsTouchAlongAnEdge) {
  // Four triangles share an edge, two of each sense: the volumes on both sides are still bounded.
  EXPECT_FALSE(
      closedness_problem(test::joined(test::box_mesh({1, 1, 1}), test::box_mesh({1, 1, 1}, {1, 1, 0}))));
}

TEST(Closedness, HoldsWithTrianglesWithoutArea) {
  // A triangle with two corners at one place bounds nothing and opens nothing.
  TriangleMesh mesh = test::box_mesh({1, 1, 1});
  mesh.triangles.push_back({0, 0, 1});
  EXPECT_FALSE(closedness_problem(mesh));
}

TEST(Closedness, HoldsForThinPlatesAndNeedlesAndFarAway) {
  // No volume means none beyond rounding, not a small one.
  EXPECT_FALSE(closedness_problem(test::box_mesh({1, 1, 1e-6})));
  EXPECT_FALSE(closedness_problem(test::box_mesh({1, 1e-6, 1e-6})));
  EXPECT_FALSE(closedness_problem(test::box_mesh({1, 1, 1}, {1e7, 1e7, 1e7})));
}

TEST(ClosednessProblem, NamesAnOpenEdge) {
  // Without its last triangle (1, 7, 5) the box is open along 1-7, 5-7 and 1-5; the first in order is named.
  TriangleMesh mesh = test::box_mesh({1, 1, 1});
  mesh.triangles.pop_back();
  expect_problem(
      closedness_problem(mesh), ProblemCode::NotClosed,
      "edge from vertex 1 at (0.5, -0.5, -0.5) to vertex 5 at (0.5, -0.5, 0.5) has a triangle on one side");
}

TEST(ClosednessProblem, NamesAnEdgeBetweenOppositeWindings) {
  // One triangle turned round runs along its edges as its neighbours do.
  TriangleMesh mesh = test::box_mesh({1, 1, 1});
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  expect_problem(closedness_problem(mesh), ProblemCode::NotClosed, "run along it in the same sense");
}

TEST(ClosednessProblem, SaysWhereNothingIsEnclosed) {
  // A triangle and its back are closed and flat; tilted, so that the volume is only zero up to rounding.
  const TriangleMesh flat{{{0.1, 0.2, 0.3}, {1.3, 0.7, 0.2}, {0.4, 1.9, 0.8}, {1.6, 2.4, 0.7}},
                          {{0, 1, 2}, {2, 1, 3}, {0, 2, 1}, {2, 3, 1}}};
  expect_problem(closedness_problem(flat), ProblemCode::NotClosed, "enclose no volume");
  expect_problem(closedness_problem({}), ProblemCode::NotClosed, "its 0 triangles enclose no volume");
}

TEST(ClosednessProblem, SaysWhereTrianglesFaceInward) {
  // The volume of a unit box turned inside out is -1.
  const std::optional<SettingsProblem> problem =
      closedness_problem(test::turned_inside_out(test::box_mesh({1, 1, 1})));
  expect_problem(problem, ProblemCode::NotClosed, "face inward, their volume is -1 m^3");
  EXPECT_EQ(problem->remedy, "swap two indices of every triangle");
}

TEST(ClosednessProblem, SaysWhereAnIndexIsOutOfRange) {
  // Vertex 8 of 8 does not exist; also found by problem_with.
  TriangleMesh mesh = test::box_mesh({1, 1, 1});
  mesh.triangles[3][1] = 8;
  expect_problem(closedness_problem(mesh), ProblemCode::OutOfRange, "triangle 3 names vertex 8 of 8");
  expect_problem(problem_with({test::mesh_shape(mesh), {}}), ProblemCode::OutOfRange,
                 "triangle 3 names vertex 8 of 8");
}

TEST(ClosednessProblem, SaysWhereAVertexIsNotFinite) {
  // NaN has no place in an order, so it must be found before vertices are sorted; also found by problem_with.
  TriangleMesh mesh = test::box_mesh({1, 1, 1});
  mesh.vertices[6].x() = kNaN;
  expect_problem(closedness_problem(mesh), ProblemCode::NotFinite, "vertex 6 is (nan,");
  expect_problem(problem_with({test::mesh_shape(mesh), {}}), ProblemCode::NotFinite, "vertex 6 is (nan,");
}

}  // namespace
}  // namespace pantin
