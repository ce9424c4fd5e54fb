#include <pantin/bridge/derive_mass.hpp>

#include <gtest/gtest.h>

#include "support/meshes.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box_mass;
using test::moved;
using test::scaled;
using test::turned;

/// A scene with known node bodies, none of them bound.
struct Sources {
  Scene scene{};
  std::unordered_map<NodeId, NodeBody> bodies{};
  std::unordered_map<NodeId, bool> bound{};

  DerivedMass derive(NodeId id, const Affine& M_BN = Affine::Identity(), double density = 1000) {
    return derive_mass({scene, bodies, [this](NodeId node) { return bound.contains(node); }}, id, M_BN,
                       density);
  }
};

TEST(DeriveMass, KeepsADeclaredMassUnderScaleAndDeformsItsInertia) {
  // A box of edges (1, 2, 3) whose node is scaled by (2, 1, 0.5) looks like a box of edges (2, 2, 1.5): with
  // the same mass its inertia is the closed form of that box, and its centre of gravity is scaled along.
  Sources s;
  const NodeId id = s.scene.create(s.scene.root(), "a");
  s.bodies[id].mass = box_mass(6, {1, 2, 3}, {1, 1, 1});
  const DerivedMass got = s.derive(id, scaled({2, 1, 0.5}));
  const MassProperties want = box_mass(6, {2, 2, 1.5}, {2, 1, 0.5});
  EXPECT_TRUE(got.known);
  EXPECT_TRUE(got.notes.empty());
  EXPECT_DOUBLE_EQ(got.mass.mass, 6);
  EXPECT_LT((got.mass.p_BBcm - want.p_BBcm).norm(), 1e-15);
  EXPECT_LT((got.mass.I_BBcm_B - want.I_BBcm_B).norm(), 1e-14);
}

TEST(DeriveMass, GivesShapesTheirRealVolumeUnderScale) {
  // A unit cube under a node scaled by (2, 3, 4) has 24 m^3; mirrored it has the same.
  Sources s;
  const NodeId id = s.scene.create(s.scene.root(), "a");
  s.bodies[id].shapes = {Shape{BoxShape{{1, 1, 1}}, Pose{.p = {1, 0, 0}}}};
  for (const double sign : {1.0, -1.0}) {
    const DerivedMass got = s.derive(id, scaled({2 * sign, 3, 4}), 10);
    EXPECT_NEAR(got.mass.mass, 240, 1e-11);
    EXPECT_LT((got.mass.p_BBcm - Vector3{2 * sign, 0, 0}).norm(), 1e-14);
    const MassProperties want = box_mass(240, {2, 3, 4});
    EXPECT_LT((got.mass.I_BBcm_B - want.I_BBcm_B).norm(), 1e-11);
    ASSERT_EQ(got.notes.size(), 1U);
    EXPECT_NE(got.notes[0].problem.find("declares no mass; 240 kg were derived from 1 shape(s) at 10 kg/m^3"),
              std::string::npos)
        << got.notes[0].problem;
  }
}

TEST(DeriveMass, BakesClosedMeshesOfUnboundNodesBelowWithTheirFullPlacement) {
  // A closed cube mesh, sheared by its place below, encloses the same volume as the determinant says; the
  // centre of gravity goes where the affine map takes the cube's centre.
  Sources s;
  const NodeId top = s.scene.create(s.scene.root(), "top");
  Affine shear = Affine::Identity();
  shear.linear() << 1, 0.5, 0, 0, 2, 0, 0, 0, 1;
  const NodeId below = s.scene.create(top, "below", moved({1, 2, 3}) * shear);
  s.bodies[below].meshes = {{"cube",
                             std::make_shared<TriangleMesh>(test::box_mesh({1, 1, 1}, {0.2, 0.3, 0.1})),
                             scaled({1, 1, 2})}};
  const DerivedMass got = s.derive(top, Affine::Identity(), 1);
  const MassProperties cube = mass_of({MeshShape{s.bodies[below].meshes[0].mesh}, Pose{}}, 1);
  EXPECT_NEAR(got.mass.mass, 4 * cube.mass, 1e-13);
  EXPECT_LT((got.mass.p_BBcm - (moved({1, 2, 3}) * shear * scaled({1, 1, 2}) * cube.p_BBcm)).norm(), 1e-14);
}

TEST(DeriveMass, UsesTheBoundingBoxOfAnOpenMeshAndSaysSo) {
  // A cube without one triangle encloses nothing; its box is that of the cube.
  Sources s;
  const NodeId id = s.scene.create(s.scene.root(), "a");
  TriangleMesh open = test::box_mesh({1, 1, 1}, {0.2, 0.3, 0.1});
  open.triangles.pop_back();
  s.bodies[id].meshes = {{"open", std::make_shared<TriangleMesh>(open), Affine::Identity()}};
  const double volume =
      mass_of({MeshShape{std::make_shared<TriangleMesh>(test::box_mesh({1, 1, 1}, {0.2, 0.3, 0.1}))}, Pose{}},
              1)
          .mass;
  const DerivedMass got = s.derive(id, Affine::Identity(), 1);
  EXPECT_NEAR(got.mass.mass, volume, 1e-13);
  EXPECT_NE(got.notes.at(0).problem.find("1 bounding box(es) of meshes that are not closed"),
            std::string::npos);
}

TEST(DeriveMass, ShapesADeclaredMassWithoutInertiaByGeometry) {
  // glTF may give a mass alone: the inertia is that of the shape, scaled to that mass.
  Sources s;
  const NodeId id = s.scene.create(s.scene.root(), "a");
  s.bodies[id].mass = MassProperties{5, Vector3::Zero(), Matrix3::Zero()};
  EXPECT_TRUE(s.derive(id).no_inertia);
  s.bodies[id].shapes = {Shape{BoxShape{{1, 2, 3}}, Pose{}}};
  const DerivedMass got = s.derive(id);
  EXPECT_FALSE(got.no_inertia);
  EXPECT_DOUBLE_EQ(got.mass.mass, 5);
  EXPECT_LT((got.mass.I_BBcm_B - box_mass(5, {1, 2, 3}).I_BBcm_B).norm(), 1e-14);
  EXPECT_NE(got.notes.at(0).problem.find("declares 5 kg but no inertia"), std::string::npos);
}

TEST(DeriveMass, AddsDeclaredMassesOfUnboundNodesBelowAndListsThem) {
  // Two masses on a rod: sum and centre of gravity are those of two points; a bound node below keeps its own.
  Sources s;
  const NodeId top = s.scene.create(s.scene.root(), "top");
  const NodeId left = s.scene.create(top, "left", moved({-1, 0, 0}));
  const NodeId right = s.scene.create(top, "right", moved({3, 0, 0}) * turned(1, {0, 0, 1}));
  const NodeId bound = s.scene.create(right, "bound", moved({100, 0, 0}));
  for (const NodeId id : {left, right, bound}) s.bodies[id].mass = box_mass(2, {1, 1, 1});
  s.bound[bound] = true;
  const DerivedMass got = s.derive(top);
  EXPECT_DOUBLE_EQ(got.mass.mass, 4);
  EXPECT_LT((got.mass.p_BBcm - Vector3{1, 0, 0}).norm(), 1e-15);
  EXPECT_NE(got.notes.at(0).problem.find(
                "carries 4 kg of nodes below that have no body of their own: 'left', 'right'"),
            std::string::npos)
      << got.notes[0].problem;
}

TEST(DeriveMass, KnowsNothingWhereThereIsNothing) {
  // No mass, no shape, no mesh: zero, and said so, not invented.
  Sources s;
  const NodeId id = s.scene.create(s.scene.root(), "a");
  EXPECT_FALSE(s.derive(id).known);
  EXPECT_EQ(s.derive(id).mass.mass, 0);
}

}  // namespace
}  // namespace pantin
