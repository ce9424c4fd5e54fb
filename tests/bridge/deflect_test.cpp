// Deflectors made from the shapes of nodes (Bridge::deflect).
#include <gtest/gtest.h>

#include <cmath>

#include "support/meshes.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box_mass;
using test::moved;
using test::scaled;
using test::Stage;
using test::turned;

std::string all(const std::vector<Diagnostic>& notes) {
  std::string out;
  for (const Diagnostic& note : notes) out += to_string(note) + '\n';
  return out;
}

/// All triangles, wherever one looks.
class EveryTriangle final : public TriangleIndex {
 public:
  explicit EveryTriangle(const MeshShape& shape) : mesh_{*shape.mesh} {}
  void find(const Vector3&, const Vector3&, std::vector<std::uint32_t>& out) const override {
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) out.push_back(i);
  }
  const TriangleMesh& mesh() const override { return mesh_; }

 private:
  TriangleMesh mesh_;
};

const IndexTriangles kIndex = [](const MeshShape& shape) { return std::make_shared<EveryTriangle>(shape); };

/// The height to which a particle falls that starts at rest 2 m above `p` and is turned back without loss;
/// -infinity where it falls on.
double lowest_above(Stage& s, const Vector3& p) {
  s.physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  const ParticleSystemId system = s.physics.particles().add(ParticleSystemSettings{});
  s.physics.particles().add_particle(system, {.p_WP = p + Vector3{0, 0, 2}});
  double lowest = p.z() + 2;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(s.physics.step(1e-3).ok());
    lowest = std::min(lowest, s.physics.particles().system(system).p_WP(0).z());
  }
  return lowest < p.z() - 1 ? -INFINITY : lowest;
}

TEST(Deflect, BakesScaleMirrorAndPlaceIntoTheDeflector) {
  // Tops of solids in a static node at (1, 2, 3) scaled by s: a ball of 0.5 m by 2 (even, mirrored) ends 1 m
  // up; a box of edge 1 by (1, 1, -3) 1.5 m up; a capsule of 0.2 m and 1 m along z by 2 1.4 m up. The step
  // of 1 ms hides at most v h = 6.3 mm of the lowest point.
  struct Case {
    ShapeGeometry geometry;
    Vector3 scale;
    double top;
    const char* kind;
  };
  for (const Case& c :
       {Case{SphereShape{0.5}, {2, -2, 2}, 1, "sphere"}, Case{BoxShape{{1, 1, 1}}, {1, 1, -3}, 1.5, "box"},
        Case{CapsuleShape{0.2, 1}, {-2, 2, 2}, 1.4, "capsule"}}) {
    Stage s;
    const NodeId id = s.scene.create(s.scene.root(), "solid", moved({1, 2, 3}) * scaled(c.scale));
    s.bridge.set_node_body(id, {.shapes = {Shape{c.geometry}}});
    ASSERT_TRUE(!has_error(s.bridge.fix(id)));
    const Deflected made = s.bridge.deflect(id, {.surface = {.restitution = 1}});
    ASSERT_EQ(made.ids.size(), 1u) << all(made.notes);
    EXPECT_EQ(all(made.notes), "");
    EXPECT_EQ(s.physics.deflectors().kind(made.ids[0]), c.kind);
    EXPECT_EQ(s.physics.deflectors().mount(made.ids[0]).body, s.bridge.body_of(id));
    EXPECT_NEAR(lowest_above(s, {1, 2, 3}), 3 + c.top, 7e-3) << c.kind;
  }
}

TEST(Deflect, TakesShapesOfFollowersAndStopsAtBoundNodes) {
  // A root with a box, an unbound child with a ball, a bound child with another: root and unbound child give
  // two deflectors on the root's body, where the child's place is that in the body.
  Stage s;
  const NodeId root = s.scene.create(s.scene.root(), "root", moved({0, 0, 5}) * turned(0.3, {0, 1, 0}));
  const NodeId child = s.scene.create(root, "child", moved({1, 0, 0}));
  const NodeId bound = s.scene.create(root, "bound", moved({0, 2, 0}));
  s.bridge.set_node_body(root, {.mass = box_mass(1, {1, 1, 1}), .shapes = {Shape{BoxShape{}}}});
  for (const NodeId id : {child, bound}) s.bridge.set_node_body(id, {.shapes = {Shape{SphereShape{0.3}}}});
  for (const NodeId id : {root, bound}) {
    const std::vector<Diagnostic> notes = s.bridge.hand_over(id);
    ASSERT_FALSE(has_error(notes)) << all(notes);
  }
  const Deflected made = s.bridge.deflect(root);
  ASSERT_EQ(made.ids.size(), 2u) << all(made.notes);
  for (const DeflectorId id : made.ids)
    EXPECT_EQ(s.physics.deflectors().mount(id).body, s.bridge.body_of(root));
  EXPECT_LT((s.physics.deflectors().mount(made.ids[1]).X_BD.p - Vector3{1, 0, 0}).norm(), 1e-15);
  // The unbound child by itself stands on the same body at the same place.
  const Deflected alone = s.bridge.deflect(child);
  ASSERT_EQ(alone.ids.size(), 1u);
  EXPECT_EQ(s.physics.deflectors().mount(alone.ids[0]).body, s.bridge.body_of(root));
  EXPECT_LT((s.physics.deflectors().mount(alone.ids[0]).X_BD.p - Vector3{1, 0, 0}).norm(), 1e-15);
}

TEST(Deflect, GoesWithASimulatedBodyAndGivesItMomentum) {
  // A plate of 1 kg floats; a particle of 0.1 kg hits its middle at 2 m/s without loss: momentum of both
  // together stays (to rounding), and the plate moves on downward at 2 * 0.1 / 1.1 * 2 m/s.
  Stage s;
  const NodeId plate = s.scene.create(s.scene.root(), "plate");
  s.bridge.set_node_body(plate, {.mass = box_mass(1, {1, 1, 0.2}), .shapes = {Shape{BoxShape{{1, 1, 0.2}}}}});
  ASSERT_TRUE(!has_error(s.bridge.hand_over(plate)));
  ASSERT_EQ(s.bridge.deflect(plate, {.surface = {.restitution = 1}}).ids.size(), 1u);
  const ParticleSystemId system = s.physics.particles().add(ParticleSystemSettings{.mass = 0.1});
  s.physics.particles().add_particle(system, {.p_WP = {0, 0, 0.3}, .v_WP = {0, 0, -2}});
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(s.physics.step(0.01).ok());
  EXPECT_NEAR(s.physics.body(s.bridge.body_of(plate)).v_WBcm().z(), -0.4 / 1.1, 1e-12);
  // Bodies take their deflectors along when they go.
  s.bridge.release(plate);
  EXPECT_EQ(s.physics.deflectors().size(), 0u);
}

TEST(Deflect, MakesMeshesOfWhatIsShearedAndOfMeshes) {
  // A box under shear keeps its eight corners, moved by the matrix; a mesh under a node has its vertices
  // there too. Particles meet the triangles: the top of the sheared box stays at 0.5.
  Stage s;
  Affine shear = Affine::Identity();
  shear.linear()(0, 2) = 0.5;
  const NodeId box = s.scene.create(s.scene.root(), "box", shear);
  s.bridge.set_node_body(box, {.shapes = {Shape{BoxShape{}}}});
  std::shared_ptr<const TriangleIndex> seen;
  const Deflected made = s.bridge.deflect(
      box,
      {.surface = {.restitution = 1}, .index = [&](const MeshShape& mesh) { return seen = kIndex(mesh); }});
  ASSERT_EQ(made.ids.size(), 1u) << all(made.notes);
  EXPECT_EQ(s.physics.deflectors().kind(made.ids[0]), "mesh");
  EXPECT_FALSE(s.physics.deflectors().mount(made.ids[0]).body);
  EXPECT_EQ(seen->mesh().vertices[7], Vector3(0.75, 0.5, 0.5));
  EXPECT_FALSE(closedness_problem(seen->mesh()));
  EXPECT_NEAR(lowest_above(s, {0.2, 0.1, 0}), 0.5, 7e-3);

  const NodeId node = s.scene.create(s.scene.root(), "node", moved({0, 0, 7}));
  s.bridge.set_node_body(
      node, {.meshes = {{.mesh = std::make_shared<const TriangleMesh>(test::corner_tetrahedron({1, 1, 1})),
                         .M_NS = scaled({2, 2, 2})}}});
  ASSERT_EQ(s.bridge.deflect(node, {.index = [&](const MeshShape& mesh) { return seen = kIndex(mesh); }})
                .ids.size(),
            1u);
  double highest = 0;
  for (const Vector3& p : seen->mesh().vertices) highest = std::max(highest, p.z());
  EXPECT_DOUBLE_EQ(highest, 9);
}

/// What is said of a node with this shape; nothing may be made.
std::string said_of(const ShapeGeometry& geometry, const Affine& M, const DeflectSettings& settings = {}) {
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "thing", M);
  s.bridge.set_node_body(id, {.shapes = {Shape{SphereShape{}}, Shape{geometry}}});
  const Deflected made = s.bridge.deflect(id, settings);
  EXPECT_TRUE(made.ids.empty());
  EXPECT_EQ(s.physics.deflectors().size(), 0u);
  return all(made.notes);
}

TEST(Deflect, RefusesByNameAndMakesNothing) {
  // One text a rule; the ball beside the bad shape is not made either.
  const Affine none = Affine::Identity();
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find("thing"), std::string::npos) << text;
  };
  for (const ShapeGeometry& geometry :
       std::initializer_list<ShapeGeometry>{CylinderShape{}, ConeShape{}, EllipsoidShape{}}) {
    has(said_of(geometry, none), (std::string{kind_of(geometry)} + " has no deflector").c_str());
  }
  has(said_of(SphereShape{}, scaled({1, 1, 2})), "a sphere that is stretched unevenly has no deflector");
  has(said_of(CapsuleShape{}, scaled({1, 1, 2})), "a capsule that is stretched unevenly has no deflector");
  has(said_of(test::mesh_shape(test::box_mesh({1, 1, 1})), none),
      "a deflector of triangles needs an index of them");
  has(said_of(SphereShape{-1}, none), "radius");
  has(said_of(BoxShape{}, none, {.surface = {.restitution = 2}}), "restitution is 2");
  has(said_of(BoxShape{}, scaled({1, 1, 0})), "its matrix is singular, so its shapes are flat");
}

TEST(Deflect, WarnsWhereThereIsNothingToMake) {
  // A node without shapes is no error: a subtree may hold none.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "bare");
  const Deflected made = s.bridge.deflect(id);
  EXPECT_TRUE(made.ids.empty());
  EXPECT_FALSE(has_error(made.notes));
  EXPECT_NE(all(made.notes).find("has no shapes to turn particles back at"), std::string::npos);
}

}  // namespace
}  // namespace pantin
