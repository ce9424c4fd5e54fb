// The shipped arm, read and compared with numbers worked out by hand from its text.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include <pantin/bridge/loaders/load_model.hpp>
#include <pantin/bridge/loaders/load_urdf.hpp>

namespace pantin {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRound = 1e-15;  ///< a few roundings of numbers below 1

const Model& arm() {
  static const Loaded<Model> loaded = load_urdf(PANTIN_SOURCE_DIR "/assets/arm.urdf");
  if (!loaded.value) throw std::runtime_error{to_string(loaded.notes.at(0))};
  return *loaded.value;
}

const ModelNode& node(const std::string& name) {
  for (const ModelNode& n : arm().nodes) {
    if (n.name == name) return n;
  }
  throw std::out_of_range{name};
}

TEST(ArmUrdf, HasOneNodeForEveryLinkParentsFirst) {
  // The file's tree: the two fingers hang on the palm, everything else is a chain; brothers in the order of
  // the file.
  const std::vector<std::pair<std::string, int>> expected{
      {"base", -1}, {"turret", 0}, {"upper_arm", 1}, {"forearm", 2},     {"wrist", 3},
      {"hand", 4},  {"flange", 5}, {"palm", 6},      {"finger_left", 7}, {"finger_right", 7}};
  ASSERT_EQ(arm().nodes.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(arm().nodes[i].name, expected[i].first);
    EXPECT_EQ(arm().nodes[i].parent, expected[i].second);
  }
  EXPECT_EQ(arm().name, "arm");
  EXPECT_EQ(arm().format, "urdf");
  EXPECT_EQ(arm().up_axis, UpAxis::Z);
  EXPECT_EQ(arm().unit_m, 1);
  EXPECT_TRUE(arm().clips.empty());
  EXPECT_EQ(node("turret").place, PANTIN_SOURCE_DIR "/assets/arm.urdf:29");
}

TEST(ArmUrdf, TurnsInertiaIntoAxesOfTheLink) {
  // base: diag(a, b, c) turned by 45 degrees about z is [(a+b)/2, (a-b)/2] in the xy block.
  // wrist: diag(a, b, c) turned by t about y has xx = a cos^2 t + c sin^2 t and xz = (c - a) sin t cos t.
  const MassProperties& base = *node("base").mass;
  EXPECT_EQ(base.mass, 6.0);
  EXPECT_EQ(base.p_BBcm, Vector3(0, 0, 0.045));
  Matrix3 I;
  I << 0.028, 0.002, 0, 0.002, 0.028, 0, 0, 0, 0.046;
  EXPECT_LT((base.I_BBcm_B - I).cwiseAbs().maxCoeff(), kRound);

  const double s = std::sin(0.4);
  const double c = std::cos(0.4);
  const double a = 0.0017;
  const double e = 0.0012;
  I << a * c * c + e * s * s, 0, (e - a) * s * c, 0, 0.0018, 0, (e - a) * s * c, 0, a * s * s + e * c * c;
  EXPECT_LT((node("wrist").mass->I_BBcm_B - I).cwiseAbs().maxCoeff(), kRound);
}

TEST(ArmUrdf, ReadsRollPitchYawAsTurnsAboutFixedAxes) {
  // URDF: first roll about x, then pitch about y, then yaw about z of the parent: R = Rz Ry Rx, and I = R I
  // R^T.
  const Matrix3 R = (Eigen::AngleAxisd{0.3, Vector3::UnitZ()} * Eigen::AngleAxisd{-0.2, Vector3::UnitY()} *
                     Eigen::AngleAxisd{0.1, Vector3::UnitX()})
                        .toRotationMatrix();
  Matrix3 I;
  I << 0.016, 0.0005, -0.0004, 0.0005, 0.015, 0.0003, -0.0004, 0.0003, 0.012;
  const MassProperties& turret = *node("turret").mass;
  EXPECT_LT((turret.I_BBcm_B - R * I * R.transpose()).cwiseAbs().maxCoeff(), kRound);
  EXPECT_EQ(turret.I_BBcm_B, turret.I_BBcm_B.transpose());  // exactly symmetric
  EXPECT_EQ(turret.p_BBcm, Vector3(0.01, 0, 0.07));
}

TEST(ArmUrdf, PlacesJointsInTheirParent) {
  // shoulder: Rx(-90) takes y to -z and z to y; then Ry(0.2) takes x to (cos, 0, -sin) and z to (sin, 0,
  // cos).
  const Link& shoulder = *node("upper_arm").link;
  Matrix3 R;
  R.col(0) = Vector3(std::cos(0.2), 0, -std::sin(0.2));
  R.col(1) = Vector3(-std::sin(0.2), 0, -std::cos(0.2));
  R.col(2) = Vector3(0, 1, 0);
  EXPECT_LT((shoulder.M_PJ.linear() - R).cwiseAbs().maxCoeff(), kRound);
  EXPECT_EQ(Vector3{shoulder.M_PJ.translation()}, Vector3(0, 0.1, 0.14));
  EXPECT_TRUE(shoulder.M_JN.isApprox(Affine::Identity(), 0));
  for (const ModelNode& n : arm().nodes) {
    if (!n.link) continue;
    EXPECT_EQ(n.M_PN.matrix(), local_matrix(*n.link, n.link->value).matrix()) << n.name;
    EXPECT_LT((n.M_PN.matrix() - n.link->M_PJ.matrix()).cwiseAbs().maxCoeff(), kRound)
        << n.name;  // value is zero
  }
}

TEST(ArmUrdf, MakesLinksOfJoints) {
  // Kinds, axes, limits and mimic stand in the file.
  EXPECT_FALSE(node("base").link.has_value());
  const Link& waist = *node("turret").link;
  EXPECT_EQ(waist.kind, LinkKind::Pivot);
  EXPECT_EQ(waist.name, "waist");
  EXPECT_EQ(waist.limits[0].lower, -2.9);
  EXPECT_EQ(waist.limits[0].upper, 2.9);
  EXPECT_EQ(waist.value, LinkValue{0.0});
  const Link& roll = *node("wrist").link;
  EXPECT_EQ(roll.kind, LinkKind::Pivot);
  EXPECT_EQ(roll.limits[0].lower, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(roll.limits[0].upper, std::numeric_limits<double>::infinity());
  EXPECT_LT((node("hand").link->axis - Vector3(0, 0.6, 0.8)).norm(), kRound);
  EXPECT_EQ(node("palm").link->kind, LinkKind::Fixed);
  EXPECT_EQ(node("palm").link->value.size(), 0);
  const Link& grip = *node("finger_left").link;
  EXPECT_EQ(grip.kind, LinkKind::Slider);
  EXPECT_EQ(grip.limits[0].upper, 0.03);
  EXPECT_FALSE(grip.mimic.has_value());
  const Link& right = *node("finger_right").link;
  ASSERT_TRUE(right.mimic.has_value());
  EXPECT_EQ(right.mimic->source, "grip");
  EXPECT_EQ(right.mimic->multiplier, 1);
  EXPECT_EQ(right.mimic->offset, 0);
  for (const ModelNode& n : arm().nodes) {
    if (n.link) {
      EXPECT_EQ(problem_with(*n.link), "") << n.name;
    }
  }
}

TEST(ArmUrdf, KeepsDampingAndFriction) {
  // From <dynamics>; a missing friction is 0, a missing <dynamics> is nothing.
  ASSERT_TRUE(node("turret").dynamics.has_value());
  EXPECT_EQ(node("turret").dynamics->damping, 0.8);
  EXPECT_EQ(node("turret").dynamics->friction, 0.2);
  EXPECT_EQ(node("wrist").dynamics->friction, 0);
  EXPECT_FALSE(node("palm").dynamics.has_value());
}

TEST(ArmUrdf, PlacesCollisionShapes) {
  // shoulder_housing: Rx(90) turns the cylinder's z axis to -y. upper_arm: then Rz(0.1) turns -y to (sin,
  // -cos, 0).
  const ModelNode& turret = node("turret");
  ASSERT_EQ(turret.shapes.size(), 2u);
  const auto& housing = std::get<CylinderShape>(turret.shapes[1].geometry);
  EXPECT_EQ(housing.radius, 0.06);
  EXPECT_EQ(housing.length, 0.1);
  EXPECT_EQ(turret.shapes[1].X_BS.p, Vector3(0, 0.05, 0.14));
  EXPECT_LT((turret.shapes[1].X_BS.q * Vector3::UnitZ() - Vector3(0, -1, 0)).norm(), kRound);

  const Shape& upper = node("upper_arm").shapes.at(0);
  const auto& capsule = std::get<CapsuleShape>(upper.geometry);  // urdfdom alone loses it
  EXPECT_EQ(capsule.radius, 0.05);
  EXPECT_EQ(capsule.length, 0.34);
  EXPECT_LT((upper.X_BS.q * Vector3::UnitZ() - Vector3(std::sin(0.1), -std::cos(0.1), 0)).norm(), kRound);

  EXPECT_EQ(std::get<BoxShape>(node("forearm").shapes.at(0).geometry).size, Vector3(0.08, 0.30, 0.08));
  EXPECT_EQ(std::get<SphereShape>(node("wrist").shapes.at(0).geometry).radius, 0.045);
}

TEST(ArmUrdf, PlacesMeshes) {
  // pedestal: turned by 45 degrees about z. Both uses of a file share one mesh, which is read once.
  int reads = 0;
  LoadOptions options;
  options.mesh_reader = [&](const std::filesystem::path& file) {
    ++reads;
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh->triangles = {{0, 1, 2}};
    EXPECT_TRUE(exists(file));
    return Loaded<std::shared_ptr<const TriangleMesh>>{std::move(mesh), {}};
  };
  const Loaded<Model> loaded = load_urdf(PANTIN_SOURCE_DIR "/assets/arm.urdf", options);
  ASSERT_TRUE(loaded.value.has_value());
  EXPECT_EQ(reads, 2);
  const ModelNode& base = loaded.value->nodes[0];
  ASSERT_EQ(base.meshes.size(), 1u);
  EXPECT_EQ(base.meshes[0].name, "pedestal");
  const double h = std::sqrt(0.5);
  EXPECT_LT((base.meshes[0].M_NS * Vector3(1, 0, 0) - Vector3(h, h, 0)).norm(), kRound);
  const auto& collider = std::get<MeshShape>(base.shapes.at(0).geometry);
  EXPECT_EQ(collider.mesh, base.meshes[0].mesh);
  EXPECT_LT((base.shapes[0].X_BS.q * Vector3::UnitX() - Vector3(h, h, 0)).norm(), kRound);
  EXPECT_EQ(loaded.value->nodes[6].meshes.at(0).name, "flange");  // the visual has no name, the file has
}

TEST(ArmUrdf, WeighsWhatTheFileSays) {
  // The sum of the masses in the text.
  double mass = 0;
  for (const ModelNode& n : arm().nodes) {
    ASSERT_TRUE(n.mass.has_value()) << n.name;
    EXPECT_FALSE(problem_with(*n.mass).has_value()) << n.name;
    mass += n.mass->mass;
  }
  EXPECT_NEAR(mass, 19.6, 1e-14);
}

TEST(Urdf, ScalesMeshesAndKeepsMirrors) {
  // The scale of a collision stays with its shape; that of a visual goes into its matrix; signs are kept.
  LoadOptions options;
  options.mesh_reader = [](const std::filesystem::path&) {
    return Loaded<std::shared_ptr<const TriangleMesh>>{std::make_shared<TriangleMesh>(), {}};
  };
  const Loaded<Model> loaded = load_urdf(PANTIN_SOURCE_DIR "/tests/loaders/data/scaled.urdf", options);
  ASSERT_TRUE(loaded.value.has_value());
  const ModelNode& only = loaded.value->nodes.at(0);
  EXPECT_EQ(std::get<MeshShape>(only.shapes.at(0).geometry).scale, Vector3(0.5, -2, 3));
  Matrix3 M;  // Rz(90) diag(0.5, -2, 3)
  M << 0, 2, 0, 0.5, 0, 0, 0, 0, 3;
  EXPECT_LT((only.meshes.at(0).M_NS.linear() - M).cwiseAbs().maxCoeff(), kRound);
}

TEST(Urdf, ReadsEveryJointType) {
  // The five types that can be represented, with the axis that URDF gives where the file says none.
  const Loaded<Model> loaded = load_urdf(PANTIN_SOURCE_DIR "/tests/loaders/data/joint_types.urdf");
  ASSERT_TRUE(loaded.value.has_value());
  const auto& nodes = loaded.value->nodes;
  ASSERT_EQ(nodes.size(), 6u);
  EXPECT_EQ(nodes[1].link->kind, LinkKind::Pivot);
  EXPECT_EQ(nodes[1].link->axis, Vector3::UnitX());
  EXPECT_EQ(nodes[2].link->kind, LinkKind::Pivot);
  EXPECT_EQ(nodes[3].link->kind, LinkKind::Slider);
  EXPECT_LT((nodes[3].link->axis - Vector3(0, 0.6, 0.8)).norm(), kRound);  // written as 0 3 4
  EXPECT_EQ(nodes[4].link->kind, LinkKind::Fixed);
  EXPECT_EQ(nodes[5].link->kind, LinkKind::Free);
  EXPECT_EQ(nodes[5].link->value, zero_value(LinkKind::Free));
  EXPECT_LT((nodes[5].M_PN.linear() - Matrix3{Eigen::AngleAxisd{kPi / 2, Vector3::UnitZ()}}).norm(), kRound);
}

}  // namespace
}  // namespace pantin
