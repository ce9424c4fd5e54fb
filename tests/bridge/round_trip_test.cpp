// The heart of the bridge: whatever the hierarchy and whatever was done to it, node -> body -> node is the
// node.
#include <gtest/gtest.h>

#include <set>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::Stage;

/// Random hierarchies whose world matrices stay within bounds. A local is rotation * stretch * rotation with
/// singular values in [0.6, 1.6], mirrored one time in eight; what the product of a chain has beyond a
/// condition of 1e3 is taken out again by a local that leads back to a fresh matrix, so that the tolerance
/// can be one number.
class Forest {
 public:
  explicit Forest(std::uint64_t seed) : rng_{seed} {}

  double uniform(double from, double to) { return std::uniform_real_distribution<double>{from, to}(rng_); }
  int below(int count) { return std::uniform_int_distribution<int>{0, count - 1}(rng_); }
  Vector3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Quaternion rotation() {
    return Quaternion{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}.normalized();
  }

  Affine matrix(double least, double most) {
    Affine M = Affine::Identity();
    const Vector3 s{uniform(least, most), uniform(least, most), uniform(least, most)};
    M.linear() = rotation().toRotationMatrix() * s.asDiagonal() * rotation().toRotationMatrix();
    if (below(8) == 0) M.linear().col(below(3)) *= -1;
    M.translation() = vector(1);
    return M;
  }

  Affine local_under(const Affine& M_WP) {
    const Affine M_PN = matrix(0.6, 1.6);
    const Affine M_WN = M_WP * M_PN;
    const Eigen::JacobiSVD<Matrix3> svd{M_WN.linear()};
    const Vector3 s = svd.singularValues();
    const bool tame = s[0] < 30 && s[2] > 0.03 && M_WN.translation().norm() < 100;
    return tame ? M_PN : Affine{M_WP.inverse() * matrix(0.6, 1.6)};
  }

  MassProperties mass() {
    MassProperties m =
        test::box_mass(uniform(0.1, 10), {uniform(0.1, 1), uniform(0.1, 1), uniform(0.1, 1)}, vector(0.5));
    return in_frame({vector(0.2), rotation()}, m);
  }

  std::mt19937_64& rng() { return rng_; }

 private:
  std::mt19937_64 rng_;
};

/// Condition of a world matrix: how much relative error its inverse may make of round-off.
double condition(const Affine& M) {
  const Eigen::JacobiSVD<Matrix3> svd{M.linear()};
  return svd.singularValues()[0] / svd.singularValues()[2];
}

class Hierarchy {
 public:
  Hierarchy(std::uint64_t seed, int nodes, double chain) : forest{seed} {
    for (int k = 0; k < nodes; ++k) {
      const bool extend = !ids.empty() && forest.uniform(0, 1) < chain;
      const NodeId parent = extend ? ids.back() : any_or_root();
      const NodeId id =
          stage.scene.create(parent, "n" + std::to_string(k), forest.local_under(stage.scene.world(parent)));
      if (forest.below(4) != 0) stage.bridge.set_node_body(id, {.mass = forest.mass()});
      if (forest.below(3) == 0) stage.scene.set_link(id, link_of(id));
      ids.push_back(id);
    }
  }

  NodeId any() { return ids[static_cast<std::size_t>(forest.below(static_cast<int>(ids.size())))]; }
  NodeId any_or_root() { return ids.empty() || forest.below(5) == 0 ? stage.scene.root() : any(); }
  Scope scope() { return forest.below(2) == 0 ? Scope::Node : Scope::Subtree; }

  /// A link at whose present value the node is where it is.
  Link link_of(NodeId id) {
    const LinkKind kind =
        std::array{LinkKind::Pivot,  LinkKind::Slider,      LinkKind::Ball,
                   LinkKind::Fixed,  LinkKind::Cylindrical, LinkKind::Universal,
                   LinkKind::Planar, LinkKind::Screw,       LinkKind::Free}[static_cast<std::size_t>(
            forest.below(9))];
    Link link{.kind = kind, .axis = forest.vector(1).normalized(), .value = zero_value(kind)};
    link.axis2 = link.axis.cross(forest.vector(1)).normalized();
    link.pitch = 0.1;
    link.M_PJ = Affine{Eigen::Translation3d{forest.vector(1)}} * Affine{forest.rotation()};
    link.M_JN = link.M_PJ.inverse() * stage.scene.local(id);
    return link;
  }

  /// One random verb. Teleports and reparenting move what they say; all others leave every world matrix
  /// alone.
  void act() {
    const NodeId id = any();
    Bridge& bridge = stage.bridge;
    switch (forest.below(9)) {
      case 0:
      case 1:
      case 2:
        static_cast<void>(bridge.hand_over(id, scope()));
        break;
      case 3:
        static_cast<void>(bridge.take_back(id, scope()));
        break;
      case 4:
        static_cast<void>(bridge.follow(id, scope()));
        break;
      case 5:
        static_cast<void>(bridge.fix(id, scope()));
        break;
      case 6:
        bridge.release(id, scope());
        break;
      case 7: {
        const NodeId parent = any_or_root();
        if (!stage.scene.is_above(id, parent) && condition(stage.scene.world(parent)) < 1e3) {
          static_cast<void>(bridge.reparent(id, parent));
        }
        break;
      }
      default: {  // a rigid move of the world matrix
        const Affine move = Affine{Eigen::Translation3d{forest.vector(1)}} * Affine{forest.rotation()};
        if (move_is_tame(id, move)) static_cast<void>(bridge.teleport(id, move * stage.scene.world(id)));
      }
    }
  }

  bool move_is_tame(NodeId id, const Affine& move) {
    return (move * stage.scene.world(id)).translation().norm() < 100;
  }

  /// Greatest relative difference between what a body and residual say and the world matrix of its node.
  double greatest_difference() {
    double worst = 0;
    for (const NodeId id : stage.bridge.bound()) {
      worst = std::max(worst, test::relative_difference(test::by_body(stage, id), stage.scene.world(id)));
    }
    return worst;
  }

  Forest forest;
  Stage stage{};
  std::vector<NodeId> ids{};
};

// The tolerance: a world matrix is the product of up to 50 locals, each product rounds to 2^-53 times the
// product of the norms, and a local that leads back under a parent of condition 1e3 may have lost that much;
// 50 * 1e-16 * some of 1e3 is the bound 1e-12.
constexpr double kExact = 1e-12;

TEST(RoundTrip, OfAHundredThousandRandomHierarchiesIsExact) {
  // M_WN = X_WB * M_BN by construction of the residual, before, between and after changes of drive in any
  // order; scale, shear, mirrors and centres of gravity off the origin included, every 500th tree a chain
  // down to depth 50. Nothing steps, so every difference is conversion.
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 100'000; ++seed) {
    const bool deep = seed % 500 == 0;
    Hierarchy tree{seed, deep ? 50 : 2 + static_cast<int>(seed % 5), deep ? 0.98 : 0.7};
    for (int k = 0; k < (deep ? 12 : 4); ++k) tree.act();
    ASSERT_LT(tree.greatest_difference(), kExact) << "seed " << seed;
    compared += tree.stage.bridge.bound().size();
  }
  EXPECT_GT(compared, 100'000U);
}

TEST(RoundTrip, WritesBackTheMatrixThatEachBodyAndResidualGive) {
  // After bodies have moved (freely: no forces, random velocities), every simulated node's world matrix in
  // the scene is X_WB * M_BN again: local matrices were divided by the fresh matrices of their parents.
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Hierarchy tree{2'000'000 + seed, 12, 0.8};
    for (int k = 0; k < 6; ++k) tree.act();
    for (const NodeId id : tree.stage.bridge.bound()) {
      if (tree.stage.bridge.drive_of(id) != Drive::Physics) continue;
      const BodyId body = tree.stage.bridge.body_of(id);
      tree.stage.physics.set_velocity(body, tree.forest.vector(1), tree.forest.vector(1));
    }
    const AdvanceReport report = tree.stage.bridge.advance(0.05);
    ASSERT_TRUE(report.last.ok()) << seed << " " << report.last.message;
    EXPECT_LT(tree.greatest_difference(), kExact) << seed;
  }
}

TEST(RoundTrip, OfChangesOfDriveLeavesEveryWorldMatrixAlone) {
  // Handing over, taking back, following, fixing and releasing without time passing moves nothing: each world
  // matrix is the one it was, to the last bit.
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Hierarchy tree{3'000'000 + seed, 10, 0.8};
    const std::vector<Affine> before = test::locals(tree.stage.scene);
    for (int k = 0; k < 10; ++k) {
      const NodeId id = tree.any();
      const Scope scope = tree.scope();
      switch (tree.forest.below(5)) {
        case 0:
        case 1:
          static_cast<void>(tree.stage.bridge.hand_over(id, scope));
          break;
        case 2:
          static_cast<void>(tree.stage.bridge.take_back(id, scope));
          break;
        case 3:
          static_cast<void>(tree.stage.bridge.follow(id, scope));
          break;
        default:
          tree.stage.bridge.release(id, scope);
      }
      ASSERT_LT(tree.greatest_difference(), kExact) << seed;
    }
    EXPECT_TRUE(test::same_bits(before, test::locals(tree.stage.scene))) << seed;
  }
}

TEST(RoundTrip, IdleStepsChangeNoBit) {
  // A thousand steps of bodies at rest without forces: no local matrix changes by one bit, whatever stands
  // above them, be it simulated, followed, fixed or unbound.
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Hierarchy tree{4'000'000 + seed, 15, 0.8};
    for (int k = 0; k < 8; ++k) tree.act();
    tree.stage.scene.update();
    static_cast<void>(tree.stage.bridge.advance(1.0 / 240));  // projects velocities of what was joined anew
    const std::vector<Affine> before = test::locals(tree.stage.scene);
    for (int k = 0; k < 1000; ++k) static_cast<void>(tree.stage.bridge.advance(1.0 / 240));
    EXPECT_TRUE(test::same_bits(before, test::locals(tree.stage.scene))) << seed;
  }
}

}  // namespace
}  // namespace pantin
